import { describe, expect, it } from 'vitest';
import { centroid, contains, insideRings, nearestOnBorder, type Polygon } from '../src/geometry/polygon';
import { product, transform, transposed } from '../src/geometry/vector';
import { pictureFromWorld, rayThrough, viewAt, viewFromWorld } from '../src/geometry/view';

const square: Polygon = [[0, 0], [2, 0], [2, 2], [0, 2]];
describe('polygons', () => {
  it('hold their inside and their border', () => {
    expect(contains(square, [1, 1])).toBe(true);
    expect(contains(square, [2, 1])).toBe(true);
    expect(contains(square, [2.001, 1])).toBe(false);
  });
  it('have a middle wherever they lie', () => {
    const far = square.map(([x, y]): [number, number] => [x + 5e6, y - 5e6]);
    expect(centroid(far)[0]).toBeCloseTo(5e6 + 1, 6);
    expect(centroid(far)[1]).toBeCloseTo(1 - 5e6, 6);
  });
  it('know the nearest point of their border', () => {
    expect(nearestOnBorder(square, [3, 1])).toEqual([2, 1]);
    expect(nearestOnBorder(square, [3, 3])).toEqual([2, 2]);
  });
  it('with holes hold what is between', () => {
    const ring: Polygon = [[0.5, 0.5], [1.5, 0.5], [1.5, 1.5], [0.5, 1.5]];
    expect(insideRings([square, ring], [0.25, 1])).toBe(true);
    expect(insideRings([square, ring], [1, 1])).toBe(false);
  });
});

describe('views', () => {
  const view = viewAt({ eye: [1, 2, 1.6], yaw: 0.7, pitch: -0.2 }, Math.PI / 3, 640, 360);
  it('have orthonormal axes that look along the yaw and the pitch', () => {
    const m = viewFromWorld(view), unit = product(m, transposed(m));
    [1, 0, 0, 0, 1, 0, 0, 0, 1].forEach((value, i) => expect(unit[i]).toBeCloseTo(value, 12));
    const forward = transform(transposed(m), [0, 0, 1]);
    expect(Math.atan2(forward[1], forward[0])).toBeCloseTo(0.7, 12);
    expect(Math.asin(forward[2])).toBeCloseTo(-0.2, 12);
  });
  it('put the ray through a pixel back on it', () => {
    for (const [u, v] of [[0, 0], [320, 180], [639.5, 12.25]]) {
      const q = transform(pictureFromWorld(view), rayThrough(view, u, v));
      expect(q[0] / q[2]).toBeCloseTo(u, 8);
      expect(q[1] / q[2]).toBeCloseTo(v, 8);
    }
  });
  it('keep the longer side at the field of view', () => {
    expect(viewAt(view, Math.PI / 2, 200, 100).focal).toBeCloseTo(100, 9);
    expect(viewAt(view, Math.PI / 2, 100, 200).focal).toBeCloseTo(100, 9);
  });
});
