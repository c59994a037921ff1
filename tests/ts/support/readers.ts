import { HandlebodyError } from '../../../wasm/ts/errors.ts';
import { type FileBytes, type FileMesh, type ReadOptions, readObj, readOff, readPly, readStl } from '../../../web/assets/index.ts';

export const READERS: Readonly<Record<string, (bytes: FileBytes, options?: ReadOptions) => FileMesh>> = {
  obj: readObj,
  ply: readPly,
  stl: readStl,
  off: readOff,
};

/** By the ending of a name. */
export function readNamed(name: string, bytes: FileBytes, options?: ReadOptions): FileMesh {
  const ending = name.slice(name.lastIndexOf('.') + 1);
  return (READERS[ending] as (typeof READERS)[string])(bytes, options);
}

/** The mesh, or the typed error; any other error is thrown on. */
export function attempt(work: () => FileMesh): FileMesh | HandlebodyError {
  try {
    return work();
  } catch (error) {
    if (error instanceof HandlebodyError) return error;
    throw error;
  }
}

/** What must hold of any mesh that a reader gives. */
export function faultOf(mesh: FileMesh): string | undefined {
  const vertices = mesh.positions.length / 3;
  if (vertices === 0) return 'no vertices';
  for (const numbers of [mesh.positions, mesh.normals ?? [], mesh.uvs ?? [], mesh.origin ?? []])
    if (!Array.from(numbers).every(Number.isFinite)) return 'a number that is not finite';
  if (mesh.triangles.length % 3 !== 0 || mesh.triangles.some((vertex) => vertex >= vertices)) return 'a vertex that is not there';
  if (mesh.normals && mesh.normals.length !== 3 * vertices) return 'too few normals';
  return mesh.warnings.every(({ code, message, remedy, count }) => code && message && remedy && count > 0)
    ? undefined
    : 'an odd warning';
}
