/** The view in a page's address: #at=x,y,yaw,pitch in metres and degrees, and &storey= where it is not the one where the walk begins. */

import type { Vec3 } from './geometry/vector';

export interface Address {
  eye: [number, number];
  yaw: number; // radians
  pitch: number;
  storey: number;
}

export function addressOf(eye: Vec3, yaw: number, pitch: number, storey: number, first: number): string {
  const degrees = (radians: number) => ((radians * 180) / Math.PI).toFixed(1);
  return (
    `#at=${eye[0].toFixed(2)},${eye[1].toFixed(2)},${degrees(yaw)},${degrees(pitch)}` + (storey === first ? '' : `&storey=${storey}`)
  );
}

/** Undefined where it tells no view of a walk with so many storeys. */
export function parseAddress(hash: string, storeys: number, first: number): Address | undefined {
  const found = /^#at=(-?[\d.]+),(-?[\d.]+),(-?[\d.]+),(-?[\d.]+)(?:&storey=(\d+))?$/.exec(hash);
  const numbers = found?.slice(1, 5).map(Number);
  const storey = found?.[5] === undefined ? first : Number(found[5]);
  if (!numbers || !numbers.every(Number.isFinite) || storey >= storeys) return undefined;
  const [x, y, yaw, pitch] = numbers;
  return { eye: [x, y], yaw: (yaw * Math.PI) / 180, pitch: (pitch * Math.PI) / 180, storey };
}
