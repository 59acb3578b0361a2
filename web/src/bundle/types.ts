/** A bundle's index, as bundle.json has it (engine/export/FORMAT.md), checked. Metres, radians, Z up. */

import type { Polygon } from '../geometry/polygon';
import type { Vec2, Vec3 } from '../geometry/vector';

export interface FileRef {
  file: string; // relative to bundle.json
  bytes: number;
  hash: string; // XXH3-128 of the file
  at?: number; // in a walk: where it begins among the data
}

export interface CaptureRef extends FileRef {
  samples: number; // reflections included
}

export interface CameraRef {
  number: number; // of all of the storey's
  middle: number; // azimuth that it looks to
  position: Vec2;
  full: CaptureRef | undefined;
  coarse: CaptureRef | undefined;
}

export interface Piece {
  camera: number;
}

export type Hand = 'counterClockwise' | 'clockwise';

export interface Cover {
  hand: Hand;
  pieces: Piece[];
}

export interface LocalRef extends FileRef {
  triangles: number;
}

export interface Region {
  number: number; // of all of the storey's
  polygon: Polygon; // where the eye stands
  neighbours: number[];
  covers: Cover[];
  panoramas: Cover[];
  local: LocalRef | undefined;
}

export interface Start {
  position: Vec2;
  yaw: number;
}

/** Ground that rises evenly: at a place it has the floor's height and dot(rise, place - at) more. */
export interface Slope {
  at: Vec2;
  rise: Vec2;
}

export interface Storey {
  name: string;
  floorHeight: number;
  slope: Slope | undefined; // of a piece of stairs or of a ramp
  eyeZ: number; // of its cameras; over level ground of the eye too
  nearBand: number;
  start: Start;
  outline: Polygon[]; // rings, the border and its holes; empty: the regions alone bound the walk
  cameras: CameraRef[];
  topElevation: number; // of its captures: what lies steeper is the sky
  bottomElevation: number;
  regions: Region[];
  regionCount: number; // of all of the storey's
}

export interface TextureUse {
  texture: number;
  uvSet: 0 | 1;
  transform: readonly [number, number, number, number, number, number]; // 2x3, row by row
}

export interface Material {
  baseColour: readonly [number, number, number, number];
  baseTexture: TextureUse | undefined;
  emissive: Vec3;
  emissiveTexture: TextureUse | undefined;
  alphaMode: 'opaque' | 'mask' | 'blend';
  alphaCutoff: number;
  transmission: number;
  unlit: boolean;
}

export type Wrap = 'repeat' | 'mirror' | 'clamp';

export interface Texture extends FileRef {
  width: number;
  height: number;
  wrapU: Wrap;
  wrapV: Wrap;
  nearest: boolean;
}

/** A plane with mirrors on it. Its sides are mirrors 1 + 2 n (towards the normal) and 2 + 2 n. */
export interface MirrorPlane {
  normal: Vec3;
  point: Vec3;
}

export interface Sky {
  zenith: Vec3;
  horizon: Vec3;
  ground: Vec3;
}

export interface Bookmark {
  name: string;
  storey: number;
  eye: Vec3;
  yaw: number;
  pitch: number;
}

export interface PathPose {
  eye: Vec3;
  yaw: number;
  pitch: number;
  seconds: number; // since it began; all 0: each pose is a frame
}

export interface Path {
  name: string;
  storey: number; // where it begins
  poses: PathPose[]; // at least one
}

export interface Bundle {
  name: string;
  exposure: number;
  fov: number; // horizontal, that the walk begins with
  sky: Sky;
  bounds: { min: Vec3; max: Vec3 } | undefined;
  storeys: Storey[];
  storey: number; // where the walk begins
  materials: Material[];
  textures: Texture[];
  mirrors: MirrorPlane[];
  bookmarks: Bookmark[];
  paths: Path[];
}

