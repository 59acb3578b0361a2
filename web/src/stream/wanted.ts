/**
 * What to load, in which order. Values only, so that it can be tested without a network: the loader asks again whenever
 * the eye has moved, something has come, or failed.
 */

import type { FileRef, Storey } from '../bundle/types';
import { distanceTo, centroid } from '../geometry/polygon';
import { camerasOf, coversFor } from '../geometry/regions';
import { directionOf, dot2, subtract2, type Vec2 } from '../geometry/vector';

export type Grade = 'coarse' | 'full' | 'local';

/** A capture of a camera, or the local geometry of a region. */
export interface Name {
  grade: Grade;
  number: number; // of the camera, or of the region, in all of its storey
}
export interface Item extends Name {
  file: FileRef;
  place: Vec2; // where it belongs
  bytes: number; // on the graphics card, about
}

export const keyOf = (item: Name): string => `${item.grade}/${item.number}`;

export interface Viewer {
  eye: Vec2;
  yaw: number;
  velocity: Vec2; // metres per second
  region: number;
  full: boolean; // false: coarse captures are enough
  saving: boolean; // the viewer pays for each byte, or asked to save them
  waiting?: boolean; // nothing is shown yet
}

/** On the graphics card, about: a sample with the borders of patches; a triangle. */
const kSampleBytes = 12, kTriangleBytes = 3 * 64;

/** Beyond this nothing is loaded ahead, metres from the eye in cell sizes of its region. */
const kReach = 2.5;

/** How wide the region is. */
const sizeOf = (storey: Storey, region: number): number => {
  const polygon = storey.regions[region].polygon, middle = centroid(polygon);
  return 2 * Math.max(...polygon.map((p) => Math.hypot(p[0] - middle[0], p[1] - middle[1])));
};

/** Regions other than the eye's within reach, nearest first; what lies in the direction of the walk, or else of the look, counts nearer. */
export function regionsAhead(storey: Storey, viewer: Viewer): number[] {
  const own = storey.regions[viewer.region], reach = kReach * sizeOf(storey, viewer.region);
  const speed = Math.hypot(...viewer.velocity);
  const heading: Vec2 = speed > 0.1 ? [viewer.velocity[0] / speed, viewer.velocity[1] / speed] : directionOf(viewer.yaw);
  const costs = new Map<number, number>();
  const consider = (number: number) => {
    if (number === viewer.region || costs.has(number)) return false;
    const region = storey.regions[number];
    const distance = distanceTo(region.polygon, viewer.eye);
    if (distance > reach) return false;
    const towards = subtract2(centroid(region.polygon), viewer.eye);
    const facing = dot2(heading, towards) / (Math.hypot(...towards) || 1);
    costs.set(number, (distance + 0.1 * reach) * (1.5 - facing));
    return true;
  };
  let front = own.neighbours.filter(consider);
  while (front.length > 0) front = front.flatMap((number) => storey.regions[number].neighbours.filter(consider));
  return [...costs].sort((a, b) => a[1] - b[1] || a[0] - b[0]).map(([number]) => number);
}

/** Cameras of the region in the order in which the picture needs them: those of the cover before those behind, those that look where the eye looks first. */
export function camerasInOrder(storey: Storey, number: number, eye: Vec2, yaw: number): number[] {
  const region = storey.regions[number];
  const { first, behind } = coversFor(region, eye, yaw);
  const heading = directionOf(yaw);
  const order: number[] = [];
  for (const pieces of [first?.pieces ?? [], behind.flatMap((cover) => cover.pieces)]) {
    const facing = (camera: number) => dot2(heading, directionOf(storey.cameras[camera].middle));
    const cameras = [...new Set(pieces.map((piece) => piece.camera))].sort((a, b) => facing(b) - facing(a) || a - b);
    for (const camera of cameras) if (!order.includes(camera)) order.push(camera);
  }
  return order;
}

/** Regions ahead of the eye whose full captures are loaded, and whose coarse ones come first while it walks. */
const kNext = 2;

/** Everything worth having at this place, most urgent first; not what cannot be had. */
export function wantedItems(storey: Storey, viewer: Viewer, failed: (item: Name) => boolean = () => false): Item[] {
  if (viewer.region < 0) return [];
  const items: Item[] = [];
  const seen = new Set<string>();
  const add = (grade: Grade, number: number) => {
    const region = storey.regions[number], camera = storey.cameras[number];
    const name: Name = { grade, number: grade === 'local' ? region.number : camera.number };
    if (seen.has(keyOf(name)) || failed(name)) return;
    seen.add(keyOf(name));
    if (grade === 'local') {
      if (region.local) items.push({ ...name, file: region.local, place: centroid(region.polygon), bytes: region.local.triangles * kTriangleBytes });
    } else {
      const file = camera[grade];
      if (file) items.push({ ...name, file, place: camera.position, bytes: file.samples * kSampleBytes });
    }
  };
  /** Where there is no coarse capture the full one takes its place. */
  const addCoarse = (camera: number) => {
    const coarse = storey.cameras[camera].coarse !== undefined && !failed({ grade: 'coarse', number: storey.cameras[camera].number });
    add(coarse ? 'coarse' : 'full', camera);
  };
  const own = camerasInOrder(storey, viewer.region, viewer.eye, viewer.yaw);
  own.forEach(addCoarse);
  if (viewer.waiting) return items;
  add('local', viewer.region);
  const ahead = regionsAhead(storey, viewer);
  const next = ahead.slice(0, kNext);
  const around = (regions: number[]) =>
    regions.forEach((number) => {
      camerasInOrder(storey, number, viewer.eye, viewer.yaw).forEach(addCoarse);
      add('local', number);
    });
  const ownFull = () => viewer.full && own.forEach((camera) => add('full', camera));
  // A walk that has begun must not outrun its coarse captures; one that stands still sharpens first.
  if (Math.hypot(...viewer.velocity) > 0.1) around(next);
  ownFull();
  if (viewer.saving) return items;
  around(ahead);
  if (viewer.full) for (const number of next) camerasOf(storey.regions[number]).forEach((camera) => add('full', camera));
  return items;
}
