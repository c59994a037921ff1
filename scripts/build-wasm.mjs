// `npm run build:wasm`: compiles the solver to wasm/handlebody.wasm and its smaller link wasm/handlebody.runtime.wasm, and notes what they
// were made of and with in wasm/toolchain.json.
// With --check it compiles into a folder of its own and fails unless the bytes are those that are committed.
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { aptInstall, packageVersion } from './lib/apt.mjs';
import { cmakeBuild } from './lib/cmake.mjs';
import { emscriptenEnvironment } from './lib/emscripten.mjs';
import { ensureInstalled } from './lib/install.mjs';
import { at, root } from './lib/paths.mjs';
import { mustRun, runMain, which } from './lib/run.mjs';
import { EIGEN, ensureEigen } from './toolchain.mjs';

/** Everything whose version decides the bytes. */
const PACKAGES = ['emscripten', 'clang-14', 'lld-14', 'llvm-14', 'binaryen'];
const LINKS = ['handlebody.wasm', 'handlebody.runtime.wasm'];
const RECORD = at('wasm', 'toolchain.json');

/** @param {string | Buffer} data */
const sha256 = (data) => createHash('sha256').update(data).digest('hex');

/** One hash of all that is compiled: names and contents, in order. */
function hashSources() {
  const files = ['CMakeLists.txt', ...['abi', 'core'].flatMap((folder) => list(folder))]
    .filter((f) => /\.(cpp|hpp|h|txt)$/.test(f))
    .sort();
  const hash = createHash('sha256');
  for (const file of files) hash.update(`${file}\n${sha256(readFileSync(at('wasm', file)))}\n`);
  return hash.digest('hex');
}

/** @param {string} folder */
function list(folder) {
  const names = readdirSync(at('wasm', folder), { recursive: true, encoding: 'utf8' });
  return names.map((name) => `${folder}/${name.replaceAll('\\', '/')}`);
}

function toolVersions() {
  /** @type {Record<string, string>} */
  const versions = {};
  for (const name of PACKAGES) versions[name] = packageVersion(name) ?? 'not from Debian';
  versions.eigen = `${EIGEN.requirement} sha256:${EIGEN.sha256}`;
  return versions;
}

/** Compiles in a folder. @param {string} folder @returns {Promise<Map<string, Buffer>>} the wasm files by name */
async function compile(folder) {
  const env = emscriptenEnvironment();
  const configure = [
    'cmake',
    '-S',
    at('wasm'),
    '-B',
    folder,
    '-DCMAKE_BUILD_TYPE=Release',
    ...(which('ninja') ? ['-G', 'Ninja'] : []),
  ];
  await mustRun('emcmake', configure, { env, stdio: ['ignore', 'ignore', 'inherit'] });
  if ((await cmakeBuild(folder, { env })) !== 0) throw new Error('The solver does not compile to wasm.');
  const built = new Map(LINKS.map((name) => [name, readFileSync(path.join(folder, name))]));
  for (const [name, bytes] of built) {
    if (bytes.includes(root))
      throw new Error(`The wasm must come out equal in every folder. ${name} contains the path of this one.`);
  }
  return built;
}

async function ensureTools() {
  if (!which('emcc') || !which('cmake')) await aptInstall(['emscripten', 'node-acorn', 'cmake', 'ninja-build']);
  if (!which('emcc') || !which('cmake'))
    throw new Error('Building the wasm needs Emscripten and CMake: on Debian, apt-get install emscripten node-acorn cmake.');
  const problem = ensureEigen();
  if (problem) throw new Error(`Building the wasm needs Eigen: ${problem}.`);
}

/** Compiles afresh and compares with what is committed. @returns {Promise<number>} */
async function check() {
  if (!existsSync(RECORD) || !LINKS.every((name) => existsSync(at('wasm', name))))
    throw new Error('There is no committed wasm to compare with: run npm run build:wasm.');
  const record = JSON.parse(readFileSync(RECORD, 'utf8'));
  mkdirSync(at('build'), { recursive: true });
  const folder = mkdtempSync(at('build', 'wasm-check-'));
  try {
    const built = await compile(folder);
    const differing = [];
    for (const [name, bytes] of built) {
      if (!bytes.equals(readFileSync(at('wasm', name)))) differing.push(`wasm/${name}`);
      else console.log(`wasm/${name} is what its sources give (${bytes.length} bytes, sha256 ${sha256(bytes).slice(0, 16)}…).`);
    }
    const stale = LINKS.filter((name) => record.wasm?.[name] !== sha256(readFileSync(at('wasm', name))));
    if (differing.length === 0 && stale.length === 0) return 0;
    for (const name of stale) console.error(`wasm/toolchain.json: its hash is not that of the committed ${name}.`);
    if (differing.length === 0) {
      console.error('wasm/toolchain.json: run npm run build:wasm and commit the result.');
      return 1;
    }
    const versions = toolVersions();
    const changed = Object.keys({ ...record.tools, ...versions }).filter((name) => record.tools[name] !== versions[name]);
    for (const name of changed) console.error(`${name}: committed with ${record.tools[name]}, here ${versions[name]}`);
    const files = differing.join(' and ');
    if (record.sources !== hashSources()) console.error(`${files}: source changed, run npm run build:wasm and commit the result.`);
    else if (changed.length)
      console.error(`${files}: toolchain changed, run npm run build:wasm with this one and commit the result.`);
    else console.error(`${files}: same sources, same toolchain, other bytes. It was edited, or the build is not reproducible.`);
    return 1;
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

await runMain(async () => {
  await ensureTools();
  if (process.argv.includes('--check')) return check();
  const built = await compile(at('build', 'wasm'));
  for (const [name, bytes] of built) writeFileSync(at('wasm', name), bytes);
  const wasm = Object.fromEntries([...built].map(([name, bytes]) => [name, sha256(bytes)]));
  const record = { tools: toolVersions(), sources: hashSources(), wasm };
  writeFileSync(RECORD, `${JSON.stringify(record, null, 2)}\n`);
  await ensureInstalled();
  await import('./generate.mjs');
  for (const [name, bytes] of built) console.log(`wasm/${name}: ${bytes.length} bytes.`);
  return 0;
});
