import type { PlaneMesh } from './mesh-shape.ts';

/** A closed triangle mesh in space: scene space, Y up. */
interface Slab {
  /** 2n×3: the lower face's n vertices, then the upper face's, in the plane mesh's order. */
  readonly positions: Float32Array;
  readonly triangles: Uint32Array;
}

/** A plane mesh as a slab of a thickness around z = 0: two faces, and walls along the border. */
export function slab({ positions, triangles, border }: PlaneMesh, thickness: number): Slab {
  const n = positions.length / 2;
  const out = new Float32Array(6 * n);
  for (let i = 0; i < n; i++) {
    const [x, y] = [positions[2 * i] as number, positions[2 * i + 1] as number];
    out.set([x, y, -thickness / 2], 3 * i);
    out.set([x, y, thickness / 2], 3 * (n + i));
  }
  const faces: number[] = [];
  /** Directed edges of the plane mesh: a wall stands to the right of its triangle. */
  const directed = new Set<number>();
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t] as number, triangles[t + 1] as number, triangles[t + 2] as number];
    faces.push(a, c, b, n + a, n + b, n + c);
    directed
      .add(a * n + b)
      .add(b * n + c)
      .add(c * n + a);
  }
  for (let i = 0; i < border.length; i += 2) {
    let [a, b] = [border[i] as number, border[i + 1] as number];
    if (!directed.has(a * n + b)) [a, b] = [b, a];
    faces.push(a, b, n + b, a, n + b, n + a);
  }
  return { positions: out, triangles: Uint32Array.from(faces) };
}
