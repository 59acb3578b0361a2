// A tiny server of static files: node serve.mjs FOLDER [PORT]. On this machine alone; port 0 takes a free one.
import { createReadStream } from 'node:fs';
import { stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize, resolve, sep } from 'node:path';
import { fileURLToPath } from 'node:url';

const kTypes = {
  '.html': 'text/html; charset=utf-8', '.js': 'text/javascript; charset=utf-8', '.css': 'text/css; charset=utf-8',
  '.json': 'application/json', '.png': 'image/png',
};

/** The file of `folder` that an address names; undefined if it leaves the folder. */
export function fileOf(folder, address) {
  let path;
  try {
    path = decodeURIComponent(new URL(address, 'http://localhost').pathname);
  } catch {
    return undefined;
  }
  const file = normalize(join(folder, path.endsWith('/') ? `${path}index.html` : path));
  return file.startsWith(resolve(folder) + sep) && !path.includes('\0') ? file : undefined;
}

/** Resolves to the server, listening. `before(request, response)` may answer itself: it then returns true. */
export function serve(folder, port = 0, before = () => false) {
  const root = resolve(folder);
  const server = createServer(async (request, response) => {
    if (before(request, response)) return;
    const file = fileOf(root, request.url ?? '/');
    const found = file && (await stat(file).catch(() => undefined));
    if (!found?.isFile()) {
      response.writeHead(404, { 'Content-Type': 'text/plain' }).end('not found\n');
      return;
    }
    response.writeHead(200, {
      'Content-Type': kTypes[extname(file)] ?? 'application/octet-stream', 'Content-Length': found.size, 'Cache-Control': 'no-cache',
    });
    if (request.method === 'HEAD') response.end();
    else createReadStream(file).on('error', () => response.destroy()).pipe(response);
  });
  return new Promise((done, failed) => {
    server.on('error', failed);
    server.listen(port, '127.0.0.1', () => done(server));
  });
}

if (process.argv[1] && resolve(process.argv[1]) === fileURLToPath(import.meta.url)) {
  const [folder, port = '8000'] = process.argv.slice(2);
  if (!folder || !/^\d{1,5}$/.test(port)) {
    console.error('usage: node serve.mjs FOLDER [PORT]');
    process.exit(2);
  }
  let server;
  try {
    server = await serve(folder, Number(port));
  } catch (error) {
    if (error.code !== 'EADDRINUSE') throw error;
    server = await serve(folder, 0);
  }
  console.log(`${resolve(folder)} is at http://127.0.0.1:${server.address().port}/ (stop it with Ctrl+C)`);
}
