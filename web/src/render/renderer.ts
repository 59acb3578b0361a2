/** One frame: covers, mirrors, local geometry and holes, as engine/view_gl does it, on WebGL2. */

import { bytesOfCapture, type Capture } from '../engine/pack_reader';
import { kPatchTexels, type Planner, type PlannedBackground } from '../engine/planner';
import type { LocalGeometry } from '../engine/local_reader';
import type { Bundle, Storey } from '../bundle/types';
import { camerasOf } from '../geometry/regions';
import { pictureFromWorld, rayThrough, worldFromPicture, type View } from '../geometry/view';
import type { Vec3 } from '../geometry/vector';
import { FillPass } from './fill_pass';
import { deleteLocal, LocalPass, uploadLocal, uploadTexture, type GpuLocal } from './local_pass';
import { PatchPass } from './patch_pass';
import { cornersExtent } from './pixel_box';
import { arrayTexture, DataTexture, kTexelsAcross, Programs, type Program } from './program';
import { Target } from './target';
import { TexelPool, type Rows } from './texel_pool';

/** As engine/view/cracks.h. */
const kCrackReach = 3, kCrackBefore = 1.03;
const kFillReach = 4096, kFillReachWhileLoading = 8;

/** A capture on the graphics card. */
export interface GpuCapture {
  number: number; // the planner's
  rows: Rows; // of the pool
  runs: WebGLTexture | undefined; // of the background
  bytes: number;
}

export interface Scene {
  number: number; // of the storey
  storey: Storey;
  region: number;
  /** The best that is loaded of a camera. */
  captureOf: (camera: number) => GpuCapture | undefined;
  mayCome: (camera: number) => boolean; // one that is not there yet
  local: GpuLocal | undefined;
}

export interface FrameFacts {
  patches: number;
  captures: number[]; // cameras that the region shows
  missing: number[]; // cameras that it needs and that are not there
  awaited: boolean; // may any of these still come?
  localTriangles: number;
}

export type Within = <Result>(work: () => Result) => Result;

export interface Picture {
  colour: WebGLTexture;
  depth: WebGLTexture;
  nearest: number; // of local geometry, metres
}

export class Renderer {
  private readonly programs: Programs;
  private readonly target: Target;
  private readonly pool: TexelPool;
  private readonly patches: PatchPass;
  private readonly fill: FillPass;
  private readonly locals: LocalPass;
  private readonly columns: DataTexture;
  private readonly captures = new Map<number, GpuCapture>();
  private nearBand = 1;

  /** `within`: around what is sent to the graphics card between frames, for those who share the context with others. */
  constructor(
    private readonly gl: WebGL2RenderingContext, private readonly bundle: Bundle, private readonly planner: Planner,
    private readonly within: Within,
  ) {
    this.programs = new Programs(gl);
    this.target = new Target(gl);
    this.pool = new TexelPool(gl);
    this.patches = new PatchPass(gl, this.programs, this.target, this.pool);
    this.fill = new FillPass(gl, this.programs);
    this.locals = new LocalPass(gl, this.programs, this.target, bundle, () => this.nearest());
    this.columns = new DataTexture(gl, gl.RG32UI, gl.RG_INTEGER, 2);
    for (const defines of [[], ['BEHIND']]) this.programs.start('patch_tile.vert', 'patches.frag', defines);
    for (const file of ['patches_settle.frag', 'cracks_find.frag', 'fill_reduce.frag', 'fill_expand.frag', 'fill_apply.frag', 'copy.frag'] as const)
      this.programs.start('whole_picture.vert', file);
    this.programs.start('whole_picture.vert', 'patches_settle.frag', ['BEHIND']);
    this.programs.start('whole_picture.vert', 'fill_reduce.frag', ['FROM_FRAME']);
    this.programs.start('whole_picture.vert', 'background.frag', ['CAPTURED']);
  }

  /** Can holes be filled at all on this driver? */
  get canFill(): boolean {
    return this.fill.possible;
  }

  uploadCapture = (capture: Capture): GpuCapture => this.within(() => this.sendCapture(capture));
  private sendCapture(capture: Capture): GpuCapture {
    const { gl } = this, rows = this.pool.add(capture.colours, capture.covers);
    const number = this.planner.addCapture(capture.part, rows.first * kTexelsAcross);
    const runs = capture.runs.length > 0 ? arrayTexture(gl, gl.RG32UI, gl.RG_INTEGER, gl.UNSIGNED_INT, 2, capture.runs) : undefined;
    const gpu = { number, rows, runs, bytes: bytesOfCapture(capture) };
    this.captures.set(number, gpu);
    return gpu;
  }
  deleteCapture(gpu: GpuCapture): void {
    this.captures.delete(gpu.number);
    this.planner.dropCapture(gpu.number);
    this.pool.remove(gpu.rows);
    if (gpu.runs) this.gl.deleteTexture(gpu.runs);
  }
  uploadLocal = (geometry: LocalGeometry): GpuLocal => this.within(() => uploadLocal(this.gl, geometry));
  deleteLocal = (gpu: GpuLocal): void => deleteLocal(this.gl, gpu);
  uploadTexture(number: number, picture: ImageBitmap): void {
    this.locals.textures[number] = this.within(() => uploadTexture(this.gl, picture, this.bundle.textures[number]));
  }

  /** All that is not a capture or local geometry: those are their owner's. */
  release(): void {
    for (const part of [this.programs, this.target, this.pool, this.patches, this.fill, this.locals, this.columns]) part.release();
  }

  /** Of local geometry, metres along the view's axis. */
  private nearest(): number {
    return 0.01 * Math.min(this.nearBand, 1);
  }

  /** What was drawn last: sRGB codes, alpha 0 where nothing is; and depths, as shaders/capture_depth.glsl tells. */
  get picture(): Picture {
    return { colour: this.target.colour, depth: this.target.depth, nearest: this.nearest() };
  }

  /** Shows it on the canvas, scaled to it. */
  present = (): void => this.target.present();

  /** Draws the view. `loudHoles`: they are not filled, but shown. */
  draw(scene: Scene, view: View, loudHoles: boolean): FrameFacts {
    const { gl, target } = this, { storey } = scene;
    this.nearBand = storey.nearBand;
    const facts: FrameFacts = { patches: 0, captures: [], missing: [], awaited: false, localTriangles: 0 };
    const used: [number, number][] = [];
    for (const camera of camerasOf(storey.regions[scene.region])) {
      const capture = scene.captureOf(camera);
      (capture ? facts.captures : facts.missing).push(camera);
      if (capture) used.push([camera, capture.number]);
    }
    facts.awaited = facts.missing.some((camera) => scene.mayCome(camera));

    target.resize(view.width, view.height);
    target.begin();
    this.drawBeyondRows(storey, view);
    const { local } = scene;
    const marked = this.drawCaptures(scene, view, used, facts);
    if (local) {
      this.locals.drawOpaque(local, view, marked);
      facts.localTriangles = local.geometry.triangles;
    }
    this.fill.draw(target, facts.awaited ? kFillReachWhileLoading : kFillReach, loudHoles, this.nearest());
    if (local) this.drawGlass(local, view);
    gl.bindVertexArray(null);
    return facts;
  }

  /** Returns whether mirrors of local geometry are marked. */
  private drawCaptures(scene: Scene, view: View, used: [number, number][], facts: FrameFacts): boolean {
    const plan = this.planner.plan(scene.number, scene.region, view, used);
    if (!plan) return false;
    for (const background of plan.backgrounds) this.drawCaptured(background, view);
    const marked = plan.mirrors && scene.local !== undefined && scene.local.geometry.mirrors;
    if (marked) this.locals.markMirrors(scene.local!, view);
    this.patches.draw('surfaces', plan.surfaces, plan.mirrors, marked);
    if (plan.behind.patches.length > 0) {
      this.findCracks();
      this.patches.draw('behind', plan.behind, plan.mirrors, marked);
    }
    if (plan.mirrors) this.patches.draw('reflections', plan.reflections, true, marked);
    facts.patches = [plan.surfaces, plan.behind, plan.reflections].reduce((sum, tables) => sum + tables.patches.length / (4 * kPatchTexels), 0);
    return marked;
  }

  /** Steeper than any capture has rows there is nothing but the background. */
  private drawBeyondRows(storey: Storey, view: View): void {
    const { bounds, sky } = this.bundle;
    if (!bounds || !(storey.nearBand > 0)) return;
    const steepest = (z: number) => (z - view.eye[2]) / storey.nearBand;
    const above = Math.max(0, steepest(bounds.max[2]), Math.tan(storey.topElevation));
    const below = Math.min(0, steepest(bounds.min[2]), Math.tan(storey.bottomElevation));
    if (!showsSteeper(view, above, below)) return;
    const program = this.beginBackground([], view, sky);
    program.float('above', above);
    program.float('below', below);
    this.drawBackground();
  }

  private drawCaptured(background: PlannedBackground, view: View): void {
    const { gl } = this, runs = this.captures.get(background.capture)?.runs;
    if (!runs) return;
    const columns = this.columns.with(background.columns);
    const program = this.beginBackground(background.part === 0 ? ['CAPTURED'] : ['CAPTURED', 'CLIP_TO_PART'], view, background);
    program.texture('columns', 0, columns);
    program.texture('runs', 1, runs);
    program.vec2('middle', ...background.middle);
    program.vec2('columnsAndPerRadian', background.columns.length / 2, background.columnsPerRadian);
    program.vec2('topAndRowsPerRadian', background.topElevation, background.rowsPerRadian);
    program.uint('roles', background.roles);
    if (background.part !== 0) {
      program.vec2('partLow', ...background.low);
      program.vec2('partHigh', ...background.high);
      program.int('partIsWide', background.part === 2 ? 1 : 0);
    }
    this.drawBackground();
    gl.activeTexture(gl.TEXTURE0);
  }

  private beginBackground(defines: string[], view: View, sky: { zenith: Vec3; horizon: Vec3; ground: Vec3 }): Program {
    const program = this.programs.whole('background.frag', defines);
    program.mat3('worldFromPicture', worldFromPicture(view));
    program.float('pictureHeight', view.height);
    for (const name of ['zenith', 'horizon', 'ground'] as const) program.vec3(name, sky[name]);
    program.float('exposure', this.bundle.exposure);
    return program;
  }

  /** Where nothing is yet. */
  private drawBackground(): void {
    const { gl } = this;
    this.target.bindForDrawing();
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.ALWAYS);
    gl.enable(gl.STENCIL_TEST);
    gl.stencilFunc(gl.EQUAL, 0, 0xff);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.INCR);
    this.programs.drawWhole();
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.STENCIL_TEST);
  }

  /** Where samples of a surface do not reach each other, the other cover may show it. */
  private findCracks(): void {
    const { target } = this;
    target.bindForCracks();
    const find = this.programs.whole('cracks_find.frag');
    find.texture('depths', 0, target.depth);
    find.int('reach', kCrackReach);
    find.float('before', kCrackBefore);
    find.float('nearest', this.nearest());
    this.programs.drawWhole();
  }

  /** Glass, blended in linear light where it may be seen. */
  private drawGlass(local: GpuLocal, view: View): void {
    const { target, programs } = this, { clearPositions, origin } = local.geometry;
    const box = cornersExtent(clearPositions, origin, view.eye, pictureFromWorld(view), view);
    if (!box) return;
    target.scissor(box);
    const lit = target.bindForBlending();
    programs.whole('copy.frag').texture('picture', 0, target.colour);
    programs.drawWhole();
    this.locals.drawClear(local, view);
    target.bindForDrawing();
    programs.whole('copy.frag', ['TO_CODES']).texture('picture', 0, lit);
    programs.drawWhole();
    target.scissor(undefined);
  }
}

/** Does a view show a direction steeper than these tangents? Its corners, its sides' middles and the poles tell. */
function showsSteeper(view: View, above: number, below: number): boolean {
  for (const u of [0, 0.5, 1])
    for (const v of [0, 0.5, 1]) {
      const [x, y, z] = rayThrough(view, u * view.width, v * view.height), flat = Math.hypot(x, y);
      if (z > above * flat || z < below * flat) return true;
    }
  return false;
}
