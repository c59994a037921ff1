import { BufferAttribute, type BufferGeometry, DynamicDrawUsage } from 'three';
import { decode } from './decode.ts';

/** A triangle this flat, as sin² of the angle at a corner, says nothing of directions in its plane. */
const FLAT = 1e-12;

/**
 * The tangents of a geometry under deformation, for normal maps. A tangent is a direction in the surface, the derivative of the position by
 * a texture coordinate: so it goes where the edges of the triangles around its vertex go, is made perpendicular to the new normal, and what
 * an author had it turned by from there at rest is turned again. A rigid motion turns it exactly.
 */
export class TurnedTangents {
  readonly attribute: BufferAttribute;
  readonly #corners: Uint32Array;
  /** For each corner of each triangle, how much of its edges to the next corner and to the one after that. */
  readonly #edges: Float32Array;
  readonly #rest: Float32Array;
  /** For each vertex, cosine and sine of the angle from what its edges make at rest to the tangent. */
  readonly #angles: Float32Array;

  private constructor(geometry: BufferGeometry) {
    const tangents = geometry.getAttribute('tangent');
    const positions = decode(geometry.getAttribute('position'));
    this.#rest = decode(tangents);
    this.#corners = Uint32Array.from(geometry.index?.array ?? { length: positions.length / 3 }, (corner, i) =>
      geometry.index ? corner : i,
    );
    this.#edges = edgesOf(this.#corners, positions, this.#rest);
    const array = new Float32Array(4 * tangents.count);
    for (let v = 0; v < tangents.count; v++) array[4 * v + 3] = tangents.getW(v);
    this.attribute = new BufferAttribute(array, 4).setUsage(DynamicDrawUsage);
    this.#angles = Float32Array.from({ length: 2 * tangents.count }, (_, i) => 1 - (i % 2));
    const normals = decode(geometry.getAttribute('normal'));
    this.update(positions, normals);
    this.#measureAngles(normals);
    this.update(positions, normals);
  }

  /** None where a geometry has no tangents, or no normals for them. */
  static of(geometry: BufferGeometry): TurnedTangents | undefined {
    const { position, normal, tangent } = geometry.attributes;
    const fits = position && normal?.count === position.count && tangent?.count === position.count && tangent.itemSize === 4;
    return fits ? new TurnedTangents(geometry) : undefined;
  }

  /** Writes the tangents at these positions and normals (n×3), both in the geometry's own space. Allocates nothing. */
  update(positions: ArrayLike<number>, normals: ArrayLike<number>): void {
    this.#carry(positions);
    const to = this.attribute.array as Float32Array;
    const rest = this.#rest;
    for (let v = 0, i = 0, k = 0; k < to.length; v += 2, i += 3, k += 4) {
      const nx = normals[i] as number;
      const ny = normals[i + 1] as number;
      const nz = normals[i + 2] as number;
      let x = to[k] as number;
      let y = to[k + 1] as number;
      let z = to[k + 2] as number;
      let along = x * nx + y * ny + z * nz;
      const size = x * x + y * y + z * z;
      // Where the edges say nothing, the tangent stays as near to rest as the normal lets it.
      const lost = !(size - along * along > FLAT * size);
      if (lost) {
        x = rest[i] as number;
        y = rest[i + 1] as number;
        z = rest[i + 2] as number;
        along = x * nx + y * ny + z * nz;
      }
      x -= along * nx;
      y -= along * ny;
      z -= along * nz;
      const scale = 1 / (Math.sqrt(x * x + y * y + z * z) || 1);
      const cosine = (lost ? 1 : (this.#angles[v] as number)) * scale;
      const sine = (lost ? 0 : (this.#angles[v + 1] as number)) * scale;
      to[k] = cosine * x + sine * (ny * z - nz * y);
      to[k + 1] = cosine * y + sine * (nz * x - nx * z);
      to[k + 2] = cosine * z + sine * (nx * y - ny * x);
    }
    this.attribute.needsUpdate = true;
  }

  /** Sums up each vertex' edges. */
  #carry(positions: ArrayLike<number>): void {
    const to = this.attribute.array as Float32Array;
    for (let k = 0; k < to.length; k += 4) to[k] = to[k + 1] = to[k + 2] = 0;
    const corners = this.#corners;
    for (let c = 0; c + 2 < corners.length; c += 3) {
      for (let corner = 0; corner < 3; corner++) {
        const a = this.#edges[2 * (c + corner)] as number;
        const b = this.#edges[2 * (c + corner) + 1] as number;
        const at = corners[c + corner] as number;
        const next = 3 * (corners[c + ((corner + 1) % 3)] as number);
        const last = 3 * (corners[c + ((corner + 2) % 3)] as number);
        for (let axis = 0; axis < 3; axis++) {
          const from = positions[3 * at + axis] as number;
          const edges = a * ((positions[next + axis] as number) - from) + b * ((positions[last + axis] as number) - from);
          to[4 * at + axis] = (to[4 * at + axis] as number) + edges;
        }
      }
    }
  }

  /** Compares what the edges make at rest, which is in `attribute`, with what the geometry says. */
  #measureAngles(normals: ArrayLike<number>): void {
    const made = this.attribute.array;
    for (let v = 0; v < made.length / 4; v++) {
      const [x, y, z] = made.slice(4 * v, 4 * v + 3) as unknown as [number, number, number];
      const [tx, ty, tz] = this.#rest.subarray(3 * v, 3 * v + 3) as unknown as [number, number, number];
      const [nx, ny, nz] = [normals[3 * v] as number, normals[3 * v + 1] as number, normals[3 * v + 2] as number];
      const cosine = tx * x + ty * y + tz * z;
      const sine = tx * (ny * z - nz * y) + ty * (nz * x - nx * z) + tz * (nx * y - ny * x);
      const length = Math.hypot(cosine, sine);
      if (length > 0) this.#angles.set([cosine / length, sine / length], 2 * v);
    }
  }
}

/** Each vertex' tangent by the edges of the triangles around it, by least squares in each triangle and weighted by its area. */
function edgesOf(corners: Uint32Array, positions: Float32Array, tangents: Float32Array): Float32Array {
  const edges = new Float32Array(2 * corners.length);
  const dot = (p: readonly number[], q: readonly number[]) =>
    (p[0] as number) * (q[0] as number) + (p[1] as number) * (q[1] as number) + (p[2] as number) * (q[2] as number);
  for (let c = 0; c + 2 < corners.length; c += 3) {
    for (let corner = 0; corner < 3; corner++) {
      const at = 3 * (corners[c + corner] as number);
      const edgeTo = (step: number) => {
        const to = 3 * (corners[c + ((corner + step) % 3)] as number);
        return [0, 1, 2].map((axis) => (positions[to + axis] as number) - (positions[at + axis] as number));
      };
      const [e, f] = [edgeTo(1), edgeTo(2)];
      const t = [...tangents.subarray(at, at + 3)];
      const [ee, ef, ff, et, ft] = [dot(e, e), dot(e, f), dot(f, f), dot(e, t), dot(f, t)];
      // The square of twice the area.
      const square = ee * ff - ef * ef;
      if (!(square > FLAT * ee * ff)) continue;
      edges.set([(ff * et - ef * ft) / Math.sqrt(square), (ee * ft - ef * et) / Math.sqrt(square)], 2 * (c + corner));
    }
  }
  return edges;
}
