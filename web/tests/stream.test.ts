import { describe, expect, it } from 'vitest';
import type { CameraRef, Region, Storey } from '../src/bundle/types';
import { chooseCover, RegionIndex } from '../src/geometry/regions';
import type { Vec2 } from '../src/geometry/vector';
import { Cache } from '../src/stream/cache';
import { keyOf, regionsAhead, wantedItems, type Item, type Name, type Viewer } from '../src/stream/wanted';

/** A row of square regions along x, each with a camera of its own to the east and one to the west. */
function row(count: number, outline: Storey['outline'] = []): Storey {
  const file = (name: string) => ({ file: `captures/${name}.pack`, bytes: 100, hash: '0'.repeat(32), samples: 1000 });
  const cameras: CameraRef[] = [];
  const regions: Region[] = Array.from({ length: count }, (_, n) => {
    for (const middle of [0, Math.PI])
      cameras.push({ number: cameras.length, position: [2 * n + 1, 1], middle, full: file(`f${cameras.length}`), coarse: file(`c${cameras.length}`) });
    const polygon: Vec2[] = [[2 * n, 0], [2 * n + 2, 0], [2 * n + 2, 2], [2 * n, 2]];
    return {
      number: n, polygon, panoramas: [],
      neighbours: [n - 1, n + 1].filter((m) => m >= 0 && m < count),
      covers: [
        { hand: 'counterClockwise', pieces: [{ camera: 2 * n }] },
        { hand: 'clockwise', pieces: [{ camera: 2 * n + 1 }] },
      ],
      local: { file: `regions/${n}.local`, bytes: 10, hash: '0'.repeat(32), triangles: 10 },
    };
  });
  return {
    name: 'floor', floorHeight: 0, slope: undefined, eyeZ: 1.6, nearBand: 1, start: { position: [1, 1], yaw: 0 }, outline, cameras, regions,
    topElevation: 1, bottomElevation: -1, regionCount: count,
  };
}
const viewer = (change: Partial<Viewer> = {}): Viewer => ({ eye: [9, 1], yaw: 0, velocity: [0, 0], region: 4, full: true, saving: false, ...change });
const keys = (items: Item[]) => items.map(keyOf);

describe('regions', () => {
  const storey = row(10), index = new RegionIndex(storey);
  it('are found by a point, shared borders by the first', () => {
    expect(index.regionAt([0.5, 0.5])).toBe(0);
    expect(index.regionAt([19.9, 1.5])).toBe(9);
    expect(index.regionAt([4, 1])).toBe(1);
    expect(index.regionAt([4, 2.5])).toBe(-1);
  });
  it('keep a walk inside and let it slide along their border', () => {
    const end = index.walk([1, 1], [3, 5]);
    expect(index.mayStand(end)).toBe(true);
    expect(end[1]).toBeGreaterThan(1.9);
    expect(end[0]).toBeGreaterThan(1.5);
    expect(index.walk([1, 1], [-50, 1])[0]).toBeCloseTo(0, 6);
  });
  it('and an outline bound the walk together', () => {
    const walled = new RegionIndex(row(10, [[[0, 0], [20, 0], [20, 2], [0, 2]], [[4, 0.5], [5, 0.5], [5, 1.5], [4, 1.5]]]));
    expect(walled.mayStand([4.5, 1])).toBe(false);
    expect(walled.walk([3, 1], [7, 1])[0]).toBeLessThan(4.01);
    expect(walled.mayStand(walled.nearestStanding([4.4, 1]))).toBe(true);
    expect(walled.nearestStanding([4.4, 1])[0]).toBeCloseTo(4, 1);
  });
  it('choose the hand by the side of the ray on which their middle lies', () => {
    const region = storey.regions[0];
    expect(chooseCover(region, [1, 0.5], 0)?.hand).toBe('counterClockwise');
    expect(chooseCover(region, [1, 1.5], 0)?.hand).toBe('clockwise');
  });
});

describe('what is loaded', () => {
  const storey = row(10);
  it('begins with coarse captures of the own region, then its full ones, then what lies around', () => {
    const items = keys(wantedItems(storey, viewer()));
    expect(items.slice(0, 5)).toEqual(['coarse/8', 'coarse/9', 'local/4', 'full/8', 'full/9']);
    expect(items[5]).toBe('coarse/10'); // ahead
    expect(items.indexOf('coarse/10')).toBeLessThan(items.indexOf('coarse/6')); // before what lies behind
    expect(items.lastIndexOf('coarse/6')).toBeLessThan(items.indexOf('full/10'));
    expect(new Set(items).size).toBe(items.length);
  });
  it('is full only where the eye is, and in the next two regions', () => {
    const full = keys(wantedItems(storey, viewer())).filter((key) => key.startsWith('full'));
    expect(full.sort()).toEqual(['full/10', 'full/11', 'full/12', 'full/13', 'full/8', 'full/9']);
  });
  it('is what the picture needs where data is to be saved', () => {
    expect(keys(wantedItems(storey, viewer({ saving: true })))).toEqual(['coarse/8', 'coarse/9', 'local/4', 'full/8', 'full/9']);
    expect(keys(wantedItems(storey, viewer({ saving: true, velocity: [1.4, 0] })))).toContain('coarse/10');
  });
  it('runs ahead of a walk', () => {
    const items = keys(wantedItems(storey, viewer({ velocity: [-1.4, 0] })));
    expect(items.indexOf('coarse/6')).toBeLessThan(items.indexOf('full/8'));
    expect(regionsAhead(storey, viewer({ velocity: [-1.4, 0] }))[0]).toBe(3);
  });
  it('stays within reach', () => {
    expect(regionsAhead(storey, viewer({ region: 0, eye: [1, 1] }))).not.toContain(9);
  });
  it('is coarse alone when that is enough', () => {
    expect(keys(wantedItems(storey, viewer({ full: false }))).some((key) => key.startsWith('full'))).toBe(false);
  });
  it('takes the full capture in place of a coarse one that cannot be had', () => {
    const failed = (item: Name) => keyOf(item) === 'coarse/8';
    expect(keys(wantedItems(storey, viewer({ full: false }), failed)).slice(0, 2)).toEqual(['full/8', 'coarse/9']);
  });
});

describe('memory', () => {
  const make = () => {
    const dropped: string[] = [];
    return { cache: new Cache<string>((value) => dropped.push(value)), dropped };
  };
  const item = (number: number): Item => ({ grade: 'full', number, file: { file: '', bytes: 1, hash: '' }, place: [number, 0], bytes: 10 });
  const plan = (cache: Cache<string>, wanted: number[], needed: number, limit: number) =>
    cache.plan(wanted.map(item), needed, limit, () => 10, (one) => one.number).map((one) => one.number);

  it('is filled in order and no further than its limit', () => {
    const { cache } = make();
    expect(plan(cache, [3, 1, 2], 1, 20)).toEqual([3, 1]);
  });
  it('never lacks what the picture needs', () => {
    const { cache } = make();
    expect(plan(cache, [3, 1, 2], 2, 5)).toEqual([3, 1]);
  });
  it('gives up the farthest first', () => {
    const { cache, dropped } = make();
    for (const number of [9, 5, 7]) cache.add(item(number), String(number), 10);
    plan(cache, [1], 1, 30);
    expect(dropped).toEqual(['9']);
    expect(cache.bytes).toBe(20);
  });
  it('keeps what is wanted though it came first', () => {
    const { cache, dropped } = make();
    for (const number of [1, 2, 3]) cache.add(item(number), String(number), 10);
    expect(plan(cache, [3, 2], 2, 20)).toEqual([]);
    expect(dropped).toEqual(['1']);
  });
});
