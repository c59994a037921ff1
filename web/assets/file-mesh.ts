/** What the readers of OBJ and PLY share: the mesh that they give, lists that grow, and errors that name the line. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { MAX_VERTICES } from './concatenate.ts';

/** A mesh as simple files hold it: one list of vertices, in the order of the file. */
export interface FileMesh {
  /** n×3. */
  readonly positions: Float32Array;
  /** m×3, counter-clockwise seen from outside; none for a cloud of points. */
  readonly triangles: Uint32Array;
  /** n×3, of unit length, where the file has one normal a vertex. */
  readonly normals: Float32Array | undefined;
  /** n×2, from the top left as in glTF, where the file has one pair a vertex. */
  readonly uvs: Float32Array | undefined;
  /** What was left out, as sentences. */
  readonly warnings: readonly string[];
}

/** More triangles would need more memory than a page has. */
const MAX_TRIANGLES = 1 << 25;

/** A typed array that grows. Its length is bounded by what the file holds, since every number pushed was read from it. */
export class NumberList<T extends Float32Array | Uint32Array> {
  length = 0;
  #array: T;

  constructor(initial: T) {
    this.#array = initial;
  }

  push(value: number): void {
    if (this.length === this.#array.length) {
      const larger = new (this.#array.constructor as new (length: number) => T)(Math.max(this.length * 2, 1024));
      larger.set(this.#array);
      this.#array = larger;
    }
    this.#array[this.length++] = value;
  }

  at(index: number): number {
    return this.#array[index] as number;
  }

  /** Exactly what was pushed. */
  finish(): T {
    return this.#array.slice(0, this.length) as T;
  }
}

/** Throws 'mesh-too-large' where a file has more vertices or triangles than can be held. */
export function checkCounts(vertices: number, triangles: number): void {
  if (vertices <= MAX_VERTICES && triangles <= MAX_TRIANGLES) return;
  throw new HandlebodyError('mesh-too-large', {
    message: `The file has ${vertices} vertices and ${triangles} triangles or more; at most ${MAX_VERTICES} and ${MAX_TRIANGLES} can be read.`,
    remedy: 'Simplify the model, or use one of its parts.',
  });
}

/** Scales rows of three to unit length; undefined when one has none, or is not finite. */
export function unitRows(rows: Float32Array): Float32Array | undefined {
  for (let i = 0; i < rows.length; i += 3) {
    const length = Math.hypot(rows[i] as number, rows[i + 1] as number, rows[i + 2] as number);
    if (!(length > 1e-30 && length < Number.POSITIVE_INFINITY)) return undefined;
    for (let axis = 0; axis < 3; axis++) rows[i + axis] = (rows[i + axis] as number) / length;
  }
  return rows;
}
