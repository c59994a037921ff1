import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { fuzzTargets, unfuzzed } from '../../scripts/lib/fuzz.mjs';
import { at } from '../../scripts/lib/paths.mjs';
import { load } from '../../wasm/ts/index.ts';
import * as assets from '../../web/assets/index.ts';
import { parseHandles } from '../../web/cli/handles.ts';
import { targetsOf } from '../fuzz/parsers/targets.mjs';

const header = readFileSync(at('wasm', 'abi', 'handlebody.h'), 'utf8');
const sources = readdirSync(at('tests', 'fuzz'))
  .filter((file) => /\.(cpp|hpp)$/.test(file))
  .map((file) => readFileSync(at('tests', 'fuzz', file), 'utf8'));

describe('fuzzing the C interface', () => {
  it('calls every function of the header', () => {
    expect(unfuzzed(header, sources)).toEqual([]);
  });

  it('names a function that no target calls', () => {
    const more = `${header}\nHB_API const double* hb_new_thing(hb_new* thing);\nHB_WHOLE_API int32_t hb_newer(uint32_t count);\n`;
    expect(unfuzzed(more, sources)).toEqual(['hb_new_thing', 'hb_newer']);
    expect(unfuzzed(more, [...sources, 'hb_new_thing(made)', 'hb_newer_still(1)'])).toEqual(['hb_newer']);
  });

  it.each(fuzzTargets().map((target) => [target.name, target] as const))('%s has the files behind it, and seeds', (_, target) => {
    const source = readFileSync(at('tests', 'fuzz', `${target.program}.cpp`), 'utf8');
    const behind = [...source.matchAll(/^\/\/ behind: (.+)$/gm)].flatMap(([, files = '']) => files.split(' '));
    expect(behind.length).toBeGreaterThan(0);
    expect(behind.filter((file) => !existsSync(at('wasm', file)))).toEqual([]);
    expect(readdirSync(target.unpack()).length).toBeGreaterThan(10);
  });
});

it('npm run fuzz knows the targets of readers', async () => {
  const readers = /READERS = \[(.*)\]/.exec(readFileSync(at('scripts', 'fuzz.mjs'), 'utf8'))?.[1] ?? '';
  expect(readers.split(', ').map((name) => name.slice(1, -1))).toEqual(
    Object.keys(await targetsOf({ assets, parseHandles, load })),
  );
});
