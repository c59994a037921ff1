import { simplify, withoutRepeats } from '../../models/resample.ts';
import type { Shape } from '../../models/shape.ts';
import { numbersOf } from '../../ui/address.ts';
import type { Channel } from './channel.ts';
import { toThousandths } from './plane-handles.ts';

/** Points of an own outline that an address can carry. */
const MOST_ADDRESS_POINTS = 400;
/** Points that are read of one that somebody else wrote, and thousandths that they may be away. */
const MOST_READ_POINTS = 20_000;
const FAR = 1e9;

/** An outline of one's own: rings apart by ";", in thousandths. */
export const outline: Channel<Shape | undefined> = {
  initial: undefined,
  write: (shape) => (shape ?? []).map((ring) => Array.from(ring, (value) => Math.round(value * 1000)).join(',')).join(';'),
  read: (text) => {
    const rings = text.split(';').map(numbersOf);
    const sound = rings.every(
      (ring) => ring !== undefined && ring.length % 2 === 0 && ring.every((value) => Math.abs(value) < FAR),
    );
    const count = rings.reduce((sum, ring) => sum + (ring?.length ?? 0) / 2, 0);
    if (!sound || count > MOST_READ_POINTS) return undefined;
    const shape = rings.map((ring) => Float64Array.from(ring ?? [], (value) => value / 1000));
    return count > MOST_ADDRESS_POINTS ? portable(shape) : shape;
  },
};

/** An outline that the address can hold: simpler, where it has too many points, and to a thousandth, as the address says it. */
export function portable(outline: Shape): Shape {
  let shape = outline.map((ring) => withoutRepeats(ring.map(toThousandths)));
  const count = () => shape.reduce((sum, ring) => sum + ring.length / 2, 0);
  for (let tolerance = 0.001; count() > MOST_ADDRESS_POINTS && tolerance < 0.1; tolerance *= 1.5)
    shape = shape.map((ring) => simplify(ring, tolerance));
  return shape;
}
