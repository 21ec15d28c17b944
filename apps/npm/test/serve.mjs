// A folder, as any web server would give it: for the tests of this package's pages, of the viewer's page and of Bevy's.
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { join, normalize } from 'node:path';

const TYPES = { html: 'text/html', js: 'text/javascript', mjs: 'text/javascript', json: 'application/json', wasm: 'application/wasm' };

/** The server, and its address. */
export async function serve(folder) {
  const server = createServer(async (question, answer) => {
    try {
      const path = normalize(new URL(question.url, 'http://page').pathname);
      const file = join(folder, path === '/' ? 'index.html' : path);
      const content = await readFile(file);
      answer.writeHead(200, { 'content-type': TYPES[file.split('.').pop()] ?? 'application/octet-stream' });
      answer.end(content);
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
  return { server, address: `http://127.0.0.1:${server.address().port}` };
}
