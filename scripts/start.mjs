// `npm start`: installs what is needed, then serves the studio.
import { ensureInstalled } from './lib/install.mjs';
import { at } from './lib/paths.mjs';
import { runMain } from './lib/run.mjs';

await runMain(async () => {
  await ensureInstalled();
  await import('./generate.mjs');
  const { createServer } = await import('vite');
  const wanted = Number(process.env.PORT ?? 5173);
  const server = await createServer({
    configFile: at('vite.config.ts'),
    logLevel: 'warn',
    clearScreen: false,
    server: { port: wanted, host: 'localhost' },
  });
  await server.listen();
  const address = server.httpServer?.address();
  const port = address && typeof address === 'object' ? address.port : wanted;
  const url = `http://localhost:${port}/studio/`;
  console.log(`\nThe studio is at ${url}  (Ctrl+C ends it)\n`);
  for (const signal of /** @type {const} */ (['SIGINT', 'SIGTERM', 'SIGHUP'])) {
    process.once(signal, () => {
      setTimeout(() => process.exit(0), 2000).unref();
      server.close().finally(() => process.exit(0));
    });
  }
  if (process.stdout.isTTY && !process.env.CI) openBrowser(url);
});

/** @param {string} url */
async function openBrowser(url) {
  const { spawn } = await import('node:child_process');
  const [command, args] =
    process.platform === 'darwin'
      ? ['open', [url]]
      : process.platform === 'win32'
        ? ['cmd', ['/c', 'start', '""', url]]
        : ['xdg-open', [url]];
  const child = spawn(/** @type {string} */ (command), /** @type {string[]} */ (args), { stdio: 'ignore', detached: true });
  child.on('error', () => {}); // no opener: the address is on the screen
  child.unref();
}
