// The built site (build/site): the studio, the lessons, and the elements for pages of others.
import { existsSync, readdirSync } from 'node:fs';
import { at } from './paths.mjs';
import { buildStandalone } from './standalone.mjs';

/** What of the elements asks for what, in the built site. */
export const ELEMENTS_MANIFEST = '.vite/elements.json';

/** Whether there is any page to build. */
export function hasPages() {
  return (
    existsSync(at('web')) &&
    readdirSync(at('web'), { recursive: true, encoding: 'utf8' }).some((name) => /(^|[\\/])index\.html$/.test(name))
  );
}

/** Builds the site with Vite. */
export async function buildSite() {
  const { build } = await import('vite');
  await build({ configFile: at('vite.config.ts'), logLevel: 'warn' });
  await buildStandalone('build/site', { embed: true, manifest: ELEMENTS_MANIFEST });
}
