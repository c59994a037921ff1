import { beforeAll, describe, expect, it } from 'vitest';
import { meshSolid } from '../../scripts/lib/level-set-mesh.mjs';
import { facts, nearestVertex, parts } from '../../scripts/lib/mesh-facts.mjs';
import { CREATURES, creature } from '../../web/models/creatures.ts';

const VERTICES = 3000;

type Mesh = Awaited<ReturnType<typeof meshSolid>>;

/** A mesh's vertices within a distance of a place. */
function within({ positions }: Mesh, [x, y, z]: readonly [number, number, number], distance: number): number[] {
  return Array.from({ length: positions.length / 3 }, (_, v) => v).filter(
    (v) =>
      Math.hypot((positions[3 * v] as number) - x, (positions[3 * v + 1] as number) - y, (positions[3 * v + 2] as number) - z) <
      distance,
  );
}

describe.each(CREATURES)('%s', (name) => {
  const solid = creature(name);
  let mesh: Mesh;

  beforeAll(async () => {
    mesh = await meshSolid(solid, { vertices: VERTICES });
  });

  it('is one closed surface without handles, seen from outside, of good triangles', () => {
    const { unmatched, genus, parts, volume, smallestAngle, smallestArea } = facts(mesh);
    expect({ unmatched, genus, parts }).toEqual({ unmatched: 0, genus: 0, parts: 1 });
    expect(volume).toBeGreaterThan(0);
    expect(smallestArea).toBeGreaterThan(1e-6);
    expect(smallestAngle).toBeGreaterThan(12);
  });

  it('has about the vertices that were asked for, on the surface', () => {
    const { positions } = mesh;
    expect(Math.abs(positions.length / 3 / VERTICES - 1)).toBeLessThan(0.2);
    for (let i = 0; i < positions.length; i += 3) {
      const [x, y, z] = positions.subarray(i, i + 3) as unknown as [number, number, number];
      expect(Math.abs(solid.distance(x, y, z))).toBeLessThan(solid.thinnest / 10);
    }
  });

  it('has tips on the surface, each a vertex of its own and the end of a limb', () => {
    expect(solid.tips.size).toBeGreaterThanOrEqual(4);
    const vertices = [...solid.tips.values()].map((place) => nearestVertex(mesh, place));
    expect(new Set(vertices).size).toBe(solid.tips.size);
    for (const [tip, place] of solid.tips) {
      const radius = solid.radius(...place);
      expect(Math.abs(solid.distance(...place)), tip).toBeLessThan(radius / 10);
      const end = within(mesh, place, 1.6 * radius);
      expect(parts(mesh.triangles, end), tip).toBe(1);
      // What lies around an end is a cap: all of its surface on one side, so that its middle is less than the ball's radius inside.
      const middle = [0, 1, 2].map((d) => end.reduce((sum, v) => sum + (mesh.positions[3 * v + d] as number), 0) / end.length);
      expect(Math.hypot(...middle.map((value, d) => value - (place[d] as number))), tip).toBeGreaterThan(radius / 3);
    }
  });

  it('is the same to the bit when it is made again', async () => {
    const again = await meshSolid(creature(name), { vertices: VERTICES });
    expect(Buffer.from(again.positions.buffer).equals(Buffer.from(mesh.positions.buffer))).toBe(true);
    expect(Buffer.from(again.triangles.buffer).equals(Buffer.from(mesh.triangles.buffer))).toBe(true);
  });
});
