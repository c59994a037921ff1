import { h } from '../../ui/dom.ts';
import { lazy } from '../../ui/lazy.ts';
import { define, type Panel } from '../kit/figure.ts';
import { mend, parameters, type State } from './playground/channels.ts';
import { Fits } from './playground/fits.ts';
import { linePanel, weightPanel } from './playground/line.ts';
import { ModelList } from './playground/model-list.ts';
import { tableOf, toolsOf } from './playground/points.ts';
import { PRESETS } from './playground/presets.ts';
import { outlierText, summary } from './playground/report.ts';
import { parts } from './playground/show.ts';
import { thumbnail } from './playground/thumbnail.ts';

/** The plane's part is fetched when somebody goes there. */
const planePart = lazy(() => import('./playground/plane.ts'), 'The part of this page that draws the plane');

/** Which points stand out. */
const found: Panel<Fits, State> = {
  place: 'below',
  shown: ({ show }) => show.outliers !== 'off',
  open: () => {
    const element = h('p', { class: 'found' });
    const draw = ({ found }: Fits) => {
      element.textContent = outlierText(found);
    };
    return { element, draw };
  },
};

export default define<typeof parameters, Fits>({
  id: 'playground',
  title: 'Compare interpolants',
  parameters,
  heading: 'Show',
  parts,
  presets: PRESETS,
  sides: {
    label: 'Points lie',
    options: [
      ['On a line', 'line'],
      ['In the plane', 'plane'],
    ],
    of: ({ d }) => d - 1,
  },
  thumbnail,
  mend,
  former: { 'd=2': 'plane' },
  shown: ['in', 'range', 'pick'],
  make: (hb, state, _, last) => (last ?? new Fits(hb)).update(state),
  panels: {
    tools: { place: 'tools', open: toolsOf },
    line: linePanel,
    weight: weightPanel,
    plane: { shown: ({ d }) => d === 2, open: async (kit) => (await planePart(kit.address)).planePanel.open(kit) },
    models: { place: 'above', open: (kit) => new ModelList(kit) },
    found,
    table: { place: 'below', open: tableOf },
  },
  told: ({ seen }) => [
    ['interpolants', seen.length],
    ['largest misfit at a point', Math.max(0, ...seen.map(({ verdict }) => verdict?.misfit ?? 0))],
    ['largest condition', Math.max(0, ...seen.map(({ verdict }) => verdict?.report?.condition ?? 0))],
  ],
  say: ({ list, found }, { p }) => summary(p.values.length, list, outlierText(found)),
});
