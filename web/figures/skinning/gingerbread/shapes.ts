import { bar, gingerbreadMan, octopus, ring } from '../../../models/outlines.ts';
import type { Shape } from '../../../models/shape.ts';
import { bone, type Handle, point } from '../../kit/plane-handles.ts';
import type { PaintedShape } from '../../kit/shape-picture.ts';
import { paintBar, paintMan, paintOctopus, paintRing } from './icing.ts';
import type { MethodId } from './methods.ts';

export type ShapeName = 'man' | 'bar' | 'ring' | 'octopus';

/** Handles in a pose, to choose from. */
interface Pose {
  /** The first pose of a shape has the shape's. */
  readonly id: string;
  readonly name: string;
  /** What to look at. */
  readonly look?: string;
  readonly handles: () => Handle[];
  readonly method?: MethodId;
}

interface KnownShape {
  readonly id: ShapeName;
  readonly name: string;
  readonly outline: () => Shape;
  readonly paint: (shape: Shape) => PaintedShape;
  /** What it is called in a choice. */
  readonly short: string;
  /** The first is what it opens with. */
  readonly poses: readonly Pose[];
}

const COLLAPSE =
  'Under linear blending the shape collapses where the turn fades out; rotations that are blended as rotations, under Rigid, keep it.';

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
    short: 'Man',
    outline: gingerbreadMan,
    paint: paintMan,
    poses: [
      {
        id: 'man',
        name: 'Wave',
        look: 'Drag a handle, turn it by its knob, and choose how the shape follows.',
        handles: () => man([0.05, 0.02, -8], [0.02, -0.14, 20], [-0.06, 0.48, 62], [0, 0, 0], [0.04, 0.02, 8]),
      },
      {
        id: 'wrist',
        name: 'Turn a wrist by 170°',
        look: COLLAPSE,
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
    short: 'Bar',
    outline: bar,
    paint: paintBar,
    poses: [
      {
        id: 'bar',
        name: 'Bend the bar',
        handles: () => [bone([-1, 0], [-0.35, 0], [0.05, 0.1], -25), bone([0.35, 0], [1, 0], [-0.08, 0], 42)],
      },
      {
        id: 'turn-bar',
        name: 'Turn the bar by 170°',
        look: COLLAPSE,
        handles: () => [bone([-1, 0], [-0.35, 0]), bone([0.35, 0], [1, 0], [0, 0], 170)],
        method: 'linear-bounded',
      },
      { id: 'pull', name: 'Pull the bar’s middle', handles: () => [point(-1, 0), point(0, 0, 0, 0.4), point(1, 0)] },
    ],
  },
  {
    id: 'ring',
    name: 'Ring',
    short: 'Ring',
    outline: ring,
    paint: paintRing,
    poses: [
      {
        id: 'ring',
        name: 'Pull the ring',
        handles: () => [point(0, 0.73, 0.1, 0.14, -20), point(-0.73, 0), point(0.73, 0, -0.2, -0.05, 15), point(0, -0.73)],
      },
      {
        id: 'turn-ring',
        name: 'Turn the ring’s top by 170°',
        look: COLLAPSE,
        handles: () => [point(0, 0.73, 0, 0, 170), point(-0.73, 0), point(0.73, 0), point(0, -0.73)],
        method: 'linear-bounded',
      },
    ],
  },
  {
    id: 'octopus',
    name: 'Octopus',
    short: 'Octopus',
    outline: octopus,
    paint: paintOctopus,
    poses: [
      {
        id: 'octopus',
        name: 'Let the octopus swim',
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

export function shapeOf(id: ShapeName): KnownShape {
  return SHAPES.find((shape) => shape.id === id) as KnownShape;
}
