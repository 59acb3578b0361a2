import { describe, expect, it } from 'vitest';
import type { Polygon } from '../src/geometry/polygon';
import type { Storey } from '../src/bundle/types';
import { StoreyGround } from '../src/geometry/ground';
import { RegionIndex } from '../src/geometry/regions';

const box = (x0: number, x1: number): Polygon => [[x0, 0], [x1, 0], [x1, 2], [x0, 2]];

const storey = (name: string, x0: number, x1: number, floorHeight: number, slope?: Storey['slope']): Storey => ({
  name, floorHeight, slope, eyeZ: floorHeight + 1.6, nearBand: 1, start: { position: [x0 + 0.1, 1], yaw: 0 }, outline: [box(x0, x1)],
  cameras: [], topElevation: 1, bottomElevation: -1, regionCount: 1,
  regions: [{ number: 0, polygon: box(x0, x1), neighbours: [], covers: [], panoramas: [], local: undefined }],
});

/** Floors at 0 and 1.2 m, between them pieces of a slope of 0.5 that rise 0.4 m each; a cellar floor far below all of it. */
const pieces = [0, 1, 2].map((k) =>
  storey(`stairs 1.${k + 1}`, 4 + 0.8 * k - 0.2, 4.8 + 0.8 * k + 0.2, 0.2 + 0.4 * k, { at: [4.4 + 0.8 * k, 1], rise: [0.5, 0] }));
const storeys = [storey('below', 0, 4.2, 0), ...pieces, storey('above', 6.2, 10, 1.2), storey('cellar', 0, 10, -3)];
const slope = (x: number) => Math.min(1.2, Math.max(0, 0.5 * (x - 4)));

describe('the ground of storeys', () => {
  for (const known of ['all regions', 'those of the storey shown alone'])
    it(`leads up and down a slope without a jump, knowing ${known}`, () => {
      let at = { storey: 0, place: [1, 1] as [number, number], ground: 0 };
      const ground = new StoreyGround(storeys, (number) => (known === 'all regions' || number === at.storey ? new RegionIndex(storeys[number]) : undefined));
      expect(ground.rises).toBe(true);
      const seen = new Set<number>();
      for (const along of [0.03, -0.03])
        for (let step = 0; step < 270; ++step) {
          const next = ground.walk(at, [at.place[0] + along, 1]) as typeof at;
          expect(Math.abs(next.ground - at.ground)).toBeLessThan(0.03);
          expect(Math.abs(next.ground - slope(next.place[0]))).toBeLessThan(0.06);
          at = next;
          seen.add(at.storey);
        }
      expect([...seen].sort()).toEqual([0, 1, 2, 3, 4]);
      expect(at.place[0]).toBeCloseTo(1, 1);
    });

  it('ends where there is none', () => {
    const ground = new StoreyGround(storeys.slice(0, 2), (number) => new RegionIndex(storeys[number]));
    const end = ground.walk(ground.on(0, [1, 1])!, [9, 1]);
    expect(end.storey).toBe(1);
    expect(end.place[0]).toBeCloseTo(5, 1);
    expect(ground.on(0, [6, 1])).toBeUndefined();
  });

  it('does not lead from one layout of a floor to another', () => {
    const two = [storey('a', 0, 4, 0), storey('b', 3, 8, 0)];
    const ground = new StoreyGround(two, (number) => new RegionIndex(two[number]));
    expect(ground.rises).toBe(false);
    expect(ground.walk(ground.on(0, [1, 1])!, [7, 1]).place[0]).toBeCloseTo(4, 1);
  });
});
