import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { BlockFile, BlockFileKind, contentHash, zstd } from '../src/bundle/block_file';
import { readCapture, type Samples } from '../src/bundle/capture';
import { PageModule, type DecodePicture } from '../src/bundle/page_module';

const module = new PageModule(
  new WebAssembly.Module(readFileSync(new URL('../../build/page/page.wasm', import.meta.url))), await zstd(),
);

/** Written by the engine (tests/web/fixture_test.cpp), with what it makes of it. */
const fixture = (name: string) => new URL(`fixtures/${name}`, import.meta.url);
const pack = () => new Uint8Array(readFileSync(fixture('capture.pack')));
interface Golden {
  exposure: number;
  camera: { centre: number[]; lowAzimuth: number; fov: number; topElevation: number; bottomElevation: number; columns: number; rows: number };
  samples: { columnStart: number[]; words: number[]; mirrors: number[] };
  reflections: { columnStart: number[]; words: number[]; mirrors: number[] };
  background: { columnStart: number[]; runs: number[]; zenith: number[] };
}
const golden = JSON.parse(readFileSync(fixture('capture.json'), 'utf8')) as Golden;

const asGolden = (samples: Samples) => ({
  columnStart: [...samples.columnStart], words: [...samples.words], mirrors: [...(samples.mirrors ?? [])],
});

describe('a pack that the engine wrote', () => {
  it('gives what the engine makes of it', async () => {
    const capture = await readCapture(module, pack(), golden.exposure);
    expect(capture.camera).toEqual(golden.camera);
    expect(asGolden(capture.samples)).toEqual(golden.samples);
    expect(asGolden(capture.reflections!)).toEqual(golden.reflections);
    expect([...capture.background!.columnStart]).toEqual(golden.background.columnStart);
    expect([...capture.background!.runs]).toEqual(golden.background.runs);
    expect(capture.background!.zenith).toEqual(golden.background.zenith);
  });

  it.each(['silhouettes.pack', 'coded.pack'])('is shown as whole samples where it knows its silhouettes: %s', async (name) => {
    const bytes = new Uint8Array(readFileSync(fixture(name)));
    const capture = await readCapture(module, bytes, golden.exposure);
    expect(asGolden(capture.samples)).toEqual(golden.samples);
    expect(asGolden(capture.reflections!)).toEqual(golden.reflections);
    expect([...capture.background!.runs]).toEqual(golden.background.runs);
  });

  it('tells ranges of blocks that hold every sample of theirs', async () => {
    const { samples } = await readCapture(module, pack(), golden.exposure);
    const inverse = new Float32Array(samples.words.map((word) => word & 0xffffff00).buffer);
    for (let k = 0; k < golden.camera.columns; ++k)
      for (let i = samples.columnStart[k]; i < samples.columnStart[k + 1]; ++i) {
        const block = samples.columnBlock[k] + Math.floor((i - samples.columnStart[k]) / 64);
        expect(inverse[3 * i]).toBeGreaterThanOrEqual(samples.blockLeast[block]);
        expect(inverse[3 * i]).toBeLessThanOrEqual(samples.columnMost[k]);
        expect(samples.blockRoles[block] & samples.words[3 * i] & 0xff).toBe(samples.words[3 * i] & 0xff);
      }
  });

  it('ranks blended samples of a pixel from the nearest', async () => {
    const { samples } = await readCapture(module, pack(), golden.exposure);
    const clear = [...samples.ranks!.keys()].filter((i) => samples.words[3 * i + 2] < 0xff000000);
    expect(clear.length).toBeGreaterThan(1);
    expect(Math.max(...clear.map((i) => samples.ranks![i]))).toBe(1);
    expect(Math.max(...samples.clearRanks!)).toBe(2);
  });

  describe('whose colours are pictures', () => {
    const display = () => new Uint8Array(readFileSync(fixture('display.pack')));
    const greyOf = (width: number, height: number) => ({ width, height, rgba: new Uint8Array(4 * width * height).fill(100) });
    const grey: DecodePicture = async (file) => {
      const view = new DataView(file.buffer, file.byteOffset);
      const at = Buffer.from(file).indexOf('ispe');
      return greyOf(view.getUint32(at + 8), view.getUint32(at + 12));
    };

    it('takes those of the first samples from what the browser decodes', async () => {
      const { samples, reflections } = await readCapture(module, display(), golden.exposure, grey);
      for (const list of [samples, reflections!]) {
        const words = list.words;
        for (let i = 0; i < list.count; ++i) {
          if (i > 0 && words[3 * i + 1] === words[3 * i - 2]) continue; // behind the first of its pixel
          for (const shift of [0, 8, 16]) expect(Math.abs(((words[3 * i + 2] >> shift) & 255) - 100)).toBeLessThanOrEqual(1);
        }
      }
    });

    it('is refused where the browser finds another size, or nothing', async () => {
      await expect(readCapture(module, display(), 1, async () => greyOf(3, 3))).rejects.toThrow('another size');
      await expect(readCapture(module, display(), 1, async () => { throw new Error(); })).rejects.toThrow('cannot be decoded');
      await expect(readCapture(module, display(), 1, grey)).resolves.toBeDefined();
    });
  });

  it('is refused with any byte changed, cut off, or of another kind', async () => {
    const sound = pack();
    for (let at = 0; at < sound.length; at += 7) {
      const bytes = sound.slice();
      bytes[at] ^= 0x10;
      await expect(readCapture(module, bytes, 1), `byte ${at}`).rejects.toThrow();
    }
    for (const length of [0, 40, 100, sound.length - 1]) await expect(readCapture(module, sound.slice(0, length), 1)).rejects.toThrow();
    await expect(BlockFile.open(sound, BlockFileKind.local, [1])).rejects.toThrow('kind 1');
  });
});

describe('hashes', () => {
  it('are XXH3 with 128 bits, high half first', async () => {
    expect(await contentHash(new Uint8Array(0))).toBe('99aa06d3014798d86001c324468d497f');
  });
});
