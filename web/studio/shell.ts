import { type Mesh, MeshNormalMaterial, type Object3D } from 'three';
import { disposeMaterial } from '../stage/dispose-object.ts';

/** Seen on paper and in the dark; of one color, so that in whatever order its layers are drawn they make the same picture. */
const COLOR = 'vec3(0.47, 0.53, 0.62)';

/** Shows an object as a faint shell, clear where it faces the viewer and firmer along its outline. What is returned gives its own materials back. */
export function asShell(object: Object3D): () => void {
  const shell = shellMaterial();
  const own = new Map<Mesh, Mesh['material']>();
  object.traverse((part) => {
    const mesh = part as Mesh;
    if (!mesh.isMesh) return;
    own.set(mesh, mesh.material);
    // As many as there were: which triangles are drawn may go by that.
    mesh.material = Array.isArray(mesh.material) ? mesh.material.map(() => shell) : shell;
  });
  // Where the graphics are interrupted, all that was made before has to be given back, also what is not shown just now.
  const forget = () => {
    for (const material of own.values()) disposeMaterial(material);
  };
  shell.addEventListener('dispose', forget);
  return () => {
    for (const [mesh, material] of own) mesh.material = material;
    shell.removeEventListener('dispose', forget);
    shell.dispose();
  };
}

/** Of three.js' materials the simplest that knows where a surface faces, bones and morph targets counted. */
function shellMaterial(): MeshNormalMaterial {
  const material = new MeshNormalMaterial({ transparent: true, depthWrite: false });
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      'gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );',
      `float away = 1.0 - abs( normalize( normal ).z );
      gl_FragColor = vec4( ${COLOR}, mix( 0.1, 0.8, away * away * away ) );`,
    );
  };
  return material;
}
