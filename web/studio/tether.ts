import { type Camera, Vector3 } from 'three';
import { byId } from '../ui/dom.ts';

/** A dotted line from where the chosen handle was at rest to where it is now. */
export class Tether {
  readonly #line = byId('tether') as unknown as SVGLineElement;
  readonly #camera: Camera;
  readonly #end = new Vector3();

  constructor(camera: Camera) {
    this.#camera = camera;
  }

  update(from: Vector3 | undefined, to: Vector3 | undefined): void {
    const visible = from !== undefined && to !== undefined && !from.equals(to);
    this.#line.style.display = visible ? '' : 'none';
    if (!visible) return;
    const { width, height } = (this.#line.ownerSVGElement as SVGSVGElement).getBoundingClientRect();
    for (const [end, point] of [[1, from] as const, [2, to] as const]) {
      this.#end.copy(point).project(this.#camera);
      this.#line.setAttribute(`x${end}`, (((this.#end.x + 1) / 2) * width).toFixed(1));
      this.#line.setAttribute(`y${end}`, (((1 - this.#end.y) / 2) * height).toFixed(1));
    }
  }
}
