// The packed library's declarations, as TypeScript reads them in a project of its own: without skipLibCheck, and under a library that is
// older than `Symbol.dispose` and Float16Array.
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { at } from '../lib/paths.mjs';
import { capture } from '../lib/run.mjs';

const SOLVER = `
import { type BodyData, type ErrorCode, load } from 'handlebody';
import { load as loadExternal } from 'handlebody/external';
import type { FileErrorCode } from 'handlebody/gltf-transform';
import { type HandlebodyRuntime, load as loadRuntime } from 'handlebody/runtime';
import { load as loadRuntimeExternal } from 'handlebody/runtime/external';
export const body: Promise<BodyData> = load().then((hb) => hb.bake({ positions: new Float64Array(9), triangles: new Uint32Array(3) }));
export const other: typeof load = loadExternal;
export const runtime: typeof loadRuntime = loadRuntimeExternal;
export const served: Promise<HandlebodyRuntime> = load();
// @ts-expect-error the runtime cannot bake
export const bake = async () => (await loadRuntime()).bake;
export const codes: ErrorCode[] = ['mesh-open', 'file-not-glb' satisfies FileErrorCode];
// @ts-expect-error: misspelt
export const misspelt: ErrorCode = 'file-nto-glb';
`;

/** What three.js calls a typed array goes in wherever numbers do, and takes whatever comes out. */
const THREE = `
import type { BodyData, Handlebody } from 'handlebody';
import { DeformedGeometry } from 'handlebody/three';
import { bakeInWorker } from 'handlebody/worker';
import type { BufferGeometry, TypedArray } from 'three';
export async function take(hb: Handlebody, body: BodyData, numbers: TypedArray, shown: DeformedGeometry) {
  const mesh = { positions: numbers, triangles: numbers };
  const bodies: BodyData[] = [await hb.bake(mesh), await hb.bake({ positions: numbers, tetrahedra: numbers }), await bakeInWorker(mesh)];
  const irbf = hb.irbf(body);
  irbf.setRestNormals(numbers);
  irbf.deform(numbers, numbers);
  const own: TypedArray = irbf.evaluate(numbers, numbers);
  const made: Float64Array = irbf.evaluate(numbers);
  shown.update(numbers, numbers);
  const rbf = hb.rbf({ dimension: 3, points: numbers, values: numbers, width: numbers, centers: numbers });
  rbf.evaluate(numbers, numbers);
  const skin = hb.linearBlend({ positions: numbers, weights: numbers });
  const moved: Float32Array = skin.deform();
  hb.biharmonicWeights(mesh, [{ vertices: numbers }]);
  hb.tetrahedralize(mesh).sample(numbers, numbers);
  hb.poseSpace({ dimensions: ['a'], examples: [{ name: 'b', at: numbers, shape: numbers }] }).evaluate(numbers, numbers);
  return [bodies, own, made, moved];
}
document.createElement('handle-body').addEventListener('change', ({ detail }) => detail.to[0].toFixed());
document.querySelector('pose-space')?.addEventListener('error', ({ detail }) => detail.remedy.trim());
export const takeGeometry = (hb: Handlebody, { attributes, index }: BufferGeometry) =>
  attributes.position && index && hb.bake({ positions: attributes.position.array, triangles: index.array });
`;

const USING = `
import { load } from 'handlebody';
import type { DeformedGeometry } from 'handlebody/three';
export async function use(body: Parameters<Awaited<ReturnType<typeof load>>['irbf']>[0], made: DeformedGeometry) {
  const hb = await load();
  using irbf = hb.irbf(body);
  using f = hb.shepard({ dimension: 1, points: [0, 1], values: [2, 3] });
  using shown = made;
  return [irbf.targets, f.size, shown.vertexCount];
}
`;

/** Every entry that has types, at once, but for those that name a framework's: see frameworks.mjs. @param {Record<string, unknown>} entries The manifest's exports. */
const everyEntry = (entries) =>
  Object.entries(entries)
    .filter(([entry, target]) => typeof target === 'object' && !/\/(react|vue|svelte)$/.test(entry))
    .map(([entry], i) => `export * as entry${i} from '${path.posix.join('handlebody', entry)}';\n`)
    .join('');

/**
 * Type-checks files in a project, under the resolution of Node and that of bundlers. Errors inside @types/three are its own.
 * @param {string} folder @param {Record<string, string>} sources @param {string[]} [newer] What the library knows besides ES2022 and the DOM.
 */
function typeCheck(folder, sources, newer = []) {
  for (const [name, source] of Object.entries(sources)) writeFileSync(path.join(folder, name), source);
  for (const [module, moduleResolution] of [
    ['NodeNext', 'NodeNext'],
    ['ESNext', 'Bundler'],
  ]) {
    const lib = ['es2022', 'dom', ...newer];
    const compilerOptions = { target: 'ES2022', module, moduleResolution, lib, types: [], strict: true, noEmit: true };
    writeFileSync(path.join(folder, 'tsconfig.json'), JSON.stringify({ compilerOptions, files: Object.keys(sources) }));
    const { stdout } = capture(
      process.execPath,
      [at('node_modules', 'typescript', 'bin', 'tsc'), '-p', folder, '--pretty', 'false'],
      {
        cwd: folder,
      },
    );
    // Indented lines go on about the error above.
    const errors = stdout.split('\n').filter((line) => /error TS/.test(line) && !/^\s|^node_modules\/@types\/three\//.test(line));
    if (errors.length > 0) throw new Error(`The packed library's types, under ${moduleResolution}:\n${errors.join('\n')}`);
  }
}

/** @param {string} folder A project with the packed library and three.js. @param {Record<string, unknown>} entries @param {string} three Its version. */
export function checkTypes(folder, entries, three) {
  typeCheck(folder, { 'entries.ts': everyEntry(entries), 'solver.ts': SOLVER, 'with-three.ts': THREE });
  typeCheck(folder, { 'using.ts': USING }, ['esnext.disposable']);
  console.log(`every entry type-checks without skipLibCheck, with three.js ${three}`);
}
