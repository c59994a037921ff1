import { HandlebodyError } from '../../../wasm/ts/errors.ts';
import { centered, type Shape } from '../../models/shape.ts';
import { type Pixels, tracePicture } from '../../models/trace-picture.ts';
import type { PaintedShape } from './shape-picture.ts';

/** Pixels along the longer side of the picture that is traced and shown. */
const SIZE = 768;
/** Larger files are refused before they are read. */
const MOST_BYTES = 32 * 2 ** 20;

/**
 * The outline of what is opaque in a file, two units large, and the picture to go on it. The file is shown by an image element only, so
 * that nothing in an SVG ever runs or is fetched.
 */
export async function openPicture(file: File): Promise<{ outline: Shape; painting: PaintedShape }> {
  const canvas = await draw(file);
  const context = canvas.getContext('2d') as CanvasRenderingContext2D;
  let pixels: Pixels;
  try {
    pixels = context.getImageData(0, 0, canvas.width, canvas.height);
  } catch (cause) {
    throw unsupported(file, cause);
  }
  const { shape, middle, scale } = centered(tracePicture(pixels), 2);
  bleed(context);
  return {
    outline: shape,
    painting: {
      canvas,
      low: [-middle[0] * scale, -middle[1] * scale],
      high: [(canvas.width - middle[0]) * scale, (canvas.height - middle[1]) * scale],
    },
  };
}

async function draw(file: File): Promise<HTMLCanvasElement> {
  if (file.size > MOST_BYTES) {
    throw new HandlebodyError('file-unsupported', {
      message: `“${file.name}” is larger than ${MOST_BYTES / 2 ** 20} MB.`,
      remedy: 'Save it smaller: a thousand pixels are plenty.',
    });
  }
  let bytes: ArrayBuffer;
  try {
    bytes = await file.arrayBuffer();
  } catch (cause) {
    throw new HandlebodyError('file-unreadable', {
      message: `“${file.name}” could not be read.`,
      remedy: 'Check that the file is still there, then choose it again.',
      cause,
    });
  }
  const url = URL.createObjectURL(new Blob([bytes], { type: typeOf(bytes, file) }));
  try {
    const image = new Image();
    image.src = url;
    try {
      await image.decode();
    } catch (cause) {
      throw unsupported(file, cause);
    }
    // An SVG may have no size of its own.
    const [width, height] = [image.naturalWidth || SIZE, image.naturalHeight || SIZE];
    const scale = SIZE / Math.max(width, height);
    const canvas = document.createElement('canvas');
    canvas.width = Math.max(1, Math.round(width * scale));
    canvas.height = Math.max(1, Math.round(height * scale));
    const context = canvas.getContext('2d', { willReadFrequently: true }) as CanvasRenderingContext2D;
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    return canvas;
  } finally {
    URL.revokeObjectURL(url);
  }
}

/** By what is in the file, since names lie. */
function typeOf(bytes: ArrayBuffer, file: File): string {
  const head = new TextDecoder().decode(bytes.slice(0, 4096));
  return /<svg[\s>]/i.test(head) ? 'image/svg+xml' : file.type.startsWith('image/') ? file.type : 'image/png';
}

function unsupported(file: File, cause: unknown): HandlebodyError {
  return new HandlebodyError('file-unsupported', {
    message: `“${file.name}” is no picture that this browser can show.`,
    remedy: 'Choose a PNG or SVG with transparency.',
    cause,
  });
}

/** Paints the picture's colors a little beyond its border, where the mesh has pixels that the picture has not. */
function bleed(context: CanvasRenderingContext2D): void {
  const { canvas } = context;
  const copy = document.createElement('canvas');
  [copy.width, copy.height] = [canvas.width, canvas.height];
  copy.getContext('2d')?.drawImage(canvas, 0, 0);
  context.globalCompositeOperation = 'destination-over';
  for (let r = 1; r <= 6; r++)
    for (let k = 0; k < 8; k++) {
      const angle = (k * Math.PI) / 4;
      context.drawImage(copy, Math.round(r * Math.cos(angle)), Math.round(r * Math.sin(angle)));
    }
  context.globalCompositeOperation = 'source-over';
}
