import type { BakeOptions, BakeShape, BakeWarning, BodyData } from '../../wasm/ts/types.ts';
import { packError, type WorkReply, type WorkRequest } from './messages.ts';

/** The worker's side of the wire: a worker's global scope, or one end of a channel. */
export interface WorkPort {
  postMessage(message: unknown, transfer: Transferable[]): void;
  addEventListener(type: 'message', listener: (event: MessageEvent) => void): void;
}

interface Listener {
  onProgress(part: number): void;
  onWarning(warning: BakeWarning): void;
}

/** An answer, and those of its arrays that are handed over instead of copied. */
interface Answered<Answer> {
  readonly answer: Answer;
  readonly transfer: readonly ArrayBufferView[];
}

/**
 * Answers questions on a port by `work`, whose transfer goes along with its answer, and says that it is ready. Never throws: errors go over
 * the wire.
 */
export function answer<Question, Answer>(
  port: WorkPort,
  work: (question: Question, listener: Listener, wasm: WebAssembly.Module | undefined) => Promise<Answered<Answer>>,
): void {
  const reply = (message: WorkReply<Answer>, transfer: Transferable[] = []) => port.postMessage(message, transfer);
  const listener: Listener = {
    onProgress: (part) => reply({ type: 'progress', part }),
    onWarning: (warning) => reply({ type: 'warning', warning }),
  };
  port.addEventListener('message', async ({ data }: MessageEvent<WorkRequest<Question>>) => {
    if (data?.type !== 'work') return;
    try {
      const { answer, transfer } = await work(data.question, listener, data.wasm);
      reply({ type: 'done', answer }, [...new Set(transfer.map(({ buffer }) => buffer as ArrayBuffer))]);
    } catch (error) {
      reply({ type: 'error', error: packError(error) });
    }
  });
  void holdLife().then((life) => reply({ type: 'ready', life }));
}

/**
 * Holds a lock of its own for as long as the worker lives, and gives its name: the browser takes it back however the worker ends, and nothing
 * else tells the page of one that was killed. None where there are no locks.
 */
function holdLife(): Promise<string | undefined> {
  return new Promise((resolve) => {
    const name = `handlebody ${Math.random()}`;
    const hold = () => {
      resolve(name);
      return new Promise<never>(() => {});
    };
    const locks = (globalThis.navigator as Navigator | undefined)?.locks;
    if (locks) locks.request(name, hold).catch(() => resolve(undefined));
    else resolve(undefined);
  });
}

/** Options that can be posted; the rest act on the page's side. */
export type PostedBakeOptions = Omit<BakeOptions, 'signal' | 'onProgress' | 'onWarning'>;

export interface BakeQuestion {
  readonly shape: BakeShape;
  readonly options: PostedBakeOptions;
}

/** The answer that `bake` gives to a question, and what of it is handed over: all that has arrays of its own. */
export async function bakeAnswer(
  { shape, options }: BakeQuestion,
  listener: Listener,
  bake: (shape: BakeShape, options: BakeOptions) => Promise<BodyData>,
): Promise<Answered<BodyData>> {
  const body = await bake(shape, { ...options, ...listener });
  const { mesh, voxels, centers, distances, spheres, sphereAxes, skeleton } = body;
  const arrays = [
    mesh.positions,
    mesh.triangles,
    voxels,
    centers,
    distances,
    spheres,
    sphereAxes,
    ...Object.values(skeleton ?? {}),
  ];
  return { answer: body, transfer: arrays.filter((array) => ArrayBuffer.isView(array)) };
}

/** Answers with what `bake` gives. */
export function answerBake(port: WorkPort, bake: (shape: BakeShape, options: BakeOptions) => Promise<BodyData>): void {
  answer<BakeQuestion, BodyData>(port, (question, listener) => bakeAnswer(question, listener, bake));
}
