/** One page with everything inside: its scripts in an import map of addresses that hold them, its model in the address of one. */
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { escapeHtml } from './escape-html.ts';
import { packageFolder, packageVersion } from './package.ts';
import { ENTRY, type Module, modulesOf } from './standalone-modules.ts';

export type Content = { readonly title: string } & (
  | { readonly kind: 'handle-figure'; readonly id: string; readonly state: string }
  | { readonly kind: 'handle-body' | 'pose-space'; readonly glb: Uint8Array; readonly baked: boolean }
);

/** The page, and how many modules it holds. Throws 'internal' where the package is not whole. */
export function embedPage(content: Content): { readonly bytes: Uint8Array; readonly modules: number } {
  const modules = modulesOf(content);
  const map = { imports: Object.fromEntries(modules.map(({ name, code }) => [name, addressOf(code)])) };
  const html = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>${escapeHtml(content.title)}</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="Handlebody ${packageVersion()}">
<link rel="icon" href="data:,">
<style>
body { margin: 0; font: 400 0.9375rem / 1.5 system-ui, sans-serif; }
main:has(handle-figure) { max-width: 75rem; margin: 0 auto; padding: 16px; }
handle-body, pose-space { display: block; height: 100vh; height: 100dvh; aspect-ratio: auto; }
noscript p { padding: 16px; }
h1 { position: absolute; width: 1px; height: 1px; margin: 0; overflow: hidden; clip-path: inset(50%); }
</style>
<script type="importmap">${JSON.stringify(map)}</script>
</head>
<body>
<noscript><p>What this page shows is a program: allow JavaScript for it.</p></noscript>
<main>
<h1>${escapeHtml(content.title)}</h1>
${tagOf(content)}
</main>
<script type="module">import '${ENTRY}';</script>
<script type="text/plain" id="licenses">${notices(modules)}</script>
</body>
</html>
`;
  return { bytes: new TextEncoder().encode(html), modules: modules.length };
}

function tagOf(content: Content): string {
  if (content.kind === 'handle-figure') {
    const state = content.state && ` state="${escapeHtml(content.state)}"`;
    return `<handle-figure name="${content.id}"${state} controls caption loading="eager"></handle-figure>`;
  }
  const { kind, glb, title } = content;
  const src = `data:model/gltf-binary;base64,${Buffer.from(glb.buffer, glb.byteOffset, glb.byteLength).toString('base64')}`;
  return `<${kind} alt="${escapeHtml(title)}" controls loading="eager" src="${src}"></${kind}>`;
}

/** The address of a script that is that script. What HTML, JSON or addresses take for their own is written by its code, "</script" too. */
function addressOf(code: string): string {
  const plain = /[^\w!$&'()*+,./:;=?@[\]^`{|}~-]+/gu;
  return `data:text/javascript;charset=utf-8,${code.replace(plain, encodeURIComponent)}`;
}

/** Whoever passes the page on passes on what is in it, under these licenses. */
function notices(modules: readonly Module[]): string {
  const texts = ['LICENSE', 'THIRD_PARTY_NOTICES.md'].map((name) => readFileSync(path.join(packageFolder(), name), 'utf8').trim());
  const text = [`What is in this page, in ${modules.length} modules, is Handlebody and what it is made of.`, ...texts].join('\n\n');
  return text.replace(/<(?=\/script|!--)/gi, '‹');
}
