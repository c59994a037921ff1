/** Models of three formats as documents, and what of a GLB passes through. */
import { Document } from '@gltf-transform/core';
import { describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { readMesh } from '../../web/assets/index.ts';
import { modelBytes, readModel } from '../../web/cli/model.ts';
import { Report } from '../../web/cli/report.ts';

const bytesOf = (text: string) => new TextEncoder().encode(text);

function report(): Report {
  const nowhere = { write: () => true };
  return new Report(nowhere, nowhere);
}

const TETRAHEDRON = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n';

/** A GLB, chunk by chunk. */
function pack(json: object, bin: Uint8Array): Uint8Array {
  const text = bytesOf(JSON.stringify(json));
  const padded = new Uint8Array(Math.ceil(text.length / 4) * 4).fill(32);
  padded.set(text);
  const out = new Uint8Array(12 + 8 + padded.length + 8 + bin.length);
  const view = new DataView(out.buffer);
  [0x46546c67, 2, out.length, padded.length, 0x4e4f534a].forEach((word, i) => {
    view.setUint32(4 * i, word, true);
  });
  out.set(padded, 20);
  view.setUint32(20 + padded.length, bin.length, true);
  view.setUint32(24 + padded.length, 0x004e4942, true);
  out.set(bin, 28 + padded.length);
  return out;
}

describe('readModel', () => {
  it('goes by what a file begins with, and by its name where that says nothing', async () => {
    const glb = await modelBytes((await readModel(bytesOf(TETRAHEDRON), 'a.obj', report())).document);
    expect((await readModel(glb, 'called.obj', report())).format).toBe('GLB');
    const ply =
      'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n';
    expect((await readModel(bytesOf(ply), 'called.glb', report())).format).toBe('PLY');
    expect((await readModel(bytesOf(TETRAHEDRON), 'called.OBJ', report())).format).toBe('OBJ');
    expect((await readModel(bytesOf(TETRAHEDRON), 'called.glb', report())).format).toBe('OBJ');
    await expect(readModel(bytesOf('# nothing but a comment'), 'called.glb', report())).rejects.toThrow(
      /"called.glb": .*an OBJ model/,
    );
  });

  it('gives files without normals smooth ones of unit length, outward', async () => {
    const { document } = await readModel(bytesOf(`${TETRAHEDRON}v 9 9 9\n`), 'folder/thing.obj', report());
    const [mesh] = document.getRoot().listMeshes();
    expect(mesh?.getName()).toBe('thing');
    const primitive = mesh?.listPrimitives()[0];
    const [position, normal] = [primitive?.getAttribute('POSITION'), primitive?.getAttribute('NORMAL')];
    expect(normal?.getCount()).toBe(5);
    for (let v = 0; v < 5; v++) {
      const [p, n] = [position?.getElement(v, []) ?? [], normal?.getElement(v, []) ?? []];
      expect(Math.hypot(...n)).toBeCloseTo(1, 6);
      // Away from the centroid (¼, ¼, ¼); the fifth vertex belongs to no face.
      if (v < 4) expect(n.reduce((sum, x, axis) => sum + x * ((p[axis] ?? 0) - 0.25), 0)).toBeGreaterThan(0);
    }
  });

  it('joins buffers, of which a GLB may have one', async () => {
    const positions = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]);
    const indices = `data:application/octet-stream;base64,${Buffer.from(Uint16Array.of(0, 1, 2).buffer).toString('base64')}`;
    const json = {
      asset: { version: '2.0' },
      scene: 0,
      scenes: [{ nodes: [0] }],
      nodes: [{ mesh: 0 }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
      accessors: [
        { bufferView: 0, componentType: 5126, type: 'VEC3', count: 3, min: [0, 0, 0], max: [1, 1, 0] },
        { bufferView: 1, componentType: 5123, type: 'SCALAR', count: 3 },
      ],
      bufferViews: [
        { buffer: 0, byteOffset: 0, byteLength: 36 },
        { buffer: 1, byteOffset: 0, byteLength: 6 },
      ],
      buffers: [{ byteLength: 36 }, { byteLength: 6, uri: indices }],
    };
    const { document } = await readModel(pack(json, new Uint8Array(positions.buffer)), 'two.glb', report());
    const back = await readModel(await modelBytes(document), 'one.glb', report());
    expect(back.document.getRoot().listBuffers()).toHaveLength(1);
    expect(readMesh(back.document).mesh).toEqual({ positions, triangles: Uint32Array.of(0, 1, 2) });
  });

  it('names the file in errors, once', async () => {
    const error = await readModel(bytesOf('v 1'), 'odd.obj', report()).catch((caught: unknown) => caught);
    expect(error).toBeInstanceOf(HandlebodyError);
    expect((error as HandlebodyError).message).toMatch(/^"odd.obj": Line 1 /);
  });

  it('warns of nothing in a plain document', async () => {
    const to = report();
    await readModel(await modelBytes(new Document()), 'empty.glb', to);
    expect(to.warnings).toEqual([]);
  });
});

describe('Report', () => {
  const spoken = (isTTY: boolean) => {
    const said: string[] = [];
    const sink = { isTTY, write: (text: string) => said.push(text) };
    return { said, report: new Report(sink, sink) };
  };

  it('draws a bar on a terminal and writes a line every tenth elsewhere', () => {
    const terminal = spoken(true);
    const draw = terminal.report.progress('baking');
    draw(0);
    draw(1);
    terminal.report.note('done');
    expect(terminal.said.join('')).toMatch(/^\r?.*\rbaking \[#{24}\] 100%\ndone\n$/);
    const file = spoken(false);
    const line = file.report.progress('baking');
    for (let i = 0; i <= 100; i++) line(i / 100);
    expect(file.said).toHaveLength(11);
    expect(file.said.at(-1)).toBe('baking 100%\n');
  });

  it('ends a bar before it says something else', () => {
    const { said, report: to } = spoken(true);
    to.progress('baking')(0.5);
    to.warn({ code: 'odd', message: 'Odd.', remedy: 'Even it.' });
    expect(said.slice(-2)).toEqual(['\n', 'warning: Odd. Even it.\n']);
  });

  it('does not pass on what steers a terminal', () => {
    const { said, report: to } = spoken(true);
    to.note('a\u001b[2Jb\u009bc\u202ed');
    expect(said.join('')).toBe('a\ufffd[2Jb\ufffdc\ufffdd\n');
  });
});
