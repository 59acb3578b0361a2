/** Camera paths of a bundle. */

import type { Path } from '../bundle/types';
import type { Pose } from './view';

/** Poses of a path without times follow each other so fast, seconds. */
const kEach = 1 / 30;

const secondsAt = (path: Path, n: number): number => (lastOf(path).seconds > 0 ? path.poses[n].seconds : n * kEach);
const lastOf = (path: Path) => path.poses[path.poses.length - 1];

export const durationOf = (path: Path): number => secondsAt(path, path.poses.length - 1);

/** So many seconds after it began: between two poses the way is straight, and the turn the shorter one. */
export function poseAt(path: Path, seconds: number): Pose {
  let n = 0;
  while (n + 1 < path.poses.length && secondsAt(path, n + 1) <= seconds) ++n;
  const a = path.poses[n], b = path.poses[Math.min(n + 1, path.poses.length - 1)];
  const length = a === b ? 0 : secondsAt(path, n + 1) - secondsAt(path, n);
  const share = length > 0 ? Math.min(1, Math.max(0, (seconds - secondsAt(path, n)) / length)) : 0;
  const turn = Math.atan2(Math.sin(b.yaw - a.yaw), Math.cos(b.yaw - a.yaw));
  const between = (k: 0 | 1 | 2) => a.eye[k] + share * (b.eye[k] - a.eye[k]);
  return { eye: [between(0), between(1), between(2)], yaw: a.yaw + share * turn, pitch: a.pitch + share * (b.pitch - a.pitch) };
}
