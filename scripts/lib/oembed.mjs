// oEmbed (https://oembed.com), as far as files can answer it: oembed/NAME.json for each figure, and the link by which pages of one figure say so.
// An answer is of use to other sites only, so it needs to know where the site is: package.json's "homepage". Without one there is no answer.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { at } from './paths.mjs';

/** Pixels of the frame, which tells the page around how high it is; both are what to begin with. */
const SIZE = { width: 720, height: 640 };

/** The site's address with a slash at the end, or nothing where none is supplied. @returns {string | undefined} */
export function homepage() {
  const { homepage: address } = JSON.parse(readFileSync(at('package.json'), 'utf8'));
  return address ? String(address).replace(/\/*$/, '/') : undefined;
}

/** What oEmbed 1.0 wants to know of a figure. @param {{ id: string, title: string }} figure @param {string} site */
function oembedOf({ id, title }, site) {
  const src = `${site}embed.html#${id}`;
  const { width, height } = SIZE;
  const words = title.replaceAll('&', '&amp;').replaceAll('"', '&quot;').replaceAll('<', '&lt;');
  return {
    version: '1.0',
    type: 'rich',
    title,
    provider_name: 'Handlebody',
    provider_url: site,
    width,
    height,
    html: `<iframe src="${src}" title="${words}" width="${width}" height="${height}" style="border: 0" loading="lazy"></iframe>`,
  };
}

/** @param {string} folder of the site @param {readonly { id: string, title: string }[]} figures @param {string} site its address */
export function writeOembed(folder, figures, site) {
  mkdirSync(path.join(folder, 'oembed'), { recursive: true });
  for (const figure of figures)
    writeFileSync(path.join(folder, 'oembed', `${figure.id}.json`), `${JSON.stringify(oembedOf(figure, site), null, 2)}\n`);
}

/** Says in the head of a page of one figure where its answer is. @param {string} html @param {string} site */
export function withDiscovery(html, site) {
  const id = /<body data-only="([\w-]+)"/.exec(html)?.[1];
  const link = `<link rel="alternate" type="application/json+oembed" href="${site}oembed/${id}.json">`;
  return id ? html.replace(/\n(\s*)<\/head>/, `\n$1  ${link}\n$1</head>`) : html;
}
