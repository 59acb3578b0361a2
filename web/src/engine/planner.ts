/** What a frame draws (web/runtime/plan_frame.cpp), from the index and what of each capture planning needs. */

import { DamagedFile } from '../bundle/file';
import type { View } from '../geometry/view';
import { EngineModule } from './module';

interface Functions {
  takeBytes(bytes: number): number;
  openIndex(): number;
  addCapture(firstTexel: number): number;
  dropCapture(number: number): void;
  useCaptures(count: number): number;
  planFrame(
    storey: number, region: number, x: number, y: number, z: number, yaw: number, pitch: number, fov: number,
    width: number, height: number,
  ): number;
}

/** For shaders: engine/view/patch_tables.h. Four words a texel, but one for the list. */
export interface PatchTables {
  patches: Uint32Array;
  pieces: Uint32Array;
  tiles: Uint8Array; // kTileBytes each
  list: Uint32Array;
}
export const kTileBytes = 12, kPatchTexels = 5, kPieceTexels = 3;

/** Where a capture shows the background. */
export interface PlannedBackground {
  capture: number;
  roles: number;
  columns: Uint32Array; // of each the first run and one behind the last
  part: number; // 0 = all of the view, 1 = between two directions, 2 = of more than half a turn
  low: readonly [number, number];
  high: readonly [number, number];
  middle: readonly [number, number]; // direction of the middle column
  columnsPerRadian: number;
  rowsPerRadian: number;
  topElevation: number;
  zenith: readonly [number, number, number];
  horizon: readonly [number, number, number];
  ground: readonly [number, number, number];
}

/** Valid until the next call. */
export interface FramePlan {
  surfaces: PatchTables; // of the first cover
  behind: PatchTables; // of the second
  reflections: PatchTables;
  backgrounds: PlannedBackground[];
  mirrors: boolean; // is anything to be shown in mirrors?
}

export class Planner {
  private readonly engine: EngineModule<Functions>;

  /** `index`: bundle.json. */
  constructor(module: WebAssembly.Module, index: string) {
    this.engine = new EngineModule<Functions>(module);
    this.open(index);
  }

  /** Another part of the same walk: captures stay. */
  open(index: string): void {
    const { engine } = this;
    engine.guarded(() => {
      engine.give(engine.call.takeBytes, new TextEncoder().encode(index));
      if (engine.call.openIndex() === 0) throw new DamagedFile(engine.message);
    });
  }

  /** Its number. */
  addCapture(part: Uint8Array, firstTexel: number): number {
    const { engine } = this;
    engine.give(engine.call.takeBytes, part);
    return engine.call.addCapture(firstTexel);
  }
  dropCapture = (number: number): void => this.engine.call.dropCapture(number);

  /** `captures`: pairs of cameras and the numbers of their captures. Undefined where the region shows nothing. */
  plan(storey: number, region: number, view: View, captures: readonly (readonly [number, number])[]): FramePlan | undefined {
    const { engine } = this;
    const used = engine.call.useCaptures(captures.length);
    new Int32Array(engine.memory, used, 2 * captures.length).set(captures.flat());
    const fov = 2 * Math.atan((0.5 * view.width) / view.focal);
    const address = engine.call.planFrame(storey, region, ...view.eye, view.yaw, view.pitch, fov, view.width, view.height);
    return address === 0 ? undefined : this.frameAt(address);
  }

  /** The PageFrame of plan_frame.cpp. */
  private frameAt(address: number): FramePlan {
    const { memory } = this.engine, words = new Uint32Array(memory, address, 27);
    const tables = (at: number): PatchTables => ({
      patches: new Uint32Array(memory, words[at + 1], 4 * kPatchTexels * words[at]),
      pieces: new Uint32Array(memory, words[at + 3], 4 * kPieceTexels * words[at + 2]),
      tiles: new Uint8Array(memory, words[at + 5], kTileBytes * words[at + 4]),
      list: new Uint32Array(memory, words[at + 7], words[at + 6]),
    });
    const kBackgroundBytes = 92;
    return {
      surfaces: tables(0), behind: tables(8), reflections: tables(16),
      backgrounds: Array.from({ length: words[24] }, (_, i) => this.backgroundAt(words[25] + kBackgroundBytes * i)),
      mirrors: words[26] !== 0,
    };
  }

  private backgroundAt(address: number): PlannedBackground {
    const { memory } = this.engine, view = new DataView(memory, address);
    const word = (at: number) => view.getUint32(4 * at, true), float = (at: number) => view.getFloat32(4 * at, true);
    const pair = (at: number) => [float(at), float(at + 1)] as const;
    const colour = (at: number) => [float(at), float(at + 1), float(at + 2)] as const;
    return {
      capture: word(0), roles: word(1), columns: new Uint32Array(memory, word(3), 2 * word(2)),
      part: word(4), low: pair(5), high: pair(7), middle: pair(9),
      columnsPerRadian: float(11), rowsPerRadian: float(12), topElevation: float(13),
      zenith: colour(14), horizon: colour(17), ground: colour(20),
    };
  }
}
