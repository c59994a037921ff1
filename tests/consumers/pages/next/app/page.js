// @ts-nocheck: it is bundled as JavaScript, as a user would write it.
'use client';
import { useEffect, useRef } from 'react';
import { show } from '../capsule.js';

export default function Page() {
  const main = useRef(null);
  useEffect(() => {
    show(main.current);
  }, []);
  return <main ref={main} />;
}
