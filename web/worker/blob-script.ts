import type { BlobScript } from './in-worker.ts';

/** The script of both workers as text, and the compiled solver that it is sent; loaded only where a worker's own file does not start. */
export async function blobScript(): Promise<BlobScript> {
  const [{ BLOB_WORKER }, { moduleInside }] = await Promise.all([
    import('./blob-worker.generated.ts'),
    import('../../wasm/ts/index.ts'),
  ]);
  return { script: BLOB_WORKER, wasm: await moduleInside() };
}
