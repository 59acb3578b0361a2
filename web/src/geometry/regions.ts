/** Which region holds a point, which capture cover it is drawn from, and where a walker may stand. */

import type { Cover, Region, Storey } from '../bundle/types';
import { boxOf, centroid, contains, insideRings, nearestOnBorder, type Box } from './polygon';
import { cross, directionOf, distance2, subtract2, type Vec2 } from './vector';

/** Finds regions by a grid over their polygons. */
export class RegionIndex {
  readonly box: Box;
  private readonly cells = new Map<number, number[]>();
  private readonly size: number;
  private readonly across: number;

  constructor(readonly storey: Storey) {
    this.box = boxOf(storey.regions.flatMap((region) => [...region.polygon]));
    const width = Math.max(this.box.max[0] - this.box.min[0], this.box.max[1] - this.box.min[1], 1e-6);
    this.size = width / Math.max(1, Math.ceil(Math.sqrt(storey.regions.length)));
    this.across = Math.ceil(width / this.size) + 1;
    storey.regions.forEach((region, number) => {
      const own = boxOf(region.polygon);
      for (let y = this.cellAt(own.min[1], 1); y <= this.cellAt(own.max[1], 1); ++y)
        for (let x = this.cellAt(own.min[0], 0); x <= this.cellAt(own.max[0], 0); ++x) {
          const key = y * this.across + x;
          const list = this.cells.get(key);
          if (list) list.push(number);
          else this.cells.set(key, [number]);
        }
    });
  }

  private cellAt(value: number, axis: 0 | 1): number {
    return Math.min(this.across - 1, Math.max(0, Math.floor((value - this.box.min[axis]) / this.size)));
  }

  /** The region that holds the point, on shared borders the one with the lowest number; -1 outside all. */
  regionAt(point: Vec2): number {
    const near = this.cells.get(this.cellAt(point[1], 1) * this.across + this.cellAt(point[0], 0)) ?? [];
    for (const number of near) if (contains(this.storey.regions[number].polygon, point)) return number;
    return -1;
  }

  mayStand(point: Vec2): boolean {
    const { outline } = this.storey;
    return this.regionAt(point) >= 0 && (outline.length === 0 || insideRings(outline, point));
  }

  /** The point itself, or about the nearest one where one may stand. */
  nearestStanding(point: Vec2): Vec2 {
    if (this.mayStand(point)) return point;
    let best: Vec2 | undefined;
    const consider = (candidate: Vec2, towards: Vec2) => {
      // A little inside, so that rounding does not put it beside the border.
      const inside: Vec2 = [candidate[0] + 1e-3 * (towards[0] - candidate[0]), candidate[1] + 1e-3 * (towards[1] - candidate[1])];
      if (this.mayStand(inside) && (!best || distance2(inside, point) < distance2(best, point))) best = inside;
    };
    for (const region of this.storey.regions) {
      const middle = centroid(region.polygon);
      consider(contains(region.polygon, point) ? point : nearestOnBorder(region.polygon, point), middle);
      for (const ring of this.storey.outline) {
        const onRing = nearestOnBorder(ring, point);
        for (const towards of [point, [2 * onRing[0] - point[0], 2 * onRing[1] - point[1]] as Vec2, middle]) consider(onRing, towards);
      }
      consider(middle, middle);
    }
    return best ?? point;
  }

  /** Where a walk from `from`, where one may stand, towards `to` ends: along walls, never through them. */
  walk(from: Vec2, to: Vec2): Vec2 {
    let at = from;
    walkInSteps(from, to, 0.01 * this.size, (next) => {
      const stands = this.mayStand(next);
      if (stands) at = next;
      return stands;
    });
    return at;
  }
}

const kTurns = [0, 0.3, -0.3, 0.6, -0.6, 0.9, -0.9, 1.2, -1.2, 1.45, -1.45];

/** In short steps, each turned aside as little as it takes; `standAt` says whether it can be made, and makes it. */
export function walkInSteps(from: Vec2, to: Vec2, grain: number, standAt: (next: Vec2) => boolean): void {
  const steps = Math.max(1, Math.ceil(distance2(from, to) / grain));
  const step: Vec2 = [(to[0] - from[0]) / steps, (to[1] - from[1]) / steps];
  let at = from;
  for (let i = 0; i < steps; ++i) {
    const taken = kTurns.some((turn) => {
      const c = Math.cos(turn), s = Math.sin(turn);
      const next: Vec2 = [at[0] + c * (c * step[0] - s * step[1]), at[1] + c * (s * step[0] + c * step[1])];
      const stands = standAt(next);
      if (stands) at = next;
      return stands;
    });
    if (!taken) return;
  }
}

/** The first cover that the eye is drawn from: the hand by which side of the viewing ray the region's middle lies on. */
export function chooseCover(region: Region, eye: Vec2, yaw: number): Cover | undefined {
  const left = cross(directionOf(yaw), subtract2(centroid(region.polygon), eye)) >= 0;
  const hand = left ? 'counterClockwise' : 'clockwise';
  return region.covers.find((cover) => cover.hand === hand) ?? region.covers[0];
}

/** All that a region draws from: panoramas and the other cover first (they lie behind), the chosen cover last. */
export function coversFor(region: Region, eye: Vec2, yaw: number): { first: Cover | undefined; behind: Cover[] } {
  const first = chooseCover(region, eye, yaw);
  return { first, behind: [...region.panoramas, ...region.covers.filter((cover) => cover !== first)] };
}

/** Cameras of all of a region's pieces. */
export function camerasOf(region: Region): Set<number> {
  const cameras = new Set<number>();
  for (const cover of [...region.covers, ...region.panoramas]) for (const piece of cover.pieces) cameras.add(piece.camera);
  return cameras;
}

