/** The ground of all storeys, as an eye is carried over it: level floors, and stairs and ramps between them. As engine/pipeline/walk_ground. */

import type { Storey } from '../bundle/types';
import { borderDistance, insideRings } from './polygon';
import { walkInSteps, type RegionIndex } from './regions';
import type { Vec2 } from './vector';

/** Metres: from ground to ground; layouts of one floor; within which one's ground goes over to another's; that another's cameras must fit better. */
const kStepApart = 0.35, kSameGround = 0.05, kGoesOver = 0.3, kAsGood = 0.03;
const kLeastRise = 0.01; // metres per metre: a landing has no ends
const kGrain = 0.01; // metres that a walk goes at once

export interface Footing {
  storey: number;
  place: Vec2;
  ground: number; // z
}

export class StoreyGround {
  /** `regionsOf`: what is known of a storey's regions; undefined where it is nothing. */
  constructor(private readonly storeys: readonly Storey[], private readonly regionsOf: (storey: number) => RegionIndex | undefined) {}

  /** Are there stairs? Else a walk stays on its storey. */
  get rises(): boolean {
    return this.storeys.some((storey) => storey.slope);
  }

  private groundAt({ floorHeight, slope }: Storey, place: Vec2): number {
    return floorHeight + (slope ? slope.rise[0] * (place[0] - slope.at[0]) + slope.rise[1] * (place[1] - slope.at[1]) : 0);
  }

  private holds(number: number, place: Vec2): boolean {
    const { outline } = this.storeys[number];
    if (outline.length > 0 && !insideRings(outline, place)) return false;
    const regions = this.regionsOf(number);
    return regions ? regions.mayStand(place) : outline.length > 0;
  }

  private joined(from: number, to: number): boolean {
    const a = this.storeys[from], b = this.storeys[to];
    return from === to || !!a.slope || !!b.slope || Math.abs(a.floorHeight - b.floorHeight) > kSameGround;
  }

  /** Standing on a storey; undefined where one may not. */
  on(storey: number, place: Vec2): Footing | undefined {
    return this.beside({ storey, place, ground: this.groundAt(this.storeys[storey], place) }, place);
  }

  /** Metres from where a storey ends, kGoesOver at most, and never quite 0: for stairs their ends, not their sides. */
  private within({ outline, slope }: Storey, place: Vec2): number {
    let away = kGoesOver;
    const rise = slope ? Math.hypot(...slope.rise) : 0;
    if (slope && rise >= kLeastRise && outline.length > 0) {
      const along = (p: Vec2) => (p[0] * slope.rise[0] + p[1] * slope.rise[1]) / rise;
      const ends = outline.flatMap((ring) => ring.map(along)), at = along(place);
      away = Math.min(at - Math.min(...ends), Math.max(...ends) - at);
    } else if (outline.length > 0) away = borderDistance(outline, place);
    return Math.max(1e-9, Math.min(kGoesOver, away));
  }

  /** Coming from nearby: on the storey whose cameras are at the most fitting height. A piece of stairs counts by how far from its ends one is, a floor by what they leave. */
  beside(from: Footing, place: Vec2): Footing | undefined {
    const holding: number[] = [];
    let stairs = 0; // what pieces count, up to all of it
    this.storeys.forEach((storey, number) => {
      if (Math.abs(this.groundAt(storey, place) - from.ground) > kStepApart || !this.joined(from.storey, number) || !this.holds(number, place)) return;
      holding.push(number);
      if (storey.slope) stairs = Math.min(1, stairs + this.within(storey, place) / kGoesOver);
    });
    if (holding.length === 0) return undefined;
    let sum = 0, ground = 0;
    for (const number of holding) {
      const storey = this.storeys[number];
      const weight = (storey.slope ? 1 : 1 + 1e-9 - stairs) * this.within(storey, place);
      sum += weight;
      ground += weight * this.groundAt(storey, place);
    }
    ground /= sum;
    const misfit = (number: number) => Math.abs(ground - this.storeys[number].floorHeight) - (number === from.storey ? kAsGood : 0);
    return { storey: holding.reduce((best, number) => (misfit(number) < misfit(best) ? number : best)), place, ground };
  }

  /** Where a walk from where one may stand towards `to` ends: along walls, never through them, and over stairs. */
  walk(from: Footing, to: Vec2): Footing {
    let at = from;
    walkInSteps(from.place, to, kGrain, (next) => {
      const footing = this.beside(at, next);
      if (footing) at = footing;
      return footing !== undefined;
    });
    return at;
  }
}
