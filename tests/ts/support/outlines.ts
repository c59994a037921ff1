/** What is left of directed edges when those that run both ways cancel: however faces are cut into triangles, it is the same. */
function netEdges(faces: Iterable<readonly number[]>): Record<string, number> {
  const net: Record<string, number> = {};
  for (const face of faces) {
    face.forEach((from, i) => {
      const to = face[(i + 1) % face.length] as number;
      if (from === to) return;
      const key = `${Math.min(from, to)} ${Math.max(from, to)}`;
      net[key] = (net[key] ?? 0) + (from < to ? 1 : -1);
    });
  }
  return Object.fromEntries(Object.entries(net).filter(([, count]) => count !== 0));
}

/** Of faces: how many triangles they make, and their outlines. */
export const outlinesOf = (faces: readonly (readonly number[])[]) => ({
  triangles: faces.reduce((sum, { length }) => sum + length - 2, 0),
  edges: netEdges(faces),
});

/** The same of triangles, as the readers give them. */
export function outlines(triangles: ArrayLike<number>): ReturnType<typeof outlinesOf> {
  const list = Array.from(triangles);
  return outlinesOf(Array.from({ length: list.length / 3 }, (_, t) => list.slice(3 * t, 3 * t + 3)));
}
