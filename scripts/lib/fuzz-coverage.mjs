// Which lines the inputs of a target reach, of the files behind it: those that its first comment lists.
import { readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { replay } from './fuzz.mjs';
import { rounded } from './fuzz-results.mjs';
import { at } from './paths.mjs';
import { capture } from './run.mjs';

/** The least part of the lines behind a target that its inputs have to reach. */
const LEAST = 0.8;

/** @typedef {{ filename: string, summary: { lines: { count: number, covered: number } } }} FileLines */

/**
 * Prints how much of each file behind the target its inputs reach, and whether that is enough.
 * @param {string} folder of the programs @param {import('./fuzz.mjs').FuzzTarget} target
 * @returns {Promise<{ enough: boolean, figures?: { linesPercent: number, inputs: number, slowestSeconds: number } }>}
 */
export async function coverTarget(folder, target) {
  const program = path.join(folder, target.program);
  const raw = at('build', `${target.name}.profraw`);
  const merged = at('build', `${target.name}.profdata`);
  process.env.LLVM_PROFILE_FILE = raw;
  const inputs = readdirSync(target.corpus, { withFileTypes: true }).length > 0 ? target.corpus : target.unpack();
  const { failed, files, slowest, executions, reached } = await replay(target, inputs, (list) => [program, [list]]);
  if (failed) return { enough: false };
  const profile = capture('llvm-profdata-14', ['merge', '-o', merged, raw]);
  const exported = capture('llvm-cov-14', ['export', '-summary-only', '-instr-profile', merged, program]);
  if (profile.status !== 0 || exported.status !== 0) throw new Error(`llvm-cov: ${profile.stderr}${exported.stderr}`);
  const source = readFileSync(at('tests', 'fuzz', `${target.program}.cpp`), 'utf8');
  const behind = [...source.matchAll(/^\/\/ behind: (.+)$/gm)].flatMap(([, list]) => /** @type {string} */ (list).split(' '));
  /** @type {FileLines[]} */
  const measured = JSON.parse(exported.stdout).data[0].files;
  let count = 0;
  let covered = 0;
  for (const name of behind) {
    const file = measured.find(({ filename }) => filename.endsWith(`/wasm/${name}`));
    if (!file) throw new Error(`${target.name}: there is no wasm/${name}.`);
    const { lines } = file.summary;
    count += lines.count;
    covered += lines.covered;
    if (lines.covered < LEAST * lines.count) console.log(`  ${name}: ${lines.covered} of ${lines.count} lines`);
  }
  const part = covered / count;
  console.log(
    `${target.name}: ${covered} of ${count} lines (${(100 * part).toFixed(1)} %) of ${behind.length} files; ${files} inputs, ${reached} of ${executions} reach the algorithm, the slowest takes ${slowest} s`,
  );
  return { enough: part >= LEAST, figures: { linesPercent: rounded(100 * part), inputs: files, slowestSeconds: slowest } };
}
