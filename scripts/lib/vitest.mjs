// Running Vitest and counting what it did.
import { existsSync, mkdirSync, readFileSync, rmSync } from 'node:fs';
import { at } from './paths.mjs';
import { run } from './run.mjs';

/** Runs one project of vitest.config.ts. @param {'ts' | 'web'} project @param {string[]} [args] @returns {Promise<import('./native.mjs').Counts>} */
export async function runVitest(project, args = []) {
  const report = at('build', `vitest-${project}.json`);
  mkdirSync(at('build'), { recursive: true });
  rmSync(report, { force: true });
  const options = [
    'run',
    '--project',
    project,
    '--passWithNoTests',
    '--reporter=default',
    '--reporter=json',
    `--outputFile.json=${report}`,
  ];
  const status = await run(process.execPath, [at('node_modules', 'vitest', 'vitest.mjs'), ...options, ...args]);
  return readVitest(existsSync(report) ? JSON.parse(readFileSync(report, 'utf8')) : undefined, status);
}

/**
 * The numbers of a JSON report. A file that failed before any of its tests, and a run that failed with no test to blame, count too.
 * @param {{ numPassedTests: number, numFailedTests: number, testResults?: { status: string, assertionResults: { status: string }[] }[] } | undefined} report
 * @param {number} status
 * @returns {import('./native.mjs').Counts}
 */
export function readVitest(report, status) {
  const passed = report?.numPassedTests ?? 0;
  const files = report?.testResults ?? [];
  const broken = files.filter(
    (file) => file.status === 'failed' && file.assertionResults.every((test) => test.status !== 'failed'),
  );
  const failed = (report?.numFailedTests ?? 0) + broken.length;
  return { passed, failed: failed === 0 && status !== 0 ? 1 : failed };
}
