// Writes the generated modules of wasm/ts: the C interface as TypeScript (from the headers) and each wasm file as a string.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';

const root = fileURLToPath(new URL('..', import.meta.url));
const at = (/** @type {string} */ name) => path.join(root, name);

/** Sizes and alignments of the struct members that the header uses, for wasm32. */
const SIZES = { double: 8, int32_t: 4, uint32_t: 4, char: 1 };

/** @param {string} text */
function withoutComments(text) {
  return text.replace(/\/\*[\s\S]*?\*\//g, '');
}

/** @param {string} header @param {string} prefix @returns {[string, number][]} */
function enumEntries(header, prefix) {
  return [...withoutComments(header).matchAll(new RegExp(`${prefix}([A-Z0-9_]+) = (\\d+)`, 'g'))].map((m) => [
    /** @type {string} */ (m[1]).toLowerCase().replaceAll('_', '-'),
    Number(m[2]),
  ]);
}

/** @param {string} header */
function structLayouts(header) {
  const layouts = [];
  for (const [, body, name] of withoutComments(header).matchAll(/typedef struct \w+ \{([\s\S]*?)\} (\w+);/g)) {
    let offset = 0;
    let alignment = 1;
    const fields = [];
    for (const declaration of /** @type {string} */ (body).split(';')) {
      const member = declaration.trim().match(/^(?:const )?(\w+?)(\*?) (\w+)(?:\[(\d+)\])?$/);
      if (!member) continue;
      const [, type, pointer, field, count] = member;
      const size = pointer ? 4 : SIZES[/** @type {keyof typeof SIZES} */ (type)];
      if (!size) throw new Error(`generate: no size known for "${declaration.trim()}" in ${name}`);
      offset = Math.ceil(offset / size) * size;
      alignment = Math.max(alignment, size);
      fields.push(`    ${field}: ${offset},`);
      offset += size * Number(count ?? 1);
    }
    layouts.push(`  ${name}: {\n    sizeof: ${Math.ceil(offset / alignment) * alignment},\n${fields.join('\n')}\n  },`);
  }
  return layouts.join('\n');
}

/** The most arguments that a call may take: beyond, they are too easily swapped, and a struct names them. */
const MOST_ARGUMENTS = 8;

/** The functions behind one marker, as methods. @param {string} header @param {'HB_API' | 'HB_WHOLE_API'} marker */
function exportSignatures(header, marker) {
  const functions = withoutComments(header).matchAll(new RegExp(`^${marker} (.+?)(hb_\\w+)\\((.*)\\);$`, 'gm'));
  const signatures = [...functions].map(([, type, name, parameters]) => {
    const names =
      parameters === 'void'
        ? []
        : /** @type {string} */ (parameters).split(',').map((p) => `${p.trim().match(/(\w+)$/)?.[1]}: number`);
    if (names.length > MOST_ARGUMENTS) throw new Error(`generate: ${name} takes ${names.length} arguments; put some into a struct`);
    return `  ${name}(${names.join(', ')}): ${/** @type {string} */ (type).trim() === 'void' ? 'void' : 'number'};`;
  });
  return signatures.join('\n');
}

const status = readFileSync(at('wasm/core/errors/status.h'), 'utf8');
const abi = readFileSync(at('wasm/abi/handlebody.h'), 'utf8');
const codes = enumEntries(status, 'HB_ERROR_');
const warnings = enumEntries(status, 'HB_WARNING_');
const culprits = enumEntries(status, 'HB_CULPRIT_');
/** @param {[string, number][]} entries */
const map = (entries) => entries.map(([name, value]) => `  ${value}: '${name}',`).join('\n');

/** Nothing where it is there already: another command may be reading it. @param {string} name @param {string} text */
function write(name, text) {
  if (existsSync(at(name)) && readFileSync(at(name), 'utf8') === text) return;
  mkdirSync(path.dirname(at(name)), { recursive: true });
  writeFileSync(at(name), text);
}

write(
  'wasm/ts/abi.generated.ts',
  `// Generated from wasm/abi/handlebody.h and wasm/core/errors/status.h by scripts/generate.mjs.

export const ERROR_CODES = {
${map(codes)}
} as const;

/** Stable names of what can go wrong in the solver. */
export type SolverErrorCode = (typeof ERROR_CODES)[keyof typeof ERROR_CODES];

export const WARNING_CODES = {
${map(warnings)}
} as const;

/** Stable names of what a bake may warn of. */
export type WarningCode = (typeof WARNING_CODES)[keyof typeof WARNING_CODES];

export const CULPRIT_KINDS = {
${map(culprits)}
} as const;

export type CulpritKind = Exclude<(typeof CULPRIT_KINDS)[keyof typeof CULPRIT_KINDS], 'none'>;

/** Byte offsets of the C structs' members. */
export const LAYOUT = {
${structLayouts(abi)}
} as const;

/** What both wasm files export, handlebody.runtime.wasm nothing else. */
export interface RuntimeExports {
  readonly memory: WebAssembly.Memory;
${exportSignatures(abi, 'HB_API')}
}

/** The exports of handlebody.wasm. */
export interface Exports extends RuntimeExports {
${exportSignatures(abi, 'HB_WHOLE_API')}
}
`,
);

/**
 * Style sheets as the elements take them into their shadow: its root stands for the page's, and lengths do not hang on the page's letters.
 * @param {readonly string[]} files
 */
function stylesOf(files) {
  const css = files.map((file) => readFileSync(at(file), 'utf8')).join('\n');
  return (
    css
      .replace(/\/\*[\s\S]*?\*\//g, '')
      .replaceAll(':root', ':host')
      // As the page around has it.
      .replace('color-scheme: light dark;', '')
      .replace(/^(?!@).*$/gm, (line) => line.replace(/(-?[\d.]+)rem\b/g, 'calc($1 * var(--rem))'))
      .replace(/\s+/g, ' ')
      // Without spaces and semicolons that mean nothing. Spaces around + and -, and before a colon, mean something and stay.
      .replace(/ ?([{};,>]) ?/g, '$1')
      .replace(/([\w-]): /g, '$1:')
      .replaceAll(';}', '}')
      .trim()
  );
}

const ELEMENT_STYLES = ['tokens', 'base', 'stage', 'handles', 'messages'].map((name) => `web/styles/${name}.css`);
const FIGURE_STYLES = [
  ...['bar', 'palette', 'chart', 'points', 'field'].map((name) => `web/styles/${name}.css`),
  ...['panel', 'card', 'figure', 'shape'].map((name) => `web/figures/kit/${name}.css`),
];
/** @type {[file: string, name: string, styles: string[]][]} */
const SHEETS = [
  ['web/element/styles.generated.ts', 'STYLES', [...ELEMENT_STYLES, 'web/element/element.css']],
  // Apart: fetched with what they are for.
  ['web/element/pad-styles.generated.ts', 'PAD_STYLES', ['web/element/pad.css', 'web/element/pose.css']],
  ['web/element/figure-styles.generated.ts', 'FIGURE_STYLES', [...FIGURE_STYLES, 'web/element/figure.css']],
];
for (const [file, name, styles] of SHEETS) {
  write(
    file,
    `// Generated from ${styles.join(', ')} by scripts/generate.mjs.
export const ${name}: string = ${JSON.stringify(stylesOf(styles))};
`,
  );
}

/** @type {[from: string, to: string][]} */
const MODULES = [
  ['wasm/handlebody.wasm', 'wasm/ts/binary.generated.ts'],
  ['wasm/handlebody.runtime.wasm', 'wasm/ts/runtime-binary.generated.ts'],
];
for (const [file, name] of MODULES) {
  if (!existsSync(at(file))) throw new Error(`${file} is not there: run npm run build:wasm, or check it out again.`);
  const wasm = readFileSync(at(file));
  write(
    name,
    `// Generated from ${file} by scripts/generate.mjs: raw deflate, base64.
export const WASM_BYTES = ${wasm.length};
export const WASM_DEFLATED_BASE64: string =
  '${deflateRawSync(wasm, { level: 9 }).toString('base64')}';
`,
  );
}

/** A worker's script in one piece, without the wasm. */
async function bundled(/** @type {string} */ entry) {
  const { build } = await import('vite');
  const made = await build({
    configFile: false,
    root,
    logLevel: 'warn',
    build: {
      write: false,
      target: 'es2022',
      modulePreload: false,
      rolldownOptions: { input: at(entry), output: { codeSplitting: false } },
    },
  });
  const [result] = [made].flat();
  const chunks = result && 'output' in result ? result.output.filter((file) => file.type === 'chunk') : [];
  const [chunk] = chunks;
  if (!chunk || chunks.length !== 1) throw new Error(`generate: ${entry} is not one script`);
  return chunk.code.trim();
}

write(
  'web/worker/blob-worker.generated.ts',
  `// Generated from web/worker/blob-worker.ts by scripts/generate.mjs.
export const BLOB_WORKER: string = ${JSON.stringify(await bundled('web/worker/blob-worker.ts'))};
`,
);
