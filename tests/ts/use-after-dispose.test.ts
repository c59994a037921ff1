/**
 * What was disposed of says so. Classes, their methods and getters are found by walking the exports and their prototypes, so that a new one is
 * tried without being listed: what is asked of a disposed object ends in 'disposed', or gives what it gave before; of three.js' side, nothing.
 */
import { Extension, ExtensionProperty } from '@gltf-transform/core';
import { type Mesh, Raycaster, Vector3 } from 'three';
import { describe, expect, it, vi } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import * as solver from '../../wasm/ts/index.ts';
import * as assets from '../../web/assets/index.ts';
import * as three from '../../web/three/index.ts';
import { right, samples } from './support/samples.ts';

type Made = Record<string, unknown> & { dispose(): void };
type Class = { readonly prototype: object };

/** Not by users: `draggable` makes them, and glTF-Transform its own. */
const INSIDE = ['BareHandles', 'HandleOverlay'];
const classes = (Object.entries({ ...solver, ...assets, ...three }) as [string, Class][]).filter(
  ([name, { prototype }]) =>
    typeof (prototype as Made | undefined)?.dispose === 'function' &&
    !INSIDE.includes(name) &&
    !(prototype instanceof Extension || prototype instanceof ExtensionProperty),
);

/** Protected, so that nobody else calls them. */
const PROTECTED = ['handle', 'move'];

/** Arguments of methods that take some; one that is in neither table fails below. */
const place = new Raycaster(new Vector3(0, 0, 5), new Vector3(0, 0, -1));
const ONE = [[0, 0, 0]];
const GIVEN: Readonly<Record<string, readonly unknown[]>> = {
  ...right,
  evaluate: [[0]],
  gradient: [[0]],
  weights: [[0]],
  'NaturalNeighbor.evaluate': [[0, 0]],
  'NaturalNeighbor.gradient': [[0, 0]],
  'NaturalNeighbor.weights': [[0, 0]],
  'Irbf.evaluate': ONE,
  'Irbf.setHandles': [[{ vertex: 0 }]],
  'Irbf.setRestNormals': [new Float32Array((right['Irbf.deform'] as [Float32Array])[0].length)],
  'BiharmonicWeights.setHandles': [[{ vertex: 0 }]],
  'DiscreteGreen.solveGrid': [undefined],
  'DiscreteGreen.solveRadial': [undefined],
  deform: [undefined],
  'EnergyMinimizer.deform': [new Float32Array(8)],
  'LinearBlend.unskin': [new Float32Array(4)],
  'DualQuaternion.unskin': [new Float32Array(4)],
  pick: [place],
  'Draggable.setHandles': [[{ vertex: 0 }]],
  addHandle: [{ vertex: 0 }],
  target: [0],
  setTarget: [0, new Vector3()],
  vertex: [0],
  reset: [0],
  'PoseDriver.set': [[0]],
};

/** Every name that an object answers to, but for what every object has. */
function membersOf({ prototype }: Class): string[] {
  const found = new Set<string>();
  for (let at = prototype; at && at !== Object.prototype; at = Object.getPrototypeOf(at))
    for (const name of Object.getOwnPropertyNames(at)) found.add(name);
  return [...found].filter((name) => !['constructor', 'dispose', ...PROTECTED].includes(name));
}

function isMethod(at: object, member: string): boolean {
  const own = Object.getOwnPropertyDescriptor(at, member);
  return own ? typeof own.value === 'function' : isMethod(Object.getPrototypeOf(at), member);
}

/** What comes of a member: of a method called with right arguments, or of a getter. */
async function ask(name: string, made: Made, member: string): Promise<unknown> {
  const value = made[member];
  if (typeof value !== 'function') return value;
  const given = GIVEN[`${name}.${member}`] ?? GIVEN[member] ?? (value.length === 0 ? [] : undefined);
  if (!given) throw new Error(`Give right arguments of ${name}.${member}.`);
  return value.apply(made, given);
}

vi.spyOn(console, 'warn').mockImplementation(() => {});

describe.each(classes.map(([name, Kind]) => ({ name, members: membersOf(Kind) })))('$name', ({ name, members }) => {
  const make = async () => {
    const sample = samples[name];
    if (!sample) throw new Error(`Give tests/ts/support/samples.ts a sample of ${name}.`);
    return (name.startsWith('Handlebody') ? await solver.load() : await sample()) as Made;
  };

  it.each(members)('%s', async (member) => {
    const made = await make();
    const before = await ask(name, made, member).catch((error) => error);
    // Some methods have no gradient, and say so.
    if (member !== 'gradient') expect(before, 'with right arguments').not.toBeInstanceOf(Error);
    made.dispose();
    made.dispose();
    const after = await ask(name, made, member).catch((error) => error);
    if (name in solver) {
      // What stands there already can be given; of what gives nothing only an error tells.
      if (!(after instanceof Error) && (before !== undefined || !isMethod(made, member))) expect(after).toEqual(before);
      else expect(after).toMatchObject({ name: 'HandlebodyError', code: 'disposed' });
    } else if (after instanceof Error) expect(after).toBeInstanceOf(HandlebodyError);
    // A page's frames may outlive what they draw: it lies at rest, without handles, and nothing of it is hit.
    else expect([before, undefined, false, []]).toContainEqual(after);
  });

  it.skipIf(name in solver)('leaves the object as it was before, whatever is called', async () => {
    const made = await make();
    made.dispose();
    const mesh = made.object as Mesh | undefined;
    const [geometry, before] = [mesh?.geometry, mesh?.geometry.getAttribute('position')?.array.slice()];
    for (const member of members) await ask(name, made, member).catch(() => {});
    expect(mesh?.geometry).toBe(geometry);
    expect(mesh?.geometry.getAttribute('position')?.array).toEqual(before);
  });
});
