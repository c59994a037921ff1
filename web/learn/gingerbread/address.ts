import { simplify, withoutRepeats } from '../../models/resample.ts';
import type { Shape } from '../../models/shape.ts';
import {
  atRest,
  type Experiment,
  type Handle,
  MOST_HANDLES,
  type Place,
  type ShapeName,
  tidy,
  VERTICES,
  wrap,
} from './experiment.ts';
import { methodOf } from './methods.ts';
import { SHAPES, shapeOf } from './shapes.ts';

/*
 * The address says what the page shows: "#ring" is a shape in its first pose, and "#shape=man&m=rigid-bounded&h=p:0,0.62,0.1,0,12~b:…" one
 * that was changed. Only what differs from the shape as it opens is written. Whatever cannot be read is left as that has it.
 */

/** Points of an own outline that an address can carry. */
const MOST_ADDRESS_POINTS = 400;

/** What a shape opens with. */
export function initial(shape: ShapeName = 'man', outline?: Shape): Experiment {
  const known = shapeOf(shape);
  return {
    shape,
    outline: known ? undefined : outline,
    vertices: VERTICES.initial,
    handles: known?.poses[0]?.handles() ?? [],
    picked: -1,
    method: 'linear-bounded',
    show: { weight: false, mesh: false },
  };
}

/** The address of an experiment, without the "#". */
export function toAddress(experiment: Experiment): string {
  const base = parts(initial(experiment.shape, experiment.outline));
  const changed = [...parts(experiment)].filter(([key, text]) => base.get(key) !== text);
  const own = experiment.shape === 'own' ? [['o', outlineText(experiment.outline ?? [])] as const] : [];
  if (changed.length === 0 && own.length === 0) return experiment.shape;
  return [['shape', experiment.shape] as const, ...own, ...changed].map(([key, text]) => `${key}=${text}`).join('&');
}

/** The experiment at an address; the gingerbread man where it says nothing that can be read. */
export function fromAddress(hash: string): Experiment {
  const text = decode(hash.replace(/^#/, ''));
  if (shapeOf(text)) return initial(text as ShapeName);
  const given = new Map(
    text.split('&').flatMap((part) => {
      const at = part.indexOf('=');
      return at > 0 ? [[part.slice(0, at), part.slice(at + 1)] as const] : [];
    }),
  );
  const outline = readOutline(given.get('o') ?? '');
  const named = SHAPES.find(({ id }) => id === given.get('shape'))?.id;
  const experiment = given.get('shape') === 'own' && outline ? initial('own', outline) : initial(named);
  const method = methodOf(given.get('m') ?? '');
  if (method) experiment.method = method.id;
  const handles = readHandles(given.get('h'));
  if (handles) experiment.handles = handles;
  const vertices = Number(given.get('v') ?? Number.NaN);
  if (vertices >= VERTICES.low && vertices <= VERTICES.high) experiment.vertices = Math.round(vertices);
  const picked = Number(given.get('pick') ?? 0) - 1;
  experiment.picked = Number.isInteger(picked) && picked < experiment.handles.length ? picked : -1;
  const show = (given.get('show') ?? '').split(',');
  experiment.show = { weight: show.includes('weight'), mesh: show.includes('mesh') };
  return experiment;
}

function parts({ method, handles, vertices, picked, show }: Experiment): Map<string, string> {
  return new Map([
    ['m', method],
    ['h', handles.map(handleText).join('~')],
    ['v', String(vertices)],
    ['pick', show.weight ? String(picked + 1) : '0'],
    ['show', (['weight', 'mesh'] as const).filter((name) => show[name]).join(',')],
  ]);
}

function handleText(handle: Handle): string {
  const pose = atRest(handle) ? [] : [...handle.move, handle.turn];
  return `${handle.end ? 'b' : 'p'}:${[...handle.rest, ...(handle.end ?? []), ...pose].join(',')}`;
}

function readHandles(text: string | undefined): Handle[] | undefined {
  if (text === undefined) return undefined;
  return text
    .split('~')
    .slice(0, MOST_HANDLES)
    .flatMap((part) => {
      const [kind, rest = ''] = part.split(':');
      const read = numbers(rest);
      const ends = kind === 'b' ? 4 : 2;
      if ((kind !== 'p' && kind !== 'b') || (read?.length !== ends && read?.length !== ends + 3)) return [];
      const [dx = 0, dy = 0, turn = 0] = read.slice(ends);
      const [x, y, ex, ey] = read as [number, number, number, number];
      return [
        { rest: [x, y] as Place, ...(kind === 'b' ? { end: [ex, ey] as Place } : {}), move: [dx, dy] as Place, turn: wrap(turn) },
      ];
    });
}

/** An outline that the address can hold: simpler, where it has too many points, and to a thousandth, as the address says it. */
export function portable(outline: Shape): Shape {
  let shape = outline.map((ring) => withoutRepeats(ring.map(tidy)));
  const count = () => shape.reduce((sum, ring) => sum + ring.length / 2, 0);
  for (let tolerance = 0.001; count() > MOST_ADDRESS_POINTS && tolerance < 0.1; tolerance *= 1.5)
    shape = shape.map((ring) => simplify(ring, tolerance));
  return shape;
}

/** Rings apart by ";", in thousandths. */
function outlineText(outline: Shape): string {
  return outline.map((ring) => Array.from(ring, (value) => Math.round(value * 1000)).join(',')).join(';');
}

function readOutline(text: string): Shape | undefined {
  const rings = text.split(';').map((ring) => numbers(ring));
  const sound = rings.every((ring) => ring !== undefined && ring.length % 2 === 0);
  const count = rings.reduce((sum, ring) => sum + (ring?.length ?? 0) / 2, 0);
  if (!sound || count > MOST_ADDRESS_POINTS) return undefined;
  return rings.map((ring) => Float64Array.from(ring ?? [], (value) => value / 1000));
}

function numbers(text: string): number[] | undefined {
  const read = text.split(',').map((part) => (part.trim() === '' ? Number.NaN : Number(part)));
  return read.every((number) => Number.isFinite(number) && Math.abs(number) < 1e9) ? read : undefined;
}

function decode(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}
