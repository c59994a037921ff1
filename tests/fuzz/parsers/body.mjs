/** A baked body in a GLB, damaged: the extension's header, its accessors and the packed bytes. */
import { glb } from '../../bench/hostile/make.mjs';

const mesh = {
  positions: Float32Array.of(0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2),
  triangles: Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3),
};
const NAMED = [
  { name: 'tip', vertex: 3 },
  { name: 'in', at: /** @type {const} */ ([0.4, 0.4, 0.4]), kind: /** @type {const} */ ('rotation') },
];

/** @param {Uint8Array} file */
function partsOf(file) {
  const length = new DataView(file.buffer, file.byteOffset).getUint32(12, true);
  return { json: JSON.parse(new TextDecoder().decode(file.subarray(20, 20 + length))), bin: file.subarray(28 + length) };
}

/** @param {import('./targets.mjs').Assets} assets @param {import('../../../wasm/ts/index.ts').Handlebody} hb @returns {Promise<import('./targets.mjs').Target>} */
export async function bodyTarget({ readBody, readGlb, writeGlb }, hb) {
  const baked = await hb.bake(mesh, { centers: 4, resolution: 8, spheres: 3 });
  const bodies = [baked, { ...baked, handles: NAMED }];
  const files = await Promise.all(bodies.map(async (body) => partsOf(await writeGlb(mesh, { body }))));
  return {
    make(random) {
      const { json, bin } = random.pick(files);
      const kind = random.below(5);
      if (kind === 0) return glb(json, bin);
      if (kind === 1) return glb(random.damage(json), bin);
      if (kind === 2) return random.bytes(glb(json, bin));
      // The extension's own part once more: what is damaged elsewhere rarely gets there.
      const extensions = { HANDLEBODY_body: random.damage(json.extensions.HANDLEBODY_body) };
      return glb({ ...json, extensions }, kind === 3 ? random.bytes(bin) : bin);
    },
    async read(bytes) {
      const body = await readBody(await readGlb(bytes));
      if (!body) return false;
      const irbf = hb.irbf(body, { onWarning: () => {} });
      try {
        irbf.setHandles([{ vertex: 0 }, ...(body.handles ?? [])]);
        irbf.solve({ maxIterations: 3 });
        const out = new Float32Array(body.mesh.positions.length);
        irbf.deform(out);
        for (const x of out) if (!Number.isFinite(x)) throw new Error(`a deformed place of ${x}`);
        return true;
      } finally {
        irbf.dispose();
      }
    },
    whole: true,
    files: /(assets\/(body-|read-body|schema|predict-|voxel-runs|meshopt|check-reading)|ts\/irbf-body)/,
  };
}
