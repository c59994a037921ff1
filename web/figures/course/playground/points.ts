import { button, h } from '../../../ui/dom.ts';
import type { Kit, OpenPanel } from '../../kit/figure.ts';
import { type PointEditing, type PointOptions, pointActions } from '../../kit/point-actions.ts';
import { MOST_POINTS, tidy } from '../../kit/point-set.ts';
import type { State } from './channels.ts';
import { emptiestPlace, fitted } from './experiment.ts';
import type { Fits } from './fits.ts';
import { PointTable } from './point-table.ts';

export const POINTS: PointOptions<Fits, State> = {
  points: 'p',
  picked: 'pick',
  range: ({ range }) => range,
  guess,
  outliers: ({ found }) => found?.outliers ?? [],
};

/** What the first good interpolant says there. */
function guess({ list }: Fits, { p: { values }, d, in: frame, range }: State, place: readonly number[]): number {
  const value = list.find(({ interpolant }) => interpolant)?.interpolant?.evaluate([...place])[0] ?? Number.NaN;
  const average = values.reduce((sum, next) => sum + next, 0) / Math.max(values.length, 1);
  const [low, high] = d === 1 ? [frame[2], frame[3]] : range;
  return tidy(Math.min(Math.max(Number.isFinite(value) ? value : average, low), high), high - low);
}

function editing(kit: Kit<State, Fits>): { readonly actions: PointEditing; readonly add: () => void } {
  const actions = pointActions(kit, (state) => state.in, POINTS);
  const add = () => {
    const place = emptiestPlace(actions.set, kit.state.in);
    actions.add(place, kit.made ? guess(kit.made, kit.state, place) : 0);
  };
  return { actions, add };
}

export function tableOf(kit: Kit<State, Fits>): OpenPanel<Fits, State> {
  const { actions, add } = editing(kit);
  return new PointTable(kit, actions, add);
}

/** Buttons that add a point, remove the chosen one, and bring all into view. */
export function toolsOf(kit: Kit<State, Fits>): OpenPanel<Fits, State> {
  const { actions, add } = editing(kit);
  const adds = button('Add a point', add);
  const removes = button('Remove', () => {
    const { picked, count } = actions;
    actions.remove(picked);
    kit.focus(`.point[data-point="${Math.min(picked, count - 2)}"]:not([aria-hidden])`, adds);
  });
  const fit = button('Fit view', () => kit.change(fitted(kit.state.p)));
  const element = h('div', { class: 'tools' }, adds, removes, fit);
  const draw = (_: Fits, { p, pick }: State) => {
    adds.disabled = p.values.length >= MOST_POINTS;
    removes.disabled = pick < 0 || p.values.length === 1;
    removes.textContent = pick < 0 ? 'Remove' : `Remove point ${pick}`;
  };
  return { element, draw };
}
