/**
 * Which rows of a capture's column can fall on the picture (engine/view/column_culling.h): seen from the eye, the sample
 * (t, w) of column direction c lies in direction c + t z + w b, and each side of the picture is a plane through the eye.
 */

import { dot3, normalized, transform, transposed, type Vec2, type Vec3 } from './vector';
import { viewFromWorld, type View } from './view';

/** Inward unit normals of the picture's four sides and of the plane through the eye. */
export type FrustumPlanes = readonly Vec3[];

/** `margin`: pixels added all around. */
export function frustumPlanes(view: View, margin: number): FrustumPlanes {
  const worldFromView = transposed(viewFromWorld(view)), f = view.focal;
  const x = 0.5 * view.width + margin, y = 0.5 * view.height + margin;
  const inView: Vec3[] = [[f, 0, x], [-f, 0, x], [0, f, y], [0, -f, y], [0, 0, 1]];
  return inView.map((normal) => transform(worldFromView, normalized(normal)));
}

const kSlack = 2e-6; // the shader computes in float

/** Of one column: what its tests share. */
export class ColumnTest {
  private readonly flat = new Float64Array(5);
  private readonly perInverse = new Float64Array(5);
  private readonly up = new Float64Array(5);
  private readonly reach: number;
  low = 0; // of the last test that succeeded: row tangents that may be seen
  high = 0;

  constructor(private readonly planes: FrustumPlanes, baseline: Vec3) {
    planes.forEach((normal, i) => {
      this.perInverse[i] = dot3(normal, baseline);
      this.up[i] = normal[2];
    });
    this.reach = Math.hypot(...baseline);
  }

  setColumn(direction: Vec2): void {
    for (let i = 0; i < 5; ++i) this.flat[i] = this.planes[i][0] * direction[0] + this.planes[i][1] * direction[1];
  }

  /** Can anything with these inverse distances and row tangents be seen? */
  mayShow(least: number, most: number, low: number, high: number): boolean {
    if (!(least <= most)) return false;
    const slack = kSlack * (1 + most * this.reach);
    for (let i = 0; i < 5; ++i) {
      const per = this.perInverse[i], up = this.up[i];
      const best = this.flat[i] + Math.max(least * per, most * per) + slack;
      if (Math.abs(up) < 1e-12) {
        if (best < 0) return false;
      } else if (up > 0) {
        const limit = -best / up;
        if (limit > low) low = limit;
      } else {
        const limit = -best / up;
        if (limit < high) high = limit;
      }
      if (!(low <= high)) return false;
    }
    this.low = low;
    this.high = high;
    return true;
  }
}
