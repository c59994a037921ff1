import type { BakeOptions, BakeShape, BakeWarning, BodyData } from '../../wasm/ts/types.ts';
import { type BakeReply, type BakeRequest, packError } from './messages.ts';

/** The worker's side of the wire: a worker's global scope, or one end of a channel. */
export interface BakePort {
  postMessage(message: BakeReply, transfer: Transferable[]): void;
  addEventListener(type: 'message', listener: (event: MessageEvent<BakeRequest>) => void): void;
}

/** Answers bake requests on a port with what `bake` gives, and says that it is ready. Never throws: errors go over the wire. */
export function answerBake(port: BakePort, bake: (shape: BakeShape, options: BakeOptions) => Promise<BodyData>): void {
  port.addEventListener('message', async ({ data }) => {
    if (data?.type !== 'bake') return;
    try {
      const onProgress = (part: number) => port.postMessage({ type: 'progress', part }, []);
      const onWarning = (warning: BakeWarning) => port.postMessage({ type: 'warning', warning }, []);
      const { mesh, ...body } = await bake(data.shape, { ...data.options, onProgress, onWarning });
      const made = 'triangles' in data.shape ? undefined : mesh;
      const arrays = [body.voxels, body.centers, body.distances, body.spheres, ...(made ? [made.positions, made.triangles] : [])];
      port.postMessage({ type: 'body', body: made ? { ...body, mesh: made } : body }, [
        ...new Set(arrays.map((array) => array.buffer as ArrayBuffer)),
      ]);
    } catch (error) {
      port.postMessage({ type: 'error', error: packError(error) }, []);
    }
  });
  port.postMessage({ type: 'ready' }, []);
}
