import { describe, expect, it } from 'vitest';
import { contentHash } from '../src/bundle/file';
import { WalkFile, type ReadRange } from '../src/bundle/walk_file';

/** A zstd frame of blocks that are not packed. */
function frameOf(text: Uint8Array): Uint8Array {
  const kBlock = 128 << 10, blocks = Math.max(1, Math.ceil(text.length / kBlock));
  const out = new Uint8Array(13 + 3 * blocks + text.length), view = new DataView(out.buffer);
  view.setUint32(0, 0xfd2fb528, true);
  out[4] = 0xe0; // one segment, its size in 8 bytes
  view.setBigUint64(5, BigInt(text.length), true);
  for (let n = 0, to = 13; n < blocks; ++n) {
    const block = text.subarray(n * kBlock, (n + 1) * kBlock), head = (block.length << 3) | (n + 1 === blocks ? 1 : 0);
    out.set([head & 255, (head >> 8) & 255, head >> 16], to);
    out.set(block, to + 3);
    to += 3 + block.length;
  }
  return out;
}

type Json = Record<string, unknown>;
type Box = [number, number, number, number];

/** A walk over side x side square regions; its index in pages of about 64, 32 of them below another, as the engine writes it. */
class Made {
  readonly pages = new Map<number, Uint8Array>(); // by where they lie
  private end = 0;
  bytesRead = 0;
  requests = 0;
  header = new Uint8Array(88);
  private root: Uint8Array = new Uint8Array(0);
  private size = 0;

  static async of(side: number): Promise<Made> {
    const made = new Made();
    const page = await made.pageOf([0, 0, side, side]);
    const start: [number, number] = [side / 2 + 0.5, side / 2 + 0.5];
    const text = new TextEncoder().encode(JSON.stringify({ storey: 0, storeys: [{ start: { position: start, yaw: 0 }, regionCount: side * side, page }] }));
    made.root = frameOf(text);
    const view = new DataView(made.header.buffer);
    made.header.set([0x41, 0x43, 0x57, 0x41, 0x4c, 0x4b, 0x0d, 0x0a]);
    view.setUint32(8, 1, true);
    made.size = 88 + made.root.length + made.end + 1000;
    [made.size, made.root.length, text.length, 88 + made.root.length, 88 + made.root.length + made.end].forEach((n, i) => view.setBigUint64(16 + 8 * i, BigInt(n), true));
    const put = (hash: string, at: number) => [0, 16].forEach((from, i) => view.setBigUint64(at + 8 * i, BigInt(`0x${hash.slice(from, from + 16)}`), true));
    put(await contentHash(made.root), 56);
    put(await contentHash(made.header.slice(0, 72)), 72);
    return made;
  }

  private async pageOf(box: Box): Promise<Json> {
    const [x0, y0, x1, y1] = box, leaf = (x1 - x0) * (y1 - y0) <= 64;
    let page: Json;
    if (leaf) {
      const regions = [];
      for (let y = y0; y < y1; ++y) for (let x = x0; x < x1; ++x) regions.push({ own: true, number: x * 7919 + y, polygon: [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]] });
      page = { cameras: [], regions };
    } else {
      let parts: Box[] = [box];
      while (parts.length < 32) {
        const area = ([a, b, c, d]: Box) => (c - a) * (d - b), largest = parts.reduce((m, p) => (area(p) > area(m) ? p : m));
        if (area(largest) <= 64) break;
        const [a, b, c, d] = largest, mx = (a + c) >> 1, my = (b + d) >> 1;
        parts = parts.filter((p) => p !== largest).concat(c - a > d - b ? [[a, b, mx, d], [mx, b, c, d]] : [[a, b, c, my], [a, my, c, d]]);
      }
      const pages = [];
      for (const part of parts) pages.push(await this.pageOf(part));
      page = { pages };
    }
    const text = new TextEncoder().encode(JSON.stringify(page)), packed = frameOf(text), at = this.end;
    this.pages.set(at, packed);
    this.end += packed.length;
    return { at, bytes: packed.length, raw: text.length, hash: await contentHash(packed), box, leaf };
  }

  read: ReadRange = async (at, bytes) => {
    const head = new Uint8Array(88 + this.root.length);
    head.set(this.header);
    head.set(this.root, 88);
    const out = at < head.length ? head.slice(at, at + bytes) : (this.pages.get(at - head.length) ?? new Uint8Array(bytes)).slice(0, bytes);
    this.bytesRead += out.length;
    ++this.requests;
    return { bytes: out, total: this.size };
  };
}

const ownNumbers = (text: string, own: boolean[]): number[] =>
  (JSON.parse(text) as { storeys: { regions: { number: number }[] }[] }).storeys[0].regions.filter((_, i) => own[i]).map((r) => r.number);

describe('a walk', () => {
  it('of a million regions opens by a few pages of its index', async () => {
    const made = await Made.of(1000);
    const walk = await WalkFile.open(made.read);
    const page = await walk.firstPage();
    expect(ownNumbers(page.text, page.own)).toContain(500 * 7919 + 500);
    console.log(`${made.pages.size} pages; ${made.requests} requests, ${(made.bytesRead / 1e3).toFixed(0)} kB`);
    expect(made.bytesRead).toBeLessThan(1e6);
  }, 120000);

  it('tells of every place, and of the nearest region outside', async () => {
    const made = await Made.of(40);
    const walk = await WalkFile.open(made.read);
    for (const [x, y] of [[0.5, 0.5], [39.5, 0.5], [20.2, 31.7], [10, 10.5], [39.9, 39.9]] as const) {
      const { text, own } = await walk.pageAt(0, [x, y]);
      const near = ownNumbers(text, own);
      expect(near.includes(Math.floor(x) * 7919 + Math.floor(y)) || near.includes((Math.floor(x) - 1) * 7919 + Math.floor(y))).toBe(true);
    }
    const { text, own } = await walk.pageAt(0, [50, 12.5]);
    expect(ownNumbers(text, own)).toContain(39 * 7919 + 12);
    const before = made.requests;
    await walk.pageAt(0, [0.5, 0.5]);
    expect(made.requests).toBe(before); // what was read is kept
  });

  it('is refused where it is damaged, cut off or something else', async () => {
    const made = await Made.of(20);
    const broken = (at: number): ReadRange => async (from, bytes) => {
      const part = await made.read(from, bytes);
      if (at >= from && at < from + part.bytes.length) part.bytes[at - from] ^= 4;
      return part;
    };
    for (let at = 0; at < 88; at += 5) await expect(WalkFile.open(broken(at)), `byte ${at}`).rejects.toThrow();
    await expect(WalkFile.open(broken(120))).rejects.toThrow('damaged');
    await expect(WalkFile.open(async (at, bytes) => ({ ...(await made.read(at, bytes)), total: 7 }))).rejects.toThrow('not copied whole');
    await expect(WalkFile.open(async () => ({ bytes: new TextEncoder().encode('<!doctype html>'), total: 15 }))).rejects.toThrow('no walk');
    for (const packed of made.pages.values()) packed[packed.length >> 1] ^= 1;
    await expect((await WalkFile.open(made.read)).firstPage()).rejects.toThrow('damaged');
  });
});
