/**
 * The spheres of a default bake hold limbs: each has three at least, and one that is bent by 60° keeps its volume within 3%, the body too,
 * where volume is told to count: nearly incompressible, and with a third of λ. The defaults, chosen for how little other limbs move and for
 * how soon a drag is solved, lose up to 12% of a limb then, and 4% of the body.
 *
 * A limb's base is held and its outer third turned as one piece. Between, only its spheres are there: more handles would hold the volume in
 * their place, and one sphere a limb would do. Targets lie on an even bend that is as long as the limb was, so that a change of volume is
 * the solver's. Tips of other limbs are pinned.
 */
import { beforeAll, describe, expect, it } from 'vitest';
import { meshSolid } from '../../scripts/lib/level-set-mesh.mjs';
import { type BodyData, type Handle, type Irbf, load, type Skeleton } from '../../wasm/ts/index.ts';
import { creature } from '../../web/models/creatures.ts';
import { readDog } from './support/dog.ts';
import {
  angleBetween,
  axisAcross,
  bentLine,
  branchesOf,
  type Limb,
  lengthOf,
  limbsOf,
  movedLine,
  type Place,
  toEnd,
  volumeMeter,
} from './support/limbs.ts';
import { random } from './support/scattered.ts';

const SEED = 60_003;
const ANGLE = Math.PI / 3;
/** How far along a limb the bend ends. */
const BENT = 2 / 3;
/** Each limb is bent about so many axes, evenly all around from one by chance. */
const AXES = 3;

const hb = await load();

/** Models, and how many limbs they have. */
const MODELS: readonly [name: string, limbs: number, bake: () => Promise<BodyData>][] = [
  // Four legs, the tail, and the neck with the head.
  ['dog', 6, readDog],
  ['octopus', 8, async () => hb.bake(await meshSolid(creature('octopus'), { vertices: 3000 }))],
];

interface Bend {
  readonly limb: number;
  readonly body: number;
  /** In degrees, how far the outer half turned: less than its end, because the bend ends within it. */
  readonly angle: number;
  readonly length: number;
}

/** Tips of other limbs. Skeletons end near the skin: a little before is inside. */
function pins(body: BodyData, limb: Limb): Handle[] {
  const { parents } = body.skeleton as Skeleton;
  return branchesOf(body).flatMap((nodes, branch) => {
    const place = nodes.at(Math.floor(0.95 * nodes.length) - 1)?.place as Place;
    return parents.includes(branch) || limb.branches.has(branch) ? [] : [{ at: place }];
  });
}

function bend(irbf: Irbf, limb: Limb, volumeOf: (irbf: Irbf) => number, turn: number): Bend {
  const { line, along } = limb;
  const length = along.at(-1) as number;
  const nodeAt = (part: number) => along.findIndex((reached) => reached >= part * length - 1e-9);
  const half = nodeAt(1 / 2);
  const axis = axisAcross(toEnd(line, half), turn);
  const bent = bentLine(limb, axis, ANGLE, [0, BENT * length]);
  const rotation = [...axis.map((value) => value * Math.sin(ANGLE / 2)), Math.cos(ANGLE / 2)];
  const turning = (at: Place): Handle => ({ at, kind: 'rotation' });

  const held = [turning(limb.joint), turning(line[0] as Place), ...pins(irbf.body, limb)];
  const outer = [nodeAt(BENT), nodeAt(0.9)];
  irbf.setHandles([...held, ...outer.map((node) => turning(line[node] as Place))]);
  outer.forEach((node, k) => {
    irbf.targets.set([...(bent[node] as Place), ...rotation], 10 * (held.length + k));
  });
  expect(irbf.solve({ maxIterations: 1000, tolerance: 1e-6 }).converged).toBe(true);
  const moved = movedLine(irbf, line);
  return {
    limb: volumeOf(irbf) - 1,
    body: irbf.report().volumeRatio - 1,
    angle: angleBetween(toEnd(line, half), toEnd(moved, half)),
    length: lengthOf(moved) / lengthOf(line) - 1,
  };
}

const percent = (part: number) => `${(100 * part).toFixed(1)}%`;

describe.each(MODELS)('the %s', (name, count, bake) => {
  let body: BodyData;
  let limbs: Limb[];

  beforeAll(async () => {
    body = await bake();
    limbs = limbsOf(body);
  });

  it('has at least three spheres on every limb', () => {
    expect(limbs).toHaveLength(count);
    for (const { branch, spheres } of limbs) expect(spheres, `branch ${branch}`).toBeGreaterThanOrEqual(3);
  });

  it.each([
    ['where volume counts, within 3%', { poissonRatio: 0.495, lambda: 1 / 3, most: { limb: 0.03, body: 0.03 } }],
    ['under all defaults, within 12%', { lambda: 1, most: { limb: 0.12, body: 0.04 } }],
  ])(`keeps the volume of every limb that is bent by 60°, %s (seed ${SEED})`, (_, { lambda, most, ...options }) => {
    const { number } = random(SEED);
    const irbf = hb.irbf(body, { ...options, smoothness: lambda * chosenSmoothness(body) });
    const wrong: string[] = [];
    for (const limb of limbs) {
      const volumeOf = volumeMeter(body, limb.voxels);
      const first = Math.PI * number();
      for (let k = 0; k < AXES; k++) {
        const did = bend(irbf, limb, volumeOf, first + (k * Math.PI) / AXES);
        const told = `${name}, branch ${limb.branch}, ${limb.spheres} spheres, axis ${k}: limb ${percent(did.limb)}, body ${percent(did.body)}, turned by ${did.angle.toFixed(1)}°, length ${percent(did.length)}`;
        if (did.angle <= 50 || did.angle >= 70 || Math.abs(did.length) > 0.03) wrong.push(`not bent: ${told}`);
        if (Math.abs(did.limb) > most.limb || Math.abs(did.body) > most.body) wrong.push(told);
      }
    }
    irbf.dispose();
    expect(wrong).toEqual([]);
  });
});

/** λ as it is chosen for a body. */
function chosenSmoothness(body: BodyData): number {
  const irbf = hb.irbf(body);
  const { smoothness } = irbf.report();
  irbf.dispose();
  return smoothness;
}
