// A tiny server of static files: node serve.mjs FOLDER [PORT]. On this machine alone; port 0 takes a free one.
import { createReadStream } from 'node:fs';
import { realpath, stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize, resolve, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { createGzip } from 'node:zlib';

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

/** The same with all links followed; undefined if they lead out of the folder, or nowhere. */
async function realFileOf(folder, address) {
  const file = fileOf(folder, address);
  if (!file) return undefined;
  try {
    const [real, root] = await Promise.all([realpath(file), realpath(folder)]);
    return real.startsWith(root.endsWith(sep) ? root : root + sep) ? real : undefined;
  } catch {
    return undefined;
  }
}

/** Resolves to the server, listening. `before(request, response)` may answer itself: it then returns true. */
export function serve(folder, port = 0, before = () => false) {
  const root = resolve(folder);
  const server = createServer(async (request, response) => {
    if (before(request, response)) return;
    const file = await realFileOf(root, request.url ?? '/');
    const found = file && (await stat(file, { bigint: true }).catch(() => undefined));
    if (!found?.isFile()) {
      response.writeHead(404, { 'Content-Type': 'text/plain' }).end('not found\n');
      return;
    }
    // Changed in content, it has another time, or lies elsewhere.
    const tag = `"${found.ino.toString(36)}-${found.size.toString(36)}-${found.mtimeNs.toString(36)}"`;
    if ((request.headers['if-none-match'] ?? '').split(',').some((known) => known.trim().replace(/^W\//, '') === tag)) {
      response.writeHead(304, { ETag: tag, 'Cache-Control': 'no-cache' }).end();
      return;
    }
    const size = Number(found.size), range = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? '');
    if (range) {
      const first = Number(range[1]), last = Math.min(range[2] === '' ? Infinity : Number(range[2]), size - 1);
      const headers = { 'Content-Range': `bytes ${first <= last ? `${first}-${last}` : '*'}/${size}`, 'Cache-Control': 'no-cache', ETag: tag };
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
      'Content-Type': type, ...(packed ? { 'Content-Encoding': 'gzip' } : { 'Content-Length': size }),
      'Cache-Control': 'no-cache', ETag: tag,
    });
    if (request.method === 'HEAD') response.end();
    else {
      const content = createReadStream(file).on('error', () => response.destroy());
      (packed ? content.pipe(createGzip()) : content).pipe(response);
    }
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
