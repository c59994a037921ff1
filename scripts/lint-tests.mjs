// A test beside every file of the core: wasm/core/…/x.hpp ↔ tests/core/x_test.cpp, both ways.
import { pathToFileURL } from 'node:url';
import { runMain } from './lib/run.mjs';
import { sourceFiles } from './lib/sources.mjs';

/** Headers without a test of their own, each with the reason. @type {Record<string, string>} */
const UNTESTED = {
  'wasm/core/irbf/bake_warning.hpp': 'a struct of data alone',
  'wasm/core/numerics/types.hpp': 'names of types alone',
};

/** Tests of more than one header, each with what they test. @type {Record<string, string>} */
const OF_MORE = {
  'tests/core/given_counts_test.cpp': 'every count that a caller gives to the C interface',
  'tests/core/irbf_solver_test.cpp': "IRBF from the bake to the frame, on the paper's bar",
  'tests/core/irbf_shapes_test.cpp': 'shapes of spheres from the targets to the frame',
};

/**
 * What is missing on either side, as one line each.
 * @param {string[]} files every source file of the project; paths with '/', from the project's folder
 * @param {{ untested?: Record<string, string>, ofMore?: Record<string, string> }} [exceptions]
 */
export function lintTests(files, { untested = UNTESTED, ofMore = OF_MORE } = {}) {
  const all = new Set(files);
  const headers = new Map();
  /** @type {string[]} */
  const violations = [];
  for (const header of files) {
    const name = /^wasm\/core\/(?:.+\/)?([^/]+)\.hpp$/.exec(header)?.[1];
    if (!name) continue;
    const test = `tests/core/${name}_test.cpp`;
    const other = headers.get(test);
    if (other) violations.push(`${header}: has the name of ${other}, and so the same test`);
    headers.set(test, header);
    if (header in untested) {
      if (all.has(test)) violations.push(`${header}: has a test, take it from the exceptions`);
    } else if (!all.has(test)) {
      violations.push(`${header}: has no test, write ${test}`);
    }
  }
  for (const test of files) {
    if (!/^tests\/core\/[^/]+_test\.cpp$/.test(test) || headers.has(test) || test in ofMore) continue;
    violations.push(`${test}: there is no such header; name it for what it tests, or without _test if it is a helper`);
  }
  for (const listed of Object.keys({ ...untested, ...ofMore })) {
    if (!all.has(listed)) violations.push(`${listed}: is gone, take it from the exceptions`);
  }
  return violations;
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  await runMain(async () => {
    const violations = lintTests(sourceFiles());
    for (const violation of violations) console.error(violation);
    console.log(`tests: ${violations.length} violations`);
    return violations.length === 0 ? 0 : 1;
  });
}
