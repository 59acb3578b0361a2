/** What is known and loaded of a walk around an eye, and its picture. Knows a WebGL2 context, and no element of a page. */

import { readIndex } from './bundle/read_index';
import type { WalkPage } from './bundle/walk_file';
import type { Bundle, Storey } from './bundle/types';
import { savesData } from './device';
import { chooseCover, RegionIndex } from './geometry/regions';
import type { Vec2 } from './geometry/vector';
import type { View } from './geometry/view';
import type { OpenWalk } from './open_walk';
import { Renderer, type FrameFacts, type Within } from './render/renderer';
import { Stream, type Failure } from './stream/stream';
import { camerasInOrder, type Viewer } from './stream/wanted';

/** While captures of the first picture come, it is drawn no more often than this, milliseconds; nor in more than a quarter of the time. */
const kWhileLoading = 400, kShareWhileLoading = 4;
/** Walking from storey to storey, the last picture stays until there is one of the next, at most so long, milliseconds. */
const kEntering = 1000;

const placeOf = (view: { eye: readonly [number, number, number] }): Vec2 => [view.eye[0], view.eye[1]];

export class LoadedWalk {
  bundle: Bundle;
  storey: number;
  facts: FrameFacts = { patches: 0, captures: [], missing: [], awaited: false, localTriangles: 0 };
  readonly failures = new Map<string, Failure>();

  private renderer: Renderer;
  private stream: Stream;
  private index: RegionIndex;
  private readonly indices = new Map<number, RegionIndex>();
  private lastRegion = -1; // drawn
  private page: WalkPage | undefined; // of a walk's index, that is open
  private shownSince = -Infinity; // the storey, milliseconds
  private refused: number | undefined; // the region whose page could not be had
  private turning = 0; // to other pages
  private turns: Promise<void> = Promise.resolve();

  /** `memory`: MB. `within`: as Renderer's. `changed`: something has come that pictures may show. */
  constructor(
    private readonly gl: WebGL2RenderingContext, private readonly opened: OpenWalk, private memory: number, private readonly within: Within,
    private readonly events: { changed: () => void; failed: (failure: Failure) => void },
  ) {
    this.bundle = opened.bundle;
    this.storey = this.bundle.storey;
    this.page = opened.source?.first;
    this.index = this.indexOf(this.storey);
    this.renderer = new Renderer(gl, this.bundle, opened.planner, within);
    this.stream = this.openStream();
  }

  get current(): Storey {
    return this.bundle.storeys[this.storey];
  }
  get regions(): RegionIndex {
    return this.index;
  }
  get canFill(): boolean {
    return this.renderer.canFill;
  }
  get loading(): number {
    return this.stream.loading;
  }
  /** Is nothing on its way? */
  get resting(): boolean {
    return this.stream.loading === 0 && this.turning === 0;
  }
  get bytes(): number {
    return this.stream.bytes;
  }
  get picture() {
    return this.renderer.picture;
  }
  isFull = (camera: number) => this.stream.isFull(camera);

  /** Captures that the picture lacks and the bundle does not hold. */
  get unbaked(): number {
    return this.facts.missing.filter((camera) => !this.current.cameras[camera].full && !this.current.cameras[camera].coarse).length;
  }

  /** What is known of them; undefined where it is nothing. */
  regionsOf = (storey: number): RegionIndex | undefined => (this.bundle.storeys[storey].regions.length > 0 ? this.indexOf(storey) : undefined);

  private indexOf(storey: number): RegionIndex {
    let index = this.indices.get(storey);
    if (!index) this.indices.set(storey, (index = new RegionIndex(this.bundle.storeys[storey])));
    return index;
  }

  private openStream(): Stream {
    const stream = new Stream(
      this.bundle, this.current, this.renderer, this.opened.pool, () => this.events.changed(), (failure) => this.fail(failure.file, failure),
    );
    stream.limit = this.memory * 1e6;
    return stream;
  }

  fail(name: string, failure: Failure): void {
    this.failures.set(name, failure);
    this.events.failed(failure);
  }

  /** MB. */
  limitMemory(memory: number): void {
    this.memory = memory;
    this.stream.limit = memory * 1e6;
  }

  /** To a storey: at once where the index tells of the place there, and never where it cannot be had. */
  async enter(storey: number, place: Vec2, there: () => void = () => undefined): Promise<void> {
    if (this.opened.source && (storey !== this.storey || !this.isOwn(this.index.regionAt(place)))) await this.turnTo(storey, place);
    if (this.bundle.storeys[storey].regions.length === 0) return;
    this.show(storey);
    there();
  }

  private show(storey: number): void {
    if (storey === this.storey) return;
    this.storey = storey;
    this.index = this.indexOf(storey);
    this.stream.close();
    this.stream = this.openStream();
    this.lastRegion = -1;
    this.shownSince = performance.now();
    this.forgetDrawn();
  }

  /** Cameras by numbers of a page or storey that was left. */
  private forgetDrawn(): void {
    this.facts = { ...this.facts, captures: [], missing: [] };
  }

  private isOwn = (region: number): boolean => region >= 0 && (this.page?.own[region] ?? true);

  /** To the page of a walk's index that tells of a place; one turn after another. */
  private turnTo(storey: number, place: Vec2): Promise<void> {
    ++this.turning;
    return (this.turns = this.turns.then(() => this.turn(storey, place)).finally(() => --this.turning));
  }

  private async turn(storey: number, place: Vec2): Promise<void> {
    try {
      const page = await this.opened.source!.walk.pageAt(storey, place);
      if (page.at === this.page?.at) return;
      const bundle = readIndex(page.text);
      this.opened.planner.open(page.text);
      const last = this.lastRegion < 0 ? -1 : this.current.regions[this.lastRegion].number;
      this.bundle = bundle;
      this.page = page;
      this.forgetDrawn();
      this.indices.clear();
      if (storey !== this.storey) return; // there is no stream of it yet
      this.index = this.indexOf(storey);
      this.lastRegion = bundle.storeys[storey].regions.findIndex((region) => region.number === last);
      this.stream.showPage(this.current);
      this.events.changed();
    } catch (error) {
      this.refused = this.current.regions[this.index.regionAt(place)]?.number;
      this.fail('index', { file: 'the index', reason: (error as Error).message });
    }
  }

  /** Loads for an eye that is there now. */
  follow(viewer: Omit<Viewer, 'region' | 'saving'>): void {
    const region = this.index.regionAt(viewer.eye);
    this.stream.update({ ...viewer, region, saving: savesData() });
    if (this.opened.source && this.turning === 0 && region >= 0 && !this.isOwn(region) && this.current.regions[region].number !== this.refused)
      void this.turnTo(this.storey, viewer.eye);
  }

  /**
   * Drawing takes time from what is loading: a first picture is not drawn for every capture that comes. `since`, `took`: how
   * long ago the last frame was, and how long it took, milliseconds.
   */
  waits(eye: Vec2, yaw: number, since: number, took: number): boolean {
    const region = this.index.regionAt(eye);
    if (region < 0) return false;
    const cameras = camerasInOrder(this.current, region, eye, yaw);
    if (cameras.every((camera) => this.stream.capture(camera) || !this.stream.mayCome(camera))) return false;
    return since < Math.max(kWhileLoading, kShareWhileLoading * took);
  }

  /** Draws the view; false where no region shows anything. */
  draw(view: View, loudHoles: boolean): boolean {
    const region = this.drawnRegion(view);
    if (region < 0) return false;
    const awaited = (camera: number) => !this.stream.capture(camera) && this.stream.mayCome(camera);
    if (performance.now() - this.shownSince < kEntering && camerasInOrder(this.current, region, placeOf(view), view.yaw).some(awaited)) return false;
    const scene = {
      number: this.storey, storey: this.current, region, captureOf: (camera: number) => this.stream.capture(camera),
      mayCome: (camera: number) => this.stream.mayCome(camera), local: this.stream.local(region),
    };
    this.facts = this.renderer.draw(scene, view, loudHoles);
    return true;
  }
  /** What was drawn, on the canvas. */
  present = (): void => this.renderer.present();

  /** That of the eye; while more of its captures are missing, the one before, whose pictures reach a little beyond it. */
  private drawnRegion(view: View): number {
    const { regions } = this.current, eye = placeOf(view), region = this.index.regionAt(eye);
    const missing = (number: number) => {
      const pieces = chooseCover(regions[number], eye, view.yaw)?.pieces ?? [];
      return pieces.length === 0 ? 1 : pieces.filter((piece) => !this.stream.capture(piece.camera)).length / pieces.length;
    };
    if (region >= 0 && (this.lastRegion < 0 || missing(region) <= missing(this.lastRegion))) this.lastRegion = region;
    return this.lastRegion;
  }

  retry(): void {
    this.failures.clear();
    this.refused = undefined;
    this.stream.retry();
  }

  contextLost(): void {
    this.stream.close();
  }
  contextRestored(): void {
    this.renderer = new Renderer(this.gl, this.bundle, this.opened.planner, this.within);
    this.stream = this.openStream();
  }

  /** Gives back all that it took of the graphics card. */
  release(): void {
    this.stream.close();
    this.renderer.release();
  }
}
