/** The command on models of formats that hold a mesh and nothing else, by whatever name; what it says was passed over; boxes of numbers. */
import { writeFileSync } from 'node:fs';
import { Document } from '@gltf-transform/core';
import { afterEach, beforeAll, beforeEach, expect, it } from 'vitest';
import { writeGlb } from '../../web/assets/index.ts';
import { buildCommand, Workbench } from './support/cli.ts';
import { binaryPly, binaryStl, obj, off, ply, prism, stl, utf16 } from './support/made-files.mjs';

let script: string;
let bench: Workbench;

beforeAll(() => {
  script = buildCommand('formats');
});
beforeEach(() => {
  bench = new Workbench(script);
});
afterEach(() => bench.dispose());

const bar = prism([
  [0, 0],
  [2, 0],
  [2, 1],
  [0, 1],
]);
const BOX = { low: [0, 0, 0], high: [2, 1, 1] };

it.each([
  ['a.stl', binaryStl(bar), 'STL'],
  ['text.stl', stl(bar), 'STL'],
  ['a.off', off(bar), 'OFF'],
  ['a.ply', binaryPly(bar, false, 'double'), 'PLY'],
  ['utf16.obj', utf16(obj(bar), true, true), 'OBJ'],
  ['stl-by.obj', stl(bar), 'STL'],
  ['off-by.glb', off(bar), 'OFF'],
  ['obj-by.txt', obj(bar), 'OBJ'],
])('inspects %s', async (name, content, format) => {
  writeFileSync(bench.at(name), content);
  expect(await bench.json('inspect', name)).toMatchObject({
    format,
    vertices: 8,
    triangles: 12,
    components: 1,
    bounds: BOX,
    warnings: [],
  });
});

it.each([
  ['a.stl', stl(bar)],
  ['a.off', off(bar)],
])('bakes %s', async (name, content) => {
  writeFileSync(bench.at(name), content);
  const baked = await bench.json('bake', name, '-o', 'body.glb', '--centers', '20', '--resolution', '24');
  expect(baked).toMatchObject({ vertices: 8, triangles: 12, warnings: [] });
  expect(await bench.json('inspect', 'body.glb')).toMatchObject({ body: { matches: true } });
});

it('says what it passes over, and with --strict refuses it', async () => {
  writeFileSync(bench.at('odd.obj'), `vn nan 0 0\nhello\nhello\n${obj(bar)}f 1 2\nv nan 0 0\n`);
  const { warnings, bounds } = await bench.json('inspect', 'odd.obj');
  expect(bounds).toEqual(BOX);
  const corners = `${BOX.low.join(', ')} to ${BOX.high.join(', ')}`;
  expect((await bench.run('inspect', 'odd.obj')).stdout).toMatch(new RegExp(`bounds +${corners.replaceAll('.', '\\.')}\\n`));
  expect(warnings).toMatchObject([
    { code: 'normals-bad', message: /^1 / },
    { code: 'statements-unknown', message: /^2 / },
    { code: 'faces-degenerate', message: /^1 /, remedy: /./ },
    { code: 'positions-bad', message: /^1 / },
  ]);
  for (const command of [
    ['inspect', 'odd.obj'],
    ['bake', 'odd.obj', '-o', 'out.glb'],
  ]) {
    const { status, stderr } = await bench.run(...command, '--strict');
    expect([status, stderr]).toEqual([3, expect.stringMatching(/"odd\.obj": Line 1 .*"nan"[\s\S]*file-invalid/)]);
  }
});

it.each([
  ['odd.obj', obj],
  ['odd.off', off],
  ['odd.ply', ply],
])('says once what is odd about a surface, inspect as it is kept, bake as it is passed over: %s', async (name, write) => {
  const odd = { points: [...bar.points, [1, 0.5, 0.5]], faces: [...bar.faces, bar.faces[0], bar.faces[3], [0, 0, 1]] };
  writeFileSync(bench.at(name), write(odd as never));
  const codes = (warnings: { code: string }[]) => warnings.map(({ code }) => code).sort();
  expect(codes((await bench.json('inspect', name)).warnings)).toEqual(['triangles-doubled', 'triangles-flat']);
  const { warnings } = await bench.json('bake', name, '-o', 'out.glb', '--centers', '20', '--resolution', '24');
  expect(codes(warnings)).toEqual(['triangles-doubled', 'triangles-flat', 'vertices-unused']);
  expect(JSON.stringify(warnings)).not.toContain('kept');
});

it.each([
  ['NaN', Float32Array.of(0, 0, 0, 1, Number.NaN, 0, 0, 1, 0), [1, 1, 1]],
  ['an infinite number', Float32Array.of(0, 0, 0, 1, 0, Number.POSITIVE_INFINITY, 0, 1, 0), [1, 1, 1]],
  ['a scale that floats cannot hold', Float32Array.of(0, 0, 0, 1e5, 0, 0, 0, 1e5, 0), [1e38, 1e38, 1e38]],
] as const)('gives no box of a GLB with %s', async (_, positions, scale) => {
  const document = new Document();
  const accessor = document.createAccessor('', document.createBuffer()).setType('VEC3').setArray(positions.slice());
  const primitive = document.createPrimitive().setAttribute('POSITION', accessor);
  const node = document
    .createNode()
    .setMesh(document.createMesh().addPrimitive(primitive))
    .setScale([...scale]);
  document.getRoot().setDefaultScene(document.createScene().addChild(node));
  writeFileSync(bench.at('odd.glb'), await writeGlb(document));
  const { status, stdout } = await bench.run('inspect', 'odd.glb', '--json');
  expect(status).toBeGreaterThan(2);
  expect(JSON.parse(stdout).error).toMatchObject({ code: expect.stringMatching(/^(mesh-not-finite|file-invalid)$/) });
});

it('takes the box of what triangles use', async () => {
  writeFileSync(bench.at('stray.obj'), `${obj(bar)}v 1e6 0 0\n`);
  expect(await bench.json('inspect', 'stray.obj')).toMatchObject({ vertices: 9, bounds: BOX });
});

it.each(['a.obj', 'a.ply', 'a.stl', 'a.off', 'a.glb'])('refuses an empty %s, and one without a mesh', async (name) => {
  for (const content of ['', 'hello\n', '# nothing\n', '\0\0\0\0']) {
    writeFileSync(bench.at(name), content);
    const { status, stdout } = await bench.run('inspect', name, '--json');
    expect([status, JSON.parse(stdout).error?.code]).toEqual([3, expect.stringMatching(/^file-/)]);
  }
});
