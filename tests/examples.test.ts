// The examples in the doc comments of everything that the package exports: each is there, compiles, and runs where Node can run it.
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import ts from 'typescript';
import { describe, expect, it } from 'vitest';
import manifest from '../package.json' with { type: 'json' };

const root = path.resolve(import.meta.dirname, '..');
const folder = path.join(root, 'build', 'examples');

/** The package's entries that have sources, by the name that they are imported by. */
const entries = Object.entries(manifest.exports).flatMap(([entry, target]) => {
  const source = typeof target === 'object' ? target.types.replace(/^\.\/dist\//, '').replace(/\.d\.ts$/, '.ts') : '';
  const isSource = source !== '' && existsSync(path.join(root, source));
  return isSource ? [[path.posix.join('handlebody', entry), path.join(root, source)] as const] : [];
});

type World = Readonly<Record<string, string>>;

const SUPPORT = `await import('${path.join(root, 'tests', 'ts', 'support', 'example-world.ts')}')`;
const PLANE: World = { mesh: `(${SUPPORT}).square()` };
const OBJ = "'v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nv 0 0 1\\nf 1 3 2\\nf 1 2 4\\nf 2 3 4\\nf 3 1 4\\n'";
const PLY =
  "'ply\\nformat ascii 1.0\\nelement vertex 4\\nproperty float x\\nproperty float y\\nproperty float z\\nelement face 4\\nproperty list uchar int vertex_indices\\nend_header\\n0 0 0\\n1 0 0\\n0 1 0\\n0 0 1\\n3 0 2 1\\n3 0 1 3\\n3 1 2 3\\n3 2 0 3\\n'";

const OFF = "'OFF 4 4 6\\n0 0 0\\n1 0 0\\n0 1 0\\n0 0 1\\n3 0 2 1\\n3 0 1 3\\n3 1 2 3\\n3 2 0 3\\n'";
const STL = `'solid a\\n${['0 0 0,0 1 0,1 0 0', '0 0 0,1 0 0,0 0 1', '1 0 0,0 1 0,0 0 1', '0 1 0,0 0 0,0 0 1']
  .map((facet) => `facet normal 0 0 0\\nouter loop\\nvertex ${facet.replaceAll(',', '\\nvertex ')}\\nendloop\\nendfacet\\n`)
  .join('')}endsolid a\\n'`;

/** What examples take for granted, each from those before it. */
const WORLD: World = {
  gltf: "({ scene: new (await import('three')).Mesh(new (await import('three')).CapsuleGeometry(0.2, 1, 8, 16)) }) as unknown as import('three/addons/loaders/GLTFLoader.js').GLTF",
  hb: "await (await import('handlebody')).load()",
  mesh: "(await import('handlebody/three')).meshFromObject(gltf.scene).mesh",
  body: 'await hb.bake(mesh, { resolution: 24, centers: 20, spheres: 10 })',
  irbf: 'hb.irbf(body)',
  object: 'gltf.scene',
  positions: 'new Float32Array(mesh.positions.length)',
  normals: 'new Float32Array(mesh.positions.length)',
  neutral: 'new Float32Array(positions.length)',
  happy: 'new Float32Array(positions.length)',
  sad: 'new Float32Array(positions.length)',
  signal: 'new AbortController().signal',
  bar: '{ value: 0 }',
  camera: "new (await import('three')).PerspectiveCamera()",
  scene: "new (await import('three')).Scene()",
  container: 'globalThis.document.body',
  renderer: "new (await import('three')).WebGLRenderer()",
};

/** What those of the files take for granted besides. */
const FILES: World = {
  document: `(${SUPPORT}).documentOf(mesh)`,
  face: "document.getRoot().listMeshes()[0] as import('@gltf-transform/core').Mesh",
  bytes: "await (await import('handlebody/gltf-transform')).writeGlb(document)",
  file: 'new Blob([bytes as BlobPart])',
  json: "{ asset: { version: '2.0' } }",
  text: 'JSON.stringify(json)',
  writeFile: 'async (_name: string, _bytes: Uint8Array) => {}',
};

const OWN: Record<string, World> = {
  BiharmonicWeights: PLANE,
  EnergyMinimizer: {
    ...PLANE,
    positions: 'mesh.positions',
    triangles: 'mesh.triangles',
    out: 'new Float32Array(positions.length)',
  },
  meshDocument: { bytes: `new TextEncoder().encode(${OBJ})` },
  readObj: { file: `new Blob([${OBJ}])` },
  readOff: { file: `new Blob([${OFF}])` },
  readPly: { file: `new Blob([${PLY}])` },
  readStl: { file: `new Blob([${STL}])` },
  writeGlb: { bytes: `new TextEncoder().encode(${OBJ})` },
};

/** Exports of other packages, as if imported. */
const IMPORTED: World = { GLTFLoader: 'three/addons/loaders/GLTFLoader.js', NodeIO: '@gltf-transform/core', Vector3: 'three' };

/** What only a browser can run, or only a file that a browser has read, or the built package. */
const NEEDS_ELSE = /\bcontainer\b|querySelector|handlebodyData\(gltf\)|external'/;

const { config } = ts.readConfigFile(path.join(root, 'tsconfig.json'), ts.sys.readFile);
const { options: strict } = ts.parseJsonConfigFileContent({ ...config, files: [], include: [] }, ts.sys, root);
const paths = Object.fromEntries(entries.map(([name, file]) => [name, [file]]));
const options = {
  ...strict,
  paths,
  noEmit: true,
  noUnusedLocals: false,
  noUnusedParameters: false,
  verbatimModuleSyntax: false,
  rewriteRelativeImportExtensions: false,
};

const program = ts.createProgram(
  entries.map(([, file]) => file),
  options,
);
const checker = program.getTypeChecker();

/** Functions and classes that a module exports, each with its doc comments' text. */
function exportsOf(file: string): { name: string; comment: string; symbol: ts.Symbol; isShown: boolean }[] {
  const module = checker.getSymbolAtLocation(program.getSourceFile(file) as ts.SourceFile) as ts.Symbol;
  return checker.getExportsOfModule(module).map((exported) => {
    const symbol = exported.flags & ts.SymbolFlags.Alias ? checker.getAliasedSymbol(exported) : exported;
    const comment = (symbol.declarations ?? [])
      .map((node) => node.getFullText().slice(0, node.getStart() - node.getFullStart()))
      .join('\n')
      .replace(/^ *\* ?/gm, '');
    const isProgram = (symbol.flags & (ts.SymbolFlags.Function | ts.SymbolFlags.Class)) !== 0;
    return { name: exported.name, comment, symbol, isShown: isProgram && !comment.includes('@internal') };
  });
}

const homes = new Map<ts.Symbol, { entry: string; name: string; comment: string; isShown: boolean }>();
/** Which entry exports a name; the first one. */
const exporters = new Map<string, string>();
for (const [entry, file] of entries) {
  for (const { symbol, ...rest } of exportsOf(file)) {
    if (!homes.has(symbol)) homes.set(symbol, { entry, ...rest });
    if (!exporters.has(rest.name)) exporters.set(rest.name, entry);
  }
}
const shown = [...homes.values()].filter(({ isShown }) => isShown);

const examples = [...homes.values()].flatMap(({ entry, name, comment }, number) =>
  [...comment.matchAll(/^```ts\n([\s\S]*?)^```$/gm)].map((match, i) => {
    const file = path.join(folder, `${number}-${entry.replaceAll('/', '-')}-${name}-${i + 1}.ts`);
    return { title: `${name} of "${entry}"`, file, code: match[1] ?? '', name, entry };
  }),
);

/** An example as a module: with the world that it takes for granted, and the imports. */
function moduleOf({ code, name, entry }: (typeof examples)[number]): string {
  const world = { ...WORLD, ...(entry.endsWith('gltf-transform') && FILES), ...OWN[name] };
  const uses = (text: string, word: string) => new RegExp(`(?<![.\\w'/-])${word}\\b(?!:)`).test(text);
  const declares = (text: string, word: string) =>
    new RegExp(`(const|let) (\\{[^}]*|\\[[^\\]]*)?\\b${word}\\b|import [^;]*\\b${word}\\b`).test(text);
  let outside = '';
  // From the last to the first: what one is made of comes before it.
  for (const [word, value] of Object.entries(world).reverse())
    if ((uses(code, word) && !declares(code, word)) || uses(outside, word)) outside = `const ${word} = ${value};\n${outside}`;
  const own = code.replace(/^import .*\n/gm, '');
  const asked = [...code.matchAll(/^import .*\n/gm)].join('');
  const imports = [...exporters, ...Object.entries(IMPORTED)].filter(([word]) => uses(code, word) && !declares(code, word));
  // In a block, so that it may call its own what the world calls so, too.
  return `${imports.map(([word, from]) => `import { ${word} } from '${from}';\n`).join('')}${asked}${outside}{\n${own}}\nexport {};\n`;
}

describe('the examples in the doc comments', () => {
  it('are there, for every function and class that the package exports', () => {
    expect(shown.length).toBeGreaterThan(50);
    expect(shown.filter(({ comment }) => !comment.includes('```ts')).map(({ name, entry }) => `${name} of "${entry}"`)).toEqual([]);
  });

  it('compile', () => {
    mkdirSync(folder, { recursive: true });
    for (const example of examples) writeFileSync(example.file, moduleOf(example));
    const compiled = ts.createProgram(
      examples.map(({ file }) => file),
      options,
    );
    const own = new Set(examples.map(({ file }) => file));
    const found = ts.getPreEmitDiagnostics(compiled).filter(({ file }) => !file || own.has(path.normalize(file.fileName)));
    const problems = found.map(({ file, messageText }) => {
      const text = ts.flattenDiagnosticMessageText(messageText, '\n');
      return `${path.relative(folder, file?.fileName ?? '')}: ${text}`;
    });
    expect(problems).toEqual([]);
  });

  it.each(examples.filter(({ code }) => !NEEDS_ELSE.test(code)).map(({ title, file }) => [title, file] as const))(
    'run: %s',
    async (_, file) => {
      await import(/* @vite-ignore */ file);
    },
  );
});
