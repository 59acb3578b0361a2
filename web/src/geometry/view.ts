/** A pinhole view: engine/geometry/perspective_view.h in TypeScript. View axes: x right, y down, z forward. */

import { product, transform, transposed, type Mat3, type Vec3 } from './vector';

export interface Pose {
  readonly eye: Vec3; // metres
  readonly yaw: number; // radians
  readonly pitch: number; // radians, in [-pi/2, pi/2]
}

export interface View extends Pose {
  readonly width: number; // pixels
  readonly height: number;
  readonly focal: number; // pixels
}

/** Across and down. */
export const kMostPixels = 8192;

/** `fov`: of the picture's longer side, radians. */
export function viewAt(pose: Pose, fov: number, width: number, height: number): View {
  return { ...pose, width, height, focal: (0.5 * Math.max(width, height)) / Math.tan(0.5 * fov) };
}

export function viewFromWorld(pose: Pose): Mat3 {
  const cy = Math.cos(pose.yaw), sy = Math.sin(pose.yaw), cp = Math.cos(pose.pitch), sp = Math.sin(pose.pitch);
  return [sy, -cy, 0, cy * sp, sy * sp, -cp, cy * cp, sy * cp, sp];
}

/** K M: world directions to (u z, v z, z), in pixels from the picture's top left. */
export function pictureFromWorld(view: View): Mat3 {
  return product([view.focal, 0, 0.5 * view.width, 0, view.focal, 0.5 * view.height, 0, 0, 1], viewFromWorld(view));
}

/** (u, v, 1) to a world direction. */
export function worldFromPicture(view: View): Mat3 {
  const f = view.focal;
  return product(transposed(viewFromWorld(view)), [
    1 / f, 0, (-0.5 * view.width) / f, 0, 1 / f, (-0.5 * view.height) / f, 0, 0, 1,
  ]);
}

export const rayThrough = (view: View, u: number, v: number): Vec3 => transform(worldFromPicture(view), [u, v, 1]);
