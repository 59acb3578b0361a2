/** bundle.json, with every check: a page must not trust what it is served. */

import type { Polygon } from '../geometry/polygon';
import type { Vec2, Vec3 } from '../geometry/vector';
import type {
  Bookmark, Bundle, CameraRef, CaptureRef, Cover, FileRef, LocalRef, Material, MirrorPlane, Path, Piece, Region,
  Storey, Texture, TextureUse,
} from './types';

export const kIndexName = 'bundle.json';
const kFormat = 'acentric bundle';
const kVersion = 4;
const kToneCurve = 'acentric neutral 1';
const kMost = 1 << 24; // of anything in a list
const kLargestFile = 2 ** 31;

/** Says where: file and JSON pointer. */
export class BadIndex extends Error {
  constructor(pointer: string, reason: string) {
    super(`${kIndexName}${pointer ? ` at ${pointer}` : ''}: ${reason}`);
  }
}

/** A value of the index and the way to it. */
class At {
  constructor(readonly value: unknown, readonly pointer: string) {}

  fail(reason: string): never {
    throw new BadIndex(this.pointer, reason);
  }
  /** A member, which may be missing. */
  get(name: string): At {
    if (typeof this.value !== 'object' || this.value === null || Array.isArray(this.value)) this.fail('an object belongs here');
    return new At((this.value as Record<string, unknown>)[name], `${this.pointer}/${name}`);
  }
  get missing(): boolean {
    return this.value === undefined || this.value === null;
  }
  list(least = 0, most = kMost): At[] {
    if (!Array.isArray(this.value)) this.fail('a list belongs here');
    const { length } = this.value;
    if (length < least || length > most) this.fail(`${length} entries, where ${least} to ${most} may be`);
    return this.value.map((value, i) => new At(value, `${this.pointer}/${i}`));
  }
  number(least = -1e12, most = 1e12): number {
    if (typeof this.value !== 'number' || !Number.isFinite(this.value)) this.fail('a finite number belongs here');
    if (this.value < least || this.value > most) this.fail(`${this.value} lies outside ${least} to ${most}`);
    return this.value;
  }
  integer(least: number, most: number): number {
    const value = this.number(least, most);
    if (!Number.isInteger(value)) this.fail('a whole number belongs here');
    return value;
  }
  text(): string {
    if (typeof this.value !== 'string') this.fail('a text belongs here');
    return this.value;
  }
  flag(): boolean {
    if (typeof this.value !== 'boolean') this.fail('true or false belongs here');
    return this.value;
  }
  oneOf<Word extends string>(words: readonly Word[]): Word {
    const text = this.text() as Word;
    if (!words.includes(text)) this.fail(`"${text}" is none of ${words.join(', ')}`);
    return text;
  }
  vec2(): Vec2 {
    const [x, y] = this.list(2, 2);
    return [x.number(), y.number()];
  }
  vec3(): Vec3 {
    const [x, y, z] = this.list(3, 3);
    return [x.number(), y.number(), z.number()];
  }
  optional<Value>(read: (at: At) => Value): Value | undefined {
    return this.missing ? undefined : read(this);
  }
}

const polygon = (at: At): Polygon => at.list(3).map((corner) => corner.vec2());

function fileRef(at: At): FileRef {
  const file = at.get('file').text();
  if (!/^[\w-]+(\/[\w-]+)*\.[\w.]+$/.test(file) || file.includes('..')) at.get('file').fail(`"${file}" is no file of the bundle`);
  const hash = at.get('hash').text();
  if (!/^[0-9a-f]{32}$/.test(hash)) at.get('hash').fail('32 hexadecimal digits belong here');
  return { file, hash, bytes: at.get('bytes').integer(1, kLargestFile), at: at.get('at').optional((n) => n.integer(0, 2 ** 53 - 1)) };
}

const captureRef = (at: At): CaptureRef => ({
  ...fileRef(at),
  samples: at.get('samples').integer(0, 2 ** 31) + (at.get('reflections').optional((n) => n.integer(0, 2 ** 31)) ?? 0),
});

const localRef = (at: At): LocalRef => ({ ...fileRef(at), triangles: at.get('triangles').integer(0, 2 ** 31) });

const cameraRef = (at: At, own: number): CameraRef => ({
  number: at.get('number').optional((n) => n.integer(0, kMost)) ?? own,
  position: at.get('position').vec2(),
  middle: at.get('lowAzimuth').number() + 0.5 * at.get('fov').number(0, Math.PI + 1e-6),
  full: at.get('full').optional(captureRef),
  coarse: at.get('coarse').optional(captureRef),
});

const piece = (at: At, cameras: number): Piece => ({
  camera: at.get('camera').integer(0, cameras - 1),
});

const cover = (at: At, cameras: number): Cover => ({
  hand: at.get('hand').oneOf(['counterClockwise', 'clockwise']),
  pieces: at.get('pieces').list().map((one) => piece(one, cameras)),
});

const region = (at: At, own: number, cameras: number, regions: number): Region => ({
  number: at.get('number').optional((n) => n.integer(0, kMost)) ?? own,
  polygon: polygon(at.get('polygon')),
  neighbours: at.get('neighbours').list().map((one) => one.integer(0, regions - 1)),
  covers: at.get('covers').list(1).map((one) => cover(one, cameras)),
  panoramas: at.get('panoramas').optional((list) => list.list().map((one) => cover(one, cameras))) ?? [],
  local: at.get('local').optional(localRef),
});

function storey(at: At): Storey {
  const cameras = at.get('cameras').list(), regions = at.get('regions').list(); // of a walk those of one page
  const limit = Math.PI / 2;
  const extreme = (name: string, of: (a: number, b: number) => number) =>
    at.get(name).optional((n) => n.number(-limit, limit)) ??
    cameras.map((camera) => camera.get(name).number(-limit, limit)).reduce((a, b) => of(a, b), 0);
  return {
    name: at.get('name').text(),
    floorHeight: at.get('floorHeight').number(),
    slope: at.get('slope').optional((slope) => ({ at: slope.get('at').vec2(), rise: slope.get('rise').vec2() })),
    eyeZ: at.get('eyeZ').number(),
    nearBand: at.get('nearBand').number(0),
    start: { position: at.get('start').get('position').vec2(), yaw: at.get('start').get('yaw').number() },
    outline: at.get('outline').optional((rings) => rings.list().map(polygon)) ?? [],
    topElevation: extreme('topElevation', Math.max),
    bottomElevation: extreme('bottomElevation', Math.min),
    cameras: cameras.map(cameraRef),
    regions: regions.map((one, own) => region(one, own, cameras.length, regions.length)),
    regionCount: at.get('regionCount').optional((n) => n.integer(0, kMost)) ?? regions.length,
  };
}

const textureUse = (at: At, textures: number): TextureUse => {
  const [first, second] = at.get('transform').list(2, 2).map((row) => row.vec3());
  return {
    texture: at.get('texture').integer(0, textures - 1),
    uvSet: at.get('uvSet').integer(0, 1) as 0 | 1,
    transform: [...first, ...second],
  };
};

const material = (at: At, textures: number): Material => ({
  baseColour: at.get('baseColour').list(4, 4).map((one) => one.number()) as unknown as Material['baseColour'],
  baseTexture: at.get('baseColourTexture').optional((use) => textureUse(use, textures)),
  emissive: at.get('emissive').vec3(),
  emissiveTexture: at.get('emissiveTexture').optional((use) => textureUse(use, textures)),
  alphaMode: at.get('alphaMode').oneOf(['opaque', 'mask', 'blend']),
  alphaCutoff: at.get('alphaCutoff').number(),
  transmission: at.get('transmission').number(),
  unlit: at.get('unlit').flag(),
});

const maxTexturePixels = 2 ** 28;

function texture(at: At): Texture {
  const width = at.get('width').integer(1, 65536), height = at.get('height').integer(1, 65536);
  if (width * height > maxTexturePixels) at.get('height').fail('makes a texture of more than 2^28 pixels');
  return { ...fileRef(at), width, height, ...sampling(at) };
}

const sampling = (at: At) => ({
  wrapU: at.get('wrapU').oneOf(['repeat', 'mirror', 'clamp']),
  wrapV: at.get('wrapV').oneOf(['repeat', 'mirror', 'clamp']),
  nearest: at.get('filter').oneOf(['nearest', 'linear']) === 'nearest',
});

const mirrorPlane = (at: At): MirrorPlane => ({ normal: at.get('normal').vec3(), point: at.get('point').vec3() });

const bookmark = (at: At, storeys: number): Bookmark => ({
  name: at.get('name').text(),
  storey: at.get('storey').integer(0, storeys - 1),
  eye: at.get('eye').vec3(),
  yaw: at.get('yaw').number(),
  pitch: at.get('pitch').number(-Math.PI, Math.PI),
});

const path = (at: At, storeys: number): Path => ({
  name: at.get('name').text(),
  storey: at.get('storey').integer(0, storeys - 1),
  poses: at.get('poses').list(1).map((pose) => ({
    eye: pose.get('eye').vec3(), yaw: pose.get('yaw').number(), pitch: pose.get('pitch').number(-Math.PI, Math.PI),
    seconds: pose.get('seconds').number(0),
  })),
});

export function readIndex(text: string): Bundle {
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch (error) {
    throw new BadIndex('', `this is not JSON (${(error as Error).message})`);
  }
  const at = new At(json, '');
  if (at.get('format').value !== kFormat) at.get('format').fail(`this is not "${kFormat}"`);
  if (at.get('version').value !== kVersion)
    at.get('version').fail(`version ${String(at.get('version').value)}; this page reads version ${kVersion}: export it again`);
  if (at.get('toneCurve').value !== kToneCurve) at.get('toneCurve').fail(`this page knows the curve "${kToneCurve}" alone`);
  const storeys = at.get('storeys').list(1), textures = at.get('textures').list();
  const sky = at.get('sky');
  const bounds = at.get('bounds').optional((box) => ({ min: box.get('min').vec3(), max: box.get('max').vec3() }));
  if (storeys.every((one) => one.get('regions').list().length === 0)) storeys[0].get('regions').fail('there is no region to stand in');
  return {
    name: at.get('name').text(),
    exposure: at.get('exposure').number(0),
    fov: at.get('fov').number(0.01, 3.13),
    sky: { zenith: sky.get('zenith').vec3(), horizon: sky.get('horizon').vec3(), ground: sky.get('ground').vec3() },
    bounds: bounds && bounds.min.some((low, k) => low < bounds.max[k]) ? bounds : undefined,
    storeys: storeys.map(storey),
    storey: at.get('storey').integer(0, storeys.length - 1),
    materials: at.get('materials').list().map((one) => material(one, textures.length)),
    textures: textures.map(texture),
    mirrors: at.get('mirrors').list(0, 127).map(mirrorPlane),
    bookmarks: at.get('bookmarks').list().map((one) => bookmark(one, storeys.length)),
    paths: (at.get('paths').optional((list) => list.list()) ?? []).map((one) => path(one, storeys.length)),
  };
}
