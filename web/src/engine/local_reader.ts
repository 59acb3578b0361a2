/** Local geometry of a region as the graphics card takes it (web/runtime/read_local.cpp). */

import type { ZSTDDecoder } from 'zstddec';
import { DamagedFile } from '../bundle/file';
import type { Vec3 } from '../geometry/vector';
import { EngineModule, unpackWith } from './module';

export const kNoPlane = 0xff;

/** Floats of one corner: position, barycentric weights, two uv; then colour, first light sample, resolution, normal. */
export const kCornerBytes = 64;

/** Consecutive triangles of one material and one set of attributes. */
export interface LocalBatch {
  material: number;
  colours: boolean;
  baseUv: boolean;
  emissiveUv: boolean;
  clear: boolean; // may it be?
  plane: number; // mirror plane, or kNoPlane
  firstTriangle: number;
  triangles: number;
}

export interface LocalGeometry {
  origin: Vec3; // of positions
  corners: Uint8Array; // kCornerBytes each, three a triangle
  triangles: number;
  batches: LocalBatch[]; // those that can be clear come last
  firstClear: number; // triangle
  clearPositions: Float32Array; // three corners a clear triangle, for sorting
  light: Uint16Array | undefined; // four halves a sample
  mirrors: boolean;
}

export const bytesOfLocal = (g: LocalGeometry): number => g.corners.byteLength + (g.light?.byteLength ?? 0);

interface Functions {
  takeBytes(bytes: number): number;
  openIndex(): number;
  readLocal(x: number, y: number, z: number): number;
}

export class LocalReader {
  private engine: EngineModule<Functions> | undefined; // with the index open

  /** `index`: bundle.json. */
  constructor(private readonly module: WebAssembly.Module, private readonly zstandard: ZSTDDecoder, private readonly index: string) {}

  private open(): EngineModule<Functions> {
    if (this.engine) return this.engine;
    const engine = new EngineModule<Functions>(this.module, unpackWith(this.zstandard));
    engine.guarded(() => {
      engine.give(engine.call.takeBytes, new TextEncoder().encode(this.index));
      if (engine.call.openIndex() === 0) throw new DamagedFile(engine.message);
    });
    return (this.engine = engine);
  }

  /** `origin`: positions are relative to it, so that floats keep their digits. */
  read(file: Uint8Array, origin: Vec3): LocalGeometry {
    const engine = this.open();
    try {
      return engine.guarded(() => {
        engine.give(engine.call.takeBytes, file);
        const address = engine.call.readLocal(...origin);
        if (address === 0) throw new DamagedFile(engine.message);
        return this.localAt(engine.memory, address, origin);
      });
    } finally {
      if (engine.ended) this.engine = undefined;
    }
  }

  /** The PageLocal of read_local.cpp; copies what it names. */
  private localAt(memory: ArrayBuffer, address: number, origin: Vec3): LocalGeometry {
    const [corners, cornersAt, batches, batchesAt, clear, clearAt, samples, lightAt, firstClear, lit, mirrors] = new Uint32Array(memory, address, 11);
    const words = new Uint32Array(memory, batchesAt, 5 * batches);
    return {
      origin, firstClear, mirrors: mirrors !== 0, triangles: corners / 3,
      corners: new Uint8Array(memory, cornersAt, kCornerBytes * corners).slice(),
      batches: Array.from({ length: batches }, (_, i) => {
        const [material, flags, plane, firstTriangle, triangles] = words.subarray(5 * i, 5 * i + 5);
        const has = (bit: number) => (flags & bit) !== 0;
        return { material, colours: has(1), baseUv: has(2), emissiveUv: has(4), clear: has(8), plane, firstTriangle, triangles };
      }),
      clearPositions: new Float32Array(memory, clearAt, 3 * clear).slice(),
      light: lit !== 0 ? new Uint16Array(memory, lightAt, 4 * samples).slice() : undefined,
    };
  }
}
