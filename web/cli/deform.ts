import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { type Irbf, load } from '../../wasm/ts/runtime.ts';
import type { SolveReport } from '../../wasm/ts/types.ts';
import { detachBody, HANDLEBODY_BODY, readBody, readMesh } from '../assets/index.ts';
import { type Options, theFile, theOutput, usageError, WRITES } from './arguments.ts';
import { prepareOutput, readInput, writeOutput } from './files.ts';
import { parseHandles } from './handles.ts';
import { modelBytes, naming, readModel } from './model.ts';
import { readBack } from './read-back.ts';
import type { Report } from './report.ts';
import type { Run } from './run.ts';
import { isStandardInput } from './special-files.ts';
import { sceneNormals, writeShape } from './write-shape.ts';

export const DEFORM_OPTIONS: Options = { ...WRITES, handles: { type: 'string' } };

/** From rest, once: as many as it takes. */
const MAX_ITERATIONS = 1000;
/** Of a diagonal in an iteration: nobody waits for a frame, and where volume is kept there is more left to go than the last step went. */
const TOLERANCE = 1e-12;

/** `handlebody deform`: a baked model, bent by handles. */
export async function deformCommand({ values, words, report, signal, clock }: Run): Promise<void> {
  const input = theFile('deform', words, 'a baked model, as "handlebody bake" writes it');
  const handlesName = values.handles;
  if (typeof handlesName !== 'string' || handlesName === '')
    throw usageError(
      '"handlebody deform" needs handles.',
      'Add --handles and the name of a JSON file; "handlebody deform --help" shows one.',
    );
  if (isStandardInput(input) && isStandardInput(handlesName))
    throw usageError('The model and the handles are both standard input.', 'Give one of them as a file.');
  const output = prepareOutput(theOutput('deform', values), { inputs: [input, handlesName], force: values.force === true });

  const { document } = await readModel(await readInput(input), input, report);
  const body = await readBody(document);
  if (!body) {
    throw new HandlebodyError('body-missing', {
      message: `"${input}" is not baked: it carries no interior distances.`,
      remedy: `Bake it first: handlebody bake ${JSON.stringify(input)} -o BODY.glb`,
    });
  }
  const { ranges } = readMesh(document, { reading: body.mesh.reading ?? {} });
  const { origin } = body.mesh;
  const vertexCount = body.mesh.positions.length / 3;
  const sphereCount = body.spheres.length / 4;
  const { handles, targets, options, shapes } = await readHandles(handlesName, { vertexCount, sphereCount });
  clock.lap('read');

  const hb = await load({ signal });
  const irbf = fromHandles(handlesName, () => {
    // Once, not every frame: the exact product.
    const made = hb.irbf(body, { ...options, precision: 'float', onWarning: (warning) => report.warn({ ...warning }) });
    made.setHandles(handles);
    return made;
  });
  clock.lap('prepare');
  irbf.targets.set(targets);
  for (const [sphere, shape] of shapes) irbf.shapes.set(shape, 9 * sphere);
  const solved = fromHandles(handlesName, () => irbf.solve({ maxIterations: MAX_ITERATIONS, tolerance: TOLERANCE }));
  clock.lap('solve');
  const shape = { positions: new Float32Array(vertexCount * 3), normals: new Float32Array(vertexCount * 3), origin };
  const restNormals = sceneNormals(ranges);
  if (restNormals) irbf.setRestNormals(restNormals);
  fromHandles(handlesName, () => irbf.deform(shape.positions, restNormals && shape.normals));
  clock.lap('deform');
  const quality = measure(irbf, solved, report);
  clock.lap('measure');
  if (!quality.converged) {
    report.warn({
      code: 'not-converged',
      message: `The solver did not come to rest within ${MAX_ITERATIONS} iterations.`,
      remedy: 'The targets may pull against each other: move them closer to rest, or use fewer.',
    });
  }

  for (const note of writeShape(document, ranges, shape)) report.note(note);
  detachBody(document);
  const unused = document.getRoot().listExtensionsUsed();
  unused.find(({ extensionName }) => extensionName === HANDLEBODY_BODY)?.dispose();
  report.note(
    'The output carries no interior distances, which are those of the shape at rest: bake it again to deform it further.',
  );
  const bytes = await modelBytes(document);
  await readBack(bytes, { shape: true });
  await writeOutput(output, bytes, signal);
  clock.lap('write');

  const counts = {
    vertices: vertexCount,
    triangles: body.mesh.triangles.length / 3,
    handles: handles.length,
    centers: body.centers.length,
    spheres: body.spheres.length / 4,
  };
  const percent = (part: number) => `${(part * 100).toFixed(2)}%`;
  const measured = quality.volumeRatio !== null && `volume ${percent(quality.volumeRatio)}, ${quality.flips} flipped tetrahedra, `;
  report.result(
    { command: 'deform', input, output: output.name, bytes: bytes.length, ...counts, ...quality, timings: clock.laps() },
    [
      `${output.name}: ${counts.vertices} vertices, ${counts.handles} handles, ${quality.iterations} iterations, ` +
        `${measured || ''}${(clock.total() / 1000).toFixed(1)} s`,
    ],
  );
}

/** What the deformation is worth. Where measuring takes more memory than there is, the deformation is none the worse for it. */
function measure(irbf: Irbf, solved: SolveReport, report: Report) {
  try {
    return irbf.report();
  } catch (error) {
    if (!(error instanceof HandlebodyError) || error.code !== 'out-of-memory') throw error;
    report.warn({
      code: 'not-measured',
      message: `Volume and distortion were not measured. ${error.message}`,
      remedy: error.remedy,
    });
    return { ...solved, volumeRatio: null, distortion: null, flips: null };
  }
}

/** Handles and options come from the file of handles, and so does the fault when the solver refuses them. */
function fromHandles<T>(name: string, work: () => T): T {
  try {
    return work();
  } catch (error) {
    if (!(error instanceof HandlebodyError)) throw error;
    const { code, message, remedy, culprit } = error;
    const refused = code === 'invalid-option' ? new HandlebodyError('handles-invalid', { message, remedy, cause: error }) : error;
    throw culprit?.kind === 'handle' || culprit?.kind === 'sphere' || code === 'target-not-finite' || refused !== error
      ? naming(name, refused)
      : error;
  }
}

async function readHandles(name: string, counts: { vertexCount: number; sphereCount: number }) {
  const bytes = await readInput(name);
  try {
    return parseHandles(bytes, counts);
  } catch (error) {
    throw naming(name, error);
  }
}
