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

export type PictureType = 'image/png' | 'image/avif';

const word = (bytes: Uint8Array, at: number): number =>
  at + 4 <= bytes.length ? new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength).getUint32(at) : 0;

/** Of an AVIF's boxes (ISO/IEC 14496-12) those that tell of sizes, wherever they lie; [width, height] each. */
function avifSizes(bytes: Uint8Array, begin = 0, end = bytes.length): [number, number][] {
  const inside: Record<string, number> = { meta: 12, iprp: 8, ipco: 8 }; // bytes before the boxes that these hold
  const sizes: [number, number][] = [];
  for (let at = begin; at + 8 <= end; ) {
    const size = word(bytes, at);
    const name = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    if (size < 8 || at + size > end) break; // 0 and 1 stand for longer ones: data, behind all that is looked for
    if (name === 'ispe') sizes.push([word(bytes, at + 12), word(bytes, at + 16)]);
    if (name in inside) sizes.push(...avifSizes(bytes, at + inside[name], at + size));
    at += size;
  }
  return sizes;
}

/** By the file's header, before anything is decoded: a few kilobytes may unpack to gigabytes. What kind it is. */
export function checkPicture(bytes: Uint8Array, width: number, height: number): PictureType {
  const isPng = [0x89504e47, 0x0d0a1a0a, 13, 0x49484452].every((expected, i) => word(bytes, 4 * i) === expected); // with IHDR
  const isAvif = [0x66747970, 0x61766966].every((expected, i) => word(bytes, 4 + 4 * i) === expected); // ftyp avif
  const sizes: [number, number][] = isPng && bytes.length >= 24 ? [[word(bytes, 16), word(bytes, 20)]] : isAvif ? avifSizes(bytes) : [];
  if (sizes.length === 0) throw new DamagedFile('it is no PNG or AVIF');
  for (const [w, h] of sizes)
    if (w !== width || h !== height) throw new DamagedFile(`it is ${w} × ${h} pixels large, and the index says ${width} × ${height}`);
  return isPng ? 'image/png' : 'image/avif';
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
  const type = checkPicture(bytes, task.width, task.height);
  const blob = new Blob([bytes as BlobPart], { type });
  return { kind: 'texture', picture: await createImageBitmap(blob, { premultiplyAlpha: 'none', colorSpaceConversion: 'none' }) };
}
