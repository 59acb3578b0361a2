/**
 * A camera of three.js as a view of the walk. The walk is Z up; its object follows glTF: (x, y, z) is (x, z, -y) there. The
 * planner of frames takes upright views with square pixels, whose axis is the picture's middle. What a camera sees else (one
 * that is rolled, or off its axis) lies within such a view from the same eye.
 */

import { kMostPixels, pictureFromWorld, viewFromWorld, type View } from '../../src/geometry/view';
import { dot3, normalized, product, transform, type Mat3, type Vec3 } from '../../src/geometry/vector';

export const walkFromObject = ([x, y, z]: Vec3): Vec3 => [x, -z, y];
export const objectFromWalk = ([x, y, z]: Vec3): Vec3 => [x, z, -y];

export interface CameraView {
  view: View;
  /** Directions on the camera's axes (x right, y up, -z ahead) to (u z, v z, z), in pixels from the view's top left. */
  pictureFromRay: Mat3;
  metresPerUnit: number; // of the walk, per unit of the camera's space
}

/** What cannot be shown, and what can. */
export class UnsupportedView extends Error {}

/** A number of 16, column by column, as three.js has them. */
type Matrix = readonly number[];

/** Rotations and scales may be so far from even ones: matrices may have been floats. */
const kEven = 1e-3;
/** Corners of pictures are seen at most so far from the axis. */
const kLeastAhead = Math.cos((80 * Math.PI) / 180);

/** `objectFromCamera`: of the walk's object; `width`, `height`: pixels; `resolution`: of the view, 1 as fine as the camera's. */
export function viewOfCamera(objectFromCamera: Matrix, projection: Matrix, width: number, height: number, resolution: number): CameraView {
  if (projection[11] !== -1 || projection[15] !== 0) throw new UnsupportedView('a walk is seen by perspective cameras alone');
  const columns = [0, 4, 8].map((k) => walkFromObject([objectFromCamera[k], objectFromCamera[k + 1], objectFromCamera[k + 2]]));
  const lengths = columns.map((column) => Math.hypot(...column)), metresPerUnit = lengths[0];
  const [x, y, z] = columns.map(normalized);
  const even = lengths.every((length) => Math.abs(length - metresPerUnit) <= kEven * metresPerUnit) &&
    [dot3(x, y), dot3(y, z), dot3(z, x)].every((cosine) => Math.abs(cosine) <= kEven) &&
    dot3([x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]], z) > 0;
  if (!even) throw new UnsupportedView('a walk is moved, turned and scaled evenly; its matrixWorld does something else, such as a scale that differs by axis, or a mirror');
  const worldFromCamera: Mat3 = [x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]];
  const rayAt = (u: number, v: number): Vec3 => [(u + projection[8]) / projection[0], (v + projection[9]) / projection[5], -1];

  const middle = rayAt(0, 0), ahead = normalized(transform(worldFromCamera, middle));
  // Straight up or down, the upper edge tells where it looks.
  const flat = Math.hypot(ahead[0], ahead[1]) > 1e-9 ? ahead : ([-ahead[2] * y[0], -ahead[2] * y[1]] as const);
  const eye = walkFromObject([objectFromCamera[12], objectFromCamera[13], objectFromCamera[14]]);
  const pose = { eye, yaw: Math.atan2(flat[1], flat[0]), pitch: Math.asin(Math.max(-1, Math.min(1, ahead[2]))) };

  const viewFromCamera = product(viewFromWorld(pose), worldFromCamera);
  let [across, down] = [0, 0]; // tangents
  for (const [u, v] of [[-1, -1], [1, -1], [-1, 1], [1, 1]]) {
    const seen = transform(viewFromCamera, normalized(rayAt(u, v)));
    if (seen[2] < kLeastAhead) throw new UnsupportedView('the camera sees farther to its sides than the 80 degrees that a walk is shown to');
    across = Math.max(across, Math.abs(seen[0] / seen[2]));
    down = Math.max(down, Math.abs(seen[1] / seen[2]));
  }
  // As many pixels as the camera has in the middle, where off its axis they are finer.
  const finest = 0.5 * Math.max(projection[0] * width, projection[5] * height) * dot3(middle, middle) * resolution;
  const focal = Math.min(finest, (0.5 * kMostPixels) / Math.max(across, down));
  const pixels = (tangent: number) => Math.max(1, Math.min(kMostPixels, Math.ceil(2 * focal * tangent - 1e-6)));
  const view: View = { ...pose, width: pixels(across), height: pixels(down), focal };
  return { view, pictureFromRay: product(pictureFromWorld(view), worldFromCamera), metresPerUnit };
}
