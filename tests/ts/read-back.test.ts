/** What the command looks at before it puts an output in place. */
import { describe, expect, it } from 'vitest';
import { meshDocument, readMesh, writeGlb } from '../../web/assets/index.ts';
import { readBack } from '../../web/cli/read-back.ts';
import { boxMesh } from './support/shapes.ts';

const BOX = boxMesh([1, 1, 1], [2, 2, 2]);

/** A box with a vertex that no triangle uses, one coordinate of one vertex changed. */
async function box(index: number, value: number): Promise<Uint8Array> {
  const document = meshDocument({ ...BOX, positions: Float32Array.from([...BOX.positions, 9, 9, 9]) });
  const positions = document.getRoot().listMeshes()[0]?.listPrimitives()[0]?.getAttribute('POSITION');
  (positions?.getArray() as Float32Array)[index] = value;
  return writeGlb(document);
}

describe('readBack', () => {
  it.each(Array.from({ length: 20 }, (_, i) => i))('names a vertex that cannot be drawn (number %i)', async (k) => {
    const index = (k * 7) % BOX.positions.length;
    const value = [Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY][k % 3] as number;
    await expect(readBack(await box(index, value), { shape: true })).rejects.toMatchObject({
      code: 'mesh-not-finite',
      culprit: { kind: 'vertex', index: Math.floor(index / 3) },
    });
    await expect(readBack(await box(BOX.positions.length + (k % 3), value), { shape: true })).resolves.toBeUndefined();
  });

  it('misses the body that should be there, and refuses what cannot be read', async () => {
    const bytes = await writeGlb(meshDocument(BOX));
    await expect(readBack(bytes, {})).resolves.toBeUndefined();
    await expect(readBack(bytes, { positionsHash: '0123456789abcdef' })).rejects.toMatchObject({ code: 'body-mismatch' });
    await expect(readBack(bytes.subarray(0, bytes.length - 8), {})).rejects.toMatchObject({ code: 'file-truncated' });
    expect(readMesh(meshDocument(BOX)).mesh.triangles).toHaveLength(BOX.triangles.length);
  });
});
