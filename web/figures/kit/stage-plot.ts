import { Group, IcosahedronGeometry, InstancedMesh, Matrix4, MeshLambertMaterial } from 'three';
import { cameraTools } from '../../stage/camera-tools.ts';
import { disposeObject } from '../../stage/dispose-object.ts';
import { sharedEasel } from '../../stage/easel.ts';
import { View } from '../../stage/view.ts';
import { ballMatrices } from '../../three/ball-images.ts';
import { BareHandles } from '../../three/handles.ts';
import { ColorMap } from '../../ui/color-map.ts';
import { h } from '../../ui/dom.ts';
import { noteIn } from '../../ui/note.ts';
import type { Kit, OpenPanel, Panel } from './figure.ts';
import { placed, rows } from './space-points.ts';
import { Surface, type Triangulation } from './surface.ts';

type Place = readonly [x: number, y: number, z: number];

interface SpaceHandle {
  move(...place: Place): void;
  reset(): void;
}

interface StagePlotOptions<M, S> {
  /** What the view shows, for those who do not see it. */
  readonly label: string;
  /** Above it, where several are shown. */
  readonly title?: string;
  /** What the colors stand for, from 0 to 1, where there are any. */
  readonly legend?: string;
  /** From where it is seen at first: degrees. */
  view(state: S): { readonly azimuth: number; readonly elevation: number };
  draw(stage: Stage<S>, made: M, state: S): void;
}

/** A panel with a shape in space that is turned by dragging beside it, and handles on it. */
export function stagePlot<M, S>(options: StagePlotOptions<M, S>): Panel<M, S> {
  return { open: (kit) => new StagePlot(kit, options) };
}

class StagePlot<M, S> implements OpenPanel<M, S> {
  readonly element: HTMLElement;
  readonly #stage: Stage<S>;
  readonly #options: StagePlotOptions<M, S>;

  constructor(kit: Kit<S>, options: StagePlotOptions<M, S>) {
    this.#options = options;
    this.#stage = new Stage(kit, options.label);
    const { title, legend } = options;
    this.element = h(
      'div',
      { class: 'stage-panel stack' },
      ...(title ? [h('h3', { class: 'chart-title' }, title)] : []),
      this.#stage.element,
      ...(legend ? [ramp(legend)] : []),
    );
  }

  draw(made: M, state: S): void {
    this.#options.draw(this.#stage, made, state);
    this.#stage.show(this.#options.view(state));
  }

  dispose(): void {
    this.#stage.dispose();
  }
}

/** What a figure in space draws with. */
class Stage<S> {
  readonly element: HTMLElement;
  readonly #kit: Kit<S>;
  readonly #view: View;
  readonly #overlay: BareHandles;
  #group = new Group();
  #surface: Surface | undefined;
  #balls: InstancedMesh | undefined;
  #dots: InstancedMesh | undefined;
  #handles: readonly SpaceHandle[] = [];
  #names: readonly string[] = [];
  #framed: Surface | undefined;
  readonly #matrix = new Matrix4();

  constructor(kit: Kit<S>, label: string) {
    this.#kit = kit;
    const canvas = h('canvas');
    const viewport = h('div', {
      class: 'viewport',
      role: 'application',
      'aria-label': `${label}. Arrow keys turn the view, plus and minus zoom, Home shows all.`,
    });
    const container = h('div', { class: 'handles' });
    const note = h('p', { class: 'note', role: 'status', hidden: true });
    viewport.append(canvas, container);
    this.#view = new View(canvas, viewport, sharedEasel());
    this.element = h('div', { class: 'stage' }, viewport, cameraTools(this.#view, viewport), note);
    this.#view.onInterrupted = noteIn(note);
    this.#overlay = new BareHandles({
      camera: this.#view.camera,
      container,
      onMove: (i, { x, y, z }) => this.#handles[i]?.move(x, y, z),
      onReset: (i) => this.#handles[i]?.reset(),
    });
    this.#view.onDrawn = () => this.#overlay.update();
  }

  /** The surface of a shape; another one comes into view whole. Write its positions, then it has moved. */
  surface(rest: Triangulation, write: (surface: Surface) => void): this {
    if (this.#surface?.rest !== rest) {
      this.#group = new Group();
      this.#balls = this.#dots = undefined;
      this.#surface = new Surface(rest);
      this.#group.add(this.#surface);
      this.#surface.geometry.computeBoundingSphere();
      this.#overlay.step = (this.#surface.geometry.boundingSphere?.radius || 1) / 50;
    }
    write(this.#surface);
    this.#surface.moved();
    return this;
  }

  /** Balls as a mapping leaves them: 18 numbers each, the images of the ends of three diameters at right angles. */
  balls(ends: ArrayLike<number>): this {
    this.#balls = this.#many(this.#balls, ends.length / 18, 4);
    ballMatrices(ends, this.#balls.instanceMatrix.array as Float32Array);
    return this;
  }

  /** Dots on vertices of the surface. */
  dots(vertices: ArrayLike<number>): this {
    const positions = this.#surface?.positions;
    if (!positions) return this;
    this.#dots = this.#many(this.#dots, vertices.length, 1);
    const size = this.#overlay.step;
    for (let i = 0; i < vertices.length; i++) {
      const v = 3 * (vertices[i] as number);
      this.#matrix.makeScale(size, size, size);
      this.#matrix.setPosition(positions[v] as number, positions[v + 1] as number, positions[v + 2] as number);
      this.#dots.setMatrixAt(i, this.#matrix);
    }
    return this;
  }

  /** The points of a channel: dragged, and brought back to where they are at `rest` (n×3). */
  points(key: keyof S & string, names: readonly string[], rest: readonly number[]): this {
    const numbers = () => this.#kit.state[key] as readonly number[];
    const put = (i: number, place: Place) => this.#kit.change({ [key]: placed(numbers(), i, place) } as Partial<S>);
    const home = rows(rest);
    this.#handles = home.map((own, i) => ({ move: (...place) => put(i, place), reset: () => put(i, own) }));
    if (names !== this.#names) this.#overlay.set(home.map((position, i) => ({ name: names[i] ?? '', position })));
    this.#names = names;
    for (const [i, place] of rows(numbers()).entries()) this.#overlay.setPosition(i, ...place);
    return this;
  }

  /** So many balls, kept while their number stays. */
  #many(kept: InstancedMesh | undefined, count: number, detail: number): InstancedMesh {
    if (kept?.count === count) {
      kept.instanceMatrix.needsUpdate = true;
      return kept;
    }
    if (kept) {
      this.#group.remove(kept);
      disposeObject(kept);
    }
    const made = new InstancedMesh(new IcosahedronGeometry(1, detail), new MeshLambertMaterial({ color: 0x2f63bd }), count);
    made.frustumCulled = false;
    this.#group.add(made);
    return made;
  }

  show(from: { readonly azimuth: number; readonly elevation: number }): void {
    if (this.#surface && this.#surface !== this.#framed) {
      this.#framed = this.#surface;
      this.#view.show(this.#group);
      this.#view.frame(this.#surface, from, true);
    } else this.#view.changed();
  }

  dispose(): void {
    this.#overlay.dispose();
    this.#view.dispose();
  }
}

function ramp(words: string): HTMLElement {
  const colors = h('div', {});
  colors.style.background = new ColorMap('viridis', 0, 1).gradient;
  return h('div', { class: 'ramp soft' }, h('span', {}, `${words}: 0`), colors, '1');
}
