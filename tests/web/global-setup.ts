// Serves the built site on a free port while the browser tests run, and builds it first when a source is newer.
import { existsSync, readdirSync, statSync } from 'node:fs';
import { createServer } from 'node:net';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { preview } from 'vite';
import type { TestProject } from 'vitest/node';
import { buildSite } from '../../scripts/lib/site.mjs';

declare module 'vitest' {
  interface ProvidedContext {
    /** Address of the built site, with a slash at the end. */
    site: string;
  }
}

const root = fileURLToPath(new URL('../..', import.meta.url));
const configFile = path.join(root, 'vite.config.ts');
const built = path.join(root, 'build/site/studio/index.html');

export default async function setup(project: TestProject): Promise<() => Promise<void>> {
  const sources = ['web', 'wasm/ts', 'public'].map((folder) => newest(path.join(root, folder)));
  if (!existsSync(built) || Math.max(...sources) > statSync(built).mtimeMs) await buildSite();
  const port = await freePort();
  const server = await preview({ configFile, logLevel: 'warn', preview: { port, strictPort: true, host: '127.0.0.1' } });
  project.provide('site', `http://127.0.0.1:${port}/`);
  return () => server.close();
}

function newest(folder: string): number {
  const files = readdirSync(folder, { recursive: true, encoding: 'utf8' }).map((name) => path.join(folder, name));
  return Math.max(
    0,
    ...files
      .map((file) => statSync(file))
      .filter((stat) => stat.isFile())
      .map((stat) => stat.mtimeMs),
  );
}

function freePort(): Promise<number> {
  return new Promise((resolve, reject) => {
    const server = createServer().on('error', reject);
    server.listen(0, '127.0.0.1', () => {
      const address = server.address();
      server.close(() => resolve(typeof address === 'object' && address ? address.port : 0));
    });
  });
}
