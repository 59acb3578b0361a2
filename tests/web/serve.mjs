// A server of static files for the browser's tests, which may answer in its place. For people there is `acentric serve`.
import { createReadStream } from 'node:fs';
import { realpath, stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, resolve, sep } from 'node:path';
import { createGzip } from 'node:zlib';

const kTypes = {
  '.html': 'text/html; charset=utf-8', '.js': 'text/javascript; charset=utf-8', '.css': 'text/css; charset=utf-8',
  '.json': 'application/json', '.png': 'image/png',
};

/** The file of `folder` that an address names, with all links followed; undefined if that leaves the folder, or leads nowhere. */
async function fileOf(folder, address) {
  try {
    const path = decodeURIComponent(new URL(address, 'http://localhost').pathname);
    const real = await realpath(join(folder, path.endsWith('/') ? `${path}index.html` : path));
    return real.startsWith((await realpath(folder)) + sep) ? real : undefined;
  } catch {
    return undefined;
  }
}

/** Resolves to the server, listening. `before(request, response)` may answer itself: it then returns true. */
export function serve(folder, port = 0, before = () => false) {
  const server = createServer(async (request, response) => {
    if (before(request, response)) return;
    const file = await fileOf(resolve(folder), request.url ?? '/');
    const found = file && (await stat(file).catch(() => undefined));
    if (!found?.isFile()) {
      response.writeHead(404, { 'Content-Type': 'text/plain' }).end('not found\n');
      return;
    }
    const { size } = found, range = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? '');
    if (range) {
      const first = Number(range[1]), last = Math.min(range[2] === '' ? Infinity : Number(range[2]), size - 1);
      const headers = { 'Content-Range': `bytes ${first <= last ? `${first}-${last}` : '*'}/${size}`, 'Cache-Control': 'no-cache' };
      if (first > last) response.writeHead(416, headers).end();
      else {
        response.writeHead(206, { ...headers, 'Content-Type': 'application/octet-stream', 'Content-Length': last - first + 1 });
        createReadStream(file, { start: first, end: last }).on('error', () => response.destroy()).pipe(response);
      }
      return;
    }
    const type = kTypes[extname(file)] ?? 'application/octet-stream';
    // As most hosts do with text.
    const packed = /^text|json/.test(type) && /\bgzip\b/.test(request.headers['accept-encoding'] ?? '');
    response.writeHead(200, {
      'Content-Type': type, ...(packed ? { 'Content-Encoding': 'gzip' } : { 'Content-Length': size }), 'Cache-Control': 'no-cache',
    });
    const content = createReadStream(file).on('error', () => response.destroy());
    (packed ? content.pipe(createGzip()) : content).pipe(response);
  });
  return new Promise((done, failed) => {
    server.on('error', failed);
    server.listen(port, '127.0.0.1', () => done(server));
  });
}
