/**
 * The engine's part of the page, a module of WebAssembly (web/runtime/page_module.cpp): packs to what is drawn. The pictures
 * in a pack are decoded by the browser.
 */

import type { ZSTDDecoder } from 'zstddec';
import { DamagedFile } from './block_file';

export interface DecodedPicture {
  width: number;
  height: number;
  rgba: Uint8Array | Uint8ClampedArray;
}
export type DecodePicture = (file: Uint8Array) => Promise<DecodedPicture>;

export interface PackList {
  columnStart: Uint32Array; // columns + 1
  words: Uint32Array; // three a sample: inverse distance with the roles in its last byte; row, and column in the high half; RGBA8
  mirrors: Uint8Array | undefined;
}
export interface Pack {
  numbers: Float64Array; // centre, low azimuth, field of view, top and bottom elevation
  columns: number;
  rows: number;
  surfaces: PackList;
  reflections: PackList | undefined;
  runs: { columnStart: Uint32Array; first: Uint16Array; end: Uint16Array; roles: Uint8Array; sky: Float32Array } | undefined;
}

interface Exports {
  memory: WebAssembly.Memory;
  __wasm_call_ctors(): void;
  takePack(bytes: number): number;
  findPictures(): number;
  pictureFile(picture: number): number;
  pictureBytes(picture: number): number;
  takePicture(picture: number, width: number, height: number): number;
  readPack(exposure: number): number;
  message(): number;
}

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

/** A module's memory never shrinks: with more of it than this a new one takes its place. */
const kMostMemory = 64 << 20; // bytes

export class PageModule {
  private instance: Exports;

  /** `module`: of build/page/page.wasm. */
  constructor(private readonly module: WebAssembly.Module, private readonly zstandard: ZSTDDecoder) {
    this.instance = this.start();
  }

  private start(): Exports {
    const none = () => 52; // ENOSYS: there are no files and no environment
    const unpack = (into: number, room: number, from: number, bytes: number): number => {
      try {
        const raw = this.zstandard.decode(this.bytesAt(from, bytes), room);
        if (raw.length > room) return -1;
        this.bytesAt(into, raw.length).set(raw);
        return raw.length;
      } catch {
        return -1;
      }
    };
    const wasi = new Proxy({}, { get: () => none });
    const instance = new WebAssembly.Instance(this.module, { page: { unpack }, wasi_snapshot_preview1: wasi as WebAssembly.ModuleImports });
    const exports = instance.exports as unknown as Exports;
    exports.__wasm_call_ctors();
    return exports;
  }

  private bytesAt(address: number, bytes: number): Uint8Array {
    return new Uint8Array(this.instance.memory.buffer, address, bytes);
  }

  private get message(): string {
    const address = this.instance.message();
    const rest = new Uint8Array(this.instance.memory.buffer, address);
    return new TextDecoder().decode(rest.slice(0, rest.indexOf(0)));
  }

  /** What the module runs into ends it; the next file gets another. */
  private guarded<T>(body: () => T): T {
    try {
      return body();
    } catch (error) {
      if (error instanceof DamagedFile) throw error;
      this.instance = this.start();
      throw new DamagedFile('it takes more memory than there is');
    }
  }

  private takePack(pack: Uint8Array): number {
    const address = this.instance.takePack(pack.length);
    this.bytesAt(address, pack.length).set(pack);
    const pictures = this.instance.findPictures();
    if (pictures < 0) throw new DamagedFile(this.message);
    return pictures;
  }

  async read(pack: Uint8Array, exposure: number, decode: DecodePicture = decodeByBrowser): Promise<Pack> {
    const files = this.guarded(() =>
      Array.from({ length: this.takePack(pack) }, (_, i) =>
        this.bytesAt(this.instance.pictureFile(i), this.instance.pictureBytes(i)).slice(),
      ),
    );
    const pictures = await Promise.all(
      files.map((file) => decode(file).catch(() => { throw new DamagedFile('a picture of its colours cannot be decoded'); })),
    );
    return this.guarded(() => { // other packs may have been read since
      if (files.length > 0) {
        this.takePack(pack);
        pictures.forEach(({ width, height, rgba }, i) =>
          this.bytesAt(this.instance.takePicture(i, width, height), rgba.length).set(rgba),
        );
      }
      const address = this.instance.readPack(exposure);
      if (address === 0) throw new DamagedFile(this.message);
      const read = this.packAt(address);
      if (this.instance.memory.buffer.byteLength > kMostMemory) this.instance = this.start();
      return read;
    });
  }

  /** The PageCapture of page_module.cpp; copies what it names. */
  private packAt(address: number): Pack {
    const memory = this.instance.memory.buffer;
    const view = new DataView(memory, address);
    const word = (at: number) => view.getUint32(at, true);
    const columns = word(56), rows = word(60);
    const list = (at: number): PackList => {
      const samples = word(at), mirrors = word(at + 12);
      return {
        columnStart: new Uint32Array(memory, word(at + 4), columns + 1).slice(),
        words: new Uint32Array(memory, word(at + 8), 3 * samples).slice(),
        mirrors: mirrors === 0 ? undefined : new Uint8Array(memory, mirrors, samples).slice(),
      };
    };
    const runs = word(96);
    return {
      numbers: new Float64Array(memory, address, 7).slice(),
      columns, rows,
      surfaces: list(64),
      reflections: word(80) > 0 ? list(80) : undefined,
      runs: runs === 0 ? undefined : {
        columnStart: new Uint32Array(memory, word(100), columns + 1).slice(),
        first: new Uint16Array(memory, word(104), runs).slice(),
        end: new Uint16Array(memory, word(108), runs).slice(),
        roles: new Uint8Array(memory, word(112), runs).slice(),
        sky: new Float32Array(memory, address + 116, 9).slice(),
      },
    };
  }
}
