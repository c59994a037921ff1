import type { NumberList } from './number-list.ts';

interface Attribute {
  /** The file's rows of `width` numbers. */
  readonly list: NumberList<Float32Array>;
  readonly width: number;
  /** Which row each corner names, from 1; 0 stands for none. */
  readonly numbers: NumberList<Uint32Array>;
  /** Which vertex each corner is. */
  readonly corners: NumberList<Uint32Array>;
  readonly vertices: number;
}

interface VertexRows {
  /** One row a vertex, unless some vertex has none, or several. */
  readonly rows: Float32Array | undefined;
  /** Corners that name a row which is not there. */
  readonly missing: number;
  /** Vertices whose corners name rows of different numbers. */
  readonly differing: number;
}

/** What corners name, brought to vertices. */
export function perVertex({ list, width, numbers, corners, vertices }: Attribute): VertexRows {
  const count = list.length / width;
  const chosen = new Uint32Array(vertices);
  const isSplit = new Uint8Array(vertices);
  let [missing, without, differing] = [0, 0, 0];
  for (let i = 0; i < numbers.length; i++) {
    const [vertex, number] = [corners.at(i), numbers.at(i)];
    const before = chosen[vertex] as number;
    if (number > count) missing++;
    else if (number === 0) without++;
    else if (before === 0) chosen[vertex] = number;
    else if (before !== number && isSplit[vertex] === 0 && !areSame(list, (before - 1) * width, (number - 1) * width, width)) {
      isSplit[vertex] = 1;
      differing++;
    }
  }
  if (missing > 0 || without > 0 || differing > 0 || numbers.length === 0) return { rows: undefined, missing, differing };
  const rows = new Float32Array(vertices * width);
  for (let vertex = 0; vertex < vertices; vertex++) {
    const number = chosen[vertex] as number;
    // A vertex of no face: any unit vector will do for a normal, any place for a texture coordinate.
    for (let k = 0; k < width; k++) rows[vertex * width + k] = number === 0 ? Number(k === 1) : list.at((number - 1) * width + k);
  }
  return { rows, missing, differing };
}

function areSame(list: NumberList<Float32Array>, a: number, b: number, width: number): boolean {
  // NaN is no other direction than NaN: both are replaced.
  for (let k = 0; k < width; k++) if (!Object.is(list.at(a + k), list.at(b + k)) && list.at(a + k) !== list.at(b + k)) return false;
  return true;
}
