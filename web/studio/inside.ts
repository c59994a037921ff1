import {
  type BufferGeometry,
  Color,
  CylinderGeometry,
  DynamicDrawUsage,
  Group,
  InstancedMesh,
  type Material,
  MeshBasicMaterial,
  MeshLambertMaterial,
  type Object3D,
  SphereGeometry,
  SRGBColorSpace,
} from 'three';
import type { Skeleton } from '../../wasm/ts/runtime.ts';
import { disposeObject } from '../stage/dispose-object.ts';
import type { View } from '../stage/view.ts';
import { ballEnds, ballMatrices, barMatrices, placesOf } from '../three/ball-images.ts';
import type { LiveBody } from '../three/live-body.ts';
import { ColorMap } from '../ui/color-map.ts';
import { PARTS, type Part } from './address.ts';
import { asShell } from './shell.ts';

/** As spheres and centers are in the figures of the paper. */
const BLUE = 0x2f63bd;
/** Beside all branches. */
const GRAY = 0x7c828d;
const ORANGE = 0xe8781e;
/** Parts of the model's diagonal. */
const DOT = 0.0042;
const LINE = 0.0018;
/** Numbers of a matrix. */
const MATRIX = 16;

/** Copies of one shape, and what brings them to where the body is now, which allocates nothing. */
interface Copies {
  readonly mesh: InstancedMesh;
  follow(): void;
}

interface InsideOptions {
  readonly view: View;
  readonly object: Object3D;
  readonly body: LiveBody;
}

/** What deforms a body, drawn where it is now, and the body as a shell around it. Leaves nothing behind when no part is shown. */
export class Inside {
  readonly #options: InsideOptions;
  readonly #group = new Group();
  readonly #copies = new Map<Part, Copies>();
  #putBack: (() => void) | undefined;

  constructor(options: InsideOptions) {
    this.#options = options;
    // The solver's places are the model's, those of the graphics card are floats, which hold them only about the body's own origin.
    this.#group.position.fromArray(options.body.data.mesh.origin ?? [0, 0, 0]);
  }

  /** Throws what the solver throws; what it could not place is not shown then. */
  show(parts: ReadonlySet<Part>): void {
    const { view, object, body } = this.#options;
    for (const part of PARTS) {
      const copies = this.#copies.get(part);
      if (parts.has(part) && !copies) this.#add(part, MAKE[part](body));
      else if (copies && !parts.has(part)) this.#remove(part, copies);
    }
    if (this.#copies.size > 0) this.#putBack ??= asShell(object);
    else {
      this.#putBack?.();
      this.#putBack = undefined;
    }
    view.changed();
  }

  /** To where the body is now. Throws what the solver throws. */
  follow(): void {
    for (const { mesh, follow } of this.#copies.values()) {
      follow();
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  dispose(): void {
    this.show(new Set());
  }

  #add(part: Part, copies: Copies | undefined): void {
    if (!copies) return;
    copies.follow();
    this.#copies.set(part, copies);
    this.#group.add(copies.mesh);
    this.#options.view.extras.add(this.#group);
  }

  #remove(part: Part, { mesh }: Copies): void {
    this.#copies.delete(part);
    disposeObject(mesh);
    mesh.removeFromParent();
    if (this.#copies.size === 0) this.#group.removeFromParent();
  }
}

/** None where the body has none. */
const MAKE: Record<Part, (body: LiveBody) => Copies | undefined> = { spheres, centers, skeleton };

function spheres(body: LiveBody): Copies | undefined {
  const { data } = body;
  if (data.spheres.length === 0) return undefined;
  const rest = ballEnds(data);
  const ends = new Float64Array(rest.length);
  const mesh = many(data.spheres.length / 4, new SphereGeometry(1, 24, 14), new MeshLambertMaterial());
  const colors = new ColorMap('viridis', 0, 1);
  const color = new Color();
  for (let i = 0; i < mesh.count; i++) mesh.setColorAt(i, colorOf(data.skeleton?.sphereBranches[i], colors, color));
  return {
    mesh,
    follow: () => {
      body.evaluate(rest, ends);
      ballMatrices(ends, matricesOf(mesh), data.mesh.origin);
    },
  };
}

function centers(body: LiveBody): Copies {
  const { centers, normalization } = body.data;
  const mesh = many(
    centers.length,
    new SphereGeometry(DOT * normalization.diagonal, 8, 6),
    new MeshLambertMaterial({ color: BLUE }),
  );
  return {
    mesh,
    follow: () => {
      const out = matricesOf(mesh);
      for (let i = 0; i < centers.length; i++) {
        const vertex = 3 * (centers[i] as number);
        for (let axis = 0; axis < 3; axis++) out[MATRIX * i + 12 + axis] = body.positions[vertex + axis] as number;
      }
    },
  };
}

function skeleton(body: LiveBody): Copies | undefined {
  const { data } = body;
  if (!data.skeleton) return undefined;
  const rest = placesOf(data, data.skeleton.nodes);
  const places = new Float64Array(rest.length);
  const joints = jointsOf(data.skeleton);
  // Seen through spheres, whose middles it runs through.
  const material = new MeshBasicMaterial({ color: ORANGE, depthTest: false, toneMapped: false });
  const mesh = many(joints.length / 2, new CylinderGeometry(1, 1, 1, 6, 1, true), material);
  mesh.renderOrder = 1;
  return {
    mesh,
    follow: () => {
      body.evaluate(rest, places);
      barMatrices(places, joints, LINE * data.normalization.diagonal, matricesOf(mesh), data.mesh.origin);
    },
  };
}

/** From each step of a branch to its next: two numbers of nodes. */
function jointsOf({ steps, lengths }: Skeleton): Uint32Array {
  const joints: number[] = [];
  let from = 0;
  for (const length of lengths) {
    for (let i = from + 1; i < from + length; i++) joints.push(steps[i - 1] as number, steps[i] as number);
    from += length;
  }
  return Uint32Array.from(joints);
}

function many(count: number, geometry: BufferGeometry, material: Material): InstancedMesh {
  const mesh = new InstancedMesh(geometry, material, count);
  mesh.instanceMatrix.setUsage(DynamicDrawUsage);
  mesh.frustumCulled = false;
  return mesh;
}

function matricesOf(mesh: InstancedMesh): Float32Array {
  return mesh.instanceMatrix.array as Float32Array;
}

const GOLDEN = (Math.sqrt(5) - 1) / 2;

/** Branches that follow one another, as limbs of one trunk do, have colors far apart. */
function colorOf(branch: number | undefined, colors: ColorMap, out: Color): Color {
  if (branch === undefined || branch < 0) return out.set(branch === undefined ? BLUE : GRAY);
  const packed = colors.packed(0.1 + 0.85 * ((branch * GOLDEN) % 1));
  return out.setRGB((packed & 255) / 255, ((packed >> 8) & 255) / 255, ((packed >> 16) & 255) / 255, SRGBColorSpace);
}
