// Servers of what was built.
import { spawn } from 'node:child_process';
import { readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import path from 'node:path';

/** A server until it is closed; `url` ends with a slash. @typedef {{ url: string, close(): void }} Site */

/** Milliseconds until a server that does not answer is given up. */
const PATIENCE = 60_000;

/** @type {Record<string, string>} */
const TYPES = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.mjs': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.json': 'application/json',
  '.woff2': 'font/woff2',
};

/**
 * Serves files as they lie, of the first folder that has them, as any static host does.
 * @param {string[]} folders @param {Record<string, string>} [headers] @returns {Promise<Site>}
 */
export async function serve(folders, headers = {}) {
  const server = createServer((request, response) => {
    const asked = decodeURIComponent(new URL(request.url ?? '/', 'http://host').pathname);
    const file = folders
      .flatMap((folder) => candidates(folder, asked))
      .find((name) => statSync(name, { throwIfNoEntry: false })?.isFile());
    response.writeHead(file ? 200 : 404, {
      'content-type': TYPES[path.extname(file ?? '')] ?? 'application/octet-stream',
      ...headers,
    });
    response.end(file && readFileSync(file));
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(undefined)));
  const { port } = /** @type {import('node:net').AddressInfo} */ (server.address());
  return { url: `http://127.0.0.1:${port}/`, close: () => server.close() };
}

/** @param {string} folder @param {string} asked */
function candidates(folder, asked) {
  const file = path.join(folder, asked);
  if (!file.startsWith(folder)) return [];
  return [file, path.join(file, 'index.html'), `${file}.html`];
}

/**
 * Starts a tool's own server, given the port, and waits until it answers.
 * @param {string} folder @param {(port: number) => string[]} command what Node runs @param {Record<string, string>} env @returns {Promise<Site>}
 */
export async function start(folder, command, env) {
  const free = await serve([]);
  const port = Number(new URL(free.url).port);
  free.close();
  const child = spawn(process.execPath, command(port), { cwd: folder, env: { ...process.env, ...env }, stdio: 'ignore' });
  const url = `http://127.0.0.1:${port}/`;
  const end = performance.now() + PATIENCE;
  while (!(await fetch(url).catch(() => undefined))) {
    if (child.exitCode !== null || performance.now() > end) {
      child.kill();
      throw new Error(`${command(port).join(' ')} does not answer (status ${child.exitCode}).`);
    }
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  return { url, close: () => child.kill() };
}
