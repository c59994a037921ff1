import { bar, gingerbreadMan, octopus, ring } from '../../models/outlines.ts';
import type { Shape } from '../../models/shape.ts';
import { bone, type Handle, point, type ShapeName } from './experiment.ts';
import { type PaintedShape, paintBar, paintMan, paintOctopus, paintRing } from './icing.ts';
import type { MethodId } from './methods.ts';

/** Handles in a pose, to choose from. */
interface Pose {
  readonly id: string;
  readonly name: string;
  readonly handles: () => Handle[];
  readonly method?: MethodId;
}

interface KnownShape {
  readonly id: ShapeName;
  readonly name: string;
  readonly outline: () => Shape;
  readonly paint: (shape: Shape) => PaintedShape;
  /** The first is what the page opens with. */
  readonly poses: readonly Pose[];
}

/** Head, hands, feet and belly, moved by so much: dx, dy, turn of each. */
const man = (...moves: readonly (readonly [number, number, number])[]): Handle[] =>
  (
    [
      [0, 0.62],
      [-0.72, 0.16],
      [0.72, 0.16],
      [-0.36, -0.82],
      [0.36, -0.82],
      [0, -0.1],
    ] as const
  ).map(([x, y], i) => point(x, y, ...(moves[i] ?? [0, 0, 0])));

export const SHAPES: readonly KnownShape[] = [
  {
    id: 'man',
    name: 'Gingerbread man',
    outline: gingerbreadMan,
    paint: paintMan,
    poses: [
      {
        id: 'wave',
        name: 'Wave',
        handles: () => man([0.05, 0.02, -8], [0.02, -0.14, 20], [-0.06, 0.48, 62], [0, 0, 0], [0.04, 0.02, 8]),
      },
      {
        id: 'wrist',
        name: 'Turn a wrist by 170°',
        handles: () => man([0, 0, 0], [0, 0, 0], [0, 0, 170]),
        method: 'linear-bounded',
      },
      {
        id: 'dance',
        name: 'Dance',
        handles: () =>
          man([0.16, -0.03, -24], [0.1, 0.5, -70], [0.05, -0.3, -40], [-0.16, 0.12, -25], [0.02, 0.06, 12], [0.06, 0, -8]),
      },
    ],
  },
  {
    id: 'bar',
    name: 'Bar',
    outline: bar,
    paint: paintBar,
    poses: [
      {
        id: 'bend',
        name: 'Bend',
        handles: () => [bone([-1, 0], [-0.35, 0], [0.05, 0.1], -25), bone([0.35, 0], [1, 0], [-0.08, 0], 42)],
      },
      {
        id: 'turn',
        name: 'Turn by 170°',
        handles: () => [bone([-1, 0], [-0.35, 0]), bone([0.35, 0], [1, 0], [0, 0], 170)],
        method: 'linear-bounded',
      },
      { id: 'pull', name: 'Pull the middle', handles: () => [point(-1, 0), point(0, 0, 0, 0.4), point(1, 0)] },
    ],
  },
  {
    id: 'ring',
    name: 'Ring',
    outline: ring,
    paint: paintRing,
    poses: [
      {
        id: 'bite',
        name: 'Pull',
        handles: () => [point(0, 0.73, 0.1, 0.14, -20), point(-0.73, 0), point(0.73, 0, -0.2, -0.05, 15), point(0, -0.73)],
      },
      {
        id: 'turn',
        name: 'Turn the top by 170°',
        handles: () => [point(0, 0.73, 0, 0, 170), point(-0.73, 0), point(0.73, 0), point(0, -0.73)],
        method: 'linear-bounded',
      },
    ],
  },
  {
    id: 'octopus',
    name: 'Octopus',
    outline: octopus,
    paint: paintOctopus,
    poses: [
      {
        id: 'swim',
        name: 'Swim',
        handles: () => [
          point(0, 0.4, 0.04, 0.06, -6),
          point(-0.97, 0.03, 0.06, 0.26, -30),
          point(-0.94, -0.5, 0, 0.12, -20),
          point(-0.44, -0.95, -0.06, 0.04, -10),
          point(0.44, -0.95, 0.1, 0.06, 25),
          point(0.94, -0.5, -0.02, 0.16, 25),
          point(0.97, 0.03, -0.14, 0.32, 60),
        ],
      },
      {
        id: 'tentacle',
        name: 'Pull one tentacle',
        handles: () => [point(0, 0.4), point(-0.44, -0.95, -0.3, -0.1), point(0.44, -0.95)],
      },
    ],
  },
];

export function shapeOf(id: string): KnownShape | undefined {
  return SHAPES.find((shape) => shape.id === id);
}
