/** The walk: where the eye is, what is loaded for it, and when a frame is drawn. Knows the canvas and no other element. */

import { readIndex } from './bundle/read_index';
import type { WalkPage } from './bundle/walk_file';
import type { Bundle, Path, Storey } from './bundle/types';
import { durationOf, poseAt } from './geometry/path';
import { chooseCover, RegionIndex } from './geometry/regions';
import { viewAt, type Pose, type View } from './geometry/view';
import type { Planner } from './engine/planner';
import { Renderer, type FrameFacts } from './render/renderer';
import type { Settings } from './settings';
import type { LoaderPool } from './stream/pool';
import type { WalkSource } from './stream/source';
import { Stream, type Failure } from './stream/stream';
import { camerasInOrder } from './stream/wanted';
import { FrameTimes } from './ui/frame_times';
import { isStill, type Movement } from './ui/controls';

const kMetresPerSecond = 1.4, kRadiansPerSecond = 1.4, kFaster = 2.5;
const kMostPitch = (85 * Math.PI) / 180;
/** Frames that take longer than this are drawn smaller while the eye moves, milliseconds. */
const kSlow = 60, kQuick = 30;
/** While captures of the first picture come, it is drawn no more often than this, milliseconds; nor in more than a quarter of the time. */
const kWhileLoading = 400, kShareWhileLoading = 4;

/** Did the user ask the browser to save data? Not all browsers tell. */
const savesData = (): boolean => (navigator as { connection?: { saveData?: boolean } }).connection?.saveData === true;

export class Walk {
  pose: Pose;
  storey: number;
  facts: FrameFacts = { patches: 0, captures: [], missing: [], awaited: false, localTriangles: 0 };
  readonly times = new FrameTimes();
  /** Milliseconds from the page's beginning to the first picture without a capture missing that may come. */
  firstPicture: number | undefined;
  framesDrawn = 0;
  drawing = { width: 0, height: 0 };
  readonly failures = new Map<string, Failure>();

  private renderer: Renderer;
  private stream: Stream;
  private index: RegionIndex;
  private readonly indices = new Map<number, RegionIndex>();
  private dirty = true;
  private scheduled = false;
  private pending: { sync: WebGLSync; began: number; moving: boolean } | undefined;
  private lastTick: number | undefined;
  private lastDraw = 0; // the page's beginning
  private lastTook = 0;
  private lastRegion = -1; // drawn
  private velocity: [number, number] = [0, 0];
  private movingScale = 1;
  private lost = false;
  private playing: { path: Path; began: number | undefined } | undefined;
  private page: WalkPage | undefined; // of a walk's index, that is open
  private refused: number | undefined; // the region whose page could not be had
  private turning = 0; // to other pages
  private turns: Promise<void> = Promise.resolve();

  constructor(
    private readonly canvas: HTMLCanvasElement, private readonly gl: WebGL2RenderingContext, public bundle: Bundle,
    readonly settings: Settings, private readonly pool: LoaderPool,
    private readonly planner: Planner, private readonly source: WalkSource | undefined, private readonly movement: () => Movement,
    private readonly events: { drawn: () => void; failed: () => void; stopped: () => void },
  ) {
    this.storey = bundle.storey;
    this.page = source?.first;
    this.index = this.indexOf(this.storey);
    this.pose = this.startPose();
    this.renderer = new Renderer(gl, bundle, planner);
    this.stream = this.openStream();
    new ResizeObserver(() => this.redraw()).observe(canvas);
    this.redraw();
  }

  get current(): Storey {
    return this.bundle.storeys[this.storey];
  }
  get regions(): RegionIndex {
    return this.index;
  }
  get region(): number {
    return this.index.regionAt([this.pose.eye[0], this.pose.eye[1]]);
  }
  get canFill(): boolean {
    return this.renderer.canFill;
  }
  get loading(): number {
    return this.stream.loading;
  }
  /** Is all drawn and loaded that is worth having here? */
  get resting(): boolean {
    return !this.dirty && !this.pending && this.stream.loading === 0 && this.turning === 0;
  }
  get bytes(): number {
    return this.stream.bytes;
  }
  isFull = (camera: number) => this.stream.isFull(camera);

  startPose(): Pose {
    const { start, eyeZ } = this.current;
    const [x, y] = this.index.nearestStanding(start.position);
    return { eye: [x, y, eyeZ], yaw: start.yaw, pitch: 0 };
  }

  /** Captures that the picture lacks and the bundle does not hold. */
  get unbaked(): number {
    return this.facts.missing.filter((camera) => !this.current.cameras[camera].full && !this.current.cameras[camera].coarse).length;
  }

  private indexOf(storey: number): RegionIndex {
    let index = this.indices.get(storey);
    if (!index) this.indices.set(storey, (index = new RegionIndex(this.bundle.storeys[storey])));
    return index;
  }

  private openStream(): Stream {
    const stream = new Stream(
      this.bundle, this.current, this.renderer, this.pool, () => this.redraw(),
      (failure) => {
        this.failures.set(failure.file, failure);
        this.events.failed();
      },
    );
    stream.limit = this.settings.memory * 1e6;
    return stream;
  }

  /** To a place, or the nearest one where one may stand. */
  go(pose: Pose, storey = this.storey): void {
    this.stop();
    const place: [number, number] = [pose.eye[0], pose.eye[1]];
    if (this.source && (storey !== this.storey || !this.isOwn(this.index.regionAt(place)))) {
      void this.turnTo(storey, place).then(() => {
        if (this.bundle.storeys[storey].regions.length > 0) this.stand(pose, storey); // else its page could not be had
      });
      return;
    }
    this.stand(pose, storey);
  }

  private stand(pose: Pose, storey: number): void {
    if (storey !== this.storey) {
      this.storey = storey;
      this.index = this.indexOf(storey);
      this.stream.close();
      this.stream = this.openStream();
      this.lastRegion = -1;
    }
    const [x, y] = this.index.nearestStanding([pose.eye[0], pose.eye[1]]);
    this.pose = { eye: [x, y, this.current.eyeZ], yaw: pose.yaw, pitch: Math.max(-kMostPitch, Math.min(kMostPitch, pose.pitch)) };
    this.redraw();
  }

  private isOwn = (region: number): boolean => region >= 0 && (this.page?.own[region] ?? true);

  /** To the page of a walk's index that tells of a place; one turn after another. */
  private turnTo(storey: number, place: [number, number]): Promise<void> {
    ++this.turning;
    return (this.turns = this.turns.then(() => this.turn(storey, place)).finally(() => --this.turning));
  }

  private async turn(storey: number, place: [number, number]): Promise<void> {
    try {
      const page = await this.source!.walk.pageAt(storey, place);
      if (page.at === this.page?.at) return;
      const bundle = readIndex(page.text);
      this.planner.open(page.text);
      const last = this.lastRegion < 0 ? -1 : this.current.regions[this.lastRegion].number;
      this.bundle = bundle;
      this.page = page;
      this.facts = { ...this.facts, captures: [], missing: [] }; // they name cameras of the page before
      this.indices.clear();
      if (storey !== this.storey) return; // there is no stream of it yet
      this.index = this.indexOf(storey);
      this.lastRegion = bundle.storeys[storey].regions.findIndex((region) => region.number === last);
      this.stream.showPage(this.current);
      this.redraw();
    } catch (error) {
      this.refused = this.current.regions[this.region]?.number;
      this.failures.set('index', { file: 'the index', reason: (error as Error).message });
      this.events.failed();
    }
  }

  /** Walks along a path of the bundle, until something else moves the eye. */
  play(path: Path): void {
    this.go(poseAt(path, 0), path.storey);
    this.playing = { path, began: undefined };
    this.schedule();
  }
  stop(): void {
    this.playing = undefined;
  }

  /** Its time begins with the first frame. */
  private followPath(now: number): void {
    const { playing } = this;
    if (!playing) return;
    playing.began ??= now;
    const seconds = (now - playing.began) / 1000, pose = poseAt(playing.path, seconds);
    const [x, y] = this.index.nearestStanding([pose.eye[0], pose.eye[1]]);
    this.pose = { ...pose, eye: [x, y, this.current.eyeZ] };
    this.dirty = true;
    if (seconds < durationOf(playing.path)) return;
    this.playing = undefined;
    this.events.stopped();
  }

  /** Turned by a drag of so many pixels: what is under the pointer stays there. */
  look(dx: number, dy: number): void {
    this.stop();
    const view = this.view(), scale = view.width / Math.max(1, this.canvas.clientWidth) / view.focal;
    const pitch = Math.max(-kMostPitch, Math.min(kMostPitch, this.pose.pitch + dy * scale));
    this.pose = { ...this.pose, yaw: this.pose.yaw + dx * scale, pitch };
    this.redraw();
  }

  settingsChanged(): void {
    this.stream.limit = this.settings.memory * 1e6;
    this.redraw();
  }

  retry(): void {
    this.failures.clear();
    this.refused = undefined;
    this.stream.retry();
    this.redraw();
  }

  /** Something that the picture shows has changed. */
  redraw(): void {
    this.dirty = true;
    this.schedule();
  }

  /** Keys are held, or let go. */
  wake(): void {
    this.schedule();
  }

  private schedule(): void {
    if (this.scheduled || this.lost) return;
    this.scheduled = true;
    requestAnimationFrame((now) => this.tick(now));
  }

  private tick(now: number): void {
    this.scheduled = false;
    if (this.lost) return;
    const movement = this.movement(), moving = !isStill(movement);
    const seconds = this.lastTick === undefined ? 1 / 60 : Math.min(0.25, (now - this.lastTick) / 1000);
    const wasMoving = this.lastTick !== undefined;
    this.lastTick = moving ? now : undefined;
    if (moving) {
      this.stop();
      this.move(movement, seconds);
    } else {
      this.velocity = [0, 0];
      this.followPath(now);
    }
    if (!moving && wasMoving) {
      this.dirty = true; // sharp again
      this.events.stopped();
    }
    const { eye, yaw } = this.pose, region = this.region;
    const full = this.settings.quality !== 'coarse';
    const waiting = this.firstPicture === undefined;
    this.stream.update({ eye: [eye[0], eye[1]], yaw, velocity: this.velocity, region, full, saving: savesData(), waiting });
    if (this.source && this.turning === 0 && region >= 0 && !this.isOwn(region) && this.current.regions[region].number !== this.refused) void this.turnTo(this.storey, [eye[0], eye[1]]);
    if (this.dirty && !this.pending && !this.waits(now)) this.drawFrame(moving || this.playing !== undefined);
    if (moving || this.playing || (this.dirty && !this.pending)) this.schedule();
  }

  /** Drawing takes time from what is loading: a first picture is not drawn for every capture that comes. */
  private waits(now: number): boolean {
    const { eye, yaw } = this.pose, region = this.region;
    if (this.firstPicture !== undefined || region < 0) return false;
    const cameras = camerasInOrder(this.current, region, [eye[0], eye[1]], yaw);
    if (cameras.every((camera) => this.stream.capture(camera) || !this.stream.mayCome(camera))) return false;
    return now - this.lastDraw < Math.max(kWhileLoading, kShareWhileLoading * this.lastTook);
  }

  private move(movement: Movement, seconds: number): void {
    const speed = movement.fast ? kFaster : 1, { eye, yaw, pitch } = this.pose;
    const turned = yaw + movement.turn * kRadiansPerSecond * speed * seconds;
    const tilted = pitch + movement.tilt * kRadiansPerSecond * speed * seconds;
    const c = Math.cos(turned), s = Math.sin(turned), step = kMetresPerSecond * speed * seconds;
    const along = Math.hypot(movement.forward, movement.right) || 1;
    const [f, r] = [(movement.forward / along) * step, (movement.right / along) * step];
    const from: [number, number] = [eye[0], eye[1]];
    const to = f === 0 && r === 0 ? from : this.index.walk(from, [from[0] + f * c + r * s, from[1] + f * s - r * c]);
    this.velocity = [(to[0] - from[0]) / seconds, (to[1] - from[1]) / seconds];
    this.pose = { eye: [to[0], to[1], eye[2]], yaw: turned, pitch: Math.max(-kMostPitch, Math.min(kMostPitch, tilted)) };
    this.dirty = true;
  }

  /** At the resolution that frames have when the eye stands still. */
  view(scale = 1): View {
    const density = Math.min(2, window.devicePixelRatio || 1) * this.settings.scale * scale;
    const size = (length: number) => Math.max(1, Math.min(8192, Math.round(length * density)));
    const width = size(this.canvas.clientWidth), height = size(this.canvas.clientHeight);
    return viewAt(this.pose, (this.settings.fov * Math.PI) / 180, width, height);
  }

  private drawFrame(moving: boolean): void {
    const began = performance.now();
    this.drawNow(this.view(moving ? this.movingScale : 1));
    this.lastDraw = began;
    this.dirty = false;
    const sync = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
    if (sync) {
      this.pending = { sync, began, moving };
      this.poll();
    }
  }

  private drawNow(view: View): void {
    const density = Math.min(2, window.devicePixelRatio || 1);
    const width = Math.max(1, Math.round(this.canvas.clientWidth * density));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * density));
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    const region = this.drawnRegion();
    if (region < 0) return;
    this.drawing = { width: view.width, height: view.height };
    try {
      const scene = {
        number: this.storey, storey: this.current, region, captureOf: (camera: number) => this.stream.capture(camera),
        mayCome: (camera: number) => this.stream.mayCome(camera), local: this.stream.local(region),
      };
      this.facts = this.renderer.draw(scene, view, this.settings.holes);
    } catch (error) { // memory, above all: what is drawn stays
      this.lost = true;
      this.failures.set('frame', { file: 'the frame', reason: `${(error as Error).message}; open the page again, with less memory in its settings` });
      this.events.failed();
    }
    ++this.framesDrawn;
  }

  /** That of the eye; while more of its captures are missing, the one before, whose pictures reach a little beyond it. */
  private drawnRegion(): number {
    const { region } = this, { regions } = this.current, { eye, yaw } = this.pose;
    const missing = (number: number) => {
      const pieces = chooseCover(regions[number], [eye[0], eye[1]], yaw)?.pieces ?? [];
      return pieces.length === 0 ? 1 : pieces.filter((piece) => !this.stream.capture(piece.camera)).length / pieces.length;
    };
    if (region >= 0 && (this.lastRegion < 0 || missing(region) <= missing(this.lastRegion))) this.lastRegion = region;
    return this.lastRegion;
  }

  /** Until the graphics card has drawn the frame; no second one waits behind it. */
  private poll(): void {
    const { gl, pending } = this;
    if (!pending || this.lost) return;
    if (gl.getSyncParameter(pending.sync, gl.SYNC_STATUS) !== gl.SIGNALED) {
      setTimeout(() => this.poll(), 1);
      return;
    }
    gl.deleteSync(pending.sync);
    this.pending = undefined;
    const now = performance.now(), took = now - pending.began;
    this.times.add(now, took);
    this.lastTook = took;
    if (pending.moving) this.adapt(took);
    if (this.firstPicture === undefined && !this.facts.awaited) {
      this.firstPicture = now;
      this.schedule(); // for what comes next
    }
    this.events.drawn();
    if (this.dirty) this.schedule();
  }

  private adapt(took: number): void {
    if (took > kSlow) this.movingScale = Math.max(0.4, 0.8 * this.movingScale);
    else if (took < kQuick) this.movingScale = Math.min(1, 1.25 * this.movingScale);
  }

  /** The picture as it would be drawn now, as a PNG's data address, and how long it took, milliseconds. */
  picture(): { address: string; took: number } {
    const began = performance.now();
    this.drawNow(this.view());
    this.gl.finish();
    this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits
    return { address: this.canvas.toDataURL('image/png'), took: performance.now() - began };
  }

  contextLost(): void {
    this.lost = true;
    this.pending = undefined;
    this.stream.close();
  }

  contextRestored(): void {
    this.lost = false;
    this.renderer = new Renderer(this.gl, this.bundle, this.planner);
    this.stream = this.openStream();
    this.redraw();
  }
}
