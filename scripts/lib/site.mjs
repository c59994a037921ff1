// The built site (build/site): the studio, the lessons, and the elements for pages of others.
import { existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { homepage, withDiscovery, writeOembed } from './oembed.mjs';
import { at } from './paths.mjs';
import { buildStandalone } from './standalone.mjs';

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
  await buildStandalone('build/site', { embed: true });
  const site = homepage();
  if (site) await addOembed(at('build', 'site'), site);
}

/** @param {string} folder @param {string} site its address */
async function addOembed(folder, site) {
  const { runnerImport } = await import('vite');
  const { module } = await runnerImport(at('web', 'figures', 'list.ts'), { configFile: false, logLevel: 'warn' });
  writeOembed(folder, /** @type {{ FIGURES: { id: string, title: string }[] }} */ (module).FIGURES, site);
  const pages = readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter((name) => name.endsWith('index.html'));
  for (const page of pages.map((name) => path.join(folder, name)))
    writeFileSync(page, withDiscovery(readFileSync(page, 'utf8'), site));
}
