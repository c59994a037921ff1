import { callback, flag, optional, type Readers } from './arguments.ts';
import type { Culprit } from './errors.ts';

/**
 * What is passed over in a mesh that operators are made of, by stable name: `triangles-flat` and `tetrahedra-flat` have no area or volume, or
 * hang on others by an edge with no more than rounding gives them; `triangles-doubled` and `tetrahedra-doubled` have the corners of another,
 * in any order; no triangle or tetrahedron uses `vertices-unused`.
 */
export type MeshWarningCode = 'triangles-flat' | 'triangles-doubled' | 'tetrahedra-flat' | 'tetrahedra-doubled' | 'vertices-unused';

/** `message` and `remedy` are written to be shown to people, `code` is stable and made for programs. */
export interface MeshWarning {
  readonly code: MeshWarningCode;
  readonly message: string;
  readonly remedy: string;
  /** How many there are. */
  readonly count: number;
  /** The first of them. */
  readonly culprit: Culprit;
}

/** How a mesh is read. */
export interface MeshOptions {
  /**
   * Whether vertices at one place are one, as where three.js or a file splits them at seams and creases: where their coordinates are equal
   * (−0 is 0), or nearer than a millionth of the diagonal of what is used and than a thousandth of the longest edge there, which only
   * rounding parts. False takes vertices by their number alone, as along a slit that is to stay open.
   */
  readonly weld?: boolean;
  /** Whether flat and doubled triangles or tetrahedra are refused ('mesh-degenerate'); else they are left out, with a warning. */
  readonly strict?: boolean;
  /** Called for each warning: something was passed over that does not change the shape. */
  readonly onWarning?: (warning: MeshWarning) => void;
}

/** @internal */
export const MESH_READERS = { weld: flag, strict: flag, onWarning: optional(callback) } satisfies Readers<MeshOptions>;

/** How many of a kind, and the first. */
interface LeftOut {
  readonly count: number;
  readonly first: number;
}

/** The warnings about a mesh of triangles (3 corners) or tetrahedra. */
export function meshWarnings(corners: 3 | 4, flat: LeftOut, doubled: LeftOut, unused: LeftOut): MeshWarning[] {
  const kind = corners === 3 ? 'triangle' : 'tetrahedron';
  const [one, many, extent] = corners === 3 ? ['Triangle', 'triangles', 'area'] : ['Tetrahedron', 'tetrahedra', 'volume'];
  const others = ({ count }: LeftOut) => (count === 1 ? '' : ` and ${count - 1} more`);
  const silence = `Nothing has to be done; remove ${many} of that kind to silence this, or have them refused by strict: true.`;
  const warnings: MeshWarning[] = [
    {
      code: corners === 3 ? 'triangles-flat' : 'tetrahedra-flat',
      message: `${one} ${flat.first}${others(flat)} ${flat.count === 1 ? 'has' : 'have'} no ${extent}, and ${were(flat)} left out.`,
      remedy: silence,
      count: flat.count,
      culprit: { kind, index: flat.first },
    },
    {
      code: corners === 3 ? 'triangles-doubled' : 'tetrahedra-doubled',
      message: `${one} ${doubled.first}${others(doubled)} ${doubled.count === 1 ? 'has' : 'have'} the corners of another, and ${were(doubled)} left out.`,
      remedy: silence,
      count: doubled.count,
      culprit: { kind, index: doubled.first },
    },
    {
      code: 'vertices-unused',
      message: `Vertex ${unused.first}${others(unused)} ${unused.count === 1 ? 'is' : 'are'} in none of the ${many}, and ${unused.count === 1 ? 'counts' : 'count'} for nothing.`,
      remedy: 'Nothing has to be done; remove what is unused to silence this.',
      count: unused.count,
      culprit: { kind: 'vertex', index: unused.first },
    },
  ];
  return warnings.filter(({ count }) => count > 0);
}

const were = ({ count }: LeftOut) => (count === 1 ? 'was' : 'were');
