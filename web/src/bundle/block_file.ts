/** The frame of packs and local geometry (engine/store/FORMAT.md, "Block files"), from bytes that hold one whole file. */

import { xxhash128 } from 'hash-wasm';
import { ZSTDDecoder } from 'zstddec';

export enum BlockFileKind {
  local = 4,
}

/** What is wrong with a file, in a sentence without its name. */
export class DamagedFile extends Error {}

const kMagic = [0x41, 0x43, 0x45, 0x4e, 0x50, 0x4b, 0x0d, 0x0a];
const kPreamble = 56;
const kChecksum = 16;
const kRecordsPerBlock = 65536;
const kLargestBlock = 16 << 20;

let decoder: Promise<ZSTDDecoder> | undefined;
export function zstd(): Promise<ZSTDDecoder> {
  decoder ??= (async () => {
    const made = new ZSTDDecoder();
    await made.init();
    return made;
  })();
  return decoder;
}

/** XXH3 with 128 bits and seed 0, as 32 hexadecimal digits, high half first. */
export const contentHash = (bytes: Uint8Array): Promise<string> => xxhash128(bytes, 0, 0);

/** Makes ready what the first file needs. */
export async function warmUp(): Promise<void> {
  await Promise.all([zstd(), contentHash(new Uint8Array(1))]);
}

const hexOf = (value: bigint): string => value.toString(16).padStart(16, '0');

export class BlockFile {
  readonly key: string;
  readonly version: number;
  readonly description: DataView;
  private readonly sizes: { raw: number; stored: number }[] = [];
  private at: number;
  private block = 0;

  private constructor(
    private readonly bytes: Uint8Array,
    private readonly zstandard: ZSTDDecoder,
    kind: BlockFileKind,
    versions: readonly number[],
  ) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    if (bytes.length < kPreamble + kChecksum || kMagic.some((byte, i) => bytes[i] !== byte))
      throw new DamagedFile('this is not a block file');
    this.version = view.getUint32(8, true);
    if (view.getUint32(12, true) !== kind) throw new DamagedFile(`kind ${view.getUint32(12, true)} where ${kind} belongs`);
    if (!versions.includes(this.version))
      throw new DamagedFile(`version ${this.version}, this page reads ${versions.join(' and ')}: export again, or take its own page`);
    if (view.getBigUint64(32, true) !== BigInt(bytes.length)) throw new DamagedFile('it is cut off, or too long');
    this.key = hexOf(view.getBigUint64(16, true)) + hexOf(view.getBigUint64(24, true));
    const described = view.getUint32(48, true), blocks = view.getUint32(52, true);
    const table = kPreamble + described;
    if (table + 8 * blocks + kChecksum > bytes.length) throw new DamagedFile('its table of blocks is longer than the file');
    this.description = new DataView(bytes.buffer, bytes.byteOffset + kPreamble, described);
    this.at = table + 8 * blocks;
    let end = this.at;
    for (let i = 0; i < blocks; ++i) {
      const size = { raw: view.getUint32(table + 8 * i, true), stored: view.getUint32(table + 8 * i + 4, true) };
      if (size.raw > kLargestBlock) throw new DamagedFile('a block is larger than any can be');
      end += size.stored;
      this.sizes.push(size);
    }
    if (end + kChecksum > bytes.length) throw new DamagedFile('its blocks are longer than the file');
  }

  /** Checks the file's own checksum and all sizes. */
  static async open(bytes: Uint8Array, kind: BlockFileKind, versions: readonly number[]): Promise<BlockFile> {
    const file = new BlockFile(bytes, await zstd(), kind, versions);
    const end = new DataView(bytes.buffer, bytes.byteOffset + bytes.length - kChecksum, kChecksum);
    const stored = hexOf(end.getBigUint64(0, true)) + hexOf(end.getBigUint64(8, true));
    if ((await contentHash(bytes.subarray(0, bytes.length - kChecksum))) !== stored)
      throw new DamagedFile('its contents do not fit its checksum');
    return file;
  }

  get rawBytes(): number {
    return this.sizes.reduce((sum, size) => sum + size.raw, 0);
  }

  private nextBlock(size: number): Uint8Array {
    const sizes = this.sizes[this.block++];
    if (sizes === undefined || sizes.raw !== size) throw new DamagedFile('a block has another size than its records');
    const packed = this.bytes.subarray(this.at, this.at + sizes.stored);
    this.at += sizes.stored;
    const raw = this.zstandard.decode(packed, size);
    if (raw.length !== size) throw new DamagedFile('a block does not unpack');
    return raw;
  }

  /** Arrays of `count` values, one for each field of 1, 2 or 4 bytes. */
  records(widths: readonly (1 | 2 | 4)[], count: number): (Uint8Array | Uint16Array | Uint32Array)[] {
    const bytesEach = widths.reduce<number>((sum, width) => sum + width, 0);
    const left = this.sizes.slice(this.block).reduce((sum, size) => sum + size.raw, 0);
    if (!Number.isSafeInteger(count) || count * bytesEach > left) throw new DamagedFile('it names more records than it holds');
    const fields = widths.map((width) =>
      width === 1 ? new Uint8Array(count) : width === 2 ? new Uint16Array(count) : new Uint32Array(count),
    );
    for (let first = 0; first < count; first += kRecordsPerBlock) {
      const m = Math.min(kRecordsPerBlock, count - first);
      const raw = this.nextBlock(m * bytesEach);
      let at = 0;
      for (let f = 0; f < widths.length; ++f) {
        unpackField(raw, at, fields[f], first, m);
        at += m * widths[f];
      }
    }
    return fields;
  }

  /** Fails where something is left over. */
  finish(): void {
    if (this.block !== this.sizes.length) throw new DamagedFile('it holds more blocks than it describes');
  }
}

/** Planes of bytes, lowest first, of differences from the value before. */
function unpackField(raw: Uint8Array, at: number, out: Uint8Array | Uint16Array | Uint32Array, first: number, m: number): void {
  let value = 0;
  if (out instanceof Uint8Array)
    for (let i = 0; i < m; ++i) out[first + i] = value = (value + raw[at + i]) & 0xff;
  else if (out instanceof Uint16Array)
    for (let i = 0; i < m; ++i) out[first + i] = value = (value + (raw[at + i] | (raw[at + m + i] << 8))) & 0xffff;
  else
    for (let i = 0; i < m; ++i) {
      const step = raw[at + i] | (raw[at + m + i] << 8) | (raw[at + 2 * m + i] << 16) | (raw[at + 3 * m + i] << 24);
      out[first + i] = value = (value + step) >>> 0;
    }
}
