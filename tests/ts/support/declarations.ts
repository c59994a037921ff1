/** The package's declarations, as `npm run build` writes them into dist/, without the wait for the rest of it: nothing is checked, and nothing written. */
import path from 'node:path';
import ts from 'typescript';
import manifest from '../../../package.json' with { type: 'json' };
import { withoutDisposeSymbol } from '../../../scripts/lib/dist.mjs';

/** Types of the elements' tags, made from their manifest: nothing in them is called. */
const TAGS = /^\.\/element\/(react|vue|svelte)$/;

/** The entries of package.json's exports that have types, and where those lie. */
const entries: readonly (readonly [entry: string, types: string])[] = Object.entries(manifest.exports).flatMap(([entry, target]) =>
  typeof target === 'object' && !TAGS.test(entry) ? [[entry, path.resolve(target.types)] as const] : [],
);
const sourceOf = (types: string) => path.relative('dist', types).replace(/\.d\.ts$/, '.ts');

function written(): { readonly texts: ReadonlyMap<string, string>; readonly sources: ts.Program } {
  const { config } = ts.readConfigFile('tsconfig.build.json', ts.sys.readFile);
  const { options } = ts.parseJsonConfigFileContent(config, ts.sys, '.');
  const files = entries.map(([, types]) => sourceOf(types));
  const sources = ts.createProgram(files, { ...options, noCheck: true, emitDeclarationOnly: true, sourceMap: false });
  const texts = new Map<string, string>();
  sources.emit(undefined, (name, text) => texts.set(path.resolve(name), withoutDisposeSymbol(text)));
  return { texts, sources };
}

/** A program of the declarations alone: what dist/ may hold on disk, of another day, is not looked at. */
export function declarations(): { readonly entries: typeof entries; readonly program: ts.Program } {
  const { texts, sources } = written();
  const options: ts.CompilerOptions = { ...sources.getCompilerOptions(), noEmit: true };
  const host = ts.createCompilerHost(options);
  const { fileExists, readFile, getSourceFile } = host;
  const isBuilt = (file: string) => !path.relative('dist', file).startsWith('..');
  const folders = new Set([...texts.keys()].map((file) => path.dirname(file)));
  host.fileExists = (file) => (isBuilt(file) ? texts.has(path.resolve(file)) : fileExists(file));
  host.readFile = (file) => (isBuilt(file) ? texts.get(path.resolve(file)) : readFile(file));
  host.directoryExists = (folder) => (isBuilt(folder) ? folders.has(path.resolve(folder)) : ts.sys.directoryExists(folder));
  // What both have in common, as the library of the DOM, is read once.
  host.getSourceFile = (file, how, ...more) =>
    isBuilt(file)
      ? ts.createSourceFile(file, texts.get(path.resolve(file)) ?? '', how)
      : (sources.getSourceFile(file) ?? getSourceFile(file, how, ...more));
  const program = ts.createProgram({ rootNames: entries.map(([, types]) => types), options, host });
  return { entries, program };
}
