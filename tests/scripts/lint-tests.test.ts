import { describe, expect, it } from 'vitest';
import { lintTests } from '../../scripts/lint-tests.mjs';

const lint = (files: string[], untested: Record<string, string> = {}, ofMore: Record<string, string> = {}) =>
  lintTests(files, { untested, ofMore });

describe('a test beside every header of the core', () => {
  it('accepts pairs, sources, helpers and what is listed', () => {
    expect(
      lint(
        [
          'tests/core/made_meshes.hpp',
          'tests/core/main.cpp',
          'tests/core/weld_test.cpp',
          'tests/core/whole_test.cpp',
          'tests/ts/load.test.ts',
          'wasm/abi/handlebody.h',
          'wasm/core/errors/status.h',
          'wasm/core/mesh/weld.cpp',
          'wasm/core/mesh/weld.hpp',
          'wasm/core/numerics/types.hpp',
        ],
        { 'wasm/core/numerics/types.hpp': 'names alone' },
        { 'tests/core/whole_test.cpp': 'more than one' },
      ),
    ).toEqual([]);
  });

  it('names a header without a test, and the test that it wants', () => {
    expect(lint(['wasm/core/mesh/weld.hpp'])).toEqual(['wasm/core/mesh/weld.hpp: has no test, write tests/core/weld_test.cpp']);
  });

  it('finds headers at any depth', () => {
    expect(lint(['wasm/core/a.hpp', 'wasm/core/mesh/deep/b.hpp'])).toHaveLength(2);
  });

  it('names a test without a header', () => {
    expect(lint(['tests/core/weld_test.cpp'])).toEqual([
      expect.stringMatching(/^tests\/core\/weld_test\.cpp: there is no such header/),
    ]);
  });

  it('names two headers that would share a test', () => {
    expect(lint(['wasm/core/mesh/weld.hpp', 'wasm/core/skinning/weld.hpp', 'tests/core/weld_test.cpp'])).toEqual([
      'wasm/core/skinning/weld.hpp: has the name of wasm/core/mesh/weld.hpp, and so the same test',
    ]);
  });

  it('names exceptions that are none any more', () => {
    const files = ['wasm/core/mesh/weld.hpp', 'tests/core/weld_test.cpp'];
    expect(lint(files, { 'wasm/core/mesh/weld.hpp': 'too small' })).toEqual([
      'wasm/core/mesh/weld.hpp: has a test, take it from the exceptions',
    ]);
    expect(lint(files, { 'wasm/core/mesh/gone.hpp': 'names alone' }, { 'tests/core/lost_test.cpp': 'whole' })).toEqual([
      'wasm/core/mesh/gone.hpp: is gone, take it from the exceptions',
      'tests/core/lost_test.cpp: is gone, take it from the exceptions',
    ]);
  });
});
