/** What readers of simple files pass over, or, in strict reading, refuse: one rule for all formats. */
import { flag, optional, options } from '../../wasm/ts/arguments.ts';
import type { HandlebodyError } from '../../wasm/ts/errors.ts';

/** How a reader of OBJ, PLY, STL or OFF is to read. */
export interface ReadOptions {
  /** Refuse what would be passed over with a warning: every contradiction of the format, with the line or byte where it stands. (false) */
  readonly strict?: boolean;
}

/** Stable names of what a reader passes over. */
export type FileWarningCode =
  | 'faces-degenerate'
  | 'faces-crossing'
  | 'triangles-flat'
  | 'triangles-doubled'
  | 'positions-bad'
  | 'normals-bad'
  | 'uvs-bad'
  | 'normals-split'
  | 'uvs-split'
  | 'attributes-left-out'
  | 'shapes-left-out'
  | 'statements-unknown'
  | 'numbers-left-over'
  | 'data-left-over'
  | 'keyword-missing';

/** What a reader passed over: one for each kind, however often it occurs. */
export interface FileWarning {
  readonly code: FileWarningCode;
  /** In a sentence, with how many. */
  readonly message: string;
  readonly remedy: string;
  readonly count: number;
}

interface Kind {
  readonly says: (count: number) => string;
  readonly remedy: string;
  /** The format allows it, so that strict reading does too. */
  readonly isSound?: true;
}

const many = (count: number, one: string, more = `${one}s`) => `${count} ${count === 1 ? one : more}`;
const EXPORT = 'Export the model again if that is not what was meant.';

const KINDS: Readonly<Record<FileWarningCode, Kind>> = {
  /** Faces of one or two corners. */
  'faces-degenerate': { says: (n) => `${many(n, 'face')} of fewer than three corners left out.`, remedy: EXPORT },
  /** Polygons that cross themselves, which no set of triangles fills. */
  'faces-crossing': {
    says: (n) =>
      `${many(n, 'face crosses itself', 'faces cross themselves')}: cut into a fan, some of whose triangles lie over others.`,
    remedy: 'Cut such faces in two before exporting.',
  },
  /** Triangles without area. They are kept, since their neighbors hang together through them, and triangles stay numbered as in the file. */
  'triangles-flat': {
    says: (n) => `${many(n, 'triangle has', 'triangles have')} no area: kept, and nothing is measured by them.`,
    remedy: 'A modeler’s "remove degenerate faces" removes them.',
  },
  /** Triangles of the same three vertices. They are kept: a sheet with two sides is made of such. */
  'triangles-doubled': {
    says: (n) => `${many(n, 'triangle is', 'triangles are')} there more than once: kept.`,
    remedy: 'A modeler’s "merge by distance" removes copies.',
  },
  /** Places that are no numbers, of vertices that no face uses. */
  'positions-bad': {
    says: (n) =>
      `${many(n, 'vertex', 'vertices')} of no face without a finite position: kept, in their order, in the place of one that is used.`,
    remedy: EXPORT,
  },
  /** Normals that are no numbers, or zero, or not there. */
  'normals-bad': {
    says: (n) => `${many(n, 'normal gives', 'normals give')} no direction: replaced by what the surface gives.`,
    remedy: 'Let the modeler compute the normals anew.',
  },
  /** Texture coordinates that are no numbers, or not there. */
  'uvs-bad': {
    says: (n) => `${many(n, 'texture coordinate')} that cannot be read: all of them were left out.`,
    remedy: 'Unwrap the model again if it is to be textured.',
  },
  /** Normals that differ between the faces of a vertex, which has only one here. */
  'normals-split': {
    says: (n) => `Normals that differ between the faces of ${many(n, 'vertex', 'vertices')} were replaced by smooth ones.`,
    remedy: 'Export as GLB to keep creases.',
    isSound: true,
  },
  /** Texture coordinates that differ between the faces of a vertex. */
  'uvs-split': {
    says: (n) => `Texture coordinates that differ between the faces of ${many(n, 'vertex', 'vertices')} were left out.`,
    remedy: 'Export as GLB to keep them.',
    isSound: true,
  },
  /** Numbers that say nothing about the surface: colors, weights, values of whatever kind. */
  'attributes-left-out': {
    says: (n) => `Colors and other numbers of ${many(n, 'vertex or face', 'vertices and faces')} were left out.`,
    remedy: 'Export as GLB to keep vertex colors.',
    isSound: true,
  },
  /** Lines, points, curves and free-form surfaces. */
  'shapes-left-out': {
    says: (n) => `${many(n, 'statement')} of lines, points, curves or free-form surfaces left out.`,
    remedy: 'Convert them to faces to keep them.',
    isSound: true,
  },
  /** Lines that begin with no word of the format. */
  'statements-unknown': { says: (n) => `${many(n, 'line')} not of the format passed over.`, remedy: EXPORT },
  /** Rows with more numbers than the file announces. */
  'numbers-left-over': {
    says: (n) => `${many(n, 'row has', 'rows have')} more numbers than announced: passed over.`,
    remedy: EXPORT,
  },
  /** Bytes behind what the file announces. */
  'data-left-over': { says: (n) => `${many(n, 'byte')} behind the end of the mesh passed over.`, remedy: EXPORT },
  /** A text that does not begin as its format does. */
  'keyword-missing': { says: () => 'The format’s name at the file’s beginning is missing.', remedy: EXPORT },
};

/** Counts what is passed over in one file. */
export class PassedOver {
  readonly #strict: boolean;
  readonly #counts = new Map<FileWarningCode, { count: number; readonly first: HandlebodyError }>();

  constructor(given: ReadOptions) {
    this.#strict = options(given, { strict: optional(flag) }).strict ?? false;
  }

  /** One more, or `count`. `refusal` is what strict reading throws at once, unless the format allows what is passed over. */
  note(code: FileWarningCode, refusal: () => HandlebodyError, count = 1): void {
    if (this.#strict && !KINDS[code].isSound) throw refusal();
    const known = this.#counts.get(code);
    if (known) known.count += count;
    else this.#counts.set(code, { count, first: refusal() });
  }

  /** What strict reading would say to the first of a kind, in the order of `codes`: the best reason for a file without a mesh. */
  firstOf(codes: readonly FileWarningCode[]): HandlebodyError | undefined {
    for (const code of codes) {
      const known = this.#counts.get(code);
      if (known) return known.first;
    }
    return undefined;
  }

  warnings(): FileWarning[] {
    return [...this.#counts].map(([code, { count }]) => {
      const { says, remedy } = KINDS[code];
      return { code, message: says(count), remedy, count };
    });
  }
}
