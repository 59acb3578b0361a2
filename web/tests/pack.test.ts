import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { BlockFile, BlockFileKind, contentHash } from '../src/bundle/block_file';
import { readCapture, type Samples } from '../src/bundle/capture';
import { numberOfHalf } from '../src/bundle/colour';

/** Written by the engine (tests/export/web_fixture_test.cpp), with what it makes of it. */
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
    const capture = await readCapture(pack(), golden.exposure);
    expect(capture.camera).toEqual(golden.camera);
    expect(asGolden(capture.samples)).toEqual(golden.samples);
    expect(asGolden(capture.reflections!)).toEqual(golden.reflections);
    expect([...capture.background!.columnStart]).toEqual(golden.background.columnStart);
    expect([...capture.background!.runs]).toEqual(golden.background.runs);
    expect(capture.background!.zenith).toEqual(golden.background.zenith);
  });

  it('is shown as whole samples where it knows its silhouettes', async () => {
    const bytes = new Uint8Array(readFileSync(fixture('silhouettes.pack')));
    const capture = await readCapture(bytes, golden.exposure);
    expect(asGolden(capture.samples)).toEqual(golden.samples);
    expect(asGolden(capture.reflections!)).toEqual(golden.reflections);
    expect([...capture.background!.runs]).toEqual(golden.background.runs);
  });

  it('tells ranges of blocks that hold every sample of theirs', async () => {
    const { samples } = await readCapture(pack(), golden.exposure);
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
    const { samples } = await readCapture(pack(), golden.exposure);
    const clear = [...samples.ranks!.keys()].filter((i) => samples.words[3 * i + 2] < 0xff000000);
    expect(clear.length).toBeGreaterThan(1);
    expect(Math.max(...clear.map((i) => samples.ranks![i]))).toBe(1);
    expect(Math.max(...samples.clearRanks!)).toBe(2);
  });

  it('is refused with any byte changed, cut off, or of another kind', async () => {
    const sound = pack();
    for (let at = 0; at < sound.length; at += 7) {
      const bytes = sound.slice();
      bytes[at] ^= 0x10;
      await expect(readCapture(bytes, 1), `byte ${at}`).rejects.toThrow();
    }
    for (const length of [0, 40, 100, sound.length - 1]) await expect(readCapture(sound.slice(0, length), 1)).rejects.toThrow();
    await expect(BlockFile.open(sound, BlockFileKind.local, [1])).rejects.toThrow('kind 1');
  });
});

describe('hashes', () => {
  it('are XXH3 with 128 bits, high half first', async () => {
    expect(await contentHash(new Uint8Array(0))).toBe('99aa06d3014798d86001c324468d497f');
  });
});

describe('halves', () => {
  it.each([[0x0000, 0], [0x3c00, 1], [0xc000, -2], [0x7bff, 65504], [0x0001, 2 ** -24], [0x7c00, Infinity], [0x3555, 0.333251953125]])(
    '%i is %d', (bits, value) => expect(numberOfHalf(bits)).toBe(value),
  );
});
