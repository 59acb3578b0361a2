import { describe, expect, it } from 'vitest';
import { durationOf, poseAt } from '../src/geometry/path';

const pose = (x: number, yaw: number, seconds: number) => ({ eye: [x, 2, 1.6] as const, yaw, pitch: 0.1 * x, seconds });

describe('a path', () => {
  const path = { name: 'tour', storey: 0, poses: [pose(0, 3, 0), pose(2, -3, 1), pose(3, -3, 4)] };
  it('is walked straight on, with the shorter turn', () => {
    expect(durationOf(path)).toBe(4);
    expect(poseAt(path, 0)).toEqual({ eye: [0, 2, 1.6], yaw: 3, pitch: 0 });
    expect(poseAt(path, 0.5).eye[0]).toBe(1);
    expect(poseAt(path, 0.5).yaw).toBeCloseTo(Math.PI, 6); // over the back, where angles wrap
    expect(poseAt(path, 2.5).eye[0]).toBe(2.5);
    expect(poseAt(path, 99).eye[0]).toBe(3);
  });
  it('without times is a film', () => {
    const film = { ...path, poses: path.poses.map((one) => ({ ...one, seconds: 0 })) };
    expect(durationOf(film)).toBeCloseTo(2 / 30, 9);
    expect(poseAt(film, 0.5 / 30).eye[0]).toBeCloseTo(1, 6);
  });
  it('of one pose stays there', () => {
    const one = { ...path, poses: [pose(5, 1, 0)] };
    expect(durationOf(one)).toBe(0);
    expect(poseAt(one, 1).eye[0]).toBe(5);
  });
});
