/** Packs to what is drawn (web/runtime/read_pack.cpp). The pictures in a pack are decoded by the browser. */

import type { ZSTDDecoder } from 'zstddec';
import { DamagedFile } from '../bundle/file';
import { EngineModule, unpackWith } from './module';

/** A capture on its way to the graphics card. */
export interface Capture {
  part: Uint8Array; // for the planner
  colours: Uint8Array; // RGBA8 of texels, whole rows of the textures that hold them
  covers: Uint32Array; // of the same texels
  runs: Uint32Array; // of the background, two words each: first row, and one below the last in the high half; roles
}

/** On the graphics card. */
export const bytesOfCapture = (c: Capture): number => c.colours.byteLength + c.covers.byteLength + c.runs.byteLength;

export interface DecodedPicture {
  width: number;
  height: number;
  rgba: Uint8Array | Uint8ClampedArray;
}
export type DecodePicture = (file: Uint8Array) => Promise<DecodedPicture>;

/** A browser's own decoder; what it makes of the file has the codes that are in it. */
export const decodeByBrowser: DecodePicture = async (file) => {
  const options: ImageBitmapOptions = { premultiplyAlpha: 'none', colorSpaceConversion: 'none' };
  const bitmap = await createImageBitmap(new Blob([file as BlobPart], { type: 'image/avif' }), options);
  const { width, height } = bitmap;
  const canvas = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true, alpha: false })!;
  canvas.drawImage(bitmap, 0, 0);
  bitmap.close();
  return { width, height, rgba: canvas.getImageData(0, 0, width, height).data };
};

interface Functions {
  takePack(bytes: number): number;
  findPictures(): number;
  pictureFile(picture: number): number;
  pictureBytes(picture: number): number;
  takePicture(picture: number, width: number, height: number): number;
  readPack(exposure: number): number;
}

/** With more memory than this a module begins anew after a pack, bytes. */
const kMostMemory = 64 << 20;

export class PackReader {
  private readonly engine: EngineModule<Functions>;

  constructor(module: WebAssembly.Module, zstandard: ZSTDDecoder) {
    this.engine = new EngineModule(module, unpackWith(zstandard));
  }

  private takePack(pack: Uint8Array): number {
    const { engine } = this;
    engine.give(engine.call.takePack, pack);
    const pictures = engine.call.findPictures();
    if (pictures < 0) throw new DamagedFile(engine.message);
    return pictures;
  }

  async read(pack: Uint8Array, exposure: number, decode: DecodePicture = decodeByBrowser): Promise<Capture> {
    const { engine } = this;
    const files = engine.guarded(() =>
      Array.from({ length: this.takePack(pack) }, (_, i) =>
        engine.bytes(engine.call.pictureFile(i), engine.call.pictureBytes(i)).slice(),
      ),
    );
    const pictures = await Promise.all(
      files.map((file) => decode(file).catch(() => { throw new DamagedFile('a picture of its colours cannot be decoded'); })),
    );
    return engine.guarded(() => {
      if (files.length > 0) { // other packs may have been read since
        this.takePack(pack);
        pictures.forEach(({ width, height, rgba }, i) => engine.give(() => engine.call.takePicture(i, width, height), rgba));
      }
      const address = engine.call.readPack(exposure);
      if (address === 0) throw new DamagedFile(engine.message);
      const read = this.captureAt(address);
      if (engine.memory.byteLength > kMostMemory) engine.restart();
      return read;
    });
  }

  /** The PageCapture of read_pack.cpp; copies what it names. */
  private captureAt(address: number): Capture {
    const { memory } = this.engine;
    const [partBytes, part, texels, colours, covers, runs, runWords] = new Uint32Array(memory, address, 7);
    return {
      part: new Uint8Array(memory, part, partBytes).slice(),
      colours: new Uint8Array(memory, colours, 4 * texels).slice(),
      covers: new Uint32Array(memory, covers, texels).slice(),
      runs: new Uint32Array(memory, runWords, 2 * runs).slice(),
    };
  }
}
