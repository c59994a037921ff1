/**
 * What a live figure of your own is made of: "handlebody/figure". A figure is declared by `define`, its pictures are panels, and
 * `registerFigure` lets `<handle-figure>` of "handlebody/element" show it.
 */
export {
  type AutoRange,
  autoRange,
  type Channel,
  type Channels,
  type Choice,
  choice,
  type Described,
  type Option,
  type Parameter,
  type Range,
  type RangeOptions,
  range,
  type StateOf,
  type Switch,
  toggle,
} from './kit/channel.ts';
export {
  type AnyFigure,
  define,
  type Figure,
  type Kit,
  type Made,
  type OpenPanel,
  type Panel,
  type PartControl,
  type Sides,
  type Told,
  type Wait,
  type Work,
} from './kit/figure.ts';
export {
  type CurveOptions,
  type Evaluable,
  type LinePlot,
  type LinePlotOptions,
  linePlot,
  type PlotHandle,
} from './kit/line-plot.ts';
export type { PointOptions } from './kit/point-actions.ts';
export { dataOf, inThePlane, onALine, type PointSet } from './kit/point-set.ts';
export type { Frame } from './kit/samples.ts';
export type { Former, Mend, Preset } from './kit/state-text.ts';
export { registerFigure } from './registry.ts';
