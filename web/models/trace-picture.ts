import { contours } from 'd3-contour';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { simplify } from './resample.ts';
import { checkShape, type Ring, type Shape, signedArea } from './shape.ts';

/** Pixels as canvases give them: red, green, blue and alpha of each, row by row from above. */
export interface Pixels {
  readonly width: number;
  readonly height: number;
  readonly data: ArrayLike<number>;
}

/** Pieces and holes of less than this part of the largest piece are specks. */
const SPECK = 0.002;

/**
 * The outline of what is opaque in a picture, holes too, in pixels from the lower left corner, y upwards. Simplified by less than a pixel.
 *
 * Throws 'picture-empty' when nothing is opaque and 'picture-opaque' when nothing is transparent.
 */
export function tracePicture({ width, height, data }: Pixels): Shape {
  // A row of transparent pixels around it closes outlines at the picture's edge.
  const [w, h] = [width + 2, height + 2];
  const alpha = new Array<number>(w * h).fill(0);
  let [opaque, clear] = [0, 0];
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const value = data[4 * (y * width + x) + 3] as number;
      alpha[(y + 1) * w + x + 1] = value;
      if (value >= 128) opaque++;
      else clear++;
    }
  }
  if (opaque === 0) {
    throw new HandlebodyError('picture-empty', {
      message: 'Nothing in the picture is opaque.',
      remedy: 'Choose a picture of something on a transparent ground.',
    });
  }
  if (clear === 0) {
    throw new HandlebodyError('picture-opaque', {
      message: 'The picture has no transparency, so it has no outline.',
      remedy: 'Remove its background first, and save it as a PNG or SVG with transparency.',
    });
  }
  const { coordinates } = contours().size([w, h]).smooth(true).contour(alpha, 127.5);
  const rings = coordinates
    .flat()
    .map((ring) => Float64Array.from(ring.slice(0, -1).flatMap(([x = 0, y = 0]) => [x - 1, height + 1 - y])));
  const largest = Math.max(...rings.map((ring) => Math.abs(signedArea(ring))));
  const kept = rings.filter((ring) => Math.abs(signedArea(ring)) >= SPECK * largest && ring.length >= 6);
  return sound(kept, Math.max(width, height));
}

/** As simple as it can be without meeting itself. */
function sound(rings: readonly Ring[], size: number): Shape {
  for (const tolerance of [size / 400, size / 1200, 0.05]) {
    const shape = rings.map((ring) => simplify(ring, tolerance));
    try {
      checkShape(shape);
      return shape;
    } catch {}
  }
  return rings;
}
