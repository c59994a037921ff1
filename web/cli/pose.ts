import type { Document, Mesh } from '@gltf-transform/core';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { load } from '../../wasm/ts/runtime.ts';
import { type PoseSpaceData, readPoseSpaces } from '../assets/index.ts';
import { type Options, theFile, theOutput, usageError, type Values, WRITES } from './arguments.ts';
import { prepareOutput, readInput, writeOutput } from './files.ts';
import { modelBytes, readModel } from './model.ts';
import { chooseByName } from './numbered.ts';
import { readBack } from './read-back.ts';
import type { Report } from './report.ts';
import type { Run } from './run.ts';

export const POSE_OPTIONS: Options = { ...WRITES, at: { type: 'string' }, mesh: { type: 'string' } };

/** `handlebody pose`: a model with a pose space, set to a place in it. */
export async function poseCommand({ values, words, report, signal, clock }: Run): Promise<void> {
  const input = theFile('pose', words, 'a model with a pose space');
  const at = values.at;
  if (typeof at !== 'string')
    throw usageError('"handlebody pose" needs a place.', 'Add --at, such as --at valence=0.6,arousal=0.4.');
  const output = prepareOutput(theOutput('pose', values), { inputs: [input], force: values.force === true });

  const { document } = await readModel(await readInput(input), input, report);
  const space = choosePoseSpace(document, values, input);
  const place = parsePlace(at, space);
  for (const [i, { name, min, max }] of space.dimensions.entries()) {
    const value = place[i] as number;
    if (value >= min && value <= max) continue;
    report.warn({
      code: 'outside-range',
      message: `${name} is ${value}, and the pose space goes from ${min} to ${max}: beyond its examples it is a guess.`,
    });
  }
  clock.lap('read');

  const hb = await load({ signal });
  const poses = hb.poseSpace({
    dimensions: space.dimensions,
    examples: space.examples.map(({ name, at: where, weights }) => ({ name, at: where, shape: weights })),
  });
  const weights = sumByName(poses.names, poses.weights(place));
  const targets = Array.from(poses.evaluate(place));
  clock.lap('solve');
  checkPosed(space.mesh, targets);
  setWeights(document, space.mesh, targets, report);
  const bytes = await modelBytes(document);
  await readBack(bytes, {});
  await writeOutput(output, bytes, signal);
  clock.lap('write');

  const where = sumByName(poses.dimensions, place);
  const strongest = Object.entries(weights)
    .sort(([, a], [, b]) => Math.abs(b) - Math.abs(a))
    .slice(0, 4)
    .map(([name, weight]) => `${name} ${weight.toFixed(2)}`);
  report.result(
    {
      ...{ command: 'pose', input, output: output.name, bytes: bytes.length, mesh: space.mesh.getName(), at: where },
      ...{ weights, targets: sumByName(targetNames(space.mesh, targets.length), targets), timings: clock.laps() },
    },
    [`${output.name}: ${at.trim()}: ${strongest.join(', ')}`],
  );
}

type FoundPoseSpace = PoseSpaceData & { readonly mesh: Mesh };

function choosePoseSpace(document: Document, values: Values, input: string): FoundPoseSpace {
  const spaces = readPoseSpaces(document);
  const [only, ...others] = spaces;
  if (!only) {
    throw new HandlebodyError('pose-space-missing', {
      message: `"${input}" carries no pose space.`,
      remedy: 'Use a model with the extension HANDLEBODY_pose_space, such as attachPoseSpace of "handlebody/gltf-transform" makes.',
    });
  }
  const numbers = new Map(
    document
      .getRoot()
      .listMeshes()
      .map((mesh, number) => [mesh, number]),
  );
  const found = spaces.map((space) => ({ space, number: numbers.get(space.mesh) ?? -1, name: space.mesh.getName() }));
  const names = found.map(({ number, name }) => (name ? `${number} (${JSON.stringify(name)})` : `${number} (no name)`)).join(', ');
  if (values.mesh === undefined) {
    if (others.length === 0) return only;
    throw usageError(
      `"${input}" has ${spaces.length} pose spaces, of the meshes ${names}.`,
      'Choose one with --mesh, by name or number.',
    );
  }
  const chosen = chooseByName(found, values.mesh as string);
  if (chosen.length === 1) return (chosen[0] as (typeof found)[number]).space;
  const problem = chosen.length === 0 ? 'No mesh with a pose space is' : `${chosen.length} meshes with a pose space are`;
  throw usageError(
    `${problem} called "${values.mesh}".`,
    `There are: ${names}. Choose by number, such as --mesh ${found[0]?.number}.`,
  );
}

/** "valence=0.6,arousal=0.4" as one number a dimension. */
function parsePlace(text: string, { dimensions }: PoseSpaceData): Float64Array {
  const names = dimensions.map(({ name }) => name);
  const places = new Map(names.map((name, i) => [name, i]));
  const place = new Float64Array(names.length).fill(Number.NaN);
  const example = names.map((name) => `${name}=0`).join(',');
  for (const part of text.split(',')) {
    const equals = part.lastIndexOf('=');
    const [name, number] = [part.slice(0, Math.max(equals, 0)).trim(), part.slice(equals + 1).trim()];
    if (equals === -1 || number === '' || !Number.isFinite(Number(number)))
      throw usageError(`--at has "${part}" where a name and a number should be.`, `Write it as --at ${example}.`);
    const index = places.get(name);
    if (index === undefined) throw usageError(`The pose space has no dimension called "${name}".`, `It has: ${names.join(', ')}.`);
    if (!Number.isNaN(place[index])) throw usageError(`--at gives ${name} twice.`, 'Give it once.');
    place[index] = Number(number);
  }
  const missing = names.filter((_, i) => Number.isNaN(place[i]));
  if (missing.length > 0)
    throw usageError(`--at does not say where ${missing.join(' and ')} should be.`, `Write it as --at ${example}.`);
  return place;
}

/** Weights far outside the examples may send vertices beyond what floats can hold, in whatever viewer opens the file. */
function checkPosed(mesh: Mesh, weights: readonly number[]): void {
  for (const primitive of mesh.listPrimitives()) {
    const rest = primitive.getAttribute('POSITION');
    const targets = primitive.listTargets().map((target) => target.getAttribute('POSITION'));
    const element: number[] = [];
    for (let v = 0; v < (rest?.getCount() ?? 0); v++) {
      const place = [...(rest?.getElement(v, element) ?? [])];
      for (const [k, target] of targets.entries()) {
        const move = target?.getElement(v, element) ?? [0, 0, 0];
        for (let axis = 0; axis < 3; axis++)
          place[axis] = Math.fround((place[axis] as number) + (weights[k] ?? 0) * (move[axis] as number));
      }
      if (place.every(Number.isFinite) || !rest?.getElement(v, element).every(Number.isFinite)) continue;
      throw new HandlebodyError('target-not-finite', {
        message: `The pose sends vertex ${v} of the mesh "${mesh.getName()}" beyond what its numbers can hold.`,
        remedy: 'Give a place nearer to the examples; "handlebody inspect" tells their range.',
        culprit: { kind: 'vertex', index: v },
      });
    }
  }
}

/** The mesh's weights; a node's own would hide them, and animations will. */
function setWeights(document: Document, mesh: Mesh, targets: number[], report: Report): void {
  mesh.setWeights(targets);
  const nodes = document
    .getRoot()
    .listNodes()
    .filter((node) => node.getMesh() === mesh);
  for (const node of nodes) node.setWeights([]);
  const moved = new Set<unknown>(nodes);
  const channels = document
    .getRoot()
    .listAnimations()
    .flatMap((animation) => animation.listChannels());
  if (channels.some((channel) => channel.getTargetPath() === 'weights' && moved.has(channel.getTargetNode())))
    report.note('An animation of the model sets the same weights and wins while it plays.');
}

/** As exporters name them, by convention in the mesh's extras; a name that is there already gets its number. */
function targetNames(mesh: Mesh, length: number): string[] {
  const { targetNames: given } = mesh.getExtras();
  const names = new Set<string>();
  for (let i = 0; i < length; i++) {
    const name = Array.isArray(given) && typeof given[i] === 'string' ? given[i] : `target ${i}`;
    names.add(names.has(name) ? `${name} (${i})` : name);
  }
  return [...names];
}

/** An object of numbers; two of one name are added. */
function sumByName(names: readonly string[], numbers: ArrayLike<number>): Record<string, number> {
  const sums = new Map<string, number>();
  names.forEach((name, i) => {
    sums.set(name, (sums.get(name) ?? 0) + (numbers[i] as number));
  });
  return Object.fromEntries(sums);
}
