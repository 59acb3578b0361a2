/** Fetches a file, checks that it is what the index says, and makes of it what is drawn. */

import { contentHash, DamagedFile, fetched } from '../bundle/file';
import type { FileRef } from '../bundle/types';
import type { LocalReader } from '../engine/local_reader';
import type { PackReader } from '../engine/pack_reader';
import type { Loaded, Request } from './messages';

/** `from`: in a walk, where the file begins. */
async function bytesAt(url: string, file: FileRef, from: number | undefined, again: boolean): Promise<Uint8Array> {
  const response = await fetched(url, again, from === undefined ? undefined : { at: from, bytes: file.bytes });
  const declared = Number(response.headers.get('Content-Length') ?? 0);
  if (declared > 4 * file.bytes + 65536) throw new DamagedFile('it is far larger than the index says');
  return new Uint8Array(await response.arrayBuffer());
}

/** The file's bytes, which are what was exported. */
export async function checkedBytes(bytes: Uint8Array, file: FileRef): Promise<Uint8Array> {
  if (bytes.length !== file.bytes) throw new DamagedFile(`it has ${bytes.length} bytes instead of ${file.bytes}`);
  if ((await contentHash(bytes)) !== file.hash) throw new DamagedFile('it is damaged: its contents do not fit its hash');
  return bytes;
}

/** By the PNG's header, before anything is decoded: a few kilobytes may unpack to gigabytes. */
export function checkPictureSize(bytes: Uint8Array, width: number, height: number): void {
  const header = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const signature = [0x89504e47, 0x0d0a1a0a, 13, 0x49484452]; // and the first chunk: 13 bytes of IHDR
  if (bytes.length < 24 || signature.some((word, i) => header.getUint32(4 * i) !== word)) throw new DamagedFile('it is no PNG');
  const [w, h] = [header.getUint32(16), header.getUint32(20)];
  if (w !== width || h !== height) throw new DamagedFile(`it is ${w} × ${h} pixels large, and the index says ${width} × ${height}`);
}

export interface Readers {
  packs: PackReader;
  locals: LocalReader;
}

export async function loadFile(request: Request, readers: Promise<Readers>): Promise<Loaded> {
  const { task, file } = request;
  const bytes = await checkedBytes(request.bytes ?? (await bytesAt(request.url!, file, request.from, request.again)), file);
  if (task.kind === 'capture') return { kind: 'capture', capture: await (await readers).packs.read(bytes, task.exposure) };
  if (task.kind === 'local') return { kind: 'local', local: (await readers).locals.read(bytes, task.origin) };
  checkPictureSize(bytes, task.width, task.height);
  const blob = new Blob([bytes as BlobPart], { type: 'image/png' });
  return { kind: 'texture', picture: await createImageBitmap(blob, { premultiplyAlpha: 'none', colorSpaceConversion: 'none' }) };
}
