import { describe, expect, it } from 'vitest';
import { BuildProgress, buildJobs, JOB_BYTES } from '../../scripts/lib/cmake.mjs';
import { isLeftOver } from '../../scripts/lib/sources.mjs';

describe('buildJobs', () => {
  it('is one a core where there is memory', () => expect(buildJobs({ cores: 8, memory: 64e9 })).toBe(8));
  it('is as many as memory holds', () => expect(buildJobs({ cores: 80, memory: 4 * JOB_BYTES })).toBe(4));
  it('is never none', () => expect(buildJobs({ cores: 2, memory: 1e8 })).toBe(1));
  it('asks this machine by itself', () => expect(buildJobs()).toBeGreaterThanOrEqual(1));
});

describe('BuildProgress', () => {
  const told = (...pieces: string[]) => {
    const lines: string[] = [];
    const progress = new BuildProgress((line) => lines.push(line));
    for (const piece of pieces) progress.add(piece);
    progress.end();
    return lines;
  };
  const steps = (count: number) =>
    Array.from({ length: count }, (_, i) => `[${i + 1}/${count}] Building CXX object x.o\n`).join('');

  it('tells every tenth of ninja’s steps', () => {
    const lines = told('[0/2] Re-checking globbed directories...\n', steps(150));
    expect(lines).toHaveLength(10);
    expect(lines[0]).toBe('   10 % (15 of 150)');
    expect(lines[9]).toBe('  100 % (150 of 150)');
  });

  it('tells every tenth of make’s steps, and neither folders nor scans', () => {
    const output =
      "make[1]: Entering directory '/x'\nScanning dependencies of target a\n[  4%] Building a\n[ 12%] Building b\n[ 19%] Building c\n";
    expect(told(output)).toEqual(['   10 %']);
  });

  it('counts anew when ninja does', () => {
    expect(told(steps(2), steps(2))).toEqual(['   50 % (1 of 2)', '  100 % (2 of 2)', '   50 % (1 of 2)', '  100 % (2 of 2)']);
  });

  it('reads lines that come in pieces', () => {
    expect(told('[1/', '2] Building CXX', ' object x.o\n[2/2] Linking')).toEqual(['   50 % (1 of 2)', '  100 % (2 of 2)']);
  });

  it('passes on what a compiler says', () => {
    const error = ['FAILED: x.o', "x.cpp:1:1: error: expected ';'", '    1 | int x'];
    expect(told(`[1/2] Building CXX object x.o\n${error.join('\n')}\n`)).toEqual(['   50 % (1 of 2)', ...error]);
  });

  it('says nothing when there is nothing to do', () => expect(told('ninja: no work to do.\n')).toEqual([]));
});

describe('isLeftOver', () => {
  it.each(['wasm/core/a.cpp.orig', 'web/ui/a.ts.rej'])('finds %s', (file) => expect(isLeftOver(file)).toBe(true));
  it.each(['wasm/core/origin.cpp', 'web/ui/orig.ts'])('allows %s', (file) => expect(isLeftOver(file)).toBe(false));
});
