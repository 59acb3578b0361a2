/**
 * A capture as the graphics card takes it, from its pack. What is left on this side tells which of its samples a view may
 * show: ranges of inverse distances, tangents and roles, of columns and of blocks of successive samples.
 */

import type { DecodePicture, PackList, PageModule } from './page_module';
import type { ColumnCamera } from './types';

export const kSamplesPerBlock = 64;

export interface Samples {
  /** Three words each: inverse distance with the roles in its last byte; row, and column in the high half; RGBA8. */
  words: Uint32Array;
  count: number;
  columnStart: Uint32Array; // columns + 1
  columnLeast: Float32Array; // inverse distances; an empty column has least > most
  columnMost: Float32Array;
  columnBlock: Uint32Array; // columns + 1
  blockLeast: Float32Array;
  blockMost: Float32Array;
  blockLow: Float32Array; // row tangents
  blockHigh: Float32Array;
  blockRoles: Uint8Array;
  mirrors: Uint8Array | undefined; // whose each sample is, 0 = none
  clearRanks: Uint8Array | undefined; // by block: the highest rank of its clear samples, plus one; undefined: all are opaque
  mostRanks: number; // the highest of those
  ranks: Uint8Array | undefined; // of each clear sample: how many lie nearer in its pixel
}

export interface Background {
  columnStart: Uint32Array; // columns + 1
  runs: Uint32Array; // two words each: first row, and one below the last in the high half; roles
  zenith: [number, number, number]; // radiance
  horizon: [number, number, number];
  ground: [number, number, number];
}

export interface Capture {
  camera: ColumnCamera;
  samples: Samples;
  reflections: Samples | undefined;
  background: Background | undefined;
}

export const kMostClearRanks = 8;

const floatBits = new Uint32Array(1);
const floatValue = new Float32Array(floatBits.buffer);
const floatOf = (bits: number): number => {
  floatBits[0] = bits;
  return floatValue[0];
};

export const bytesOfSamples = (s: Samples): number => s.words.byteLength + (s.mirrors?.byteLength ?? 0) + (s.ranks?.byteLength ?? 0);
/** On the graphics card. */
export const bytesOfCapture = (c: Capture): number =>
  bytesOfSamples(c.samples) + (c.reflections ? bytesOfSamples(c.reflections) : 0) + (c.background?.runs.byteLength ?? 0);

export const tangentAt = (camera: ColumnCamera, y: number): number =>
  Math.tan(camera.topElevation - (y * (camera.topElevation - camera.bottomElevation)) / camera.rows);

export const azimuthAt = (camera: ColumnCamera, x: number): number => camera.lowAzimuth + (x * camera.fov) / camera.columns;

/** What a view needs to know of samples before it draws them. */
function readSamples({ columnStart, words, mirrors }: PackList, camera: ColumnCamera, tangents: Float32Array): Samples {
  const blocks = new Uint32Array(camera.columns + 1);
  for (let k = 0; k < camera.columns; ++k)
    blocks[k + 1] = blocks[k] + Math.ceil((columnStart[k + 1] - columnStart[k]) / kSamplesPerBlock);
  const blockCount = blocks[camera.columns];
  const samples: Samples = {
    words, count: words.length / 3, columnStart,
    columnLeast: new Float32Array(camera.columns).fill(1),
    columnMost: new Float32Array(camera.columns),
    columnBlock: blocks,
    blockLeast: new Float32Array(blockCount), blockMost: new Float32Array(blockCount),
    blockLow: new Float32Array(blockCount), blockHigh: new Float32Array(blockCount),
    blockRoles: new Uint8Array(blockCount),
    mirrors, clearRanks: undefined, mostRanks: 0, ranks: undefined,
  };
  let blended = false;
  for (let k = 0; k < camera.columns; ++k) {
    const begin = columnStart[k], end = columnStart[k + 1];
    let least = Infinity, most = 0;
    for (let i = begin, block = blocks[k]; i < end; ++block) {
      const first = i, last = Math.min(end, i + kSamplesPerBlock);
      let blockLeast = 0xffffffff, blockMost = 0, all = 0;
      for (; i < last; ++i) {
        const word = words[3 * i], unsigned = (word & 0xffffff00) >>> 0; // bits of floats that are not negative order as they do
        if (unsigned < blockLeast) blockLeast = unsigned;
        if (unsigned > blockMost) blockMost = unsigned;
        all |= word & 0xff;
        if (words[3 * i + 2] < 0xff000000) blended = true;
      }
      samples.blockHigh[block] = tangents[words[3 * first + 1] & 0xffff];
      samples.blockLow[block] = tangents[words[3 * last - 2] & 0xffff];
      samples.blockLeast[block] = floatOf(blockLeast);
      samples.blockMost[block] = floatOf(blockMost);
      samples.blockRoles[block] = all;
      least = Math.min(least, samples.blockLeast[block]);
      most = Math.max(most, samples.blockMost[block]);
    }
    if (begin < end) {
      samples.columnLeast[k] = least;
      samples.columnMost[k] = most;
    }
  }
  if (blended) rankClear(samples, camera.columns);
  return samples;
}

/** Blended samples are drawn one rank at a time, so that the splats of one pane tint a pixel once. */
function rankClear(samples: Samples, columns: number): void {
  const { words, columnStart } = samples;
  const ranks = new Uint8Array(samples.count), most = new Uint8Array(samples.blockRoles.length);
  for (let k = 0; k < columns; ++k) {
    let inPixel = 0;
    for (let i = columnStart[k]; i < columnStart[k + 1]; ++i) {
      if (i === columnStart[k] || words[3 * i + 1] !== words[3 * i - 2]) inPixel = 0;
      if (words[3 * i + 2] >= 0xff000000) continue;
      ranks[i] = Math.min(inPixel++, kMostClearRanks - 1);
      const block = samples.columnBlock[k] + Math.floor((i - columnStart[k]) / kSamplesPerBlock);
      most[block] = Math.max(most[block], ranks[i] + 1);
    }
  }
  samples.ranks = ranks;
  samples.clearRanks = most;
  samples.mostRanks = most.reduce((a, b) => Math.max(a, b), 0);
}

/** Row tangents at the rows' middles. */
export const rowTangents = (camera: ColumnCamera): Float32Array =>
  Float32Array.from({ length: camera.rows }, (_, row) => tangentAt(camera, row + 0.5));

export async function readCapture(module: PageModule, bytes: Uint8Array, exposure: number, decode?: DecodePicture): Promise<Capture> {
  const pack = await module.read(bytes, exposure, decode);
  const [x, y, z, lowAzimuth, fov, topElevation, bottomElevation] = pack.numbers;
  const camera: ColumnCamera = {
    centre: [x, y, z], lowAzimuth, fov, topElevation, bottomElevation, columns: pack.columns, rows: pack.rows,
  };
  const tangents = rowTangents(camera);
  const capture: Capture = {
    camera,
    samples: readSamples(pack.surfaces, camera, tangents),
    reflections: pack.reflections && readSamples(pack.reflections, camera, tangents),
    background: undefined,
  };
  if (pack.runs) {
    const { columnStart, first, end, roles, sky } = pack.runs;
    const runs = new Uint32Array(2 * first.length);
    for (let i = 0; i < first.length; ++i) {
      runs[2 * i] = first[i] | (end[i] << 16);
      runs[2 * i + 1] = roles[i];
    }
    const colour = (at: number): [number, number, number] => [sky[at], sky[at + 1], sky[at + 2]];
    capture.background = { columnStart, runs, zenith: colour(0), horizon: colour(3), ground: colour(6) };
  }
  return capture;
}
