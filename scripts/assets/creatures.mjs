/**
 * Makes the animals of `web/models/creatures.ts` as meshes, and says what they are. Wants the library in dist/ (`npm run build -- library`).
 *
 *     node scripts/assets/creatures.mjs --list
 *     node scripts/assets/creatures.mjs NAME [--vertices 8000] [-o FILE.ply | FILE.json]
 *
 * JSON is `{ positions, triangles, tips }`, for tests and benchmarks; `tips` are the vertices nearest to where limbs end.
 */
import { writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { meshSolid } from '../lib/level-set-mesh.mjs';
import { facts, nearestVertex } from '../lib/mesh-facts.mjs';
import { runMain } from '../lib/run.mjs';

/** @param {{ positions: Float32Array, triangles: Uint32Array }} mesh @returns {Uint8Array} binary, little-endian */
function toPly({ positions, triangles }) {
  const header = [
    'ply',
    'format binary_little_endian 1.0',
    `element vertex ${positions.length / 3}`,
    ...['x', 'y', 'z'].map((axis) => `property float ${axis}`),
    `element face ${triangles.length / 3}`,
    'property list uchar int vertex_indices',
    'end_header\n',
  ].join('\n');
  const bytes = Buffer.alloc(header.length + 4 * positions.length + (13 * triangles.length) / 3);
  let at = bytes.write(header, 'latin1');
  for (const value of positions) at = bytes.writeFloatLE(value, at);
  triangles.forEach((vertex, i) => {
    if (i % 3 === 0) at = bytes.writeUInt8(3, at);
    at = bytes.writeInt32LE(vertex, at);
  });
  return bytes;
}

await runMain(async () => {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { list: { type: 'boolean' }, vertices: { type: 'string', default: '8000' }, output: { type: 'string', short: 'o' } },
  });
  const { CREATURES, creature } = await import('../../dist/web/models/creatures.js');
  if (values.list) {
    console.log(CREATURES.join('\n'));
    return 0;
  }
  const name = CREATURES.find((each) => each === positionals[0]);
  if (!name) throw new Error(`Which animal? One of: ${CREATURES.join(', ')}.`);
  const vertices = Number(values.vertices);
  if (!(vertices >= 500 && vertices <= 100_000))
    throw new Error(`${values.vertices} vertices were asked for; ask for 500 to 100000.`);
  const solid = creature(name);
  const mesh = await meshSolid(solid, { vertices });
  const { genus, smallestAngle, volume } = facts(mesh);
  const tips = Object.fromEntries([...solid.tips].map(([tip, place]) => [tip, nearestVertex(mesh, place)]));
  console.log(
    `${name}: ${mesh.positions.length / 3} vertices, genus ${genus}, smallest angle ${smallestAngle.toFixed(1)}°, volume ${volume.toFixed(4)}`,
  );
  for (const [tip, vertex] of Object.entries(tips)) console.log(`  ${tip}: ${vertex}`);
  const { output } = values;
  if (!output) return 0;
  if (output.endsWith('.ply')) writeFileSync(output, toPly(mesh));
  else if (output.endsWith('.json'))
    writeFileSync(output, JSON.stringify({ positions: [...mesh.positions], triangles: [...mesh.triangles], tips }));
  else throw new Error(`What is ${output}? Files end in .ply or .json.`);
  return 0;
});
