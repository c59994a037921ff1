import { describe, expect, it } from 'vitest';
import { rewriteModuleUrls, withoutDisposeSymbol } from '../../scripts/lib/dist.mjs';
import { nodeProblem } from '../../scripts/lib/install.mjs';
import { readDoctest } from '../../scripts/lib/native.mjs';
import { readVitest } from '../../scripts/lib/vitest.mjs';
import { findMachinePaths } from '../../scripts/lib/words.mjs';

describe('nodeProblem', () => {
  it.each(['20.19.0', '20.20.2', '22.0.0', '24.1.0'])('accepts Node %s', (version) => expect(nodeProblem(version)).toBeUndefined());
  it.each(['18.20.0', '20.9.0', '20.18.3'])('refuses Node %s in a sentence', (version) => {
    expect(nodeProblem(version)).toMatch(new RegExp(`needs Node 20\\.19 or newer, and this is Node ${version}`));
  });
});

describe('readDoctest', () => {
  const summary =
    '[doctest] test cases:  12 |  11 passed | 1 failed | 0 skipped\n[doctest] assertions: 900 | 899 passed | 1 failed |\n';
  it('counts test cases, not assertions', () => expect(readDoctest(summary, 1)).toEqual({ passed: 11, failed: 1 }));
  it('counts a crash as a failure', () => expect(readDoctest('', 128)).toEqual({ passed: 0, failed: 1 }));
  it('never calls a failing status a success', () =>
    expect(readDoctest('test cases: 3 | 3 passed | 0 failed', 139)).toEqual({ passed: 3, failed: 1 }));
});

describe('readVitest', () => {
  const file = (status: string, ...tests: string[]) => ({ status, assertionResults: tests.map((test) => ({ status: test })) });
  it('counts tests', () => {
    const testResults = [file('failed', 'passed', 'failed'), file('passed', 'passed')];
    expect(readVitest({ numPassedTests: 2, numFailedTests: 1, testResults }, 1)).toEqual({ passed: 2, failed: 1 });
  });
  it('counts a file that does not load', () => {
    expect(
      readVitest({ numPassedTests: 1, numFailedTests: 0, testResults: [file('failed'), file('passed', 'passed')] }, 1),
    ).toEqual({
      passed: 1,
      failed: 1,
    });
  });
  it('counts a run without a report', () => expect(readVitest(undefined, 1)).toEqual({ passed: 0, failed: 1 }));
});

describe('rewriteModuleUrls', () => {
  it('points workers at what tsc wrote', () => {
    expect(rewriteModuleUrls("new Worker(new URL('./bake-worker.ts', import.meta.url), { type: 'module' })")).toBe(
      "new Worker(new URL('./bake-worker.js', import.meta.url), { type: 'module' })",
    );
  });
  it('leaves other URLs alone', () => {
    const code = "new URL('../../../wasm/handlebody.wasm', import.meta.url); new URL('./x.ts', location.href)";
    expect(rewriteModuleUrls(code)).toBe(code);
  });
});

describe('findMachinePaths', () => {
  const slash = '/';
  it.each([`${slash}home/someone/x`, `see ${slash}Users/someone`, `a\n'${slash}root/x'`, String.raw`C:${'\\'}Users\me`])(
    'finds %s',
    (text) => expect(findMachinePaths(text)).toHaveLength(1),
  );
  it.each(['https://example.org/home/page', '../work/x', 'src/root/x', '/usr/share/nodejs'])('allows %s', (text) =>
    expect(findMachinePaths(text)).toEqual([]),
  );
});

describe('withoutDisposeSymbol', () => {
  const declarations =
    'export declare class A {\n    dispose(): void;\n    [Symbol.dispose](): void;\n}\nexport declare class B {\n}\n';
  it('takes the symbol out of the class, and adds it where a library knows it', () => {
    const rewritten = withoutDisposeSymbol(declarations);
    expect(rewritten).not.toContain('[Symbol.dispose]');
    expect(rewritten).toContain('export interface A extends Disposing {');
    expect(rewritten).not.toContain('interface B');
  });
  it('leaves others as they are', () =>
    expect(withoutDisposeSymbol('export declare const a: 1;\n')).toBe('export declare const a: 1;\n'));
});
