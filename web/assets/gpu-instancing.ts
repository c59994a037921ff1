import type { Document } from '@gltf-transform/core';
import { HandlebodyError } from '../../wasm/ts/errors.ts';

const NAME = 'EXT_mesh_gpu_instancing';

/**
 * Refuses nodes that draw their mesh many times by EXT_mesh_gpu_instancing: vertices are numbered as stored, once, and what is deformed
 * would be every copy alike. Throws 'file-unsupported' naming the node.
 */
export function refuseInstancing(document: Document): void {
  const nodes = document.getRoot().listNodes();
  const index = nodes.findIndex((node) => node.getMesh() && node.getExtension(NAME));
  if (index === -1) return;
  const name = nodes[index]?.getName();
  throw new HandlebodyError('file-unsupported', {
    message: `nodes[${index}]${name ? ` ("${name}")` : ''} draws its mesh many times (${NAME}), and a body knows each vertex once.`,
    remedy:
      'Export the model without instancing, each copy as a node of its own; with glTF-Transform: document.transform(uninstance()).',
  });
}
