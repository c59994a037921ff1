import { readdirSync, readFileSync } from 'node:fs';
import { beforeAll, describe, expect, it } from 'vitest';
import { type Element, readElements } from '../../scripts/lib/elements-manifest.mjs';
import { HandleBodyElement, HandleFigureElement, PoseSpaceElement } from '../../web/element/index.ts';
import { STYLES } from '../../web/element/styles.generated.ts';

const CLASSES = { 'handle-body': HandleBodyElement, 'handle-figure': HandleFigureElement, 'pose-space': PoseSpaceElement };

const sources = readdirSync('web/element')
  .filter((file) => /\.ts$/.test(file) && !file.includes('generated'))
  .map((file) => readFileSync(`web/element/${file}`, 'utf8'))
  .join('\n');

/** What the sources of the elements say, wherever it stands. */
const said = (pattern: RegExp) => [...new Set([...sources.matchAll(pattern)].map((match) => match[1]))].sort();

let elements: readonly Element[];
beforeAll(() => {
  elements = readElements();
}, 60_000);

const named = (what: 'events' | 'slots' | 'cssParts' | 'cssProperties') =>
  [...new Set(elements.flatMap((element) => element[what].map(({ name }) => name)))].sort();

describe('the manifest of the elements', () => {
  it('has every tag', () => expect(elements.map(({ tagName }) => tagName).sort()).toEqual(Object.keys(CLASSES).sort()));

  it.each(Object.entries(CLASSES))('has the attributes that <%s> observes', (tag, { observedAttributes }) => {
    const element = elements.find(({ tagName }) => tagName === tag);
    expect(element?.attributes.map(({ name }) => name).sort()).toEqual([...observedAttributes].sort());
  });

  it('has the events that are told', () => expect(named('events')).toEqual(said(/new CustomEvent(?:<[^>]+>)?\('(\w+)'/g)));
  it('has the slots that there are', () => expect(named('slots')).toEqual(said(/h\('slot', \{ name: '(\w+)'/g)));
  it('has the parts that there are', () =>
    expect(named('cssParts')).toEqual(said(/(?:\bpart: |setAttribute\('part', )'([\w-]+)'/g)));
  it('has custom properties that the styles use', () => {
    expect(named('cssProperties').filter((name) => !STYLES.includes(`var(${name})`))).toEqual([]);
  });
  it('describes all that has a name', () => {
    for (const { tagName, attributes, events, slots, cssParts, cssProperties, description } of elements) {
      expect(description, tagName).not.toBe('');
      for (const each of [...attributes, ...events, ...slots, ...cssParts, ...cssProperties])
        expect(each.description, `${tagName} ${each.name}`).not.toBe('');
    }
  });
});
