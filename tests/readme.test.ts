import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';
import { beforeAll, describe, expect, it } from 'vitest';

const root = fileURLToPath(new URL('..', import.meta.url));
const folder = path.join(root, 'build', 'readme');
const text = (file: string) => readFileSync(path.join(root, file), 'utf8');

const PAGES = [
  'README.md',
  'docs/embedding.md',
  'docs/recipes/README.md',
  'wasm/ts/README.md',
  'web/cli/README.md',
  'web/embed/README.md',
  'tests/bench/README.md',
  'CONTRIBUTING.md',
];

/** Every TypeScript block of the README and of the library's page, as a module that hands out its results. */
const examples = [
  ...PAGES.map(text)
    .join('\n')
    .matchAll(/^```ts\n([\s\S]*?)^```$/gm),
].map((match, index) => ({
  code: match[1] ?? '',
  file: path.join(folder, `example-${index + 1}.ts`),
}));

beforeAll(() => {
  mkdirSync(folder, { recursive: true });
  for (const { code, file } of examples) {
    const names = [...code.matchAll(/^const (?:(\w+)|\{ ([\w, ]+) \}) =/gm)].map((match) => match[1] ?? match[2]);
    writeFileSync(file, `${code}\nexport { ${names.join(', ')} };\n`);
  }
});

describe("the README's examples", () => {
  it('are there', () => expect(examples).toHaveLength(7));

  it('are about ten lines', () => {
    for (const { code } of examples)
      expect(code.split('\n').filter((line) => line && !line.startsWith('import')).length).toBeLessThan(12);
  });

  it('type-check under the strictest options', () => {
    const { config } = ts.readConfigFile(path.join(root, 'tsconfig.json'), ts.sys.readFile);
    const { options } = ts.parseJsonConfigFileContent({ ...config, files: [], include: [] }, ts.sys, root);
    const entries = {
      handlebody: ['wasm/ts/index.ts'],
      'handlebody/runtime': ['wasm/ts/runtime.ts'],
      'handlebody/three': ['web/three/index.ts'],
    };
    const paths = Object.fromEntries(
      Object.entries(entries).map(([name, files]) => [name, files.map((file) => path.join(root, file))]),
    );
    const program = ts.createProgram(
      examples.map(({ file }) => file),
      { ...options, paths, noEmit: true },
    );
    const problems = ts.getPreEmitDiagnostics(program).map((problem) => ts.flattenDiagnosticMessageText(problem.messageText, '\n'));
    expect(problems).toEqual([]);
  });

  it('bend the capsule: its held end arrives and its other end stays', async () => {
    const { irbf, positions, mesh } = await import(/* @vite-ignore */ examples[0]?.file ?? '');
    const imageOf = (point: number[]) => Array.from(irbf.evaluate(point) as Float64Array);
    for (const [at, to] of [
      [
        [0, 0.5, 0],
        [0.3, 0.45, 0],
      ],
      [
        [0, 0, 0],
        [0, 0, 0],
      ],
      [
        [0, -0.5, 0],
        [0, -0.5, 0],
      ],
    ] as const) {
      const image = imageOf([...at]);
      expect(Math.hypot(...image.map((x, i) => x - (to[i] ?? 0)))).toBeLessThan(0.01);
    }
    expect(positions).toHaveLength(mesh.positions.length);
    expect(positions.every(Number.isFinite)).toBe(true);
  });

  it('bend the beam: hard constraints are met, the volume is kept, and space deforms with it', async () => {
    const { irbf, volumeRatio, distortion, flips, condition, anywhere } = await import(/* @vite-ignore */ examples[2]?.file ?? '');
    const end = Array.from(irbf.evaluate([2, 0, 0]) as Float64Array);
    expect(Math.hypot((end[0] ?? 0) - 2, (end[1] ?? 0) - 1, end[2] ?? 0)).toBeLessThan(1e-6);
    expect(Math.abs(volumeRatio - 1)).toBeLessThan(0.1);
    expect(distortion.total).toBeGreaterThan(distortion.max);
    expect(flips).toBe(0);
    expect(condition).toBeGreaterThan(1);
    expect(anywhere).toHaveLength(6);
  });

  it('make the box higher about its largest sphere', async () => {
    const { irbf } = await import(/* @vite-ignore */ examples[3]?.file ?? '');
    const [x = 0, y = 0, z = 0, radius = 0] = irbf.body.spheres;
    const { center, diagonal } = irbf.body.normalization;
    const ends = [-radius, radius].flatMap((up) => [x, y + up, z].map((c, axis) => center[axis] + diagonal * c));
    const moved = irbf.evaluate(ends) as Float64Array;
    expect(Math.abs(((moved[4] as number) - (moved[1] as number)) / (3 * radius * diagonal) - 1)).toBeLessThan(0.02);
  });

  it('blend the faces: each example is met at its own place', async () => {
    const { space, examples: faces, shape } = await import(/* @vite-ignore */ examples[4]?.file ?? '');
    expect(shape).toHaveLength(3);
    for (const face of faces) {
      const got = Array.from(space.evaluate(face.at) as Float64Array);
      got.forEach((x, i) => {
        expect(x).toBeCloseTo(face.shape[i], 6);
      });
    }
  });

  it('pass through their points, gently or not', async () => {
    const { data, surface, heights, slope, report, gentle } = await import(/* @vite-ignore */ examples[5]?.file ?? '');
    expect(heights[0]).toBeCloseTo(2, 6);
    data.values.forEach((value: number, i: number) => {
      expect(surface.evaluate(data.points.slice(2 * i, 2 * i + 2))[0]).toBeCloseTo(value, 6);
    });
    expect(slope).toHaveLength(2);
    expect(report.condition).toBeGreaterThan(1);
    expect(gentle[0]).toBeGreaterThan(0);
    expect(gentle[0]).toBeLessThan(2);
  });

  it('bend the plane: its right end stands upright, its left end stays', async () => {
    const { mesh, bent, weights } = await import(/* @vite-ignore */ examples[6]?.file ?? '');
    expect(weights).toHaveLength((mesh.positions.length / 3) * 2);
    for (let v = 0; v < mesh.positions.length / 3; v++) {
      const [x, y] = mesh.positions.slice(3 * v, 3 * v + 2);
      if (Math.abs(y) > 1e-6 || Math.abs(x) < 1.55) continue;
      const image = x < 0 ? [x, y] : [2 - y, x];
      expect(Math.hypot(bent[3 * v] - image[0], bent[3 * v + 1] - image[1])).toBeLessThan(1e-5);
    }
  });
});

describe('the documents', () => {
  it.each(PAGES)('%s links to files that are there', (file) => {
    const links = [...text(file).matchAll(/\]\((?!https?:|#|mailto:)([^)#\s]+)/g)].map((match) => match[1] ?? '');
    expect(links.filter((link) => !existsSync(path.join(root, path.dirname(file), link)))).toEqual([]);
  });

  it.each(PAGES)('%s names only npm scripts that exist', (file) => {
    const known = Object.keys(JSON.parse(text('package.json')).scripts);
    const named = [...text(file).matchAll(/npm (?:run )?(start|test|(?<=run )[\w:-]+)/g)].map((match) => match[1] ?? '');
    expect(named.filter((name) => !known.includes(name))).toEqual([]);
  });
});
