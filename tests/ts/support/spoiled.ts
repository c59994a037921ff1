// Meshes as they come: with split vertices, flat and doubled triangles or tetrahedra, and vertices that nothing uses.
import type { random } from './scattered.ts';

export interface MadeMesh {
  readonly positions: readonly number[];
  readonly dimension: 2 | 3;
  readonly corners: 3 | 4;
  readonly simplices: readonly number[];
}

export interface SpoiledMesh extends MadeMesh {
  /** For each vertex the one of the sound mesh that it is a copy of, or −1. */
  readonly copyOf: readonly number[];
  /** Vertices that only flat simplices use, halfway between two of the sound mesh. */
  readonly halfway: readonly { readonly vertex: number; readonly between: readonly [number, number] }[];
  readonly flat: number;
  readonly doubled: number;
  readonly unused: number;
}

export interface Defects {
  readonly split?: boolean;
  readonly flat?: boolean;
  /** Turned round, too, by chance. */
  readonly doubled?: boolean | 'not turned';
  readonly unused?: boolean;
}

/** The mesh as the solver takes it. */
export const asSimplexMesh = ({ positions, dimension, corners, simplices }: MadeMesh) => ({
  positions,
  dimension,
  ...(corners === 3 ? { triangles: simplices } : { tetrahedra: simplices }),
});

/** Brings defects into a sound mesh, at random places and in random order. */
export function spoil(mesh: MadeMesh, next: ReturnType<typeof random>, defects: Defects): SpoiledMesh {
  const { dimension, corners } = mesh;
  const positions: number[] = [];
  const copyOf: number[] = [];
  const halfway: { vertex: number; between: readonly [number, number] }[] = [];
  const list: number[][] = [];
  const count = { flat: 0, doubled: 0, unused: 0 };
  const chance = (part: number) => next.number() < 2 * part - 1;
  const place = (v: number) => mesh.positions.slice(v * dimension, (v + 1) * dimension);
  const add = (at: readonly number[], of: number) => {
    positions.push(...at);
    return copyOf.push(of) - 1;
  };
  // −0 is 0.
  const copy = (v: number) =>
    add(
      place(v).map((x) => (x === 0 && chance(0.5) ? -0 : x)),
      v,
    );
  const last = new Map<number, number>();
  const corner = (v: number) => {
    const known = last.get(v);
    if (known !== undefined && !(defects.split && chance(0.4))) return known;
    const made = copy(v);
    last.set(v, made);
    return made;
  };
  for (let s = 0; s < mesh.simplices.length; s += corners) {
    const own = mesh.simplices.slice(s, s + corners);
    const [a = 0, b = 0] = own;
    list.push(own.map(corner));
    if (defects.doubled && chance(0.3)) {
      const again = own.map((v) => (defects.split ? corner(v) : (last.get(v) as number)));
      list.push(
        defects.doubled === 'not turned' || chance(0.5) ? again : [again[1] as number, again[0] as number, ...again.slice(2)],
      );
      count.doubled++;
    }
    const known = own.map((v) => last.get(v) as number);
    if (defects.flat && chance(0.3)) {
      list.push([known[0] as number, chance(0.5) ? (known[0] as number) : copy(a), ...known.slice(2)]);
      count.flat++;
    }
    if (defects.flat && chance(0.2)) {
      const between = add(
        place(a).map((x, axis) => (x + (place(b)[axis] as number)) / 2),
        -1,
      );
      list.push([known[0] as number, known[1] as number, between, ...known.slice(3)]);
      // A tetrahedron with three corners on an edge has no volume either.
      halfway.push({ vertex: between, between: [a, b] });
      count.flat++;
    }
    if (defects.unused && chance(0.2)) {
      const wild = [Number.NaN, Number.POSITIVE_INFINITY, 1e300, 1e6 * next.number()];
      add(Array(dimension).fill(wild[Math.abs(Math.round(3 * next.number()))]), -1);
      count.unused++;
    }
  }
  // Vertices in another order, simplices too.
  const order = next.permutation(copyOf.length);
  const number = new Array<number>(order.length);
  order.forEach((from, to) => {
    number[from] = to;
  });
  const simplices = next.permutation(list.length).flatMap((s) => (list[s] as number[]).map((v) => number[v] as number));
  return {
    positions: order.flatMap((from) => positions.slice(from * dimension, (from + 1) * dimension)),
    dimension,
    corners,
    simplices,
    copyOf: order.map((from) => copyOf[from] as number),
    halfway: halfway.map(({ vertex, between }) => ({ vertex: number[vertex] as number, between })),
    ...count,
  };
}
