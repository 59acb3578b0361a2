/** Convex polygons in plan, counter-clockwise. */

import { cross, distance2, subtract2, type Vec2 } from './vector';

export type Polygon = readonly Vec2[];

export interface Box {
  min: [number, number];
  max: [number, number];
}

export function boxOf(points: Iterable<Vec2>): Box {
  const box: Box = { min: [Infinity, Infinity], max: [-Infinity, -Infinity] };
  for (const p of points)
    for (const k of [0, 1] as const) {
      box.min[k] = Math.min(box.min[k], p[k]);
      box.max[k] = Math.max(box.max[k], p[k]);
    }
  return box;
}

/** Its border belongs to it, and what lies beyond by rounding. */
export function contains(polygon: Polygon, point: Vec2, slack = 1e-9): boolean {
  for (let i = 0; i < polygon.length; ++i) {
    const a = polygon[i], b = polygon[(i + 1) % polygon.length];
    const along = subtract2(b, a);
    if (cross(along, subtract2(point, a)) < -slack * Math.hypot(along[0], along[1])) return false;
  }
  return polygon.length > 2;
}

export function centroid(polygon: Polygon): Vec2 {
  let area = 0, x = 0, y = 0;
  const [ox, oy] = polygon[0];
  for (let i = 0; i < polygon.length; ++i) {
    const a = subtract2(polygon[i], [ox, oy]), b = subtract2(polygon[(i + 1) % polygon.length], [ox, oy]);
    const twice = cross(a, b);
    area += twice;
    x += twice * (a[0] + b[0]);
    y += twice * (a[1] + b[1]);
  }
  return [ox + x / (3 * area), oy + y / (3 * area)];
}

function nearestOnSegment(a: Vec2, b: Vec2, point: Vec2): Vec2 {
  const along = subtract2(b, a), to = subtract2(point, a);
  const squared = along[0] * along[0] + along[1] * along[1];
  const t = squared > 0 ? Math.min(1, Math.max(0, (along[0] * to[0] + along[1] * to[1]) / squared)) : 0;
  return [a[0] + t * along[0], a[1] + t * along[1]];
}

/** On the polygon's border. */
export function nearestOnBorder(polygon: Polygon, point: Vec2): Vec2 {
  let best: Vec2 = polygon[0];
  for (let i = 0; i < polygon.length; ++i) {
    const candidate = nearestOnSegment(polygon[i], polygon[(i + 1) % polygon.length], point);
    if (distance2(candidate, point) < distance2(best, point)) best = candidate;
  }
  return best;
}

export function distanceTo(polygon: Polygon, point: Vec2): number {
  return contains(polygon, point) ? 0 : distance2(nearestOnBorder(polygon, point), point);
}

/** Is the point inside closed rings (the outer border and its holes), by the number of borders that a ray crosses? */
export function insideRings(rings: readonly Polygon[], point: Vec2): boolean {
  let inside = false;
  for (const ring of rings)
    for (let i = 0; i < ring.length; ++i) {
      const a = ring[i], b = ring[(i + 1) % ring.length];
      if (a[1] > point[1] !== b[1] > point[1] && point[0] < a[0] + ((point[1] - a[1]) / (b[1] - a[1])) * (b[0] - a[0]))
        inside = !inside;
    }
  return inside;
}

/** To a place within closed rings; 0 there, and where there are no rings. */
export function distanceToRings(rings: readonly Polygon[], point: Vec2): number {
  return rings.length === 0 || insideRings(rings, point) ? 0 : borderDistance(rings, point);
}

/** To the nearest ring. */
export const borderDistance = (rings: readonly Polygon[], point: Vec2): number =>
  Math.min(...rings.map((ring) => distance2(nearestOnBorder(ring, point), point)));
