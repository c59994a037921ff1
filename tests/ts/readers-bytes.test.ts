/** What readers take for a file's bytes; where positions begin; which format a file is of. */
import vm from 'node:vm';
import { describe, expect, it } from 'vitest';
import { chooseOrigin } from '../../wasm/ts/origin.ts';
import { fileFormat } from '../../web/assets/file-format.ts';
import { type FileBytes, meshDocument, readMesh, readObj } from '../../web/assets/index.ts';
import { binaryPly, binaryStl, bytesOf, madeFiles, moved, obj, off, ply, SHAPES, stl } from './support/made-files.mjs';
import { attempt, READERS, readNamed } from './support/readers.ts';
import { placeOf } from './support/surfaces.ts';

const box = SHAPES.box as { points: number[][]; faces: number[][] };

const FILES: Record<string, Uint8Array> = {
  obj: bytesOf(obj(box)),
  ply: binaryPly(box, true),
  stl: binaryStl(box),
  off: bytesOf(off(box)),
};

/** The same bytes in every form that holds bytes, in the middle of a larger memory where the form allows. */
const FORMS: Record<string, (bytes: Uint8Array) => FileBytes> = {
  ArrayBuffer: (bytes) => bytes.slice().buffer,
  'a part of a buffer': (bytes) => Uint8Array.from([1, 2, 3, ...bytes, 4]).subarray(3, 3 + bytes.length),
  Buffer: (bytes) => Buffer.from(bytes),
  DataView: (bytes) => new DataView(Uint8Array.from([1, ...bytes, 4]).buffer, 1, bytes.length),
  Int8Array: (bytes) => new Int8Array(bytes.slice().buffer),
  Uint8ClampedArray: (bytes) => new Uint8ClampedArray(bytes),
  Uint16Array: (bytes) => new Uint16Array(Uint8Array.from([9, 9, ...bytes]).buffer, 2, bytes.length / 2),
  SharedArrayBuffer: (bytes) => {
    const shared = new SharedArrayBuffer(bytes.length);
    new Uint8Array(shared).set(bytes);
    return shared;
  },
  'a view of shared memory': (bytes) => {
    const shared = new Uint8Array(new SharedArrayBuffer(bytes.length + 2), 1, bytes.length);
    shared.set(bytes);
    return shared;
  },
  'an ArrayBuffer of another realm': (bytes) => vm.runInNewContext(`Uint8Array.from([${bytes.join()}]).buffer`),
};

describe('bytes', () => {
  it.each(Object.keys(FILES).flatMap((format) => Object.keys(FORMS).map((form) => [format, form] as const)))(
    '%s: as %s',
    (format, form) => {
      // An even number of them, by a line end or a byte that is passed over.
      const bytes = FILES[format] as Uint8Array;
      const even = bytes.length % 2 === 0 ? bytes : Uint8Array.from([...bytes, 10]);
      const read = READERS[format] as (typeof READERS)[string];
      expect(read((FORMS[form] as (typeof FORMS)[string])(even))).toEqual(read(even));
    },
  );

  it.each(Object.keys(READERS))('%s: nothing else, which is named', (format) => {
    const read = READERS[format] as (typeof READERS)[string];
    for (const [given, name, remedy] of [
      ['v 0 0 0', 'a string', 'TextEncoder'],
      [new Blob(['v 0 0 0']), 'a Blob', 'arrayBuffer'],
      [Promise.resolve(new Uint8Array(1)), 'a Promise', 'Await'],
      [new Response('v'), 'a Response', 'arrayBuffer'],
      [[1, 2, 3], 'an Array', 'Uint8Array'],
      [undefined, 'undefined', 'ArrayBuffer'],
      [null, 'null', 'ArrayBuffer'],
      [7, 'a Number', 'ArrayBuffer'],
      [{ length: 3 }, 'an Object', 'ArrayBuffer'],
    ] as const) {
      expect(attempt(() => read(given as unknown as FileBytes))).toMatchObject({
        code: 'file-not-bytes',
        message: expect.stringContaining(`${name} is given`),
        remedy: expect.stringContaining(remedy),
      });
    }
  });
});

describe('the origin of positions', () => {
  it('is chosen for a box that is more than 1,000 diagonals away, and is exact as a float', () => {
    expect(chooseOrigin([0, 0, 0], [1, 1, 1])).toBeUndefined();
    expect(chooseOrigin([999, 0, 0], [1000, 0, 0])).toBeUndefined();
    expect(chooseOrigin([1000, 0, 0], [1001, 0, 0])).toBeUndefined();
    expect(chooseOrigin([1000.5, 0, 0], [1001.5, 0, 0])).toEqual([1001, 0, 0]);
    expect(chooseOrigin([-1001.5, 0, 0], [-1000.5, 0, 0])).toEqual([-1001, 0, 0]);
    // It goes through the origin's planes: near in x, far in y.
    expect(chooseOrigin([-1, 2500, 0], [1, 2500, 0])).toEqual([0, 2500, 0]);
    expect(chooseOrigin([-1, 1500, 0], [1, 1500, 0])).toBeUndefined();
    expect(chooseOrigin([5e8, 0, 0], [5e8, 0, 0])).toBeUndefined();
    const [x] = chooseOrigin([1e9 + 0.1, 0, 0], [1e9 + 0.3, 0, 0]) as [number, number, number];
    expect([Math.fround(x), Math.abs(x - 1e9) < 64]).toEqual([x, true]);
  });

  const places = [
    [5e5, 4e6, 100],
    [-5e5, 0, 4e6],
    [1e7, 1e7, -1e7],
    [0, 0, 3e5],
    [123456.789, 9.87654321e6, 0.1],
  ];
  const writers = { obj, ply, stl, off } as const;
  it.each(Object.keys(writers).flatMap((format) => places.map((place) => [format, place] as const)))(
    '%s at %j: every edge to 1e-6',
    (format, place) => {
      const far = moved(box, place);
      const mesh = (READERS[format] as (typeof READERS)[string])(bytesOf(writers[format as keyof typeof writers](far)));
      expect(mesh.origin?.map(Math.fround)).toEqual(mesh.origin);
      const middle = place.map((x, axis) => x + ([1, 0.5, 0.5][axis] as number));
      expect(mesh.origin).toEqual(middle.map(Math.fround));
      const places = Array.from({ length: 8 }, (_, v) => placeOf(mesh, v));
      const distances = places
        .flatMap((a) => places.map((b) => Math.hypot(...a.map((x, axis) => x - (b[axis] as number)))))
        .sort((a, b) => a - b);
      const near = Array.from({ length: 8 }, (_, v) => box.points[v] as number[]);
      const right = near
        .flatMap((a) => near.map((b) => Math.hypot(...a.map((x, axis) => x - (b[axis] as number)))))
        .sort((a, b) => a - b);
      expect(Math.max(...distances.map((distance, i) => Math.abs(distance - (right[i] as number))))).toBeLessThan(1e-6);
    },
  );

  it('is that of binary doubles, too', () => {
    const far = moved(box, [5e5, 4e6, 100]);
    for (const little of [true, false]) {
      const mesh = readNamed('a.ply', binaryPly(far, little, 'double'));
      expect(mesh.origin).toEqual([500001, Math.fround(4000000.5), 100.5]);
      expect(far.points.map((_, v) => placeOf(mesh, v))).toEqual(far.points);
    }
  });

  it('is set by what faces use alone', () => {
    const near = readNamed(
      'a.obj',
      bytesOf(`v 1e7 0 0\n${obj(box).replaceAll(/f .*/g, (face) => face.replaceAll(/\d/g, (d) => `${Number(d) + 1}`))}`),
    );
    expect(near.origin).toBeUndefined();
    expect([...near.positions.slice(0, 3)]).toEqual([1e7, 0, 0]);
    const far = moved(box, [1e6, 0, 0]);
    const mesh = readNamed('a.obj', bytesOf(`${obj(far)}v 0 0 0\nv nan 0 0\nv 3e38 0 0\nv -3.4e38 0 0\n`));
    expect(mesh.origin).toEqual([1000001, 0.5, 0.5]);
    expect(placeOf(mesh, 8)).toEqual([0, 0, 0]);
    // One without a place is put where a vertex in use is, so that it widens no box.
    expect(placeOf(mesh, 9)).toEqual(placeOf(mesh, 0));
    expect(mesh.positions.every(Number.isFinite)).toBe(true);
  });

  it('is that of a cloud of points', () => {
    const mesh = readObj(bytesOf('v 1e6 0 0\nv 1000001 0 0\nv 1000000 0.125 0\n'));
    expect(mesh.origin).toEqual([1000000.5, 0.0625, 0]);
    expect(placeOf(mesh, 2)).toEqual([1000000, 0.125, 0]);
  });

  it('is not there for what is near, whose positions are the floats of the file', () => {
    for (const [name, bytes] of madeFiles()) {
      const mesh = name.startsWith('far') ? undefined : attempt(() => readNamed(name, bytes));
      if (mesh && 'origin' in mesh) expect(name).toBe('without an origin');
    }
    expect([...readObj(bytesOf('v 0.1 0.2 0.3\n')).positions]).toEqual([0.1, 0.2, 0.3].map(Math.fround));
  });

  it('becomes the translation of a node', () => {
    const mesh = readObj(bytesOf(obj(moved(box, [5e5, 4e6, 100]))));
    const [node] = meshDocument(mesh, 'far').getRoot().listNodes();
    expect(node?.getTranslation()).toEqual(mesh.origin);
    expect(node?.getMesh()?.listPrimitives()[0]?.getAttribute('POSITION')?.getArray()).toEqual(mesh.positions);
    const { positions, origin = [0, 0, 0] } = readMesh(meshDocument(mesh)).mesh;
    expect(Math.abs((positions[1] as number) + origin[1] - 4e6)).toBeLessThan(1);
    for (const origin of [[Number.NaN, 0, 0], [0, 0, 1e39], [0, 0] as unknown as number[]])
      expect(() => meshDocument({ ...mesh, origin: origin as [number, number, number] })).toThrow(
        expect.objectContaining({ code: 'invalid-shape' }),
      );
  });
});

describe('the format of a file', () => {
  it('is told by its content, whatever its name', () => {
    for (const [name, bytes] of madeFiles()) {
      const format = name.slice(name.lastIndexOf('.') + 1).toUpperCase();
      expect([name, fileFormat(bytes, name)]).toEqual([name, format]);
      const found = attempt(() => readNamed(name, bytes));
      // An OBJ that begins with no word of OBJ, an OFF without its name, an STL that is longer than it says: by their names.
      if ('positions' in found && !/^(unknown|no-keyword|left-over\.stl)/.test(name)) {
        for (const wrong of ['model', 'a.glb', 'a.obj', 'a.ply', 'a.stl', 'a.off', 'a.txt'])
          expect([name, wrong, fileFormat(bytes, wrong)]).toEqual([name, wrong, format]);
      }
    }
  });

  it('is told by its name where the content says nothing', () => {
    for (const [name, format] of [
      ['a.obj', 'OBJ'],
      ['A.PLY', 'PLY'],
      ['a.stl', 'STL'],
      ['a.off', 'OFF'],
      ['a.glb', 'GLB'],
      ['a', 'GLB'],
    ] as const)
      expect(fileFormat(bytesOf('hello'), name)).toBe(format);
    expect(fileFormat(bytesOf('glTF\x02\0\0\0'), 'a.obj')).toBe('GLB');
    expect(fileFormat(bytesOf(stl(box)), 'a.obj')).toBe('STL');
    expect(fileFormat(bytesOf(ply(box)), 'a.glb')).toBe('PLY');
    expect(fileFormat(new Uint8Array(200), 'a.glb')).toBe('GLB');
    expect(fileFormat(bytesOf('solid state physics\n'), 'a.obj')).toBe('OBJ');
    expect(fileFormat(bytesOf(`${'\n'.repeat(4000)}`), 'a.obj')).toBe('OBJ');
  });
});
