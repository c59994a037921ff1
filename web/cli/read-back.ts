/** What is about to be written, read as others will read it: a file that comes out is one that goes in. */
import type { Document } from '@gltf-transform/core';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { readBody, readGlb, readMesh, readPoseSpaces } from '../assets/index.ts';

interface Expected {
  /** Of the body that it was given. */
  readonly positionsHash?: string;
  /** Whether its scene is a shape of ours, so that its numbers are to be looked at. */
  readonly shape?: boolean;
}

/**
 * Reads an output back. Throws 'mesh-not-finite' naming a vertex that cannot be drawn, and what reading throws; an output that is refused
 * here is not put in place.
 */
export async function readBack(bytes: Uint8Array, { positionsHash, shape = false }: Expected): Promise<void> {
  const document = await readGlb(bytes);
  readPoseSpaces(document);
  if (shape) checkFinite(document);
  if (positionsHash === undefined) return;
  const body = await readBody(document);
  if (body?.positionsHash === positionsHash) return;
  throw new HandlebodyError('body-mismatch', {
    message: 'The file that was to be written does not carry the body that was baked.',
    remedy: 'This is a defect: please report it, with the model if you can. The older file was kept.',
  });
}

/** Looks at the vertices that are drawn. */
function checkFinite(document: Document): void {
  const { positions, triangles } = readMesh(document).mesh;
  const isCloud = triangles.length === 0;
  for (let i = 0; i < (isCloud ? positions.length / 3 : triangles.length); i++) {
    const vertex = isCloud ? i : (triangles[i] as number);
    if ([0, 1, 2].every((axis) => Number.isFinite(positions[3 * vertex + axis]))) continue;
    throw new HandlebodyError('mesh-not-finite', {
      message: `Vertex ${vertex} of the result has a coordinate that is no finite number.`,
      remedy: 'Use numbers of the size of the model; the older file was kept.',
      culprit: { kind: 'vertex', index: vertex },
    });
  }
}
