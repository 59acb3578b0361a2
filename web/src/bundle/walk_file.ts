/** A walk: a bundle as one file that is read by ranges (engine/export/FORMAT.md, "Walks"). */

import { contentHash, DamagedFile, fetched, zstd } from './file';
import { distanceTo } from '../geometry/polygon';
import type { Vec2 } from '../geometry/vector';

const kHeaderBytes = 88, kHashAt = 72;
const kMagic = [0x41, 0x43, 0x57, 0x41, 0x4c, 0x4b, 0x0d, 0x0a];
const kVersion = 1;
/** What is asked for at first: header, root and, of most walks, the page where the walk begins. */
const kFirstBytes = 64 << 10;
const kMostRoot = 64 << 20, kMostPage = 16 << 20, kMostLevels = 8;

/** `again`: past what caches say. */
export type ReadRange = (at: number, bytes: number, again?: boolean) => Promise<{ bytes: Uint8Array; total: number }>;

/** Of an address, by HTTP. */
export const rangesOf = (url: string): ReadRange => async (at, bytes, again = false) => {
  const response = await fetched(url, again, { at, bytes });
  // Hosts of other origins may not show it.
  const total = Number(/\/(\d+)$/.exec(response.headers.get('Content-Range') ?? '')?.[1] ?? NaN);
  return { bytes: new Uint8Array(await response.arrayBuffer()), total };
};

interface Entry {
  at: number;
  bytes: number;
  raw: number;
  hash: string;
  box: readonly [number, number, number, number];
  leaf: boolean;
}
interface Leaf {
  cameras: object[];
  regions: { number: number; own: boolean; polygon: Vec2[] }[];
}
interface RootStorey {
  page: Entry | null;
}
interface Root {
  storeys: RootStorey[];
}

const isEntry = (entry: Partial<Entry> | null | undefined): entry is Entry =>
  !!entry && [entry.at, entry.bytes, entry.raw].every((n) => Number.isSafeInteger(n) && n! >= 0) && typeof entry.hash === 'string' &&
  Array.isArray(entry.box) && entry.box.length === 4 && entry.box.every((n) => Number.isFinite(n));

/** Of the index what is needed at one place. */
export interface WalkPage {
  at: number; // tells it from others
  text: string; // of bundle.json, with the page's cameras and regions alone
  own: boolean[]; // by region: is no other page needed there?
}

const distanceToBox = ([x0, y0, x1, y1]: Entry['box'], [x, y]: Vec2): number =>
  Math.hypot(Math.max(x0 - x, 0, x - x1), Math.max(y0 - y, 0, y - y1));

export class WalkFile {
  private readonly pages = new Map<number, Promise<object>>();
  private again = false; // something was damaged

  private constructor(
    private readonly read: ReadRange, private readonly root: Root, private readonly pageStart: number,
    readonly dataStart: number, private readonly first: Uint8Array,
  ) {}

  static async open(read: ReadRange): Promise<WalkFile> {
    const { bytes: first, total } = await read(0, kFirstBytes);
    if (first.length < kHeaderBytes || kMagic.some((byte, i) => first[i] !== byte)) throw new DamagedFile('this is no walk');
    const view = new DataView(first.buffer, first.byteOffset);
    if (view.getUint32(8, true) !== kVersion) throw new DamagedFile(`version ${view.getUint32(8, true)}; this page reads version ${kVersion}: export it again`);
    const hexOf = (at: number) => [8, 0].map((half) => view.getBigUint64(at + 8 - half, true)).map((n) => n.toString(16).padStart(16, '0')).join('');
    if ((await contentHash(first.slice(0, kHashAt))) !== hexOf(kHashAt)) throw new DamagedFile('its header is damaged');
    const [fileBytes, rootBytes, rootRaw, pageStart, dataStart] = [16, 24, 32, 40, 48].map((at) => Number(view.getBigUint64(at, true)));
    if (rootBytes > kMostRoot || rootRaw > kMostRoot || pageStart !== kHeaderBytes + rootBytes) throw new DamagedFile('its header makes no sense');
    if (!Number.isNaN(total) && total !== fileBytes) throw new DamagedFile(`it has ${total} bytes and says ${fileBytes}: it was not copied whole`);
    const walk = new WalkFile(read, { storeys: [] }, pageStart, dataStart, first);
    const root = (await walk.unpacked(kHeaderBytes, rootBytes, rootRaw, hexOf(56))) as Root;
    if (!Array.isArray(root.storeys)) throw new DamagedFile('its index makes no sense');
    return new WalkFile(read, root, pageStart, dataStart, first);
  }

  private async unpacked(at: number, bytes: number, raw: number, hash: string): Promise<object> {
    const packed = at + bytes <= this.first.length ? this.first.subarray(at, at + bytes) : (await this.read(at, bytes, this.again)).bytes;
    if (packed.length !== bytes || (await contentHash(packed)) !== hash) throw new DamagedFile(`the part of its index at ${at} is damaged`);
    let json: unknown;
    try {
      const text = (await zstd()).decode(packed, raw);
      if (text.length !== raw) throw new Error();
      json = JSON.parse(new TextDecoder().decode(text));
    } catch {
      throw new DamagedFile(`the part of its index at ${at} does not unpack`);
    }
    if (typeof json !== 'object' || json === null) throw new DamagedFile('its index makes no sense');
    return json;
  }

  private page(entry: Entry): Promise<object> {
    let page = this.pages.get(entry.at);
    if (!page) {
      if (entry.raw > kMostPage || entry.bytes > entry.raw + 1024) throw new DamagedFile('a page of its index is too large');
      page = this.unpacked(this.pageStart + entry.at, entry.bytes, entry.raw, entry.hash);
      page.catch(() => {
        this.pages.delete(entry.at); // asked for again, it may come
        this.again = true;
      });
      this.pages.set(entry.at, page);
    }
    return page;
  }

  /** The page whose own regions hold a place of a storey, or come nearest to it. */
  async pageAt(storey: number, place: Vec2): Promise<WalkPage> {
    const root = this.root.storeys[storey]?.page;
    let best: { leaf: Leaf; at: number; number: number; distance: number } | undefined;
    const visit = async (entry: Entry, level: number): Promise<void> => {
      if (!isEntry(entry) || level >= kMostLevels) throw new DamagedFile('its index makes no sense');
      if (best && distanceToBox(entry.box, place) > best.distance) return;
      const page = await this.page(entry);
      if (!entry.leaf) {
        const { pages } = page as { pages: Entry[] };
        if (!Array.isArray(pages) || !pages.every(isEntry)) throw new DamagedFile('its index makes no sense');
        const near = [...pages].sort((a, b) => distanceToBox(a.box, place) - distanceToBox(b.box, place));
        for (const child of near) await visit(child, level + 1);
        return;
      }
      const leaf = page as Leaf;
      if (!Array.isArray(leaf.cameras) || !Array.isArray(leaf.regions))
        throw new DamagedFile('its index makes no sense');
      for (const region of leaf.regions) {
        if (!region.own) continue;
        if (!Array.isArray(region.polygon) || region.polygon.length < 3) throw new DamagedFile('its index makes no sense');
        const distance = distanceTo(region.polygon, place);
        // Of regions that overlap the first is the eye's.
        if (!best || distance < best.distance || (distance === best.distance && region.number < best.number))
          best = { leaf, at: entry.at, number: region.number, distance };
      }
    };
    if (root) await visit(root, 0);
    if (!best) throw new DamagedFile('it has no region to stand in');
    const { leaf, at } = best;
    const storeys = this.root.storeys.map((other, number) =>
      number === storey ? { ...other, cameras: leaf.cameras, regions: leaf.regions } : { ...other, cameras: [], regions: [] },
    );
    return { at, text: JSON.stringify({ ...this.root, storeys }), own: leaf.regions.map((region) => region.own) };
  }

  /** Where the walk begins. */
  async firstPage(): Promise<WalkPage> {
    const { storey, storeys } = this.root as unknown as { storey: number; storeys: { start?: { position?: Vec2 } }[] };
    const place = storeys[storey]?.start?.position;
    if (!Array.isArray(place)) throw new DamagedFile('its index makes no sense');
    return this.pageAt(storey, place);
  }
}
