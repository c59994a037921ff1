/** A sweater that ends the bust neatly: made for this project from the base mesh's own surface. */
import { between } from './color.mjs';
import { aboveNeckline, bustFaces } from './geometry.mjs';
import { carry, clip, fixed, partOf, subdivide } from './part.mjs';
import { addRim, boundary, raise } from './shell.mjs';

/** @typedef {import('./source.mjs').FaceSource} FaceSource */
/** @typedef {import('./part.mjs').Part} Part */

/**
 * A plain sweater: the bust's own surface, raised, cut by the neckline above and by a rounded curve below, and closed.
 * @param {FaceSource} source
 * @returns {Part}
 */
export function sweaterPart(source) {
  let part = subdivide(
    source,
    partOf(
      source,
      bustFaces(source).filter((face) => face.v.every((id) => (source.positions[3 * id + 1] ?? 0) < 5.95)),
    ),
  );
  const p = carry(part, source.positions, true);
  part = clip(
    part,
    part.vertices.map((_, i) => {
      const [x, y] = [p[3 * i] ?? 0, p[3 * i + 1] ?? 0];
      const below = Math.min(0, y - 5.45);
      return Math.min(-aboveNeckline(p, i), 1 - (x / 1.06) ** 2 - (below / 0.66) ** 2);
    }),
  );
  const q = carry(part, source.positions, true);
  const neckline = part.vertices.map((_, i) => -aboveNeckline(q, i));
  // A ribbed collar stands a little higher than the rest.
  raise(source, part, (i) => 0.03 + 0.022 * between(0.11, 0.085, neckline[i] ?? 0));
  addRim(source, part, 0.055);
  for (const vertex of part.vertices) [vertex.u, vertex.v] = [0, 0];
  // Free every vertex from the base: the face units leave it alone.
  const rest = carry(part, source.positions, true);
  part.vertices = part.vertices.map(({ group = 0 }, i) => ({
    ...fixed(rest[3 * i] ?? 0, rest[3 * i + 1] ?? 0, rest[3 * i + 2] ?? 0, 0, 0),
    group,
  }));
  const bottom = part.vertices.push({ ...fixed(0, 5, 0.2, 0, 0), group: 2 }) - 1;
  for (const [i, j] of boundary(source, part)) {
    if (aboveNeckline(rest, i) > -0.12) continue;
    const [from, to] = [i, j].map(
      (k) => part.vertices.push({ ...fixed(rest[3 * k] ?? 0, rest[3 * k + 1] ?? 0, rest[3 * k + 2] ?? 0, 0, 0), group: 2 }) - 1,
    );
    part.triangles.push(to ?? 0, from ?? 0, bottom);
  }
  return part;
}
