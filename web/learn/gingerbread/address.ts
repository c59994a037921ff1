import { simplify, withoutRepeats } from '../../models/resample.ts';
import type { Shape } from '../../models/shape.ts';
import { decoded, numbersOf, pairsOf, quoted } from '../../ui/address.ts';
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
/** Points that are read of one that somebody else wrote, and thousandths that they may be away. */
const MOST_READ_POINTS = 20_000;
const FAR = 1e9;

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
  // Without a word on them, a shape of one's own opens with handles.
  if (own.length > 0 && experiment.handles.length === 0) changed.unshift(['h', '']);
  if (changed.length === 0 && own.length === 0) return experiment.shape;
  return [['shape', experiment.shape] as const, ...own, ...changed].map(([key, text]) => `${key}=${text}`).join('&');
}

const KEYS = ['shape', 'o', 'm', 'h', 'v', 'pick', 'show'];

/** The experiment at an address; the gingerbread man where it says nothing that can be read. What had to be left out goes to `left`. */
export function fromAddress(hash: string, left: string[] = []): Experiment {
  const text = decoded(hash);
  if (shapeOf(text)) return initial(text as ShapeName);
  const given = pairsOf(text, KEYS, left);
  const take = <T>(key: string, read: (text: string) => T | undefined): T | undefined => {
    const value = given.get(key);
    const taken = value === undefined ? undefined : read(value);
    if (value !== undefined && taken === undefined) left.push(quoted(`${key}=${value}`));
    return taken;
  };
  const outline = take('o', readOutline);
  const named = take('shape', (name) => (name === 'own' ? name : SHAPES.find(({ id }) => id === name)?.id));
  // A shape of one's own without its outline is none.
  if (named === 'own' && !outline && !given.has('o')) left.push(quoted('shape=own'));
  const experiment = named !== 'own' ? initial(named) : outline ? initial('own', outline) : initial();
  experiment.method = take('m', methodOf)?.id ?? experiment.method;
  experiment.handles = take('h', (handles) => readHandles(handles, left)) ?? experiment.handles;
  experiment.vertices = take('v', readVertices) ?? experiment.vertices;
  const last = experiment.handles.length;
  const isHandle = (number: number) => Number.isInteger(number) && number >= 0 && number <= last;
  experiment.picked = (take('pick', (pick) => (pick !== '' && isHandle(Number(pick)) ? Number(pick) : undefined)) ?? 0) - 1;
  const show = (given.get('show') ?? '').split(',');
  experiment.show = { weight: show.includes('weight'), mesh: show.includes('mesh') };
  left.push(...show.filter((word) => !['', 'weight', 'mesh'].includes(word)).map(quoted));
  return experiment;
}

function readVertices(text: string): number | undefined {
  const vertices = text === '' ? Number.NaN : Number(text);
  return vertices >= VERTICES.low && vertices <= VERTICES.high ? Math.round(vertices) : undefined;
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

function readHandles(text: string, left: string[]): Handle[] {
  const parts = text === '' ? [] : text.split('~');
  if (parts.length > MOST_HANDLES)
    left.push(`${(parts.length - MOST_HANDLES).toLocaleString('en')} of ${parts.length.toLocaleString('en')} handles`);
  return parts.slice(0, MOST_HANDLES).flatMap((part) => {
    const [kind, rest = ''] = part.split(':');
    const read = numbersOf(rest);
    const ends = kind === 'b' ? 4 : 2;
    if ((kind !== 'p' && kind !== 'b') || (read?.length !== ends && read?.length !== ends + 3)) {
      left.push(quoted(part));
      return [];
    }
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
  const rings = text.split(';').map(numbersOf);
  const sound = rings.every((ring) => ring !== undefined && ring.length % 2 === 0 && ring.every((value) => Math.abs(value) < FAR));
  const count = rings.reduce((sum, ring) => sum + (ring?.length ?? 0) / 2, 0);
  if (!sound || count > MOST_READ_POINTS) return undefined;
  const outline = rings.map((ring) => Float64Array.from(ring ?? [], (value) => value / 1000));
  return count > MOST_ADDRESS_POINTS ? portable(outline) : outline;
}
