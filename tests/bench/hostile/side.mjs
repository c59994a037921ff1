// One kind of hostile input at one size, in a process of its own: `side.mjs KIND BYTES`. Prints time, memory and how it ended. Run it with --single-threaded: what V8 does beside it counts as well.
import { fileFormat } from '../../../dist/web/assets/file-format.js';
import * as assets from '../../../dist/web/assets/index.js';
import { parseHandles } from '../../../dist/web/cli/handles.js';
import { median } from '../support.mjs';
import { KINDS } from './kinds.mjs';

const ROUNDS = 5;

/** Milliseconds of the processor: what others do on the machine leaves no trace in them. */
function now() {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
}

/** @param {Uint8Array} bytes @param {typeof assets.readGlb} read */
async function readAll(bytes, read) {
  const document = await read(bytes, { resource: async () => new Uint8Array(1e5) });
  const ends = [];
  for (const look of [
    () => assets.readMesh(document, { morphs: 'present' }),
    () => assets.readBody(document),
    () => assets.readPoseSpaces(document),
  ])
    try {
      await look();
    } catch (error) {
      ends.push(nameOf(error));
    }
  return ends.join(', ') || 'read';
}

/** @type {Record<string, (bytes: Uint8Array) => unknown>} */
const READERS = {
  readObj: assets.readObj,
  readPly: assets.readPly,
  readOff: assets.readOff,
  readStl: assets.readStl,
  glb: (bytes) => readAll(bytes, assets.readGlb),
  gltf: (bytes) => readAll(bytes, assets.readGltf),
  handles: (bytes) => parseHandles(bytes, { vertexCount: 1 }),
  format: (bytes) => fileFormat(bytes, 'a'),
};

/** @param {unknown} error */
const nameOf = (error) =>
  error instanceof Error && 'code' in error && 'remedy' in error ? String(error.code) : `UNTYPED ${String(error).slice(0, 80)}`;

const [name, size] = process.argv.slice(2);
const kind = KINDS[name ?? ''];
const read = kind && READERS[kind.reader];
if (!kind || !read) throw new Error(`There is no kind "${name}".`);
const bytes = kind.make(Number(size));
const warm = kind.make(2000);
for (let i = 0; i < 20; i++)
  await Promise.resolve(warm)
    .then(read)
    .catch(() => {});
globalThis.gc?.();
const before = process.memoryUsage().rss;
const times = [];
let end = '';
for (let round = 0; round < ROUNDS; round++) {
  // The last round's waste is not this one's work.
  globalThis.gc?.();
  const start = now();
  try {
    const given = await read(bytes);
    end = typeof given === 'string' ? given : 'read';
  } catch (error) {
    end = nameOf(error);
  }
  times.push(now() - start);
  if (now() - start > 20000) break;
}
const peak = process.resourceUsage().maxRSS * 1024 - before;
console.log(JSON.stringify({ bytes: bytes.length, milliseconds: median(times), peak, end }));
