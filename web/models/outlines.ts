import { capsule, smoothUnion, traceLevelSet } from './level-set.ts';
import type { Ring, Shape } from './shape.ts';

/** Outlines are about two units large, around the origin, y upwards. */

/** A gingerbread man: head, arms and legs, rounded where they meet. */
export function gingerbreadMan(): Shape {
  const field = smoothUnion(
    [
      capsule(0, 0.6, 0, 0.62, 0.335),
      capsule(0, 0.16, 0, -0.22, 0.27, 0.285),
      capsule(0.1, 0.1, 0.72, 0.16, 0.14, 0.165),
      capsule(-0.1, 0.1, -0.72, 0.16, 0.14, 0.165),
      capsule(0.13, -0.3, 0.36, -0.82, 0.17, 0.185),
      capsule(-0.13, -0.3, -0.36, -0.82, 0.17, 0.185),
    ],
    0.045,
  );
  return [traceLevelSet(field, [0, 0.96], 0.01)];
}

/** A bar with rounded corners, lying. */
export function bar(): Shape {
  return [roundedRectangle(2.4, 0.5, 0.12)];
}

/** A ring with a hole. */
export function ring(): Shape {
  return [circle(1, 200), circle(0.46, 120)];
}

/** A head on six tentacles, which come near each other. */
export function octopus(): Shape {
  const arms = [
    [-0.34, 0.06, -0.74, -0.18, -1.0, 0.06],
    [-0.26, -0.1, -0.62, -0.5, -0.98, -0.5],
    [-0.1, -0.15, -0.2, -0.62, -0.46, -0.98],
    [0.1, -0.15, 0.2, -0.62, 0.46, -0.98],
    [0.26, -0.1, 0.62, -0.5, 0.98, -0.5],
    [0.34, 0.06, 0.74, -0.18, 1.0, 0.06],
  ] as const;
  const field = smoothUnion(
    [
      capsule(0, 0.42, 0, 0.3, 0.46, 0.44),
      capsule(0, 0.3, 0, 0, 0.32, 0.3),
      ...arms.flatMap(([ax, ay, bx, by, cx, cy]) => [capsule(ax, ay, bx, by, 0.14, 0.12), capsule(bx, by, cx, cy, 0.12, 0.1)]),
    ],
    0.045,
  );
  return [traceLevelSet(field, [0, 0.86], 0.01)];
}

/** A star with rounded valleys and sharp tips: its corners are kept. */
export function star(points = 5, outer = 1, inner = 0.5): Shape {
  const out: number[] = [];
  for (let i = 0; i < 2 * points; i++) {
    const angle = Math.PI / 2 + (i * Math.PI) / points;
    const radius = i % 2 === 0 ? outer : inner;
    out.push(radius * Math.cos(angle), radius * Math.sin(angle));
  }
  return [Float64Array.from(out)];
}

function circle(radius: number, count: number): Ring {
  return Float64Array.from({ length: 2 * count }, (_, k) => {
    const angle = (Math.floor(k / 2) / count) * 2 * Math.PI;
    return radius * (k % 2 === 0 ? Math.cos(angle) : Math.sin(angle));
  });
}

function roundedRectangle(width: number, height: number, radius: number): Ring {
  const out: number[] = [];
  const steps = 12;
  for (const [k, sx, sy] of [
    [0, 1, 1],
    [1, -1, 1],
    [2, -1, -1],
    [3, 1, -1],
  ] as const) {
    for (let i = 0; i <= steps; i++) {
      const angle = ((k + i / steps) * Math.PI) / 2;
      out.push(sx * (width / 2 - radius) + radius * Math.cos(angle), sy * (height / 2 - radius) + radius * Math.sin(angle));
    }
  }
  return Float64Array.from(out);
}
