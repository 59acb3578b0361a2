/**
 * A capture as the graphics card takes it, from its pack. What is left on this side tells which of its samples a view may
 * show: ranges of inverse distances, tangents and roles, of columns and of blocks of successive samples.
 */

import { BlockFile, BlockFileKind, DamagedFile } from './block_file';
import { DisplayColours } from './colour';
import type { ColumnCamera } from './types';

export const kSamplesPerBlock = 64;
const kVersions = [4];

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

/** One behind the last of each column. */
function starts(counts: Uint32Array, all: number): Uint32Array {
  const start = new Uint32Array(counts.length + 1);
  let sum = 0;
  for (let k = 0; k < counts.length; ++k) {
    sum += counts[k];
    if (sum > all) throw new DamagedFile('its columns hold more than there is');
    start[k + 1] = sum;
  }
  if (sum !== all) throw new DamagedFile('its columns hold less than there is');
  return start;
}

function readSamples(
  file: BlockFile, camera: ColumnCamera, tangents: Float32Array, columnStart: Uint32Array, count: number, colours: DisplayColours,
): Samples {
  const [row, w, r, g, b, a, roles] = file.records([2, 4, 2, 2, 2, 2, 1], count);
  const blocks = new Uint32Array(camera.columns + 1);
  for (let k = 0; k < camera.columns; ++k)
    blocks[k + 1] = blocks[k] + Math.ceil((columnStart[k + 1] - columnStart[k]) / kSamplesPerBlock);
  const blockCount = blocks[camera.columns];
  const samples: Samples = {
    words: new Uint32Array(3 * count), count, columnStart,
    columnLeast: new Float32Array(camera.columns).fill(1),
    columnMost: new Float32Array(camera.columns),
    columnBlock: blocks,
    blockLeast: new Float32Array(blockCount), blockMost: new Float32Array(blockCount),
    blockLow: new Float32Array(blockCount), blockHigh: new Float32Array(blockCount),
    blockRoles: new Uint8Array(blockCount),
    mirrors: undefined, clearRanks: undefined, mostRanks: 0, ranks: undefined,
  };
  const words = samples.words;
  let blended = false;
  for (let k = 0; k < camera.columns; ++k) {
    const begin = columnStart[k], end = columnStart[k + 1];
    let least = Infinity, most = 0, before = 0;
    for (let i = begin, block = blocks[k]; i < end; ++block) {
      const last = Math.min(end, i + kSamplesPerBlock);
      let blockLeast = 0xffffffff, blockMost = 0, all = 0;
      samples.blockHigh[block] = tangents[row[i]];
      for (; i < last; ++i) {
        const bits = w[i] & 0xffffff00;
        const unsigned = bits >>> 0; // bits of floats that are not negative order as they do
        if (unsigned < blockLeast) blockLeast = unsigned;
        if (unsigned > blockMost) blockMost = unsigned;
        if (row[i] < before || row[i] >= camera.rows || (w[i] & 0x80000000) !== 0)
          throw new DamagedFile('its samples are not in order, or lie outside the picture');
        before = row[i];
        all |= roles[i];
        words[3 * i] = bits | roles[i];
        words[3 * i + 1] = row[i] | (k << 16);
        const colour = colours.encode(r[i], g[i], b[i], a[i]);
        words[3 * i + 2] = colour;
        if (colour < 0xff000000) blended = true;
      }
      samples.blockLow[block] = tangents[before];
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

/** Bytes of descriptions: without mirrors and silhouettes, with mirrors, and with silhouettes. */
const kDescriptions = [124, 132, 156];

/** What samples cover of their pixels, and their planes: the page draws whole samples. */
function skipSilhouettes(file: BlockFile, samples: number, planes: number): void {
  if (planes === 0) return;
  file.records([2, 4], samples);
  file.records([4, 4, 4, 1], planes);
}

export async function readCapture(bytes: Uint8Array, exposure: number): Promise<Capture> {
  const file = await BlockFile.open(bytes, BlockFileKind.capture, kVersions);
  const d = file.description;
  if (!kDescriptions.includes(d.byteLength)) throw new DamagedFile('its description has another length');
  const double = (i: number) => d.getFloat64(8 * i, true);
  const colour = (at: number): [number, number, number] => [
    d.getFloat32(at, true), d.getFloat32(at + 4, true), d.getFloat32(at + 8, true),
  ];
  const camera: ColumnCamera = {
    centre: [double(0), double(1), double(2)],
    lowAzimuth: double(3), fov: double(4), topElevation: double(5), bottomElevation: double(6),
    columns: d.getUint32(64, true), rows: d.getUint32(68, true),
  };
  checkCamera(camera);
  const samples = Number(d.getBigUint64(72, true)), runs = Number(d.getBigUint64(80, true));
  const reflections = d.byteLength >= 132 ? Number(d.getBigUint64(124, true)) : 0;
  const silhouettes = d.byteLength === 156;
  const tangents = rowTangents(camera), colours = new DisplayColours(exposure);
  const columnCounts = () => file.records([4], camera.columns)[0] as Uint32Array;

  const surfaces = readSamples(file, camera, tangents, starts(columnCounts(), samples), samples, colours);
  if (reflections > 0) surfaces.mirrors = file.records([1], samples)[0] as Uint8Array;
  if (silhouettes) skipSilhouettes(file, samples, Number(d.getBigUint64(132, true)));
  const capture: Capture = { camera, samples: surfaces, reflections: undefined, background: undefined };
  if (runs > 0) {
    const columnStart = starts(columnCounts(), runs);
    const [first, end, roles] = file.records([2, 2, 1], runs);
    const words = new Uint32Array(2 * runs);
    for (let i = 0; i < runs; ++i) {
      if (first[i] >= end[i] || end[i] > camera.rows) throw new DamagedFile('its background lies outside the picture');
      words[2 * i] = first[i] | (end[i] << 16);
      words[2 * i + 1] = roles[i];
    }
    capture.background = { columnStart, runs: words, zenith: colour(88), horizon: colour(100), ground: colour(112) };
  }
  if (reflections > 0) {
    const seen = readSamples(file, camera, tangents, starts(columnCounts(), reflections), reflections, colours);
    seen.mirrors = file.records([1], reflections)[0] as Uint8Array;
    if (silhouettes) skipSilhouettes(file, reflections, Number(d.getBigUint64(140, true)));
    capture.reflections = seen;
  }
  file.finish();
  return capture;
}

function checkCamera(camera: ColumnCamera): void {
  const { centre, lowAzimuth, fov, topElevation, bottomElevation, columns, rows } = camera;
  const finite = [...centre, lowAzimuth, fov, topElevation, bottomElevation].every(Number.isFinite);
  const limit = (89.91 * Math.PI) / 180;
  if (!finite || fov <= 0 || fov > Math.PI || topElevation > limit || bottomElevation < -limit || topElevation <= bottomElevation)
    throw new DamagedFile('its camera has impossible angles');
  if (columns < 1 || columns > 65535 || rows < 1 || rows > 65535) throw new DamagedFile('its camera has no sensible size');
}
