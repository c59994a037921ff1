import type { ScriptText } from './in-worker.ts';

/** The script of both workers as text, and the compiled solver to send to it: fetched only where no worker starts from a file. */
export async function scriptText(): Promise<ScriptText> {
  const [{ BLOB_WORKER }, { moduleInside }] = await Promise.all([
    import('./blob-worker.generated.ts'),
    import('../../wasm/ts/index.ts'),
  ]);
  return { script: BLOB_WORKER, wasm: await moduleInside() };
}
