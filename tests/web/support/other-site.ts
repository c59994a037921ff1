import { createServer, type RequestListener } from 'node:http';
import { onTestFinished } from 'vitest';

/** Another site than ours, until the test ends: its address, with a slash at the end. */
export async function otherSite(answer: RequestListener): Promise<string> {
  const server = createServer(answer);
  await new Promise<void>((resolve) => server.listen(0, 'localhost', resolve));
  onTestFinished(() => {
    server.close();
  });
  const { port } = server.address() as { port: number };
  return `http://localhost:${port}/`;
}

/** One that has a single page. */
export function otherPage(html: string): Promise<string> {
  return otherSite((_, response) => {
    response.writeHead(200, { 'content-type': 'text/html' });
    response.end(html);
  });
}
