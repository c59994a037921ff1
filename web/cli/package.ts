/** The package that this file is part of. */
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

interface Found {
  readonly folder: string;
  readonly version: string;
}

function find(): Found | undefined {
  for (let folder = path.dirname(fileURLToPath(import.meta.url)); ; folder = path.dirname(folder)) {
    try {
      const { name, version } = JSON.parse(readFileSync(path.join(folder, 'package.json'), 'utf8'));
      if (name === 'handlebody') return { folder, version };
    } catch {}
    if (folder === path.dirname(folder)) return undefined;
  }
}

export function packageVersion(): string {
  return find()?.version ?? 'unknown';
}

/** Where its files lie. */
export function packageFolder(): string {
  const found = find();
  if (!found) throw new Error('its package.json is not there');
  return found.folder;
}
