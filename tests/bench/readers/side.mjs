/** Reads one kind of file in three sizes, by our reader and by three.js's in turns; prints medians of five rounds in milliseconds. */
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
import { PLYLoader } from 'three/addons/loaders/PLYLoader.js';
import { STLLoader } from 'three/addons/loaders/STLLoader.js';
import { readObj, readOff, readPly, readStl } from '../../../dist/web/assets/index.js';
import { median } from '../support.mjs';
import { fileOf } from './files.mjs';
import { ROUNDS, SIZES } from './sizes.mjs';

const kind = process.argv[2] ?? '';
const format = /** @type {'OBJ' | 'PLY' | 'STL' | 'OFF'} */ (kind.slice(0, 3));
const ours = { OBJ: readObj, PLY: readPly, STL: readStl, OFF: readOff }[format];
/** three.js has no loader of OFF. */
const theirs = {
  OBJ: (/** @type {Uint8Array} */ bytes) => new OBJLoader().parse(new TextDecoder().decode(bytes)),
  PLY: (/** @type {Uint8Array<ArrayBuffer>} */ bytes) => new PLYLoader().parse(bytes.buffer),
  STL: (/** @type {Uint8Array<ArrayBuffer>} */ bytes) => new STLLoader().parse(bytes.buffer),
  OFF: undefined,
}[format];

const files = SIZES.map((size) => fileOf(kind, size));

/** Small files are read so often that as many bytes are read in all, and collections of garbage weigh as much. @param {(bytes: Uint8Array<ArrayBuffer>) => unknown} read @param {Uint8Array<ArrayBuffer>} bytes */
function time(read, bytes) {
  const times = Math.round((SIZES.at(-1) ?? 0) / bytes.length);
  const start = performance.now();
  for (let i = 0; i < times; i++) read(bytes);
  return (performance.now() - start) / times;
}

/** @type {Record<string, number>} */
const found = {};
const sides = { ours, ...(theirs && { theirs }) };
for (const read of Object.values(sides)) for (const bytes of files.slice(0, 2)) time(read, bytes);
const taken = Array.from({ length: ROUNDS }, () => files.map((bytes) => Object.values(sides).map((read) => time(read, bytes))));
files.forEach((bytes, i) => {
  found[`bytes ${SIZES[i]}`] = bytes.length;
  Object.keys(sides).forEach((side, k) => {
    found[`${side} ${SIZES[i]}`] = median(taken.map((round) => round[i]?.[k] ?? Number.NaN));
  });
});
console.log(JSON.stringify(found));
