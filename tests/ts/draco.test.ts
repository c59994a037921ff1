/** Draco with the decoder that the caller gives, and what is said without one. */
import { NodeIO } from '@gltf-transform/core';
import { KHRDracoMeshCompression } from '@gltf-transform/extensions';
import draco3d from 'draco3dgltf';
import { expect, it } from 'vitest';
import { type GltfWarning, meshDocument, readGlb, readMesh, writeGlb } from '../../web/assets/index.ts';
import { boxMesh } from './support/shapes.ts';

const SEEDS = Array.from({ length: 20 }, (_, i) => i + 1);

async function compressed(n: number): Promise<Uint8Array> {
  const document = meshDocument(boxMesh([1, 1 + n / 7, 0.5], [n, 2, 3]), 'box');
  document.createExtension(KHRDracoMeshCompression).setRequired(true);
  const io = new NodeIO().registerExtensions([KHRDracoMeshCompression]);
  return io.registerDependencies({ 'draco3d.encoder': await draco3d.createEncoderModule() }).writeBinary(document);
}

it.each(SEEDS)('is read as glTF-Transform reads it, and written plain (box of %i columns)', async (n) => {
  const bytes = await compressed(n);
  const decoder = await draco3d.createDecoderModule();
  const io = new NodeIO().registerExtensions([KHRDracoMeshCompression]).registerDependencies({ 'draco3d.decoder': decoder });
  const expected = readMesh(await io.readBinary(bytes)).mesh;
  const warnings: GltfWarning[] = [];
  const document = await readGlb(bytes, { draco: decoder, onWarning: (warning) => warnings.push(warning) });
  expect(readMesh(document).mesh).toEqual(expected);
  expect(warnings).toMatchObject([{ code: 'decompressed', message: expect.stringContaining('Draco') }]);
  const written = await writeGlb(document);
  expect(new TextDecoder().decode(written)).not.toContain('draco');
  expect(readMesh(await readGlb(written)).mesh).toEqual(expected);
});

it('is refused without a decoder, whether or not the file says that it needs one', async () => {
  const bytes = await compressed(4);
  await expect(readGlb(bytes)).rejects.toMatchObject({ code: 'file-unsupported', message: expect.stringContaining('Draco') });
  await expect(readGlb(bytes, { extensions: [KHRDracoMeshCompression as never] })).rejects.toMatchObject({
    code: 'file-unsupported',
  });
  const text = new TextDecoder('latin1').decode(bytes);
  const optional = Uint8Array.from(text.replace('"extensionsRequired"', '"extensionsOptional"'), (c) => c.charCodeAt(0));
  await expect(readGlb(optional)).rejects.toMatchObject({ code: 'file-unsupported', remedy: expect.stringContaining('"draco"') });
});

it('is refused where the stream is damaged', async () => {
  const bytes = await compressed(4);
  const draco = await draco3d.createDecoderModule();
  for (let k = 0; k < 40; k++) {
    const damaged = bytes.slice();
    damaged.fill(k * 6, damaged.length - 20 - 10 * k, damaged.length - 10 * k);
    const outcome = await readGlb(damaged, { draco }).then(
      () => 'read',
      (error: { code?: string }) => error.code,
    );
    expect(['read', 'file-invalid', 'file-unsupported']).toContain(outcome);
  }
});
