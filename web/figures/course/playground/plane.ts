import { fieldPlot } from '../../kit/field-plot.ts';
import type { State } from './channels.ts';
import type { Fits } from './fits.ts';
import { POINTS } from './points.ts';

/** Points in the plane, their interpolants as small multiples in one color scale: maps, or surfaces. */
export const planePanel = fieldPlot<Fits, State>({
  ...POINTS,
  frame: (state) => state.in,
  maps: ({ seen }) =>
    seen.map(({ label, model: { key, slot }, interpolant, problem }) => ({
      ...label,
      key,
      slot,
      stale: problem !== undefined,
      source: interpolant as NonNullable<typeof interpolant>,
    })),
  colors: ({ show }) => show.colors,
  weightOf: ({ show, pick }) => (show.cardinal ? pick : -1),
  isolines: ({ show }) => show.isolines,
  surfaces: { on: ({ show }) => show.surface, set: ({ show }, surface) => ({ show: { ...show, surface } }) },
  section: ({ show }) => show.section,
  sectionAt: ({ show }) => show.sectionAt,
});
