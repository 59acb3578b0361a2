/** A walk as an object of three.js scenes. */

import { Matrix4, Object3D, Vector3, Vector4, type Camera, type Object3DEventMap, type WebGLRenderer } from 'three';
import { memoryOfDevice, threadsOfDevice } from '../../src/device';
import { distanceToRings } from '../../src/geometry/polygon';
import { directionOf, subtract2, type Vec2, type Vec3 } from '../../src/geometry/vector';
import type { View } from '../../src/geometry/view';
import { LoadedWalk } from '../../src/loaded_walk';
import { openWalk, type OpenWalk } from '../../src/open_walk';
import { FolderSource, WalkSource } from '../../src/stream/source';
import { objectFromWalk, UnsupportedView, viewOfCamera, walkFromObject, type CameraView } from './camera_view';
import { Composite } from './composite';
import { sharingState } from './sharing_state';

export interface AcentricWalkOptions {
  /** MB of captures on the graphics card; by default what the device seems to have room for. */
  memory?: number;
  /** Workers that load files; by default one less than processors, 1 to 4. */
  threads?: number;
  /** Pixels of the walk's picture per pixel across, above 0 to 2; by default 1. */
  resolution?: number;
  /** 'coarse' loads sooner and takes less memory; by default 'full'. */
  quality?: 'full' | 'coarse';
}

/** A file that could not be had, or something else that keeps the walk from being shown. */
export interface AcentricWalkFailure {
  file: string;
  reason: string;
}

export interface AcentricWalkStats {
  /** Region that the eye is in, of its storey's; -1: the eye is outside of the walk, and nothing of it is shown. */
  region: number;
  storey: number;
  /** Files on their way. */
  loading: number;
  /** Of captures and near geometry on the graphics card. */
  bytes: number;
  /** Captures that the picture lacks. */
  missing: number;
  /** Is all there that is worth having here, and in the picture? */
  settled: boolean;
  /** Of the walk's picture, pixels. */
  width: number;
  height: number;
}

export interface AcentricWalkEventMap extends Object3DEventMap {
  /** Something has come: draw again. */
  change: object;
  error: AcentricWalkFailure;
}

/** Longer than this between two frames, the eye has not walked from one to the other, milliseconds. */
const kStep = 500;
/** A picture that is larger than what is asked for by no more than this serves too. */
const kLarger = 2;
/** A picture that was put off is thought of again after this, milliseconds. */
const kLater = 50;

const viewport = new Vector4(), matrix = new Matrix4();

/** What may be asked for. */
const kLimits = { memory: [1, 1e6], threads: [1, 64], resolution: [0.01, 2] } as const;
const checked = (name: keyof typeof kLimits, value: number): number => {
  const [least, most] = kLimits[name];
  if (Number.isFinite(value) && value >= least && value <= most) return value;
  throw new RangeError(`${name} is ${value}, where ${least} to ${most} may be`);
};
const checkedQuality = (quality: string): 'full' | 'coarse' => {
  if (quality === 'full' || quality === 'coarse') return quality;
  throw new RangeError(`quality is "${quality}", which is neither full nor coarse`);
};

/** The address of a folder or of one of its indices ends so; others are walks. */
const isFolder = (address: string) => /(\/|\/bundle\.json)$/.test(new URL(address).pathname);

export class AcentricWalk extends Object3D<AcentricWalkEventMap> {
  readonly isAcentricWalk = true;
  override readonly type: string = 'AcentricWalk';
  /** Of the storeys: metres above the walk's origin. */
  readonly eyeHeights: readonly number[];

  private readonly composite = new Composite();
  private readonly gl: WebGL2RenderingContext;
  private readonly loaded: LoadedWalk;
  private drawn: { view: View; seen: readonly number[] } | undefined;
  private dirty = true; // something has come since
  private begun = false; // a picture was drawn without a capture missing that may come
  private pending: WebGLSync | null = null; // the last picture
  private lastDraw = -Infinity;
  private lastTook = 0;
  private lastUpdate = -Infinity;
  private lastEye: Vec2 | undefined;
  private region = -1;
  private entering = false; // another storey
  private closed = -1; // a storey that could not be entered
  private waiting: ReturnType<typeof setTimeout> | undefined;
  private state: 'shown' | 'lost' | 'ended' = 'shown';
  private refused = ''; // why the camera's view is

  private constructor(
    private readonly renderer: WebGLRenderer, private readonly opened: OpenWalk, private readonly wanted: Required<AcentricWalkOptions>,
  ) {
    super();
    const { bundle } = opened;
    this.name = bundle.name;
    this.eyeHeights = bundle.storeys.map((storey) => storey.eyeZ);
    this.gl = renderer.getContext() as WebGL2RenderingContext;
    this.loaded = new LoadedWalk(this.gl, opened, wanted.memory, (work) => sharingState(renderer, work), {
      changed: () => this.changed(), failed: (failure) => this.dispatchEvent({ type: 'error', ...failure }),
    });
    this.composite.bounds(bundle.bounds);
    this.composite.onBeforeRender = (by, _scene, camera) => this.prepare(by, camera);
    this.add(this.composite);
    for (const [event, hear] of this.canvasEvents) renderer.domElement.addEventListener(event, hear);
  }

  /**
   * Opens a folder of a bundle (its address ends with "/", or names its bundle.json) or else a walk of one file, relative to the
   * page, for one renderer. Fails with the address and the reason.
   */
  static async open(url: string | URL, renderer: WebGLRenderer, options: AcentricWalkOptions = {}): Promise<AcentricWalk> {
    if (!('resetState' in renderer && renderer.getContext() instanceof WebGL2RenderingContext))
      throw new TypeError('a walk is drawn by a WebGLRenderer with WebGL2; other renderers of three.js have no such context');
    const all: Required<AcentricWalkOptions> = { memory: memoryOfDevice(), threads: threadsOfDevice(), resolution: 1, quality: 'full' };
    for (const name of ['memory', 'threads', 'resolution'] as const) all[name] = checked(name, options[name] ?? all[name]);
    all.quality = checkedQuality(options.quality ?? all.quality);
    const address = new URL(url, document.baseURI).href;
    const source = isFolder(address) ? new FolderSource(address) : await WalkSource.open(address);
    const opened = await openWalk(source, all.threads).catch((error: Error) => {
      throw new Error(`${address}: ${error.message}`);
    });
    return new AcentricWalk(renderer, opened, all);
  }

  get memory(): number {
    return this.wanted.memory;
  }
  set memory(memory: number) {
    this.wanted.memory = checked('memory', memory);
    this.loaded.limitMemory(memory);
  }
  get resolution(): number {
    return this.wanted.resolution;
  }
  set resolution(resolution: number) {
    this.wanted.resolution = checked('resolution', resolution);
  }
  get quality(): 'full' | 'coarse' {
    return this.wanted.quality;
  }
  set quality(quality: 'full' | 'coarse') {
    this.wanted.quality = checkedQuality(quality);
  }

  get stats(): AcentricWalkStats {
    const { loaded, drawn } = this;
    return {
      region: this.region, storey: loaded.storey, loading: loaded.loading, bytes: loaded.bytes, missing: loaded.facts.missing.length,
      settled: drawn !== undefined && !this.dirty && !this.entering && loaded.resting,
      width: drawn?.view.width ?? 0, height: drawn?.view.height ?? 0,
    };
  }
  /** All that failed, as `error` told it. */
  get failures(): AcentricWalkFailure[] {
    return [...this.loaded.failures.values()];
  }
  /** Asks once more for what could not be had. */
  retry(): void {
    this.closed = -1;
    this.loaded.retry();
    this.changed();
  }

  /** Where the walk begins, and a place a metre ahead; in the world's coordinates. */
  start(): { position: Vector3; target: Vector3 } {
    const { start, eyeZ } = this.opened.bundle.storeys[this.opened.bundle.storey];
    const [dx, dy] = directionOf(start.yaw), [x, y] = start.position;
    return { position: this.toWorld([x, y, eyeZ]), target: this.toWorld([x + dx, y + dy, eyeZ]) };
  }

  /**
   * Moves `position`, of the world, to about the nearest place where one may stand, at the eye height there. Of a walk of one
   * file: to the nearest in what its index has told so far.
   */
  clampToWalk(position: Vector3): Vector3 {
    const [x, y, z] = this.toWalk(position), storey = this.storeyAt([x, y, z]);
    return this.stand(position, storey, this.loaded.regionsOf(storey)?.nearestStanding([x, y]));
  }
  /** Moves `to` to where a walk from `from` towards it ends: along walls, never through them. */
  moveWithin(from: Vector3, to: Vector3): Vector3 {
    const [x, y, z] = this.toWalk(from), [toX, toY] = this.toWalk(to), storey = this.storeyAt([x, y, z]), regions = this.loaded.regionsOf(storey);
    return this.stand(to, storey, regions?.walk(regions.nearestStanding([x, y]), [toX, toY]));
  }

  private stand(position: Vector3, storey: number, place: Vec2 | undefined): Vector3 {
    return place ? position.copy(this.toWorld([...place, this.eyeHeights[storey]])) : position;
  }
  private toWalk = (position: Vector3): Vec3 => walkFromObject(this.worldToLocal(position.clone()).toArray());
  private toWorld = (position: Vec3): Vector3 => this.localToWorld(new Vector3(...objectFromWalk(position)));

  /** Whose eye height is nearest; of pieces of stairs and floors whose outlines are beside the place, none of these. */
  private storeyAt([x, y, z]: Vec3): number {
    const away = this.opened.bundle.storeys.map(({ outline, eyeZ }) => Math.hypot(10 * distanceToRings(outline, [x, y]), eyeZ - z));
    return away.indexOf(Math.min(...away));
  }

  /** What rendering does by itself: loads for the camera and draws what it sees. Before `renderer.render`, if it is not to happen within. */
  update(camera: Camera): void {
    this.updateWorldMatrix(true, false);
    camera.updateWorldMatrix(true, false);
    this.prepare(this.renderer, camera);
  }

  private prepare(renderer: WebGLRenderer, camera: Camera): void {
    if (this.state !== 'shown') return;
    try {
      if (renderer !== this.renderer) throw new UnsupportedView('it was opened for another renderer');
      if (renderer.xr.isPresenting) throw new UnsupportedView('a walk is not shown in WebXR');
      const { width, height } = renderer.getCurrentViewport(viewport);
      const objectFromCamera = matrix.multiplyMatrices(camera.matrixWorldInverse, this.matrixWorld).invert();
      const seen = viewOfCamera(objectFromCamera.elements, camera.projectionMatrix.elements, width, height, this.resolution);
      this.refused = '';
      this.follow(seen);
    } catch (error) {
      if (!(error instanceof UnsupportedView)) throw error;
      this.composite.shown = false;
      if (this.refused !== error.message) this.loaded.fail('view', { file: 'the view', reason: error.message });
      this.refused = error.message;
    }
  }

  private follow(seen: CameraView): void {
    const { loaded } = this, { view } = seen, [x, y, z] = view.eye, eye: Vec2 = [x, y], storey = this.storeyAt([x, y, z]);
    const now = performance.now(), took = now - this.lastUpdate;
    if (storey !== loaded.storey && storey !== this.closed && !this.entering) {
      this.entering = true;
      void loaded.enter(storey, eye).then(() => {
        this.entering = false;
        this.closed = loaded.storey === storey ? -1 : storey;
        this.changed();
      });
    }
    const walked = took > 0 && took < kStep && this.lastEye !== undefined ? subtract2(eye, this.lastEye) : undefined;
    const velocity: Vec2 = walked ? [(1000 * walked[0]) / took, (1000 * walked[1]) / took] : [0, 0];
    this.lastUpdate = now;
    this.lastEye = eye;
    const begun = this.begun, follow = () => loaded.follow({ eye, yaw: view.yaw, velocity, full: this.quality === 'full', waiting: !this.begun });
    follow();
    this.region = storey === loaded.storey ? loaded.regions.regionAt(eye) : -1;
    this.composite.shown = false;
    if (this.region >= 0 && this.draw(view, now)) this.composite.show(loaded.picture, seen, this.renderer);
    if (this.begun !== begun) follow(); // for what comes after the first picture
  }

  /** Where the last picture does not serve; false where there is none. */
  private draw(view: View, now: number): boolean {
    const { loaded, drawn } = this, seen = [...view.eye, view.yaw, view.pitch, view.width / view.focal, view.height / view.focal];
    const serves = drawn && view.width <= drawn.view.width && kLarger * view.width >= drawn.view.width && seen.every((value, i) => value === drawn.seen[i]);
    if (serves && !this.dirty) return true;
    if (serves && (this.isDrawing() || (!this.begun && loaded.waits([view.eye[0], view.eye[1]], view.yaw, now - this.lastDraw, this.lastTook)))) {
      this.putOff();
      return true;
    }
    try {
      if (!sharingState(this.renderer, () => loaded.draw(view, false))) return false;
    } catch (error) { // memory, above all
      this.end();
      loaded.fail('frame', { file: 'the frame', reason: `${(error as Error).message}; open the walk again, with less memory` });
      return false;
    }
    this.drawn = { view, seen };
    this.dirty = false;
    this.lastDraw = now;
    this.gl.deleteSync(this.pending);
    this.pending = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.begun ||= !loaded.facts.awaited;
    return true;
  }

  /** Is the graphics card still at the last picture? No second one waits behind it for what has come since. */
  private isDrawing(): boolean {
    const { gl, pending } = this;
    if (!pending) return false;
    if (gl.getSyncParameter(pending, gl.SYNC_STATUS) !== gl.SIGNALED && !gl.isContextLost()) return true;
    gl.deleteSync(pending);
    this.pending = null;
    this.lastTook = performance.now() - this.lastDraw;
    return false;
  }

  /** What has come shows a little later. */
  private putOff(): void {
    this.waiting ??= setTimeout(() => {
      this.waiting = undefined;
      if (this.isDrawing()) this.putOff();
      else this.changed();
    }, kLater);
  }

  private changed(): void {
    if (this.state === 'ended') return;
    this.dirty = true;
    this.dispatchEvent({ type: 'change' });
  }

  private readonly canvasEvents: [string, () => void][] = [
    ['webglcontextlost', () => {
      if (this.state !== 'shown') return;
      this.state = 'lost';
      this.drawn = undefined;
      this.pending = null;
      this.loaded.contextLost();
    }],
    ['webglcontextrestored', () => {
      if (this.state !== 'lost') return;
      this.state = 'shown';
      this.loaded.contextRestored();
      this.changed();
    }],
  ];

  /** Nothing is shown or loaded any more. */
  private end(): void {
    this.state = 'ended';
    this.drawn = undefined;
    this.composite.shown = false;
    clearTimeout(this.waiting);
    this.gl.deleteSync(this.pending);
    for (const [event, hear] of this.canvasEvents) this.renderer.domElement.removeEventListener(event, hear);
    this.opened.pool.close();
    this.loaded.release();
  }

  /** Takes the walk out of its scene, and gives back all that it holds. */
  dispose(): void {
    if (this.state !== 'ended') this.end();
    this.composite.release();
    this.removeFromParent();
  }

  override copy(): this {
    throw new Error('a walk cannot be copied: open it once more');
  }
  override clone(): this {
    return this.copy();
  }
}
