import { describe, expect, it } from 'vitest';
import { ownNames, together } from '../../scripts/lib/tidy.mjs';

const source = (file: string, own: string, rest = '', includes = '') => ({
  file,
  code: `${includes}namespace handlebody {\nnamespace {\n\n${own}\n}  // namespace\n\n${rest}\n}  // namespace handlebody\n`,
});
const groupsOf = (sources: ReturnType<typeof source>[], read = (_: string) => '') =>
  together(sources, read)
    .map((group) => group.map(({ file }) => file).sort())
    .sort();

describe('ownNames', () => {
  it('are what a source names for itself, not what it calls or others see', () => {
    const own = `/** Not this. */
constexpr double farthest = 2;
const Vector3 sweep(.5, .6, .5);
struct Pair {
  int inner;
};
using Row = int;
template <class T> struct Half {};
Weld number_places(const Indices& first) {
  return other(first);
}
`;
    const { code } = source('a', own, 'int seen() { return 1; }');
    expect([...ownNames(code)].sort()).toEqual(['Half', 'Pair', 'Row', 'farthest', 'number_places', 'sweep']);
  });
});

describe('together', () => {
  const few = (count: number) => Array.from({ length: count }, (_, k) => source(`f${k}`, `int own${k};`));
  it('puts eight or so into each file, and each source into one', () => {
    const groups = groupsOf(few(24));
    expect(groups.map((group) => group.length)).toEqual([8, 8, 8]);
    expect(groups.flat().sort()).toEqual(
      few(24)
        .map(({ file }) => file)
        .sort(),
    );
  });
  it('parts two that name the same', () => {
    expect(groupsOf([source('a', 'int flat;'), source('b', 'double flat;')])).toEqual([['a'], ['b']]);
  });
  it('parts one that names what another uses', () => {
    expect(groupsOf([source('a', 'int flat;'), source('b', '', 'int x = mesh.flat;')])).toEqual([['a'], ['b']]);
  });
  it('does not part those that only speak of it', () => {
    expect(groupsOf([source('a', 'int flat;'), source('b', '', '// flat')])).toEqual([['a', 'b']]);
  });
  it('parts one that names what is in a header of another, however far', () => {
    const read = (name: string) => (name === 'h.hpp' ? '#include "deep.hpp"\n' : 'double flat();');
    expect(groupsOf([source('a', 'int flat;'), source('b', '', '', '#include "h.hpp"\n')], read)).toEqual([['a'], ['b']]);
    const both = [source('a', 'int flat;', '', '#include "h.hpp"\n'), source('b', '', '', '#include "h.hpp"\n')];
    expect(groupsOf(both, read)).toEqual([['a', 'b']]);
  });
});
