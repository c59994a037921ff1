import { Canvas } from '@react-three/fiber';
import { StrictMode, Suspense, useState } from 'react';
import { createRoot } from 'react-dom/client';
import { Dog } from './dog.tsx';

function App() {
  const [paw, setPaw] = useState('');
  return (
    <>
      <div style={{ height: '80vh' }}>
        <Canvas camera={{ position: [1.2, 0.9, 2.4], fov: 35 }} onCreated={({ camera }) => camera.lookAt(0, 0.4, 0)}>
          <hemisphereLight args={['white', 'tan', 3]} />
          <Suspense>
            <Dog
              onPaw={(place) =>
                setPaw(
                  place
                    .toArray()
                    .map((x) => x.toFixed(3))
                    .join(),
                )
              }
            />
          </Suspense>
        </Canvas>
      </div>
      <output>The front right paw is at {paw}.</output>
    </>
  );
}

createRoot(document.getElementById('root') as HTMLElement).render(
  <StrictMode>
    <App />
  </StrictMode>,
);
