import { extentOf, type Shape } from '../../../models/shape.ts';
import type { Place } from '../../kit/plane-handles.ts';
import type { PaintedShape } from '../../kit/shape-picture.ts';

/** Colors of a biscuit. */
interface Dough {
  readonly middle: string;
  readonly base: string;
  readonly rim: string;
  readonly icing: string | undefined;
}

const DOUGHS = {
  gingerbread: { middle: '#c98a4b', base: '#b9763a', rim: '#7d4518', icing: '#fff8ec' },
  chocolate: { middle: '#e9c38f', base: '#dcae74', rim: '#a9743b', icing: undefined },
  doughnut: { middle: '#dda560', base: '#d0954e', rim: '#96602a', icing: undefined },
  berry: { middle: '#e98aa6', base: '#dd7394', rim: '#a2426a', icing: undefined },
} satisfies Record<string, Dough>;

const PIXELS = 1280;

/** Paints a shape as something baked; `decorate` adds to it, in the shape's own units, y upwards. */
function bake(shape: Shape, dough: Dough, decorate: (context: CanvasRenderingContext2D) => void): PaintedShape {
  const { low, high } = extentOf(...shape);
  const size = Math.max(high[0] - low[0], high[1] - low[1]);
  const margin = 0.03 * size;
  const [left, bottom, right, top] = [low[0] - margin, low[1] - margin, high[0] + margin, high[1] + margin];
  const scale = PIXELS / (size + 2 * margin);
  const canvas = document.createElement('canvas');
  canvas.width = Math.round((right - left) * scale);
  canvas.height = Math.round((top - bottom) * scale);
  const context = canvas.getContext('2d') as CanvasRenderingContext2D;
  context.fillStyle = dough.rim;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.setTransform(scale, 0, 0, -scale, -left * scale, top * scale);
  context.lineJoin = context.lineCap = 'round';
  const path = pathOf(shape);
  const glow = context.createRadialGradient(0, 0.1 * size, 0, 0, 0, 0.62 * size);
  glow.addColorStop(0, dough.middle);
  glow.addColorStop(1, dough.base);
  context.save();
  context.clip(path, 'evenodd');
  context.fillStyle = glow;
  context.fillRect(left, bottom, right - left, top - bottom);
  crumbs(context, [left, bottom], [right, top]);
  // Browner towards the rim: wide faint strokes, then narrower ones.
  context.strokeStyle = dough.rim;
  for (let i = 0; i < 10; i++) {
    context.globalAlpha = 0.07 + 0.012 * i;
    context.lineWidth = (0.085 - 0.0078 * i) * size;
    context.stroke(path);
  }
  context.globalAlpha = 1;
  if (dough.icing) iceAlong(context, shape, dough.icing, size);
  decorate(context);
  context.restore();
  return { canvas, low: [left, bottom], high: [right, top] };
}

/** A line of icing beside the border, with a shadow. */
function iceAlong(context: CanvasRenderingContext2D, shape: Shape, color: string, size: number): void {
  // What a ring's wide stroke covers less a narrower one is a line inside it: drawn apart, so that the dough shows on both sides.
  const layer = document.createElement('canvas');
  layer.width = context.canvas.width;
  layer.height = context.canvas.height;
  const pen = layer.getContext('2d') as CanvasRenderingContext2D;
  pen.setTransform(context.getTransform());
  pen.lineJoin = 'round';
  const path = pathOf(shape);
  pen.strokeStyle = color;
  pen.lineWidth = 0.068 * size;
  pen.stroke(path);
  pen.globalCompositeOperation = 'destination-out';
  pen.lineWidth = 0.044 * size;
  pen.stroke(path);
  context.save();
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.shadowColor = 'rgb(60 25 5 / 55%)';
  context.shadowBlur = 5;
  context.shadowOffsetY = 3;
  context.drawImage(layer, 0, 0);
  context.restore();
}

/** Numbers from 0 to 1, always the same. */
function randomFrom(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state * 16807) % 2147483647;
    return state / 2147483647;
  };
}

/** Specks of dough. */
function crumbs(context: CanvasRenderingContext2D, [left, bottom]: Place, [right, top]: Place): void {
  const random = randomFrom(7);
  for (let i = 0; i < 900; i++) {
    context.fillStyle = random() < 0.5 ? 'rgb(90 45 10 / 16%)' : 'rgb(255 230 190 / 16%)';
    context.beginPath();
    const r = 0.002 + 0.005 * random();
    context.ellipse(left + (right - left) * random(), bottom + (top - bottom) * random(), r, r * 0.8, 0, 0, 7);
    context.fill();
  }
}

function pathOf(shape: Shape): Path2D {
  return new Path2D(shape.map((ring) => `M${ring.join(' ')}Z`).join(''));
}

/** A drop of sugar with a light on it. */
function candy(context: CanvasRenderingContext2D, x: number, y: number, r: number, color: string): void {
  context.fillStyle = 'rgb(60 25 5 / 35%)';
  disk(context, x, y - r * 0.14, r * 1.06);
  context.fillStyle = color;
  disk(context, x, y, r);
  context.fillStyle = 'rgb(255 255 255 / 55%)';
  disk(context, x - r * 0.32, y + r * 0.34, r * 0.26);
}

function disk(context: CanvasRenderingContext2D, x: number, y: number, r: number): void {
  context.beginPath();
  context.arc(x, y, r, 0, 7);
  context.fill();
}

/** A squeezed line of icing. */
function squeeze(context: CanvasRenderingContext2D, points: readonly Place[], width: number, color = '#fff8ec'): void {
  const path = new Path2D(`M${points.join(' ')}`);
  context.save();
  context.translate(0, -0.008);
  context.strokeStyle = 'rgb(60 25 5 / 35%)';
  context.lineWidth = width * 1.1;
  context.stroke(path);
  context.restore();
  context.strokeStyle = color;
  context.lineWidth = width;
  context.stroke(path);
}

/** A smile, r wide to each side of a middle, and as high; the part of a half circle that it spans. */
function smile(context: CanvasRenderingContext2D, y: number, r: Place, part: number, width: number, color?: string): void {
  const points = Array.from({ length: 17 }, (_, i): Place => {
    const angle = Math.PI * (1.5 + part * (i / 16 - 0.5));
    return [r[0] * Math.cos(angle), y + r[1] * Math.sin(angle)];
  });
  squeeze(context, points, width, color);
}

/** A wave across a limb: from one place to another. */
function wave(context: CanvasRenderingContext2D, [ax, ay]: Place, [bx, by]: Place): void {
  const [dx, dy] = [bx - ax, by - ay];
  const length = Math.hypot(dx, dy);
  const points = Array.from({ length: 41 }, (_, i): Place => {
    const swing = Math.sin((i / 40) * 6 * Math.PI) * 0.024;
    return [ax + (dx * i) / 40 - (dy / length) * swing, ay + (dy * i) / 40 + (dx / length) * swing];
  });
  squeeze(context, points, 0.024);
}

const CANDIES = ['#d8344f', '#2f8f5b', '#3d7fd0', '#f2b632', '#8d55c7'] as const;

export function paintMan(shape: Shape): PaintedShape {
  return bake(shape, DOUGHS.gingerbread, (context) => {
    for (const side of [-1, 1]) {
      context.fillStyle = 'rgb(216 80 80 / 45%)';
      disk(context, side * 0.175, 0.535, 0.05);
      candy(context, side * 0.105, 0.66, 0.034, '#3a2113');
      wave(context, [side * 0.6, 0.028], [side * 0.575, 0.272]);
      wave(context, [side * 0.425, -0.66], [side * 0.14, -0.58].map((v, i) => (i === 0 ? v : v + 0.02)) as unknown as Place);
    }
    smile(context, 0.585, [0.14, 0.12], 0.64, 0.026);
    [0.16, 0.0, -0.16].forEach((y, i) => {
      candy(context, 0, y, 0.043, CANDIES[i] as string);
    });
  });
}

export function paintBar(shape: Shape): PaintedShape {
  return bake(shape, DOUGHS.chocolate, (context) => {
    // Dipped at both ends, with zigzags between.
    context.fillStyle = '#5b3420';
    for (const side of [-1, 1]) context.fillRect(side < 0 ? -1.3 : 0.78, -0.4, 0.52, 0.8);
    const zigzag = Array.from({ length: 61 }, (_, i): Place => [-0.72 + (1.44 * i) / 60, 0.12 * Math.sin((i / 60) * 16 * Math.PI)]);
    squeeze(context, zigzag, 0.034, '#5b3420');
    for (const side of [-1, 1]) {
      [-0.12, 0.02, 0.14].forEach((y, i) => {
        candy(context, side * (0.9 + 0.09 * ((i * 2) % 3)), y, 0.028, CANDIES[i + 1] as string);
      });
    }
  });
}

export function paintRing(shape: Shape): PaintedShape {
  return bake(shape, DOUGHS.doughnut, (context) => {
    const glaze = new Path2D();
    for (const [mean, swing, waves, phase] of [
      [0.93, 0.02, 17, 0],
      [0.53, 0.018, 9, 1],
    ] as const) {
      const edge = Array.from({ length: 240 }, (_, i) => {
        const angle = (i / 120) * Math.PI;
        const r = mean + swing * Math.sin(waves * angle + phase);
        return [r * Math.cos(angle), r * Math.sin(angle)];
      });
      glaze.addPath(new Path2D(`M${edge.join(' ')}Z`));
    }
    context.save();
    context.shadowColor = 'rgb(60 25 5 / 50%)';
    context.shadowBlur = 10;
    context.shadowOffsetY = 4;
    context.fillStyle = '#f4a9c0';
    context.fill(glaze, 'evenodd');
    context.restore();
    const random = randomFrom(3);
    context.lineWidth = 0.022;
    for (let i = 0; i < 110; i++) {
      const [r, angle, lean] = [0.58 + 0.3 * random(), (i / 110) * 2 * Math.PI, random() * 3];
      const [x, y] = [r * Math.cos(angle), r * Math.sin(angle)];
      context.strokeStyle = [...CANDIES, '#fffaf0'][i % 6] as string;
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x + 0.045 * Math.cos(lean), y + 0.045 * Math.sin(lean));
      context.stroke();
    }
  });
}

export function paintOctopus(shape: Shape): PaintedShape {
  return bake(shape, DOUGHS.berry, (context) => {
    for (const side of [-1, 1]) {
      candy(context, side * 0.16, 0.34, 0.085, '#fffaf0');
      candy(context, side * 0.145, 0.325, 0.042, '#3a1a2c');
      context.fillStyle = 'rgb(200 40 90 / 35%)';
      disk(context, side * 0.29, 0.2, 0.055);
    }
    smile(context, 0.22, [0.1, 0.09], 0.6, 0.024, '#7c2350');
    // Suckers along the tentacles.
    context.fillStyle = '#f7c3d3';
    for (const [ax, ay, bx, by] of [
      [0.42, 0.0, 0.72, -0.17],
      [0.78, -0.12, 0.98, 0.05],
      [0.36, -0.22, 0.6, -0.47],
      [0.68, -0.5, 0.95, -0.5],
      [0.13, -0.34, 0.2, -0.62],
      [0.25, -0.7, 0.44, -0.95],
    ] as const)
      for (const side of [-1, 1])
        for (const t of [0.05, 0.4, 0.75]) disk(context, side * (ax + (bx - ax) * t), ay + (by - ay) * t, 0.034);
  });
}

/** An outline of one's own, in gingerbread. */
export function paintOwn(shape: Shape): PaintedShape {
  return bake(shape, DOUGHS.gingerbread, () => {});
}
