import { DirectionalLight, Group, HemisphereLight, Mesh, type Object3D, PlaneGeometry, ShadowMaterial, Vector3 } from 'three';

const SHADOW_SIZE = 512;

/** Soft daylight from above, a cool rim from behind, and a ground that only shows the shadow. */
export class StudioLight {
  readonly group = new Group();
  readonly #key = new DirectionalLight(0xfff4e6, 1.9);
  readonly #rim = new DirectionalLight(0xcfe0ff, 0.9);
  readonly #ground: Mesh<PlaneGeometry, ShadowMaterial>;

  constructor() {
    const sky = new HemisphereLight(0xf7faff, 0xc9bbae, 1.9);
    this.#key.castShadow = true;
    this.#key.shadow.mapSize.set(SHADOW_SIZE, SHADOW_SIZE);
    this.#key.shadow.radius = 5;
    this.#key.shadow.bias = -0.0005;
    this.#key.shadow.blurSamples = 10;
    this.#ground = new Mesh(new PlaneGeometry(1, 1), new ShadowMaterial({ opacity: 0.22 }));
    this.#ground.rotation.x = -Math.PI / 2;
    this.#ground.receiveShadow = true;
    this.group.add(sky, this.#key, this.#key.target, this.#rim, this.#rim.target, this.#ground);
  }

  /** Sizes everything for a model around `center` with this `radius`, standing at height `floor`, first seen from `azimuth` (radians). */
  fit(center: Vector3, radius: number, floor: number, azimuth: number): void {
    const from = (angle: number, across: number, up: number) =>
      new Vector3(Math.sin(azimuth + angle) * across, up, Math.cos(azimuth + angle) * across).multiplyScalar(radius).add(center);
    this.#key.position.copy(from(-0.5, 1.35, 3.4));
    this.#key.target.position.copy(center);
    this.#rim.position.copy(from(2.4, 3, 1.2));
    this.#rim.target.position.copy(center);
    const camera = this.#key.shadow.camera;
    const reach = radius * 1.7;
    Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: radius * 0.1, far: radius * 8 });
    camera.updateProjectionMatrix();
    this.#ground.position.set(center.x, floor, center.z);
    this.#ground.scale.setScalar(radius * 12);
  }

  /** A bust floats, an animal stands. */
  set grounded(value: boolean) {
    this.#ground.visible = value;
    this.#key.castShadow = value;
  }

  /** Shadows on a dark floor need more ink to be seen. */
  set dark(value: boolean) {
    this.#ground.material.opacity = value ? 0.45 : 0.17;
  }

  castFrom(object: Object3D): void {
    object.traverse((part) => {
      part.castShadow = true;
    });
  }
}
