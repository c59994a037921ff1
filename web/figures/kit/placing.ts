import type { PlaneMesh } from '../../models/mesh-shape.ts';
import { inside, type Shape } from '../../models/shape.ts';
import { bone, type Handle, type Place, point, toThousandths } from './plane-handles.ts';

/** A bone is at most as long as this. */
const LONGEST_BONE = 0.36;
/** And keeps this far from the border. */
const CLEARANCE = 0.06;

/** The interior vertex farthest from all handles, at rest; any where there is no handle. */
export function emptiest({ positions, border }: PlaneMesh, handles: readonly Handle[]): Place {
  const rim = new Set(border);
  let [best, farthest] = [[positions[0] as number, positions[1] as number] as Place, -1];
  for (let i = 0; i < positions.length; i += 2) {
    if (rim.has(i / 2)) continue;
    const [x, y] = [positions[i] as number, positions[i + 1] as number];
    let least = Infinity;
    for (const { rest, end } of handles)
      for (const [px, py] of end ? [rest, end] : [rest]) least = Math.min(least, Math.hypot(x - px, y - py));
    if (least > farthest) [best, farthest] = [[x, y], least];
  }
  return [toThousandths(best[0]), toThousandths(best[1])];
}

/** Points far from each other. */
export function spread(mesh: PlaneMesh, count: number): Handle[] {
  // The first is as far as can be from just any vertex.
  const handles = [point(...emptiest(mesh, [point(...emptiest(mesh, []))]))];
  while (handles.length < count) handles.push(point(...emptiest(mesh, handles)));
  return handles;
}

/** A bone that ends at a place, from where there is most room inside the outline; none where there is no room. */
export function boneIn(outline: Shape, end: Place): Handle | undefined {
  let [start, longest] = [end, 0];
  for (let k = 0; k < 32; k++) {
    const [c, s] = [Math.cos((k * Math.PI) / 16), Math.sin((k * Math.PI) / 16)];
    const isFree = (length: number) => inside(outline, end[0] + c * length, end[1] + s * length);
    let length = 0;
    while (length < LONGEST_BONE && isFree(length + CLEARANCE)) length += 0.02;
    if (length > longest) [longest, start] = [length, [toThousandths(end[0] + c * length), toThousandths(end[1] + s * length)]];
  }
  return longest > 0 ? bone(start, end) : undefined;
}

/** Where the point of the shape was at rest that is now drawn at a place; nothing beside the shape. */
export function restOf({ positions, triangles }: PlaneMesh, drawn: ArrayLike<number>, [x, y]: Place): Place | undefined {
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [2 * (triangles[t] as number), 2 * (triangles[t + 1] as number), 2 * (triangles[t + 2] as number)];
    const [ax, ay] = [drawn[a] as number, drawn[a + 1] as number];
    const [ux, uy] = [(drawn[b] as number) - ax, (drawn[b + 1] as number) - ay];
    const [vx, vy] = [(drawn[c] as number) - ax, (drawn[c + 1] as number) - ay];
    const area = ux * vy - uy * vx;
    const s = ((x - ax) * vy - (y - ay) * vx) / area;
    const r = (ux * (y - ay) - uy * (x - ax)) / area;
    if (!(s >= 0 && r >= 0 && s + r <= 1)) continue;
    const at = (k: 0 | 1) =>
      (1 - s - r) * (positions[a + k] as number) + s * (positions[b + k] as number) + r * (positions[c + k] as number);
    return [at(0), at(1)];
  }
  return undefined;
}
