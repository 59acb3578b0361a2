/** Parts of a picture. */

import { subtract3, transform, type Mat3, type Vec3 } from '../geometry/vector';

/** Pixels [x0, x1) x [y0, y1) of a picture, from its top left. */
export interface PixelBox {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

/** Where a picture shows these corners of triangles, three numbers each, relative to `origin`; undefined where it shows none. */
export function cornersExtent(corners: Float32Array, origin: Vec3, eye: Vec3, picture: Mat3, size: { width: number; height: number }): PixelBox | undefined {
  const from = subtract3(origin, eye);
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < corners.length; i += 3) {
    const [x, y, z] = transform(picture, [corners[i] + from[0], corners[i + 1] + from[1], corners[i + 2] + from[2]]);
    if (z < 1e-3) { // beside the eye, or behind it
      [left, top, right, bottom] = [-Infinity, -Infinity, Infinity, Infinity];
      break;
    }
    left = Math.min(left, x / z);
    right = Math.max(right, x / z);
    top = Math.min(top, y / z);
    bottom = Math.max(bottom, y / z);
  }
  const within = (value: number, limit: number) => Math.min(limit, Math.max(0, value));
  const box = {
    x0: within(Math.floor(left - 1), size.width), y0: within(Math.floor(top - 1), size.height),
    x1: within(Math.ceil(right + 1), size.width), y1: within(Math.ceil(bottom + 1), size.height),
  };
  return box.x0 < box.x1 && box.y0 < box.y1 ? box : undefined;
}
