/** Where the nodes of an object are, in its own space: its own transform does not count. */
import type { Object3D } from 'three';
import { IDENTITY, type Matrix, multiplyMatrices } from '../assets/transform.ts';

export class Places {
  readonly object: Object3D;
  readonly #known = new Map<Object3D, Matrix>();

  constructor(object: Object3D) {
    this.object = object;
    this.#known.set(object, IDENTITY);
  }

  /** Of a node below the object. */
  inObject(node: Object3D): Matrix {
    const known = this.#known.get(node);
    if (known) return known;
    const matrix = multiplyMatrices(node.parent ? this.inObject(node.parent) : IDENTITY, localMatrix(node));
    this.#known.set(node, matrix);
    return matrix;
  }

  inWorld(node: Object3D): Matrix {
    return multiplyMatrices(node.parent ? this.inWorld(node.parent) : IDENTITY, localMatrix(node));
  }

  isInside(node: Object3D): boolean {
    for (let at: Object3D | null = node; at; at = at.parent) if (at === this.object) return true;
    return false;
  }
}

function localMatrix(node: Object3D): Matrix {
  if (node.matrixAutoUpdate) node.updateMatrix();
  return [...node.matrix.elements];
}
