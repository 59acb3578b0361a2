/** The walk: where the eye is, and when a frame is drawn. Knows the canvas and no other element. */

import type { Bundle, Path, Storey } from './bundle/types';
import { durationOf, poseAt } from './geometry/path';
import { StoreyGround, type Footing } from './geometry/ground';
import type { RegionIndex } from './geometry/regions';
import { kMostPixels, viewAt, type Pose, type View } from './geometry/view';
import { LoadedWalk } from './loaded_walk';
import type { OpenWalk } from './open_walk';
import type { FrameFacts } from './render/renderer';
import type { Settings } from './settings';
import type { Failure } from './stream/stream';
import { FrameTimes } from './ui/frame_times';
import { isStill, type Movement } from './ui/controls';

const kMetresPerSecond = 1.4, kRadiansPerSecond = 1.4, kFaster = 2.5;
const kMostPitch = (85 * Math.PI) / 180;
/** Frames that take longer than this are drawn smaller while the eye moves, milliseconds. */
const kSlow = 60, kQuick = 30;

export class Walk {
  pose: Pose;
  readonly times = new FrameTimes();
  /** Milliseconds from the page's beginning to the first picture without a capture missing that may come. */
  firstPicture: number | undefined;
  framesDrawn = 0;
  drawing = { width: 0, height: 0 };

  private readonly loaded: LoadedWalk;
  private dirty = true;
  private scheduled = false;
  private pending: { sync: WebGLSync; began: number; moving: boolean } | undefined;
  private lastTick: number | undefined;
  private lastDraw = 0; // the page's beginning
  private lastTook = 0;
  private velocity: [number, number] = [0, 0];
  private movingScale = 1;
  private lost = false;
  private groundOf: { bundle: Bundle; ground: StoreyGround } | undefined;
  private footing: Footing | undefined; // the last, on walks with stairs
  private entering: number | undefined; // the storey that is asked for
  private playing: { path: Path; began: number | undefined } | undefined;

  constructor(
    private readonly canvas: HTMLCanvasElement, private readonly gl: WebGL2RenderingContext, opened: OpenWalk,
    readonly settings: Settings, private readonly movement: () => Movement,
    private readonly events: { drawn: () => void; failed: () => void; stopped: () => void },
  ) {
    this.loaded = new LoadedWalk(gl, opened, settings.memory, (work) => work(), {
      changed: () => this.redraw(), failed: () => events.failed(),
    });
    this.pose = this.startPose();
    new ResizeObserver(() => this.redraw()).observe(canvas);
    this.redraw();
  }

  get bundle(): Bundle {
    return this.loaded.bundle;
  }
  get storey(): number {
    return this.loaded.storey;
  }
  get current(): Storey {
    return this.loaded.current;
  }
  get regions(): RegionIndex {
    return this.loaded.regions;
  }
  get region(): number {
    return this.regions.regionAt([this.pose.eye[0], this.pose.eye[1]]);
  }
  get facts(): FrameFacts {
    return this.loaded.facts;
  }
  get failures(): Map<string, Failure> {
    return this.loaded.failures;
  }
  get canFill(): boolean {
    return this.loaded.canFill;
  }
  get loading(): number {
    return this.loaded.loading;
  }
  /** Is all drawn and loaded that is worth having here? */
  get resting(): boolean {
    return !this.dirty && !this.pending && this.loaded.resting;
  }
  get bytes(): number {
    return this.loaded.bytes;
  }
  get unbaked(): number {
    return this.loaded.unbaked;
  }
  isFull = (camera: number) => this.loaded.isFull(camera);

  startPose(): Pose {
    const { start, eyeZ } = this.current;
    const [x, y] = this.regions.nearestStanding(start.position);
    return { eye: [x, y, eyeZ], yaw: start.yaw, pitch: 0 };
  }

  /** Of all storeys; undefined where none of them has stairs. */
  private get ground(): StoreyGround | undefined {
    if (this.groundOf?.bundle !== this.bundle)
      this.groundOf = { bundle: this.bundle, ground: new StoreyGround(this.bundle.storeys, (storey) => this.loaded.regionsOf(storey)) };
    return this.groundOf.ground.rises ? this.groundOf.ground : undefined;
  }

  /** The eye there: over stairs it is carried up and down, and the storey is another one soon. */
  private eyeOn(footing: Footing | undefined, [x, y]: readonly [number, number]): [number, number, number] {
    this.footing = footing;
    if (!footing) return [x, y, this.current.eyeZ];
    if (footing.storey !== this.storey && footing.storey !== this.entering) {
      this.entering = footing.storey;
      void this.loaded.enter(footing.storey, footing.place).finally(() => {
        if (this.entering === footing.storey) this.entering = undefined;
        this.redraw();
      });
    }
    const { eyeZ, floorHeight } = this.bundle.storeys[footing.storey];
    return [footing.place[0], footing.place[1], footing.ground + eyeZ - floorHeight];
  }

  /** Where the feet are, on walks with stairs. */
  private feet(): Footing | undefined {
    const [x, y] = this.pose.eye, { footing } = this;
    return footing && footing.place[0] === x && footing.place[1] === y ? footing : this.ground?.on(this.storey, [x, y]);
  }

  /** To a place, or the nearest one where one may stand. */
  go(pose: Pose, storey = this.storey): void {
    this.stop();
    void this.loaded.enter(storey, [pose.eye[0], pose.eye[1]], () => this.stand(pose));
  }

  private stand(pose: Pose): void {
    const place = this.regions.nearestStanding([pose.eye[0], pose.eye[1]]);
    this.pose = { eye: this.eyeOn(this.ground?.on(this.storey, place), place), yaw: pose.yaw, pitch: Math.max(-kMostPitch, Math.min(kMostPitch, pose.pitch)) };
    this.redraw();
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
    const feet = this.feet(), on = feet && this.ground?.beside(feet, [pose.eye[0], pose.eye[1]]);
    const place = on?.place ?? this.regions.nearestStanding([pose.eye[0], pose.eye[1]]);
    this.pose = { ...pose, eye: this.eyeOn(on ?? this.ground?.on(this.storey, place), place) };
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
    this.loaded.limitMemory(this.settings.memory);
    this.redraw();
  }

  retry(): void {
    this.loaded.retry();
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
    const { eye, yaw } = this.pose;
    this.loaded.follow({
      eye: [eye[0], eye[1]], yaw, velocity: this.velocity, full: this.settings.quality !== 'coarse', waiting: this.firstPicture === undefined,
    });
    if (this.dirty && !this.pending && !this.waits(now)) this.drawFrame(moving || this.playing !== undefined);
    if (moving || this.playing || (this.dirty && !this.pending)) this.schedule();
  }

  private waits(now: number): boolean {
    const { eye, yaw } = this.pose;
    return this.firstPicture === undefined && this.loaded.waits([eye[0], eye[1]], yaw, now - this.lastDraw, this.lastTook);
  }

  private move(movement: Movement, seconds: number): void {
    const speed = movement.fast ? kFaster : 1, { eye, yaw, pitch } = this.pose;
    const turned = yaw + movement.turn * kRadiansPerSecond * speed * seconds;
    const tilted = pitch + movement.tilt * kRadiansPerSecond * speed * seconds;
    const c = Math.cos(turned), s = Math.sin(turned), step = kMetresPerSecond * speed * seconds;
    const along = Math.hypot(movement.forward, movement.right) || 1;
    const [f, r] = [(movement.forward / along) * step, (movement.right / along) * step];
    const from: [number, number] = [eye[0], eye[1]];
    const to = this.step(from, f === 0 && r === 0 ? from : [from[0] + f * c + r * s, from[1] + f * s - r * c]);
    this.velocity = [(to[0] - from[0]) / seconds, (to[1] - from[1]) / seconds];
    this.pose = { eye: to, yaw: turned, pitch: Math.max(-kMostPitch, Math.min(kMostPitch, tilted)) };
    this.dirty = true;
  }

  /** The eye after a walk to a place, as far as that leads. */
  private step(from: [number, number], to: [number, number]): [number, number, number] {
    const feet = this.feet();
    if (feet) return this.eyeOn(this.ground!.walk(feet, to), to);
    const [x, y] = from === to ? from : this.regions.walk(from, to);
    return [x, y, this.pose.eye[2]];
  }

  /** At the resolution that frames have when the eye stands still. */
  view(scale = 1): View {
    const density = Math.min(2, window.devicePixelRatio || 1) * this.settings.scale * scale;
    const size = (length: number) => Math.max(1, Math.min(kMostPixels, Math.round(length * density)));
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
    try {
      if (!this.loaded.draw(view, this.settings.holes)) return;
      this.loaded.present();
      this.drawing = { width: view.width, height: view.height };
    } catch (error) { // memory, above all: what is drawn stays
      this.lost = true;
      this.loaded.fail('frame', { file: 'the frame', reason: `${(error as Error).message}; open the page again, with less memory in its settings` });
    }
    ++this.framesDrawn;
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
    this.loaded.contextLost();
  }

  contextRestored(): void {
    this.lost = false;
    this.loaded.contextRestored();
    this.redraw();
  }
}
