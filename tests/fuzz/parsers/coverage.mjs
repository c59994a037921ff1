/** Line coverage of the built package by V8's own counters. */
import { readFileSync } from 'node:fs';
import { Session } from 'node:inspector/promises';
import { fileURLToPath } from 'node:url';

export async function startCoverage() {
  const session = new Session();
  session.connect();
  await session.post('Profiler.enable');
  await session.post('Profiler.startPreciseCoverage', { callCount: true, detailed: true });
  return {
    /** In percent, over the files whose address fits. @param {RegExp} files */
    async stop(files) {
      const { result } = await session.post('Profiler.takePreciseCoverage');
      await session.post('Profiler.stopPreciseCoverage');
      session.disconnect();
      let [covered, all] = [0, 0];
      for (const { url, functions } of result) {
        if (!url.includes('/dist/') || !files.test(url)) continue;
        const source = readFileSync(fileURLToPath(url), 'utf8');
        const counts = new Int32Array(source.length).fill(1);
        const ranges = functions.flatMap((each) => each.ranges);
        // The larger first: what lies within another knows better.
        ranges.sort((a, b) => b.endOffset - b.startOffset - (a.endOffset - a.startOffset));
        for (const { startOffset, endOffset, count } of ranges) counts.fill(count, startOffset, endOffset);
        let offset = 0;
        for (const line of source.split('\n')) {
          const code = line.trim();
          if (code !== '' && !/^(\/\/|\/?\*|[{}()\];,]+$)/.test(code)) {
            all++;
            const first = offset + line.search(/\S/);
            if ((counts[first] ?? 0) > 0) covered++;
          }
          offset += line.length + 1;
        }
      }
      return (100 * covered) / Math.max(all, 1);
    },
  };
}
