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
});
