/** The engine's part of the page, an instance of web/runtime: its memory, and what it refuses. */

import type { ZSTDDecoder } from 'zstddec';
import { DamagedFile } from '../bundle/file';

interface Common {
  memory: WebAssembly.Memory;
  __wasm_call_ctors(): void;
  message(): number;
}

/** zstd: what it unpacks to, or nothing. */
export type Unpack = (packed: Uint8Array, room: number) => Uint8Array | undefined;

export const unpackWith = (zstandard: ZSTDDecoder): Unpack => (packed, room) => {
  try {
    return zstandard.decode(packed, room);
  } catch {
    return undefined;
  }
};

export class EngineModule<Functions> {
  private exports: Functions & Common;
  ended = false; // it began anew since: what it held is gone

  /** `module`: of build/page/page.wasm. Without `unpack` it reads no packs. */
  constructor(private readonly module: WebAssembly.Module, private readonly unpack: Unpack = () => undefined) {
    this.exports = this.start();
  }

  private start(): Functions & Common {
    const none = () => 52; // ENOSYS: there are no files and no environment
    const unpack = (into: number, room: number, from: number, bytes: number): number => {
      const raw = this.unpack(this.bytes(from, bytes), room);
      if (!raw || raw.length > room) return -1;
      this.bytes(into, raw.length).set(raw);
      return raw.length;
    };
    const wasi = new Proxy({}, { get: () => none });
    const instance = new WebAssembly.Instance(this.module, { page: { unpack }, wasi_snapshot_preview1: wasi as WebAssembly.ModuleImports });
    const exports = instance.exports as unknown as Functions & Common;
    exports.__wasm_call_ctors();
    return exports;
  }

  get call(): Functions {
    return this.exports;
  }
  /** Its arrays are valid until the next call. */
  get memory(): ArrayBuffer {
    return this.exports.memory.buffer;
  }
  bytes(address: number, count: number): Uint8Array {
    return new Uint8Array(this.memory, address, count);
  }
  get message(): string {
    const rest = new Uint8Array(this.memory, this.exports.message());
    return new TextDecoder().decode(rest.slice(0, rest.indexOf(0)));
  }

  /** What is taken by a function that gives room for it. */
  give(room: (bytes: number) => number, value: Uint8Array | Uint8ClampedArray): void {
    this.bytes(room(value.length), value.length).set(value);
  }

  /** An empty one in its place: memory never shrinks. */
  restart(): void {
    this.exports = this.start();
  }

  /** What it runs into ends it; the next call has another. */
  guarded<T>(body: () => T): T {
    try {
      return body();
    } catch (error) {
      if (error instanceof DamagedFile) throw error;
      const why = this.message;
      this.restart();
      this.ended = true;
      throw new DamagedFile(why || 'it takes more memory than there is');
    }
  }
}
