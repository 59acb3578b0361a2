import { afterEach, describe, expect, it, vi } from 'vitest';
import { contentHash } from '../src/bundle/file';
import { loadFile, type Readers } from '../src/stream/load_file';

/** Of a PNG all that comes before its pixels. */
function headerOf(width: number, height: number): Uint8Array {
  const bytes = new Uint8Array(33);
  const view = new DataView(bytes.buffer);
  [0x89504e47, 0x0d0a1a0a, 13, 0x49484452, width, height].forEach((word, i) => view.setUint32(4 * i, word));
  return bytes;
}

const box = (name: string, ...inside: Uint8Array[]): Uint8Array => {
  const size = 8 + inside.reduce((sum, part) => sum + part.length, 0);
  const bytes = new Uint8Array(size);
  new DataView(bytes.buffer).setUint32(0, size);
  bytes.set(new TextEncoder().encode(name), 4);
  let at = 8;
  for (const part of inside) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
};
const words = (...values: number[]): Uint8Array => {
  const bytes = new Uint8Array(4 * values.length);
  values.forEach((value, i) => new DataView(bytes.buffer).setUint32(4 * i, value));
  return bytes;
};
/** Of an AVIF the boxes that tell of its colours' and its alpha's size. */
function avifOf(...sizes: [number, number][]): Uint8Array {
  const extents = sizes.map(([width, height]) => box('ispe', words(0, width, height)));
  const meta = box('meta', words(0), box('hdlr', words(0)), box('iprp', box('ipco', box('pixi', words(0)), ...extents)));
  const file = [box('ftyp', new TextEncoder().encode('avif'), words(0)), meta, box('mdat', words(1, 2, 3))];
  return new Uint8Array(file.flatMap((part) => [...part]));
}

const noModule = new Promise<Readers>(() => {}); // textures need none

async function load(bytes: Uint8Array, width: number, height: number) {
  const file = { file: 'textures/a.png', bytes: bytes.length, hash: await contentHash(bytes) };
  return loadFile({ id: 1, task: { kind: 'texture', width, height }, file, url: undefined, from: undefined, bytes, again: false }, noModule);
}

describe('a texture', () => {
  afterEach(() => vi.unstubAllGlobals());

  it('is decoded only if its header has the size that the index says', async () => {
    const decode = vi.fn(async () => 'picture');
    vi.stubGlobal('createImageBitmap', decode);
    expect(await load(headerOf(3, 2), 3, 2)).toEqual({ kind: 'texture', picture: 'picture' });
    expect(decode).toHaveBeenCalledTimes(1);
    await expect(load(headerOf(16384, 16384), 2048, 2048)).rejects.toThrow('16384 × 16384 pixels large, and the index says 2048 × 2048');
    await expect(load(headerOf(3, 2).slice(0, 20), 3, 2)).rejects.toThrow('no PNG');
    await expect(load(new Uint8Array(100), 3, 2)).rejects.toThrow('no PNG');
    expect(decode).toHaveBeenCalledTimes(1);
  });

  it('may be an AVIF, all of whose parts have that size', async () => {
    const decode = vi.fn(async (_: Blob) => 'picture');
    vi.stubGlobal('createImageBitmap', decode);
    expect(await load(avifOf([3, 2], [3, 2]), 3, 2)).toEqual({ kind: 'texture', picture: 'picture' });
    expect(decode.mock.calls[0][0].type).toBe('image/avif');
    await expect(load(avifOf([16384, 16384]), 3, 2)).rejects.toThrow('16384 × 16384 pixels large, and the index says 3 × 2');
    await expect(load(avifOf([3, 2], [16384, 2]), 3, 2)).rejects.toThrow('16384 × 2 pixels large');
    await expect(load(avifOf(), 3, 2)).rejects.toThrow('no PNG or AVIF');
    const cut = avifOf([3, 2]);
    for (let bytes = 0; bytes < cut.length - 20; ++bytes) await expect(load(cut.slice(0, bytes), 3, 2)).rejects.toThrow('no PNG or AVIF');
    expect(decode).toHaveBeenCalledTimes(1);
  });
});
