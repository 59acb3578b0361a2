/** Keeps what the eye needs and is walking towards on the graphics card, within a limit of memory. */

import { bytesOfLocal } from '../engine/local_reader';
import type { Bundle, FileRef, Storey } from '../bundle/types';
import { distance2 } from '../geometry/vector';
import type { GpuLocal } from '../render/local_pass';
import type { GpuCapture, Renderer } from '../render/renderer';
import { Cache } from './cache';
import type { LoaderPool } from './pool';
import { camerasInOrder, keyOf, wantedItems, type Item, type Viewer } from './wanted';

type Held = { kind: 'capture'; gpu: GpuCapture } | { kind: 'local'; gpu: GpuLocal };

export interface Failure {
  file: string;
  reason: string;
}

export class Stream {
  /** By file. */
  readonly failures = new Map<string, Failure>();
  private readonly failedItems = new Set<string>();
  private readonly cache: Cache<Held>;
  private readonly underWay = new Set<string>();
  private readonly textures = new Map<number, Promise<void>>();
  private readonly measured = new Map<string, number>(); // bytes
  private viewer: Viewer | undefined;
  private retrying = false;
  private closed = false;
  limit = 1 << 30; // bytes

  constructor(
    private readonly bundle: Bundle, private storey: Storey, private readonly renderer: Renderer,
    private readonly pool: LoaderPool, private readonly changed: () => void, private readonly failed: (failure: Failure) => void,
  ) {
    pool.onRoom = () => this.pump(); // whether what came was for this stream or one before it
    this.cache = new Cache((held) => (held.kind === 'capture' ? renderer.deleteCapture(held.gpu) : renderer.deleteLocal(held.gpu)));
  }

  get bytes(): number {
    return this.cache.bytes;
  }
  get loading(): number {
    return this.underWay.size;
  }

  /** The best of a camera that is there. */
  capture(camera: number): GpuCapture | undefined {
    const of = (grade: 'full' | 'coarse') => this.cache.get({ grade, number: this.storey.cameras[camera].number });
    const held = of('full') ?? of('coarse');
    return held?.kind === 'capture' ? held.gpu : undefined;
  }
  isFull = (camera: number) => this.cache.has({ grade: 'full', number: this.storey.cameras[camera].number });
  local(region: number): GpuLocal | undefined {
    const held = this.cache.get({ grade: 'local', number: this.storey.regions[region].number });
    return held?.kind === 'local' ? held.gpu : undefined;
  }

  /** Is a capture of the camera on its way, or to be asked for? */
  mayCome(camera: number): boolean {
    const renditions = this.storey.cameras[camera];
    return (['coarse', 'full'] as const).some(
      (grade) => renditions[grade] !== undefined && !this.failedItems.has(keyOf({ grade, number: renditions.number })),
    );
  }

  /** What it took when it was there; were only the guess believed, what does not quite fit would come and go for ever. */
  private bytesOf = (item: Item): number => this.measured.get(keyOf(item)) ?? item.bytes;
  private distanceOf = (item: Item): number => distance2(item.place, this.viewer!.eye);

  /** The same storey, of which the index tells of other parts now. */
  showPage(storey: Storey): void {
    this.storey = storey;
    this.viewer = undefined; // until it knows its region there
  }

  /** After the eye has moved, or settings have changed. */
  update(viewer: Viewer): void {
    this.viewer = viewer;
    this.pump();
  }

  private pump(): void {
    if (this.closed || !this.viewer || this.viewer.region < 0) return;
    const { viewer } = this;
    const wanted = wantedItems(this.storey, viewer, (item) => this.failedItems.has(keyOf(item)));
    // What the picture cannot do without: one capture of each camera, and what is near.
    const needed = new Set(camerasInOrder(this.storey, viewer.region, viewer.eye, viewer.yaw)).size + 1;
    const missing = this.cache.plan(wanted, needed, this.limit, this.bytesOf, this.distanceOf);
    for (const item of missing) {
      if (this.pool.room === 0) break;
      if (!this.underWay.has(keyOf(item))) void this.fetch(item);
    }
  }

  private async fetch(item: Item): Promise<void> {
    const key = keyOf(item), { file } = item;
    this.underWay.add(key);
    try {
      if (item.grade === 'local') await this.fetchLocal(item, file);
      else {
        const loaded = await this.pool.load({ kind: 'capture', exposure: this.bundle.exposure }, file, this.retrying);
        if (loaded.kind !== 'capture' || this.closed) return;
        const gpu = this.renderer.uploadCapture(loaded.capture);
        this.measured.set(key, gpu.bytes);
        this.cache.add(item, { kind: 'capture', gpu }, gpu.bytes);
      }
      this.changed();
    } catch (error) {
      this.failedItems.add(key);
      this.fail(file.file, error);
    } finally {
      this.underWay.delete(key);
    }
  }

  private async fetchLocal(item: Item, file: FileRef): Promise<void> {
    const [x, y] = item.place;
    const { materials } = this.bundle;
    const loaded = await this.pool.load({ kind: 'local', origin: [x, y, this.storey.eyeZ] }, file, this.retrying);
    if (loaded.kind !== 'local') return;
    const used = loaded.local.batches.flatMap((batch) => {
      const { baseTexture, emissiveTexture } = materials[batch.material];
      return [baseTexture, emissiveTexture].flatMap((use) => (use ? [use.texture] : []));
    });
    await Promise.all([...new Set(used)].map((texture) => this.texture(texture)));
    if (this.closed) return;
    const bytes = bytesOfLocal(loaded.local);
    this.measured.set(keyOf(item), bytes);
    this.cache.add(item, { kind: 'local', gpu: this.renderer.uploadLocal(loaded.local) }, bytes);
  }

  /** Each once; without it its surfaces are drawn plain. */
  private texture(number: number): Promise<void> {
    let done = this.textures.get(number);
    if (!done) {
      const file = this.bundle.textures[number];
      done = this.pool.load({ kind: 'texture', width: file.width, height: file.height }, file, this.retrying).then(
        (loaded) => {
          if (loaded.kind !== 'texture' || this.closed) return;
          this.renderer.uploadTexture(number, loaded.picture);
          loaded.picture.close();
        },
        (error: unknown) => {
          this.textures.delete(number);
          this.fail(file.file, error);
        },
      );
      this.textures.set(number, done);
    }
    return done;
  }

  private fail(file: string, error: unknown): void {
    if (this.closed) return;
    const failure: Failure = { file, reason: error instanceof Error ? error.message : String(error) };
    const known = this.failures.has(file);
    this.failures.set(file, failure);
    if (!known) this.failed(failure);
  }

  /** Asks once more for what could not be had. */
  retry(): void {
    this.failures.clear();
    this.failedItems.clear();
    this.retrying = true; // past caches that may hold what was damaged
    this.pump();
  }

  close(): void {
    this.closed = true;
    this.cache.clear();
  }
}
