// `npm run bench`: everything that is measured; `npm run bench -- interpolation` (or bake, checks, elements, figures, hostile, irbf, leakage, readers, skinning) runs that part only.
import { ensureInstalled } from '../../scripts/lib/install.mjs';
import { runMain } from '../../scripts/lib/run.mjs';

const PARTS = {
  bake: async () => (await import('./bake/main.mjs')).benchBake(),
  checks: async () => (await import('./checks/main.mjs')).benchChecks(),
  elements: async () => (await import('./elements/main.mjs')).benchElements(),
  figures: async () => (await import('./figures/main.mjs')).benchFigures(),
  hostile: async () => (await import('./hostile/main.mjs')).benchHostile(),
  interpolation: async () => (await import('./interpolation/main.mjs')).benchInterpolation(),
  irbf: async () => (await import('./irbf/main.mjs')).benchIrbf(),
  leakage: async () => (await import('./leakage/main.mjs')).benchLeakage(),
  readers: async () => (await import('./readers/main.mjs')).benchReaders(),
  skinning: async () => (await import('./skinning/main.mjs')).benchSkinning(),
};

await runMain(async () => {
  const named = process.argv.slice(2);
  const unknown = named.find((name) => !Object.hasOwn(PARTS, name));
  if (unknown) throw new Error(`There is no benchmark called "${unknown}": use ${Object.keys(PARTS).join(', ')}, or none for all.`);
  await ensureInstalled();
  for (const [name, run] of Object.entries(PARTS)) if (named.length === 0 || named.includes(name)) await run();
});
