import { mkdtemp, mkdir, rm, symlink, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { serve } from '../serve.mjs';

let folder, server, at;
beforeEach(async () => {
  folder = await mkdtemp(join(tmpdir(), 'acentric-serve-'));
  await mkdir(join(folder, 'page'));
  await writeFile(join(folder, 'page', 'index.html'), 'page');
  await writeFile(join(folder, 'secret.txt'), 'secret');
  await symlink('../secret.txt', join(folder, 'page', 'out.txt'));
  await symlink('..', join(folder, 'page', 'up'));
  await symlink('index.html', join(folder, 'page', 'within.html'));
  server = await serve(join(folder, 'page'));
  at = `http://127.0.0.1:${server.address().port}`;
});
afterEach(async () => {
  server.closeAllConnections();
  await new Promise((done) => server.close(done));
  await rm(folder, { recursive: true });
});

it('serves what lies in the folder, also by links within it', async () => {
  for (const name of ['/', '/index.html', '/within.html']) expect(await (await fetch(at + name)).text()).toBe('page');
});

it('follows no link out of the folder', async () => {
  for (const name of ['/out.txt', '/up/secret.txt', '/%2e%2e/secret.txt', '/..%2fsecret.txt']) expect((await fetch(at + name)).status).toBe(404);
});

it('answers 304 to who has the file, until it changes', async () => {
  const first = await fetch(`${at}/index.html`);
  const tag = first.headers.get('etag');
  expect(tag).toMatch(/^".+"$/);
  await first.text();
  const again = () => fetch(`${at}/index.html`, { headers: { 'If-None-Match': tag }, cache: 'no-store' });
  expect((await again()).status).toBe(304);
  await writeFile(join(folder, 'page', 'index.html'), 'another page');
  const changed = await again();
  expect(changed.status).toBe(200);
  expect(await changed.text()).toBe('another page');
});

it('sends parts of files', async () => {
  const part = async (range) => {
    const response = await fetch(`${at}/index.html`, { headers: { Range: range } });
    return [response.status, await response.text(), response.headers.get('Content-Range')];
  };
  expect(await part('bytes=1-2')).toEqual([206, 'ag', 'bytes 1-2/4']);
  expect(await part('bytes=2-')).toEqual([206, 'ge', 'bytes 2-3/4']);
  expect(await part('bytes=2-90')).toEqual([206, 'ge', 'bytes 2-3/4']);
  expect(await part('bytes=4-5')).toEqual([416, '', 'bytes */4']);
});
