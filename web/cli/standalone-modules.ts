/** The modules of dist/handlebody.standalone.js that a page of one figure or one model needs, as the build has split and listed them. */
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { FIGURES } from '../figures/list.ts';

/** The entry's name in the page. */
export const ENTRY = 'handlebody/handlebody.standalone.js';

/** Under which name pages import it, and its code, which imports others by such names. */
export interface Module {
  readonly name: string;
  readonly code: string;
}

/** What Vite's manifest says of a file. */
interface Chunk {
  readonly file: string;
  /** Of the source that it is made of, or the last of several. */
  readonly name?: string;
  readonly isEntry?: boolean;
  readonly imports?: readonly string[];
  readonly dynamicImports?: readonly string[];
}

type Wanted = { readonly kind: 'handle-figure'; readonly id: string } | { readonly kind: string; readonly baked: boolean };

const SHOWS: Readonly<Record<string, string>> = {
  'handle-figure': 'figure-showing',
  'handle-body': 'body-showing',
  'pose-space': 'pose-showing',
};

/** In the order of their names. Throws 'internal' where the package is not whole. */
export function modulesOf(wanted: Wanted): Module[] {
  const folder = path.join(fileURLToPath(new URL('.', import.meta.url)), '..', '..');
  try {
    const manifest: Record<string, Chunk> = JSON.parse(readFileSync(path.join(folder, 'standalone', 'manifest.json'), 'utf8'));
    const files = filesOf(manifest, wanted);
    const names = new Set([...files].map((file) => path.posix.basename(file)));
    return [...files].sort().map((file) => ({
      name: `handlebody/${path.posix.basename(file)}`,
      code: renamed(readFileSync(path.join(folder, file), 'utf8'), names),
    }));
  } catch (cause) {
    throw new HandlebodyError('internal', {
      message: `The package is not whole: ${cause instanceof Error ? cause.message : String(cause)}.`,
      remedy: 'Install it again; in a clone, run "npm run build".',
      cause,
    });
  }
}

/** All that the entry asks for, but for what shows something else. */
function filesOf(manifest: Readonly<Record<string, Chunk>>, wanted: Wanted): ReadonlySet<string> {
  const files = new Set<string>();
  const visit = (key: string): void => {
    const chunk = manifest[key];
    if (!chunk || files.has(chunk.file)) return;
    files.add(chunk.file);
    for (const next of chunk.imports ?? []) visit(next);
    for (const next of chunk.dynamicImports ?? []) if (!isElse(manifest[next]?.name, wanted)) visit(next);
  };
  for (const [key, { isEntry, file }] of Object.entries(manifest)) if (isEntry && ENTRY.endsWith(`/${file}`)) visit(key);
  if (files.size === 0) throw new Error(`${ENTRY} is not in its manifest`);
  return files;
}

/** Whether a page would never ask for what it could: another element's program, another figure, the baking of what is baked. */
function isElse(name: string | undefined, wanted: Wanted): boolean {
  if (name === undefined) return false;
  if (Object.values(SHOWS).includes(name)) return name !== SHOWS[wanted.kind];
  if ('baked' in wanted) return wanted.baked && name === 'bake-in-worker';
  return FIGURES.some(({ id }) => id === name && id !== wanted.id);
}

/** Addresses beside the file, which have no meaning within an address, become names. */
function renamed(code: string, names: ReadonlySet<string>): string {
  return code.replace(/(["'`])\.\.?\/(?:standalone\/)?([\w.-]+\.js)\1/g, (found, quote, name) =>
    names.has(name) ? `${quote}handlebody/${name}${quote}` : found,
  );
}
