// The layering of the house: nothing imports or includes upward, sideways or in a circle. The tables are the rules.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { findCycle, globalUses, isCpp, isScript, references } from './lib/imports.mjs';
import { at } from './lib/paths.mjs';
import { runMain } from './lib/run.mjs';
import { sourceFiles } from './lib/sources.mjs';

const GROUND = ['wasm/core/errors'];
const FLOOR_1 = [...GROUND, 'wasm/core/numerics', 'wasm/core/kernels', 'wasm/core/mesh'];
const FLOOR_2 = ['wasm/core/interpolation', 'wasm/core/distance', 'wasm/core/skinning'];
const FLOOR_3 = ['wasm/core/irbf', 'wasm/core/posespace'];
const CORE = [...FLOOR_1, ...FLOOR_2, ...FLOOR_3];
const BASE = ['wasm/ts', 'web/assets', 'web/models', 'web/three', 'web/worker'];
const KIT = [...BASE, 'web/ui', 'web/stage', 'web/figures/kit'];
const GLTF = '@gltf-transform/';
const D3 = ['d3-array', 'd3-contour', 'd3-scale', 'd3-shape'];

/**
 * What the files of a folder may use besides their own folder.
 * @typedef {object} Layer
 * @property {string[]} may folders of the project
 * @property {string[]} [packages] npm packages, by the beginning of their name; 'node:' stands for Node's own modules
 * @property {string[]} [lazy] packages that only a dynamic import() may name
 * @property {string[]} [never] packages that no chain of imports may reach
 * @property {string[]} [globals] globals that must not be touched
 * @property {boolean} [apart] its files do not use each other; what one of them uses alone lies in a folder of its name
 */

/** @type {Record<string, Layer>} The longest folder that contains a file decides. */
export const LAYERS = {
  'wasm/core/errors': { may: [] },
  'wasm/core/numerics': { may: GROUND },
  'wasm/core/kernels': { may: [...GROUND, 'wasm/core/numerics'] },
  'wasm/core/mesh': { may: [...GROUND, 'wasm/core/numerics'] },
  'wasm/core/interpolation': { may: FLOOR_1 },
  'wasm/core/distance': { may: FLOOR_1 },
  'wasm/core/skinning': { may: FLOOR_1 },
  'wasm/core/irbf': { may: [...FLOOR_1, ...FLOOR_2] },
  'wasm/core/posespace': { may: [...FLOOR_1, ...FLOOR_2] },
  'wasm/abi': { may: CORE },
  'wasm/ts': { may: [], packages: [], never: ['three', GLTF], globals: ['document', 'window'] },
  'web/assets': { may: ['wasm/ts'], packages: [GLTF, 'earcut'], lazy: ['meshoptimizer'], never: ['three'] },
  'web/models': { may: ['wasm/ts'], packages: ['delaunator', 'd3-contour'], never: ['three', GLTF] },
  'web/three': { may: ['wasm/ts', 'web/assets', 'web/ui'], packages: ['three'], never: [GLTF] },
  'web/worker': { may: ['wasm/ts', 'web/assets', 'web/models', 'web/three'], packages: [GLTF], never: [] },
  'web/ui': { may: [], packages: [] },
  'web/stage': { may: ['web/ui'], packages: ['three'] },
  'web/figures/kit': { may: [...BASE, 'web/ui', 'web/stage'], packages: ['three', ...D3] },
  'web/figures/course': { may: KIT, packages: ['three'], apart: true },
  'web/figures/irbf': { may: KIT, packages: ['three'], apart: true },
  'web/figures/skinning': { may: KIT, packages: ['three'], apart: true },
  'web/figures': { may: ['web/figures/kit', 'web/figures/course', 'web/figures/irbf', 'web/figures/skinning'] },
  'web/element': { may: [...KIT, 'web/figures'], packages: ['three', GLTF] },
  'web/cli': { may: [...BASE, 'web/figures'], packages: [GLTF, 'node:'] },
  'web/studio': { may: [...BASE, 'web/ui', 'web/stage', 'web/element'], packages: ['three', GLTF] },
  'web/embed': { may: ['web/ui', 'web/element'] },
  'web/learn': {
    may: [...BASE, 'web/ui', 'web/stage', 'web/figures', 'web/figures/kit', 'web/element'],
    packages: ['three', GLTF],
  },
};

/** Headers that would tie the core to one platform. */
const FOREIGN_HEADERS = /^(emscripten|wasm_simd128|abi\/)/;

/** Whether two files are one figure: "solid.ts", and what lies in "solid/". @param {string} a @param {string} b */
function areOne(a, b) {
  const home = (/** @type {string} */ file) => Object.keys(LAYERS).find((folder) => path.posix.dirname(file) === folder);
  const name = (/** @type {string} */ file) => (home(file) ? file.replace(/\.\w+$/, '') : path.posix.dirname(file));
  return name(a) === name(b);
}

/** The layer's folder of a file. @param {string} file */
function layerOf(file) {
  return Object.keys(LAYERS)
    .filter((folder) => file.startsWith(`${folder}/`))
    .sort((a, b) => b.length - a.length)[0];
}

/** @param {string} text @param {string[] | undefined} names */
const listed = (text, names) =>
  (names ?? []).some((name) => text === name || text.startsWith(name.endsWith('/') || name.endsWith(':') ? name : `${name}/`));

/**
 * All violations, as one line each.
 * @param {Map<string, string>} files every source file of the project with its text; paths with '/', from the project's folder
 */
export function lintLayers(files) {
  /** @type {string[]} */
  const violations = [];
  const graph = new Map([...files].map(([file, code]) => [file, references(file, code, files)]));
  const isPackage = (/** @type {import('./lib/imports.mjs').Reference} */ { text }) =>
    !text.startsWith('.') && !text.startsWith('/');

  for (const [file, refs] of graph) {
    const folder = layerOf(file);
    if (!folder) {
      if (/^(wasm|web)\/.+\/.+/.test(file) && (isCpp(file) || isScript(file)))
        violations.push(`${file}: its folder is in no layer, add it to the table`);
      continue;
    }
    const layer = /** @type {Layer} */ (LAYERS[folder]);
    const core = folder.startsWith('wasm/core/');
    for (const ref of refs) {
      const where = `${file}:${ref.line}: ${folder} must not`;
      if (core && FOREIGN_HEADERS.test(ref.text)) violations.push(`${where} include ${ref.text}`);
      else if (ref.file) {
        const target = layerOf(ref.file) ?? ref.file;
        if (target !== folder && !layer.may.includes(target)) violations.push(`${where} use ${target} (${ref.text})`);
        if (target === folder && layer.apart && !areOne(file, ref.file))
          violations.push(`${file}:${ref.line}: a figure uses its kit, never another one (${ref.text})`);
      } else if (isScript(file) && isPackage(ref)) {
        if (!listed(ref.text, layer.packages) && !(ref.dynamic && listed(ref.text, layer.lazy)))
          violations.push(`${where} import ${ref.text}`);
      }
    }
    if (layer.globals && isScript(file)) {
      for (const { name, line } of globalUses(file, files.get(file) ?? '', layer.globals))
        violations.push(`${file}:${line}: ${folder} must not touch ${name}`);
    }
    for (const name of layer.never ?? []) {
      const chain = chainTo(graph, file, (text) => listed(text, [name]));
      if (chain && chain.length > 2) violations.push(`${file}: ${folder} must never reach ${name}, and does: ${chain.join(' → ')}`);
    }
  }
  const cycle = findCycle(graph);
  if (cycle) violations.push(`circle: ${cycle.join(' → ')}`);
  return violations;
}

/**
 * The shortest chain of imports from a file to a package.
 * @param {Map<string, import('./lib/imports.mjs').Reference[]>} graph @param {string} start @param {(text: string) => boolean} isGoal
 */
function chainTo(graph, start, isGoal) {
  const queue = [[start]];
  const seen = new Set([start]);
  for (const trail of queue) {
    for (const ref of graph.get(/** @type {string} */ (trail.at(-1))) ?? []) {
      if (!ref.file && isGoal(ref.text)) return [...trail, ref.text];
      if (!ref.file || seen.has(ref.file)) continue;
      seen.add(ref.file);
      queue.push([...trail, ref.file]);
    }
  }
  return undefined;
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  await runMain(async () => {
    const sources = sourceFiles().filter((file) => isCpp(file) || isScript(file));
    const violations = lintLayers(new Map(sources.map((file) => [file, readFileSync(at(file), 'utf8')])));
    for (const violation of violations) console.error(violation);
    console.log(`layers: ${sources.length} files, ${violations.length} violations`);
    return violations.length === 0 ? 0 : 1;
  });
}
