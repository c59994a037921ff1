// What tsc leaves undone in dist/: it rewrites `.ts` in imports, but not in `new URL('./x.ts', import.meta.url)`, and its declarations ask
// the reader for a library that knows `Symbol.dispose`.
import { existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';

const URL_OF_MODULE = /(new URL\(\s*(['"])\.{1,2}\/[^'"]+?)\.ts(\2\s*,\s*import\.meta\.url)/g;

/** @param {string} code */
export const rewriteModuleUrls = (code) => code.replace(URL_OF_MODULE, '$1.js$3');

const DISPOSE_MEMBER = /^ +\[Symbol\.dispose\]\(\): void;\n/gm;

/** What a class has besides where the reader's library knows `Symbol.dispose`, so that `using` takes it; nothing elsewhere. */
const DISPOSING = `type Disposing = SymbolConstructor extends { readonly dispose: infer S extends symbol } ? { [K in S]: () => void } : {};
`;

/**
 * Declarations that compile under a library without `Symbol.dispose`, and let `using` work under one that has it. Rejected:
 * `/// <reference lib="esnext.disposable" />`, which promises the symbol to the reader's whole program, whose browsers may not have it.
 * @param {string} declarations
 */
export function withoutDisposeSymbol(declarations) {
  /** @type {string[]} */
  const classes = [];
  // A class declaration runs to the first brace at the line's start.
  const rewritten = declarations.replace(/^export declare (?:abstract )?class (\w+)[\s\S]*?^}$/gm, (text, name) => {
    const rest = text.replace(DISPOSE_MEMBER, '');
    if (rest !== text) classes.push(`export interface ${name} extends Disposing {\n}\n`);
    return rest;
  });
  if (classes.length === 0) return declarations;
  return `${rewritten.trimEnd()}\n${DISPOSING}${classes.join('')}export {};\n`;
}

/**
 * Rewrites the module URLs of all scripts under a folder, fails when one leads nowhere, and frees the declarations of
 * `Symbol.dispose`.
 * @param {string} folder
 */
export function finishDist(folder) {
  const files = readdirSync(folder, { recursive: true, encoding: 'utf8' });
  for (const name of files.filter((file) => file.endsWith('.d.ts'))) {
    const file = path.join(folder, name);
    const declarations = readFileSync(file, 'utf8');
    const rewritten = withoutDisposeSymbol(declarations);
    if (rewritten.includes('Symbol.dispose]')) throw new Error(`dist: ${name} names Symbol.dispose outside a class.`);
    if (rewritten !== declarations) writeFileSync(file, rewritten);
  }
  for (const name of files.filter((file) => file.endsWith('.js'))) {
    const file = path.join(folder, name);
    const code = readFileSync(file, 'utf8');
    const rewritten = rewriteModuleUrls(code);
    if (rewritten !== code) writeFileSync(file, rewritten);
    for (const [, target] of rewritten.matchAll(/new URL\(\s*['"](\.{1,2}\/[^'"]+)['"]\s*,\s*import\.meta\.url/g)) {
      const resolved = path.resolve(path.dirname(file), /** @type {string} */ (target));
      if (!existsSync(resolved)) throw new Error(`dist: ${name} asks for ${target}, which is not there.`);
    }
  }
}
