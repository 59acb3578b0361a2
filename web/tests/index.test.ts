import { describe, expect, it } from 'vitest';
import { readIndex } from '../src/bundle/read_index';
import { checkedBytes } from '../src/stream/load_file';
import { contentHash } from '../src/bundle/file';
import { defaultMemory } from '../src/device';
import { FrameTimes } from '../src/ui/frame_times';
import { isStill, movementOf } from '../src/ui/controls';

const file = (name: string) => ({ file: name, bytes: 10, hash: 'ab'.repeat(16) });
function sound() {
  const corners = [[0, 0], [1, 0], [0, 1]];
  return {
    format: 'acentric bundle', version: 4, name: 'room', exposure: 1, toneCurve: 'acentric neutral 1', fov: 1.05,
    view: { maxSplatPixels: 16 }, storey: 0,
    sky: { zenith: [0, 0, 0], horizon: [0, 0, 0], ground: [0, 0, 0] },
    bounds: { min: [0, 0, 0], max: [1, 1, 1] },
    textures: [{ ...file('textures/a.png'), width: 4, height: 8, wrapU: 'repeat', wrapV: 'clamp', filter: 'linear', colourSpace: 'sRGB' }],
    materials: [
      {
        baseColour: [1, 1, 1, 1], baseColourTexture: { texture: 0, uvSet: 0, transform: [[1, 0, 0], [0, 1, 0]] }, emissive: [0, 0, 0],
        emissiveTexture: null, alphaMode: 'opaque', alphaCutoff: 0.5, transmission: 0, unlit: false,
      },
    ],
    mirrors: [], bookmarks: [{ name: 'door', storey: 0, eye: [0, 0, 1.6], yaw: 0, pitch: 0, fov: 1 }],
    storeys: [
      {
        name: 'floor', floorHeight: 0, slope: undefined, eyeZ: 1.6, nearBand: 1, start: { position: [0.2, 0.2], yaw: 0 }, outline: [],
        cameras: [
          {
            position: [0, 0], lowAzimuth: 0, fov: 1, topElevation: 1, bottomElevation: -1,
            full: { ...file('captures/a.pack'), columns: 4, rows: 4, samples: 5, reflections: 2 }, coarse: null,
          },
        ],
        regions: [
          {
            kind: 'ring', polygon: corners, grown: corners, neighbours: [], local: null, panoramas: [],
            covers: [
              {
                hand: 'clockwise', wedges: 0,
                pieces: [{ camera: 0, clip: { line: [[0, 0], [1, 1]], left: true, claim: { line: [[0, 0], [1, 0]], left: false } }, roles: 3 }],
              },
            ],
          },
        ],
      },
    ],
  };
}
type Index = ReturnType<typeof sound>;
/** What reading says of the index with something in it changed. */
function complaint(change: (index: Index) => unknown): string {
  const index = sound();
  change(index);
  try {
    readIndex(JSON.stringify(index));
    return '';
  } catch (error) {
    return (error as Error).message;
  }
}

describe('the index', () => {
  it('is read', () => {
    const bundle = readIndex(JSON.stringify(sound()));
    expect(bundle.storeys[0].cameras[0]).toMatchObject({ middle: 0.5, full: { samples: 7 }, coarse: undefined });
    expect(bundle.materials[0].baseTexture?.transform).toEqual([1, 0, 0, 0, 1, 0]);
  });

  it('is read with 200,000 cameras', () => {
    const index = sound();
    const [storey] = index.storeys;
    storey.cameras = Array.from({ length: 200_000 }, (_, i) => ({ ...storey.cameras[0], topElevation: i / 200_000 }));
    const { topElevation, bottomElevation } = readIndex(JSON.stringify(index)).storeys[0];
    expect(topElevation).toBeCloseTo(1, 4);
    expect(bottomElevation).toBe(-1);
  });

  it.each<[string, (index: Index) => unknown, string]>([
    ['another format', (i) => (i.format = 'zip'), '/format'],
    ['another version', (i) => (i.version = 5), 'version 5'],
    ['another tone curve', (i) => (i.toneCurve = 'filmic'), '/toneCurve'],
    ['a path upwards', (i) => (i.textures[0].file = '../../etc/passwd.png'), '/textures/0/file'],
    ['an absolute path', (i) => (i.textures[0].file = '/etc/a.png'), '/textures/0/file'],
    ['an address', (i) => (i.textures[0].file = 'http://host/a.png'), '/textures/0/file'],
    ['a hash too short', (i) => (i.textures[0].hash = 'ab'), '/textures/0/hash'],
    ['a texture too large', (i) => (i.textures[0].width = i.textures[0].height = 65536), '/textures/0/height'],
    ['an absurd size', (i) => (i.textures[0].bytes = 1e15), '/textures/0/bytes'],
    ['a camera out of range', (i) => (i.storeys[0].regions[0].covers[0].pieces[0].camera = 1), '/storeys/0/regions/0/covers/0/pieces/0/camera'],
    ['a polygon of two corners', (i) => i.storeys[0].regions[0].polygon.pop(), '/storeys/0/regions/0/polygon'],
    ['text where a number belongs', (i) => Object.assign(i.storeys[0], { eyeZ: 'high' }), '/storeys/0/eyeZ'],
    ['half a camera', (i) => (i.storeys[0].regions[0].neighbours = [0.5] as never[]), '/storeys/0/regions/0/neighbours/0'],
    ['a number that is none', (i) => Object.assign(i.sky, { zenith: [null, 0, 0] }), '/sky/zenith/0'],
    ['no regions', (i) => (i.storeys[0].regions = []), '/storeys/0/regions'],
    ['an unknown word', (i) => (i.materials[0].alphaMode = 'dither'), '/materials/0/alphaMode'],
  ])('is refused with %s', (_, change, where) => expect(complaint(change)).toContain(where));

  it('is refused when it is no JSON', () => expect(() => readIndex('<!doctype html>')).toThrow('not JSON'));
});

describe('files', () => {
  const bytes = new Uint8Array([1, 2, 3]);
  it('are what the index says', async () => {
    const hash = await contentHash(bytes);
    await expect(checkedBytes(bytes, { file: 'a.pack', bytes: 3, hash })).resolves.toBe(bytes);
    await expect(checkedBytes(bytes, { file: 'a.pack', bytes: 4, hash })).rejects.toThrow('3 bytes instead of 4');
    await expect(checkedBytes(new Uint8Array([1, 2, 4]), { file: 'a.pack', bytes: 3, hash })).rejects.toThrow('damaged');
  });
});

describe('controls', () => {
  it('add up', () => {
    expect(movementOf(new Set(['KeyW', 'ArrowLeft']), false)).toMatchObject({ forward: 1, turn: 1, right: 0 });
    expect(isStill(movementOf(new Set(['KeyW', 'KeyS']), true))).toBe(true);
    expect(movementOf(new Set(['KeyW', 'ArrowUp']), false).forward).toBe(1);
  });
});

describe('readouts', () => {
  it('tell the median and the worst frame of the last second', () => {
    const times = new FrameTimes();
    expect(times.summary).toBeUndefined();
    times.add(0, 500);
    for (let n = 0; n < 5; ++n) times.add(1100 + n, 10 + n);
    expect(times.summary).toEqual({ median: 12, worst: 14, count: 5 });
  });
  it('choose memory by the device', () => {
    expect(defaultMemory(8, false)).toBe(1024);
    expect(defaultMemory(undefined, true)).toBe(384);
    expect(defaultMemory(0.5, true)).toBe(256);
    expect(defaultMemory(16, true)).toBe(512);
  });
});
