/** Local geometry of a region as the graphics card takes it, from its file (engine/export/FORMAT.md, "Kind 4"). */

import type { Vec3 } from '../geometry/vector';
import { BlockFile, BlockFileKind, DamagedFile } from './block_file';
import type { Material, TextureUse } from './types';

const kVersions = [1];
const kLight = 1, kMirrors = 2, kUv0 = 4, kUv1 = 8, kColours = 16; // flags
const kHasBack = 1 << 16;
export const kNoPlane = 0xff;

/** Floats of one corner: position, barycentric weights, two uv; then colour, first light sample, resolution, normal. */
export const kCornerBytes = 64;

/** Consecutive triangles of one material and one set of attributes. */
export interface LocalBatch {
  material: number;
  colours: boolean;
  baseUv: boolean;
  emissiveUv: boolean;
  plane: number; // mirror plane, or kNoPlane
  firstTriangle: number;
  triangles: number;
}

export interface LocalGeometry {
  origin: Vec3; // of positions
  corners: ArrayBuffer; // kCornerBytes each, three a triangle
  triangles: number;
  batches: LocalBatch[]; // those that can be clear come last
  firstClear: number; // triangle
  clearPositions: Float32Array; // three corners a clear triangle, for sorting
  light: Uint16Array | undefined; // three halves a sample
  mirrors: boolean;
}

export const canBeClear = (m: Material): boolean => m.alphaMode === 'blend' || (m.transmission > 0 && !m.unlit);

export const bytesOfLocal = (g: LocalGeometry): number => g.corners.byteLength + (g.light?.byteLength ?? 0);

const asFloats = (words: Uint32Array): Float32Array => new Float32Array(words.buffer, words.byteOffset, words.length);

interface Mesh {
  material: number;
  flags: number;
  firstTriangle: number; // among all source triangles
}

/** What the file holds, checked against itself. */
async function unpack(bytes: Uint8Array, materials: number) {
  const file = await BlockFile.open(bytes, BlockFileKind.local, kVersions);
  const d = file.description;
  if (d.byteLength < 25) throw new DamagedFile('its description has another length');
  const [vertices, triangles, places, sources, lights, meshCount] = [0, 1, 2, 3, 4, 5].map((i) => d.getUint32(4 * i, true));
  const flags = d.getUint8(24);
  if (d.byteLength !== 25 + 13 * meshCount) throw new DamagedFile('its description has another length');
  const meshes: Mesh[] = [];
  let first = 0;
  for (let m = 0; m < meshCount; ++m) {
    const at = 25 + 13 * m, material = d.getUint32(at, true);
    if (material >= materials) throw new DamagedFile(`it has material ${material} of ${materials}`);
    meshes.push({ material, flags: d.getUint8(at + 12), firstTriangle: first });
    first += d.getUint32(at + 8, true);
  }
  if (first !== sources) throw new DamagedFile('its meshes hold other triangles than it says');
  const words = (fields: number, count: number) => file.records(new Array<4>(fields).fill(4), count) as Uint32Array[];
  const floats = (fields: number, count: number) => words(fields, count).map(asFloats);
  const vertex = floats(5, vertices);
  const triangle = words(4, triangles);
  const place = floats(6, places);
  const uv = [flags & kUv0 ? floats(2, places) : undefined, flags & kUv1 ? floats(2, places) : undefined];
  const colour = flags & kColours ? (file.records([1, 1, 1, 1], places) as Uint8Array[]) : undefined;
  const source = words(3, sources);
  const lightPlace = flags & kLight ? file.records([4, 2, 1], sources) : undefined;
  const light = flags & kLight ? (file.records([2, 2, 2], lights) as Uint16Array[]) : undefined;
  const plane = flags & kMirrors ? (file.records([1], sources)[0] as Uint8Array) : undefined;
  file.finish();
  const within = (fields: Uint32Array[], limit: number) => fields.every((field) => field.every((value) => value < limit));
  if (!within(triangle.slice(0, 3), vertices) || !within([triangle[3]], sources) || !within(source, places))
    throw new DamagedFile('its triangles name corners that it does not have');
  if (lightPlace)
    for (let s = 0; s < sources; ++s) {
      const r = lightPlace[1][s], each = r > 0 ? ((r + 1) * (r + 2)) / 2 : 0;
      if (lightPlace[0][s] + each * (lightPlace[2][s] ? 2 : 1) > lights) throw new DamagedFile('its light ends too early');
    }
  return { meshes, vertex, triangle, place, uv, colour, source, lightPlace, light, plane };
}

/** `origin`: positions are relative to it, so that floats keep their digits. */
export async function readLocal(bytes: Uint8Array, materials: readonly Material[], origin: Vec3): Promise<LocalGeometry> {
  const file = await unpack(bytes, materials.length);
  const { meshes, vertex, triangle, place, uv, colour, source, lightPlace, plane } = file;
  const count = triangle[0].length;
  const meshOf = new Uint32Array(source[0].length);
  meshes.forEach((mesh, m) => meshOf.fill(m, mesh.firstTriangle));

  const batchOf = (t: number): Omit<LocalBatch, 'firstTriangle' | 'triangles'> => {
    const mesh = meshes[meshOf[triangle[3][t]]], material = materials[mesh.material];
    const has = (use: TextureUse | undefined) => use !== undefined && (mesh.flags & (use.uvSet === 1 ? kUv1 : kUv0)) !== 0;
    return {
      material: mesh.material, colours: (mesh.flags & kColours) !== 0,
      baseUv: has(material.baseTexture), emissiveUv: has(material.emissiveTexture),
      plane: plane ? plane[triangle[3][t]] : kNoPlane,
    };
  };
  const order = Array.from({ length: count }, (_, t) => ({ t, batch: batchOf(t) }));
  const keyOf = ({ batch: b }: { batch: ReturnType<typeof batchOf> }) =>
    (((canBeClear(materials[b.material]) ? 1 : 0) * materials.length + b.material) * 8 + (b.colours ? 4 : 0) + (b.baseUv ? 2 : 0) + (b.emissiveUv ? 1 : 0)) * 256 + b.plane;
  order.sort((a, b) => keyOf(a) - keyOf(b) || a.t - b.t);

  const corners = new ArrayBuffer(kCornerBytes * 3 * count);
  const f32 = new Float32Array(corners), u32 = new Uint32Array(corners), u16 = new Uint16Array(corners);
  const batches: LocalBatch[] = [], clear: number[] = [];
  let firstClear = count;
  order.forEach(({ t, batch }, n) => {
    const s = triangle[3][t], material = materials[batch.material];
    if (n === 0 || keyOf(order[n - 1]) !== keyOf(order[n])) batches.push({ ...batch, firstTriangle: n, triangles: 0 });
    ++batches[batches.length - 1].triangles;
    const isClear = canBeClear(material);
    if (isClear && firstClear === count) firstClear = n;
    const at = [source[0][s], source[1][s], source[2][s]];
    const blend = (values: Float32Array | Uint8Array, b1: number, b2: number) =>
      values[at[0]] * (1 - b1 - b2) + values[at[1]] * b1 + values[at[2]] * b2;
    const r = lightPlace ? lightPlace[1][s] : 0;
    for (let c = 0; c < 3; ++c) {
      const v = triangle[c][t], b1 = vertex[3][v], b2 = vertex[4][v], to = (kCornerBytes / 4) * (3 * n + c);
      for (let axis = 0; axis < 3; ++axis) f32[to + axis] = vertex[axis][v] - origin[axis];
      f32[to + 3] = b1;
      f32[to + 4] = b2;
      [material.baseTexture, material.emissiveTexture].forEach((use, k) => {
        const set = use && (k === 0 ? batch.baseUv : batch.emissiveUv) ? uv[use.uvSet] : undefined;
        if (!use || !set) return;
        const x = blend(set[0], b1, b2), y = blend(set[1], b1, b2), m = use.transform;
        f32[to + 5 + 2 * k] = m[0] * x + m[1] * y + m[2];
        f32[to + 6 + 2 * k] = m[3] * x + m[4] * y + m[5];
      });
      for (let k = 0; k < 4; ++k)
        u16[2 * (to + 9) + k] = colour && batch.colours ? Math.round((blend(colour[k], b1, b2) / 255) * 65535) : 65535;
      u32[to + 11] = r > 0 ? lightPlace![0][s] : 0;
      u32[to + 12] = r | (r > 0 && lightPlace![2][s] ? kHasBack : 0);
      const normal: Vec3 = [blend(place[3], b1, b2), blend(place[4], b1, b2), blend(place[5], b1, b2)];
      f32.set(Math.hypot(...normal) > 0 ? normal : flatNormal(place, at), to + 13);
      if (isClear) clear.push(f32[to], f32[to + 1], f32[to + 2]);
    }
  });
  return {
    origin, corners, triangles: count, batches, firstClear, clearPositions: Float32Array.from(clear),
    light: file.light && interleave(file.light),
    mirrors: batches.some((batch) => batch.plane !== kNoPlane),
  };
}

function flatNormal(place: Float32Array[], at: number[]): Vec3 {
  const edge = (to: number): Vec3 => [0, 1, 2].map((axis) => place[axis][at[to]] - place[axis][at[0]]) as unknown as Vec3;
  const a = edge(1), b = edge(2);
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function interleave(fields: Uint16Array[]): Uint16Array {
  const out = new Uint16Array(fields.length * fields[0].length);
  fields.forEach((field, k) => field.forEach((value, i) => (out[fields.length * i + k] = value)));
  return out;
}
