import { describe, expect, it } from 'vitest';
import { lintExports, publicEntries } from '../../scripts/lint-exports.mjs';

const found = (files: Record<string, string>, ...entries: string[]) => lintExports(new Map(Object.entries(files)), entries);

describe('an export that nobody imports', () => {
  it('is named with file and line', () => {
    expect(found({ 'web/ui/a.ts': 'const b = 1;\nexport const a = b;\n' })).toEqual([
      'web/ui/a.ts:2: nothing imports a: delete it, or do not export it',
    ]);
  });

  it.each([
    ['a function', 'export function a() {}', 'a'],
    ['a class', 'export class a {}', 'a'],
    ['an interface', 'export interface A {}', 'A'],
    ['a type', 'export type A = number;', 'A'],
    ['a default', 'export default function a() {}', 'default'],
    ['a list', 'const b = 1;\nexport { b as a };', 'a'],
    ['a pattern', 'export const { b: [a] } = { b: [1] };', 'a'],
  ])('may be %s', (_, code, name) => {
    const lines = found({ 'scripts/lib/a.mjs': code });
    expect(lines).toHaveLength(1);
    expect(lines[0]).toContain(`nothing imports ${name}:`);
  });

  it('is one still when its own file uses it, or a list passes it on that nobody imports', () => {
    expect(found({ 'web/ui/a.ts': 'export const a = 1;\nconsole.log(a);' })).toHaveLength(1);
    expect(found({ 'web/ui/a.ts': 'export const a = 1;', 'web/ui/b.ts': "export { a as b } from './a.ts';" })).toEqual([
      'web/ui/b.ts:1: nothing imports b: delete it, or do not export it',
    ]);
  });

  it('is not looked for in tests', () => expect(found({ 'tests/ts/support/a.ts': 'export const a = 1;' })).toEqual([]));
});

describe('an import', () => {
  const a = { 'web/ui/a.ts': 'export const a = 1;\nexport const b = 2;' };
  const unused = ['web/ui/a.ts:2: nothing imports b: delete it, or do not export it'];
  it.each([
    ['a name', "import { a } from './a.ts';"],
    ['a name under another', "import { a as c } from './a.ts';"],
    ['a type', "import type { a } from './a.ts';"],
    ['a name when it is reached', "const { a } = await import('./a.ts');"],
    ['a property when it is reached', "console.log((await import('./a.ts')).a);"],
    ['a type in place', "let x: typeof import('./a.ts').a;"],
  ])('of %s takes that alone', (_, code) => expect(found({ ...a, 'web/ui/c.ts': code })).toEqual(unused));

  it('of a type in a comment of a script counts', () => {
    expect(found({ ...a, 'web/ui/c.mjs': "/** @param {import('./a.ts').a} x */\nfunction f(x) {}" })).toEqual(unused);
  });

  it.each([
    ['all under one name', "import * as everything from './a.ts';"],
    ['a module that is handed on', "const all = import('./a.ts');"],
  ])('of %s takes everything', (_, code) => expect(found({ ...a, 'web/ui/c.ts': code })).toEqual([]));

  it('of what tsc wrote stands for the source', () => {
    expect(found({ ...a, 'scripts/c.mjs': "import { a } from '../dist/web/ui/a.js';" })).toEqual(unused);
  });

  it('goes through files that pass everything on', () => {
    const files = { ...a, 'web/ui/all.ts': "export * from './a.ts';", 'web/ui/c.ts': "import { a } from './all.ts';" };
    expect(found(files)).toEqual(unused);
  });

  it('for its effect alone takes nothing', () => expect(found({ ...a, 'web/ui/c.ts': "import './a.ts';" })).toHaveLength(2));
});

it('what an entry of the package exports is public, passed on or not', () => {
  const files = { 'web/three/index.ts': "export * from './a.ts';\nexport const c = 1;", 'web/three/a.ts': 'export const a = 1;' };
  const entries = publicEntries({
    exports: { './three': { default: './dist/web/three/index.js' }, './package.json': './package.json' },
  });
  expect(entries).toEqual(['web/three/index.ts', 'package.json']);
  expect(found(files, ...entries)).toEqual([]);
  expect(found(files)).toHaveLength(2);
});
