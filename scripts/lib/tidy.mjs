// clang-tidy over the solver, several sources at a time.
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { sideBySide } from './cmake.mjs';
import { at } from './paths.mjs';
import { run } from './run.mjs';

/**
 * Of the ten seconds that a source takes alone, nine go into Eigen and the standard library, which are parsed and searched by every check.
 * Eight sources after one another in one file take twenty (all 118: 320 s of one core instead of 1250); more would take more memory than a
 * compiler does.
 */
const TOGETHER = 8;

/** @typedef {{ file: string, code: string }} Source */

const words = (/** @type {string} */ code) => code.match(/[A-Za-z_]\w*/g) ?? [];
const withoutComments = (/** @type {string} */ code) => code.replace(/\/\*[\s\S]*?\*\/|\/\/.*/g, '');

/** What a source names for itself alone, between `namespace {` and `}  // namespace`. @param {string} code */
export function ownNames(code) {
  /** @type {Set<string>} */
  const names = new Set();
  for (const [, body = ''] of code.matchAll(/^namespace \{$([\s\S]*?)^\} *\/\/ namespace$/gm)) {
    for (const line of withoutComments(body)
      .split('\n')
      .filter((each) => /^[A-Za-z_[]/.test(each))) {
      const name =
        line.match(/^(?:template *<.*> *)?(?:struct|class|enum(?: class)?|union|using) (\w+)/)?.[1] ??
        words(line.match(/^[^({=;]*/)?.[0] ?? '').at(-1);
      if (name) names.add(name);
    }
  }
  return names;
}

/** What a file includes of ours, and what that includes. @param {string} code @param {(name: string) => string} read @param {Set<string>} [found] */
function headersOf(code, read, found = new Set()) {
  for (const [, name = ''] of code.matchAll(/^#include "(.+)"/gm)) {
    if (found.has(name)) continue;
    found.add(name);
    headersOf(read(name), read, found);
  }
  return found;
}

/**
 * Sources that may stand in one file: no name that one has for itself occurs in another, or in a header that only the other includes.
 * @param {readonly Source[]} sources @param {(name: string) => string} read a header, by the name by which it is included
 * @returns {Source[][]}
 */
export function together(sources, read) {
  const wordsOf = (/** @type {string} */ code) => new Set(words(withoutComments(code)));
  /** @type {Map<string, Set<string>>} */
  const inHeader = new Map();
  const all = sources.map((source) => {
    const headers = headersOf(source.code, read);
    for (const name of headers) if (!inHeader.has(name)) inHeader.set(name, wordsOf(read(name)));
    return { source, headers, own: ownNames(source.code), used: wordsOf(source.code) };
  });
  /** @typedef {typeof all[number]} Read */
  const hides = (/** @type {Read} */ a, /** @type {Read} */ b) =>
    [...a.own].some(
      (name) => b.used.has(name) || [...b.headers].some((header) => !a.headers.has(header) && inHeader.get(header)?.has(name)),
    );
  const size = (/** @type {Read[]} */ group) => group.reduce((sum, { source }) => sum + source.code.length, 0);

  /** @type {Read[][]} */
  const groups = Array.from({ length: Math.ceil(sources.length / TOGETHER) }, () => []);
  // The largest first, each to the smallest group that it suits: all take about as long, and as much memory.
  for (const one of all.sort((a, b) => b.source.code.length - a.source.code.length)) {
    const suited = groups.filter((group) => group.every((other) => !hides(one, other) && !hides(other, one)));
    const [group] = suited.sort((a, b) => size(a) - size(b));
    if (group) group.push(one);
    else groups.push([one]);
  }
  return groups.filter((group) => group.length > 0).map((group) => group.map(({ source }) => source));
}

/**
 * Checks sources and shows what was found. A group that is not clean says nothing yet: its names may only be in each other's way. Each of
 * its sources is then looked at alone, and what is found there counts.
 * @param {string} build a folder with compile_commands.json @param {readonly string[]} files
 * @returns {Promise<number>} how many sources are not clean
 */
export async function tidy(build, files) {
  /** @type {{ directory: string, file: string, command: string }[]} */
  const commands = JSON.parse(readFileSync(path.join(build, 'compile_commands.json'), 'utf8'));
  const commandOf = new Map(commands.map((entry) => [path.relative(at(), entry.file).replaceAll('\\', '/'), entry]));
  const folder = path.join(build, 'together');
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });

  // Only what is compiled alike stands together.
  /** @type {Map<string, Source[]>} */
  const alike = new Map();
  /** @type {string[]} */
  const alone = [];
  for (const file of files) {
    const command = commandOf.get(file)?.command.replace(/ -o \S+ -c \S+/, '');
    if (command === undefined) alone.push(file);
    else alike.set(command, [...(alike.get(command) ?? []), { file, code: readFileSync(at(file), 'utf8') }]);
  }
  const read = (/** @type {string} */ name) => (existsSync(at('wasm', name)) ? readFileSync(at('wasm', name), 'utf8') : '');
  const groups = [...alike].flatMap(([command, sources]) => together(sources, read).map((group) => ({ command, group })));
  const entries = groups.map(({ command, group }, k) => {
    const file = path.join(folder, `${k}.cpp`);
    writeFileSync(file, group.map(({ code }) => `${code}\n`).join(''));
    return { directory: build, file, command: `${command} -c ${file}` };
  });
  writeFileSync(path.join(folder, 'compile_commands.json'), JSON.stringify(entries));

  await sideBySide([...groups.keys()], async (k) => {
    const { status } = await clangTidy(folder, path.join(folder, `${k}.cpp`));
    if (status !== 0) alone.push(...(groups[k]?.group ?? []).map(({ file }) => file));
  });
  let failures = 0;
  await sideBySide(alone, async (file) => {
    const { status, output } = await clangTidy(build, at(file));
    if (status === 0) return;
    failures += 1;
    console.error(`${file}\n${output.trim()}`);
  });
  console.log(`clang-tidy: ${files.length} sources in ${groups.length} groups, ${alone.length} of them looked at alone`);
  return failures;
}

/** @param {string} build @param {string} file */
async function clangTidy(build, file) {
  let output = '';
  const status = await run('clang-tidy', ['--quiet', '-p', build, file], {
    behind: true,
    stdio: ['ignore', 'pipe', 'ignore'],
    onOutput: (text) => {
      output += text;
    },
  });
  return { status, output };
}
