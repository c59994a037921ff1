import { load } from '../../wasm/ts/index.ts';
import type { BodyData, DistanceMethod } from '../../wasm/ts/types.ts';
import { attachBody, type BodyProperty, HANDLEBODY_BODY, readMesh } from '../assets/index.ts';
import { count, numberBetween, type Options, oneOf, READS, theFile, theOutput, type Values, WRITES } from './arguments.ts';
import { prepareOutput, readInput, writeOutput } from './files.ts';
import { modelBytes, readModel } from './model.ts';
import { readBack } from './read-back.ts';
import type { Run } from './run.ts';

const METHODS = ['fast-marching', 'heat', 'mean-value', 'euclidean'] as const satisfies readonly DistanceMethod[];
const MORPHS = ['rest', 'present'] as const;
const PACKINGS = ['skeleton', 'tree', 'medial'] as const;
const QUALITIES = ['draft', 'normal', 'fine'] as const;

export const BAKE_OPTIONS: Options = {
  ...READS,
  ...WRITES,
  centers: { type: 'string' },
  distance: { type: 'string' },
  morphs: { type: 'string' },
  resolution: { type: 'string' },
  quality: { type: 'string' },
  spheres: { type: 'string' },
  packing: { type: 'string' },
  level: { type: 'string' },
  overlap: { type: 'string' },
  'smallest-radius': { type: 'string' },
  bones: { type: 'boolean' },
};

/** `handlebody bake`: a model with its interior distances in it. */
export async function bakeCommand({ values, words, report, signal, clock }: Run): Promise<void> {
  const input = theFile('bake', words, 'a model: a .glb, .gltf, .obj, .ply, .stl or .off file');
  const options = bakeOptions(values);
  const output = prepareOutput(theOutput('bake', values), { inputs: [input], force: values.force === true });

  const { document, format } = await readModel(await readInput(input), input, report, {
    strict: values.strict === true,
    baked: true,
  });
  const morphs = oneOf(values, 'morphs', MORPHS);
  const { mesh } = readMesh(document, { morphs, onWarning: (warning) => report.warn(warning) });
  clock.lap('read');
  const hb = await load({ signal });
  // Without triangles it is a cloud of points.
  const { triangles: _, ...cloud } = mesh;
  const shape = mesh.triangles.length > 0 ? mesh : cloud;
  const onProgress = report.progress('baking');
  const body = await hb.bake(shape, { ...options, signal, onProgress, onWarning: (warning) => report.warn(warning) });
  clock.lap('bake');
  await attachBody(document, body);
  const bytes = await modelBytes(document);
  await readBack(bytes, { positionsHash: body.positionsHash });
  await writeOutput(output, bytes, signal);
  clock.lap('write');

  const [vertices, triangles] = [mesh.positions.length / 3, mesh.triangles.length / 3];
  const summary = describeBody(body);
  const distances = document.getRoot().getExtension<BodyProperty>(HANDLEBODY_BODY)?.getAccessor('distances')?.getByteLength() ?? 0;
  const megabytes = (count: number) => `${(count / 1e6).toFixed(2)} MB`;
  report.result(
    {
      command: 'bake',
      input,
      format,
      output: output.name,
      bytes: bytes.length,
      vertices,
      triangles,
      ...summary,
      ...(options.packing && { packing: options.packing }),
      distances: { stored: distances },
      timings: clock.laps(),
    },
    [
      `${output.name}: ${vertices} vertices, ${triangles} triangles, ${summary.centers} centers, ${summary.spheres} spheres, ` +
        `${summary.voxels} voxels (${summary.distance}), ${megabytes(bytes.length)} (${megabytes(distances)} of them distances, ` +
        `${((8 * distances) / (summary.centers * summary.voxels)).toFixed(1)} bits for each center and voxel), ${(clock.total() / 1000).toFixed(1)} s`,
    ],
  );
}

function bakeOptions(values: Values) {
  const entries = {
    centers: count(values, 'centers'),
    distance: oneOf(values, 'distance', METHODS),
    resolution: count(values, 'resolution'),
    quality: oneOf(values, 'quality', QUALITIES),
    spheres: count(values, 'spheres'),
    packing: oneOf(values, 'packing', PACKINGS),
    level: count(values, 'level'),
    overlap: numberBetween(values, 'overlap', -4, 1),
    smallestRadius: numberBetween(values, 'smallest-radius', 1e-6, 1),
    bones: values.bones ? ('straight' as const) : undefined,
  };
  return Object.fromEntries(Object.entries(entries).filter(([, value]) => value !== undefined)) as {
    [K in keyof typeof entries]?: NonNullable<(typeof entries)[K]>;
  };
}

/** What a body is made of, in numbers. Lengths in the model's units. */
export function describeBody({ centers, spheres, sphereAxes, voxels, grid, normalization, distance, version, skeleton }: BodyData) {
  return {
    version,
    centers: centers.length,
    spheres: spheres.length / 4,
    voxels: voxels.length,
    grid: { dimensions: grid.dimensions, spacing: grid.spacing * normalization.diagonal },
    distance,
    ...(skeleton && { branches: skeleton.lengths.length }),
    ...(sphereAxes && {
      bones: Array.from({ length: sphereAxes.length / 3 }, (_, s) => s).filter((s) => isLong(sphereAxes, s)).length,
    }),
  };
}

const isLong = (axes: Float64Array, sphere: number) => axes.subarray(3 * sphere, 3 * sphere + 3).some((x) => x !== 0);
