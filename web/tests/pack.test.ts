import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { contentHash, zstd } from '../src/bundle/file';
import { PackReader, type Capture, type DecodePicture } from '../src/engine/pack_reader';

const reader = new PackReader(
  new WebAssembly.Module(readFileSync(new URL('../../build/page/page.wasm', import.meta.url))), await zstd(),
);

/** Written by the engine (tests/web/fixture_test.cpp), with what it makes of it. */
const fixture = (name: string) => new URL(`fixtures/${name}`, import.meta.url);
const pack = (name = 'coded.pack') => new Uint8Array(readFileSync(fixture(name)));
interface Golden {
  exposure: number;
  texels: number; // of surfaces, then of reflections
  colours: string; // hashes
  covers: string;
  runs: number[];
}
const golden = JSON.parse(readFileSync(fixture('capture.json'), 'utf8')) as Golden;

const hashOf = (values: Uint8Array | Uint32Array) => contentHash(new Uint8Array(values.buffer, values.byteOffset, values.byteLength));

describe('a pack that the engine wrote', () => {
  it('gives the texels that the engine makes of it', async () => {
    const capture = await reader.read(pack(), golden.exposure);
    expect(capture.covers.length).toBe(golden.texels);
    expect(await hashOf(capture.colours)).toBe(golden.colours);
    expect(await hashOf(capture.covers)).toBe(golden.covers);
    expect([...capture.runs]).toEqual(golden.runs);
    expect(capture.part.length).toBeGreaterThan(0);
  });

  it('is refused without silhouettes', async () => {
    await expect(reader.read(pack('capture.pack'), 1)).rejects.toThrow('earlier version');
  });

  describe('whose colours are pictures', () => {
    const display = () => pack('display.pack');
    const greyOf = (width: number, height: number) => ({ width, height, rgba: new Uint8Array(4 * width * height).fill(100) });
    const grey: DecodePicture = async (file) => {
      const view = new DataView(file.buffer, file.byteOffset);
      const at = Buffer.from(file).indexOf('ispe');
      return greyOf(view.getUint32(at + 8), view.getUint32(at + 12));
    };

    it('takes those of the first samples from what the browser decodes', async () => {
      const { colours, covers }: Capture = await reader.read(display(), golden.exposure, grey);
      let grey100 = 0, whole = 0;
      for (let i = 0; i < covers.length; ++i) {
        if ((covers[i] & 0xffff) !== 0xffff) continue;
        ++whole;
        if ([0, 1, 2].every((k) => Math.abs(colours[4 * i + k] - 100) <= 1)) ++grey100;
      }
      expect(grey100).toBeGreaterThan(0.5 * whole); // the others lie behind the first of their pixels
    });

    it('is refused where the browser finds another size, or nothing', async () => {
      await expect(reader.read(display(), 1, async () => greyOf(3, 3))).rejects.toThrow('another size');
      await expect(reader.read(display(), 1, async () => { throw new Error(); })).rejects.toThrow('cannot be decoded');
      await expect(reader.read(display(), 1, grey)).resolves.toBeDefined();
    });
  });

  it('is refused with any byte changed, cut off, or of another kind', async () => {
    const sound = pack();
    for (let at = 0; at < sound.length; at += 7) {
      const bytes = sound.slice();
      bytes[at] ^= 0x10;
      await expect(reader.read(bytes, 1), `byte ${at}`).rejects.toThrow();
    }
    for (const length of [0, 40, 100, sound.length - 1]) await expect(reader.read(sound.slice(0, length), 1)).rejects.toThrow();
  });
});

describe('hashes', () => {
  it('are XXH3 with 128 bits, high half first', async () => {
    expect(await contentHash(new Uint8Array(0))).toBe('99aa06d3014798d86001c324468d497f');
  });
});
