/**
 * What a frame draws of a capture: which of its samples a picture may show (engine/view/piece_planner.h). With a depth test
 * the order is free, so a piece becomes ranges of successive samples.
 */

import { azimuthAt, tangentAt, type Capture, type Samples } from '../bundle/capture';
import type { ColumnCamera, Piece, Region } from '../bundle/types';
import { ColumnTest, type FrustumPlanes } from '../geometry/culling';
import { exitOf } from '../geometry/polygon';
import { cross, directionOf, subtract2, subtract3, transform, type Mat3, type Vec2, type Vec3 } from '../geometry/vector';

/** A sample on the border itself is still drawn, however the bake rounded it. */
const kBorderSlack = 1e-4;
/** Samples that lie so much of its distance within a region's border may be the last of a surface that crosses it. */
const kBorderOverlap = 0.05;
/** Fewer samples than these between two ranges are drawn with them. */
const kGap = 96;

/** What of a capture's columns a piece draws, from wherever in the region one looks. */
export interface ColumnLimits {
  directions: Float64Array; // two each
  most: Float32Array; // largest inverse distance: nearer samples lie inside the grown region
  least: Float32Array; // smallest: farther ones lie outside the piece
  clips: boolean; // is any of them above 0?
}

export function columnLimits(camera: ColumnCamera, region: Region, piece: Piece): ColumnLimits {
  const limits: ColumnLimits = {
    directions: new Float64Array(2 * camera.columns),
    most: new Float32Array(camera.columns).fill(3e38),
    least: new Float32Array(camera.columns),
    clips: piece.clip !== undefined,
  };
  const centre: Vec2 = [camera.centre[0], camera.centre[1]];
  const line = piece.clip, along: Vec2 = line ? subtract2(line.to, line.from) : [0, 0];
  const away = line ? cross(along, subtract2(centre, line.from)) : 0; // > 0: the centre lies left
  for (let k = 0; k < camera.columns; ++k) {
    const direction = directionOf(azimuthAt(camera, k + 0.5));
    limits.directions[2 * k] = direction[0];
    limits.directions[2 * k + 1] = direction[1];
    const exit = exitOf(region.grown, centre, direction);
    if (exit !== undefined) limits.most[k] = (1 + kBorderSlack) / ((1 - kBorderOverlap) * exit);
    if (!line) continue;
    const rate = cross(along, direction);
    if (line.left ? rate < 0 : rate > 0) {
      const distance = -away / rate;
      limits.least[k] = distance > 0 ? (1 - kBorderSlack) / distance : 3e38;
    }
  }
  return limits;
}

export interface Ranges {
  firsts: Int32Array;
  counts: Int32Array;
  length: number;
  samples: number;
}

/** Pixels [x0, x1) x [y0, y1) of a picture, from its top left. */
export interface PixelBox {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

/** What is drawn falls into it. */
class GrowingBox {
  private box: PixelBox = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };

  constructor(private readonly width: number, private readonly height: number) {}

  /** A direction in picture coordinates (u z, v z, z). */
  add(x: number, y: number, z: number): void {
    if (z < 1e-3) {
      this.box = { x0: -Infinity, y0: -Infinity, x1: Infinity, y1: Infinity }; // beside the eye, or behind it
      return;
    }
    const { box } = this;
    box.x0 = Math.min(box.x0, x / z);
    box.x1 = Math.max(box.x1, x / z);
    box.y0 = Math.min(box.y0, y / z);
    box.y1 = Math.max(box.y1, y / z);
  }
  /** With a margin, within the picture; undefined where nothing is left. */
  within(margin: number): PixelBox | undefined {
    const { x0, y0, x1, y1 } = this.box;
    const clamp = (value: number, limit: number) => Math.min(limit, Math.max(0, value));
    const box = {
      x0: clamp(Math.floor(x0 - margin), this.width), y0: clamp(Math.floor(y0 - margin), this.height),
      x1: clamp(Math.ceil(x1 + margin), this.width), y1: clamp(Math.ceil(y1 + margin), this.height),
    };
    return box.x0 < box.x1 && box.y0 < box.y1 ? box : undefined;
  }
}

export const united = (a: PixelBox | undefined, b: PixelBox | undefined): PixelBox | undefined =>
  a && b
    ? { x0: Math.min(a.x0, b.x0), y0: Math.min(a.y0, b.y0), x1: Math.max(a.x1, b.x1), y1: Math.max(a.y1, b.y1) }
    : a ?? b;

/** Kept from frame to frame for its memory. */
export class RangeList implements Ranges {
  firsts = new Int32Array(4096);
  counts = new Int32Array(4096);
  length = 0;
  samples = 0;

  clear(): void {
    this.length = this.samples = 0;
  }

  add(first: number, end: number): void {
    const last = this.length - 1;
    if (last >= 0) {
      const before = this.firsts[last] + this.counts[last];
      if (first >= before && first - before <= kGap) {
        this.samples += end - before;
        this.counts[last] = end - this.firsts[last];
        return;
      }
    }
    if (this.length === this.firsts.length) {
      const [firsts, counts] = [this.firsts, this.counts];
      this.firsts = new Int32Array(2 * this.length);
      this.counts = new Int32Array(2 * this.length);
      this.firsts.set(firsts);
      this.counts.set(counts);
    }
    this.firsts[this.length] = first;
    this.counts[this.length++] = end - first;
    this.samples += end - first;
  }
}

/** What of the samples the picture may show, and for the shader 8 floats of each column, from `at` on in `columns`. */
export function planSamples(
  camera: ColumnCamera, samples: Samples, limits: ColumnLimits, roles: number, planes: FrustumPlanes, baseline: Vec3,
  picture: Mat3, ranges: RangeList, columns: Float32Array, at: number, samplesPerBlock: number, clearRank = -1,
): void {
  const test = new ColumnTest(planes, baseline);
  const lowRow = tangentAt(camera, camera.rows - 0.5), highRow = tangentAt(camera, 0.5);
  ranges.clear();
  const { directions } = limits;
  for (let k = 0; k < camera.columns; ++k) {
    columns[at + 8 * k + 3] = -1; // nothing, should another column's range run over it
    const x = directions[2 * k], y = directions[2 * k + 1];
    const most = limits.most[k], least = limits.least[k];
    const leastHere = Math.max(samples.columnLeast[k], least), mostHere = Math.min(samples.columnMost[k], most);
    if (leastHere > mostHere) continue;
    test.setColumn([x, y]);
    if (!test.mayShow(leastHere, mostHere, lowRow, highRow)) continue;
    const low = test.low, high = test.high;
    const begin = samples.columnStart[k], end = samples.columnStart[k + 1], first = samples.columnBlock[k];
    let any = false;
    for (let block = first; block < samples.columnBlock[k + 1]; ++block) {
      if (
        (clearRank >= 0 && samples.clearRanks![block] <= clearRank) || (samples.blockRoles[block] & roles) === 0 || samples.blockLeast[block] > most || samples.blockMost[block] < least ||
        samples.blockLow[block] > high || samples.blockHigh[block] < low ||
        !test.mayShow(
          Math.max(least, samples.blockLeast[block]), Math.min(most, samples.blockMost[block]),
          samples.blockLow[block], samples.blockHigh[block],
        )
      )
        continue;
      const from = begin + (block - first) * samplesPerBlock;
      ranges.add(from, Math.min(end, from + samplesPerBlock));
      any = true;
    }
    if (!any) continue;
    const to = at + 8 * k;
    columns[to] = picture[0] * x + picture[1] * y;
    columns[to + 1] = picture[3] * x + picture[4] * y;
    columns[to + 2] = picture[6] * x + picture[7] * y;
    columns[to + 3] = most;
    columns[to + 4] = least;
  }
}

/** Where a picture may show blended samples of a rank. */
export function clearExtent(
  camera: ColumnCamera, samples: Samples, limits: ColumnLimits, roles: number, planes: FrustumPlanes, baseline: Vec3,
  picture: Mat3, size: { width: number; height: number }, margin: number, clearRank: number,
): PixelBox | undefined {
  const box = new GrowingBox(size.width, size.height);
  const test = new ColumnTest(planes, baseline), b = transform(picture, baseline);
  for (let k = 0; k < camera.columns; ++k) {
    const x = limits.directions[2 * k], y = limits.directions[2 * k + 1];
    const most = limits.most[k], least = limits.least[k];
    let set = false;
    for (let block = samples.columnBlock[k]; block < samples.columnBlock[k + 1]; ++block) {
      if (samples.clearRanks![block] <= clearRank || (samples.blockRoles[block] & roles) === 0) continue;
      const from = Math.max(least, samples.blockLeast[block]), to = Math.min(most, samples.blockMost[block]);
      if (!set) test.setColumn([x, y]);
      set = true;
      if (!test.mayShow(from, to, samples.blockLow[block], samples.blockHigh[block])) continue;
      for (const w of [from, to])
        for (const t of [samples.blockLow[block], samples.blockHigh[block]])
          box.add(
            picture[0] * x + picture[1] * y + picture[2] * t + w * b[0],
            picture[3] * x + picture[4] * y + picture[5] * t + w * b[1],
            picture[6] * x + picture[7] * y + picture[8] * t + w * b[2],
          );
    }
  }
  return box.within(margin);
}

/** Where a picture may show background of this capture. */
export function backgroundExtent(
  capture: Capture, limits: ColumnLimits, planes: FrustumPlanes, picture: Mat3, size: { width: number; height: number },
): PixelBox | undefined {
  const { camera } = capture, { columnStart, runs } = capture.background!;
  const test = new ColumnTest(planes, [0, 0, 0]), box = new GrowingBox(size.width, size.height);
  for (let k = 0; k < camera.columns; ++k) {
    const first = columnStart[k], end = columnStart[k + 1];
    if (first === end || limits.least[k] > 0) continue;
    const low = tangentAt(camera, runs[2 * (end - 1)] >>> 16), high = tangentAt(camera, runs[2 * first] & 0xffff);
    test.setColumn([limits.directions[2 * k], limits.directions[2 * k + 1]]);
    if (!test.mayShow(0, 0, low, high)) continue;
    for (const side of [0, 1]) {
      const [x, y] = directionOf(azimuthAt(camera, k + side));
      for (const t of [test.low, test.high])
        box.add(
          picture[0] * x + picture[1] * y + picture[2] * t, picture[3] * x + picture[4] * y + picture[5] * t,
          picture[6] * x + picture[7] * y + picture[8] * t,
        );
    }
  }
  return box.within(2);
}

/** Where a picture shows these corners of triangles, three numbers each, relative to `origin`. */
export function cornersExtent(corners: Float32Array, origin: Vec3, eye: Vec3, picture: Mat3, size: { width: number; height: number }): PixelBox | undefined {
  const box = new GrowingBox(size.width, size.height), from = subtract3(origin, eye);
  for (let i = 0; i < corners.length; i += 3) {
    const q = transform(picture, [corners[i] + from[0], corners[i + 1] + from[1], corners[i + 2] + from[2]]);
    box.add(q[0], q[1], q[2]);
  }
  return box.within(1);
}
