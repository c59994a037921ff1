/** What made a reader fail once, as tests/fuzz/parsers made it small: each file's name begins with its target's. */
import { readdirSync, readFileSync } from 'node:fs';
import { expect, it, vi } from 'vitest';
import { load } from '../../wasm/ts/index.ts';
import * as assets from '../../web/assets/index.ts';
import { parseHandles } from '../../web/cli/handles.ts';
import { faultOf } from '../fuzz/parsers/fault.mjs';
import { targetsOf } from '../fuzz/parsers/targets.mjs';

const folder = new URL('parsers/', import.meta.url);
const files = readdirSync(folder);
const targets = await targetsOf({ assets, parseHandles, load });
vi.spyOn(console, 'warn').mockImplementation(() => {});

it.each(files)('%s is read, or refused by a typed error', async (file) => {
  const target = targets[file.split('-')[0] ?? ''];
  expect(target, 'a target of this name').toBeDefined();
  const fault = await (async () => target?.read(new Uint8Array(readFileSync(new URL(file, folder)))))().then(
    () => undefined,
    faultOf,
  );
  expect(fault).toBeUndefined();
});
