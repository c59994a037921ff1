import type { Document } from '@gltf-transform/core';
import { boxOf } from '../../wasm/ts/box.ts';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { Mesh } from '../../wasm/ts/types.ts';
import { type BodyProperty, HANDLEBODY_BODY, readBody, readMesh, readPoseSpaces } from '../assets/index.ts';
import { theFile } from './arguments.ts';
import { describeBody } from './bake.ts';
import { countComponents } from './components.ts';
import { readInput } from './files.ts';
import { readModel } from './model.ts';
import type { Report } from './report.ts';
import type { Run } from './run.ts';

/** `handlebody inspect`: what is in a file. */
export async function inspectCommand({ values, words, report }: Run): Promise<void> {
  const file = theFile('inspect', words, 'a file to look at');
  const bytes = await readInput(file);
  const { document, format } = await readModel(bytes, file, report, { pictures: 'optional', strict: values.strict === true });
  const surface = describeSurface(document);
  const body = await describeBodyOf(document, report);
  const poseSpaces = describePoseSpaces(document, report);
  const facts = { file, format, bytes: bytes.length, ...surface, body, poseSpaces };
  report.result({ command: 'inspect', ...facts }, table(facts));
}

function describeSurface(document: Document) {
  const root = document.getRoot();
  const { mesh } = readMesh(document);
  const primitives = root.listMeshes().flatMap((each) => each.listPrimitives());
  const used = root.listExtensionsUsed().map(({ extensionName }) => extensionName);
  return {
    vertices: mesh.positions.length / 3,
    triangles: mesh.triangles.length / 3,
    components: countComponents(mesh.positions, mesh.triangles),
    bounds: boundsOf(mesh),
    origin: mesh.origin,
    nodes: root.listNodes().length,
    meshes: root.listMeshes().map((each) => each.getName()),
    materials: root.listMaterials().map((each) => each.getName()),
    textures: root.listTextures().length,
    skins: root.listSkins().length,
    animations: root.listAnimations().map((each) => each.getName()),
    morphTargets: primitives.reduce((most, primitive) => Math.max(most, primitive.listTargets().length), 0),
    extensions: used,
  };
}

/** The box, in the scene's units, of what triangles use; of a cloud, of all. Throws 'mesh-not-finite': a box of other things than numbers is none. */
function boundsOf({ positions, triangles, origin = [0, 0, 0] }: Mesh): { low: number[]; high: number[] } | undefined {
  if (positions.length === 0) return undefined;
  const { low, high } = boxOf(positions, triangles);
  if ([...low, ...high].every(Number.isFinite))
    return { low: low.map((x, axis) => x + (origin[axis] as number)), high: high.map((x, axis) => x + (origin[axis] as number)) };
  const isWrong = (vertex: number) => positions.subarray(3 * vertex, 3 * vertex + 3).some((x) => !Number.isFinite(x));
  const all = triangles.length > 0 ? triangles : Uint32Array.from({ length: positions.length / 3 }, (_, vertex) => vertex);
  const vertex = all.find(isWrong) as number;
  throw new HandlebodyError('mesh-not-finite', {
    message: `Vertex ${vertex} has the coordinates ${positions.subarray(3 * vertex, 3 * vertex + 3).join(', ')}.`,
    remedy: 'Export the model again; a glTF validator says more.',
    culprit: { kind: 'vertex', index: vertex },
  });
}

/** A body that does not fit, or is damaged, is described as far as it goes, with what is wrong with it. */
async function describeBodyOf(document: Document, report: Report) {
  const property = document.getRoot().getExtension<BodyProperty>(HANDLEBODY_BODY);
  if (!property) return undefined;
  try {
    const body = await readBody(document);
    const stored = property.getAccessor('distances')?.getByteLength() ?? 0;
    return body && { ...describeBody(body), distances: { bytes: body.distances.byteLength, stored }, matches: true };
  } catch (error) {
    if (!(error instanceof HandlebodyError)) throw error;
    const { code, message, remedy } = error;
    report.warn({ code, message, remedy });
    return { version: property.getHeader().version, matches: false, error: code };
  }
}

function describePoseSpaces(document: Document, report: Report) {
  try {
    const numbers = new Map(
      document
        .getRoot()
        .listMeshes()
        .map((mesh, number) => [mesh, number]),
    );
    return readPoseSpaces(document).map(({ mesh, dimensions, examples, version }) => ({
      mesh: mesh.getName(),
      meshNumber: numbers.get(mesh) ?? -1,
      version,
      targets: examples[0]?.weights.length ?? 0,
      dimensions,
      examples: examples.map(({ name, at }) => ({ name, at })),
    }));
  } catch (error) {
    if (!(error instanceof HandlebodyError)) throw error;
    const { code, message, remedy } = error;
    report.warn({ code, message, remedy });
    return [];
  }
}

type Facts = { file: string; format: string; bytes: number } & ReturnType<typeof describeSurface> & {
    body: Awaited<ReturnType<typeof describeBodyOf>>;
    poseSpaces: ReturnType<typeof describePoseSpaces>;
  };

/** The facts as lines for people: two columns, only what is there. */
function table(facts: Facts): string[] {
  const { bounds, body } = facts;
  const size = bounds?.high.map((high, axis) => short(high - (bounds.low[axis] ?? 0))).join(' × ');
  const rows: [string, string | number | undefined][] = [
    ['file', `${facts.file} (${facts.format}, ${megabytes(facts.bytes)})`],
    ['vertices', facts.vertices],
    ['triangles', facts.triangles],
    ['components', facts.components],
    ['size', size],
    ['bounds', bounds && `${bounds.low.map(short).join(', ')} to ${bounds.high.map(short).join(', ')}`],
    ['origin', facts.origin && `${facts.origin.join(', ')}: handles count from the scene's own, distances and vertices from here`],
    ['meshes', named(facts.meshes)],
    ['materials', named(facts.materials)],
    ['textures', facts.textures || undefined],
    ['skins', facts.skins || undefined],
    ['animations', named(facts.animations)],
    ['morph targets', facts.morphTargets || undefined],
    ['extensions', facts.extensions.join(', ') || undefined],
    ['body', body ? `format version ${body.version}` : 'none: not baked'],
  ];
  if (body && 'centers' in body) {
    rows.push(
      ['  for this shape', 'yes'],
      ['  centers', body.centers],
      ['  spheres', spheresInWords(body)],
      ['  voxels', `${body.voxels} of ${body.grid.dimensions.join(' × ')}, ${short(body.grid.spacing)} apart`],
      [
        '  distances',
        `${body.distance}, ${megabytes(body.distances.stored)} in the file, ${megabytes(body.distances.bytes)} unpacked`,
      ],
    );
  } else if (body) rows.push(['  for this shape', `no (${body.error})`]);
  for (const { mesh, meshNumber, dimensions, examples, targets } of facts.poseSpaces) {
    rows.push(['pose space', `of mesh ${meshNumber}${mesh && `, "${mesh}"`}, ${targets} morph targets`]);
    for (const { name, min, max, scale } of dimensions)
      rows.push([`  ${name}`, `${min} … ${max}${scale ? `, scale ${scale}` : ''}`]);
    rows.push(['  examples', `${examples.length}`]);
    for (const { name, at } of examples) rows.push([`    ${name}`, at.map(short).join(', ')]);
  }
  const shown = rows.filter(([, value]) => value !== undefined);
  const width = shown.reduce((most, [name]) => Math.max(most, name.length), 0) + 2;
  return shown.map(([name, value]) => `${name.padEnd(width)}${value}`);
}

/** How many, and the first few names. */
function named(names: readonly string[]): string | undefined {
  if (names.length === 0) return undefined;
  const [some, more] = [names.filter((name) => name !== '').slice(0, 6), names.length > 6 ? ' …' : ''];
  return some.length === 0 ? `${names.length}` : `${names.length}: ${some.join(', ')}${more}`;
}

const short = (x: number) => `${Number(x.toPrecision(4))}`;

const megabytes = (bytes: number) => (bytes < 1e5 ? `${(bytes / 1e3).toFixed(1)} kB` : `${(bytes / 1e6).toFixed(2)} MB`);

function spheresInWords({ spheres, bones, branches }: { spheres: number; bones?: number; branches?: number }): string {
  const long = bones ? `, ${bones} of them bones` : '';
  return `${spheres}${long}${branches === undefined ? '' : `, skeleton of ${branches} branches`}`;
}
