/** Which of a mesh's triangles three.js draws: its draw range, its groups, its materials. */

import type { BufferGeometry, Material, MeshStandardMaterial, Points, Mesh as ThreeMesh } from 'three';
import type { DrawnRun } from '../assets/drawn-corners.ts';

/** Undefined where all is drawn. `hidden` counts groups of materials that are not visible as well. */
export function drawnRuns({ geometry, material }: ThreeMesh | Points, hidden: boolean): DrawnRun[] | undefined {
  const whole = { start: 0, count: geometry.index?.count ?? geometry.getAttribute('position').count };
  const range = both(whole, geometry.drawRange);
  if (!Array.isArray(material)) return range.count < whole.count ? [range] : undefined;
  const isDrawn = (each: Material | undefined) => each && (hidden || each.visible);
  return union(
    geometry.groups.filter(({ materialIndex = 0 }) => isDrawn(material[materialIndex])).map((group) => both(range, group)),
  );
}

/** Whether no material shows anything of the mesh. */
export function isInvisible({ material }: ThreeMesh | Points): boolean {
  return [material].flat().every((each) => !each?.visible);
}

/** Whether the graphics card moves its vertices by a picture. */
export function isDisplaced({ material }: ThreeMesh | Points): boolean {
  return [material].flat().some((each) => {
    const { displacementMap, displacementScale = 1 } = (each ?? {}) as Partial<MeshStandardMaterial>;
    return displacementMap && displacementScale !== 0;
  });
}

/** A reason why the vertices that are drawn are not those that a program can see; undefined where they are. */
export function unreadable(geometry: BufferGeometry): string | undefined {
  if ('isInstancedBufferGeometry' in geometry) return 'whose copies are placed by the graphics card';
  if ('isGLBufferAttribute' in geometry.getAttribute('position')) return 'whose positions only the graphics card has';
  return undefined;
}

function both(a: DrawnRun, b: DrawnRun): DrawnRun {
  const start = Math.max(a.start, b.start);
  const count = Math.min(a.start + a.count, b.start + b.count) - start;
  // Of what is no number nothing is drawn.
  return count > 0 ? { start, count } : { start: 0, count: 0 };
}

/** Groups may overlap, to draw a triangle in two materials: it counts once. */
function union(runs: readonly DrawnRun[]): DrawnRun[] {
  const out: DrawnRun[] = [];
  for (const run of runs.filter(({ count }) => count > 0).sort((a, b) => a.start - b.start)) {
    const last = out.at(-1);
    const inStep = last && run.start <= last.start + last.count && (run.start - last.start) % 3 === 0;
    if (inStep) {
      const end = Math.max(last.start + last.count, run.start + run.count);
      out[out.length - 1] = { start: last.start, count: end - last.start };
    } else out.push(run);
  }
  return out;
}
