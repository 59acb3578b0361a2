/** One frame: covers, mirrors, local geometry and holes, as engine/view_gl does it, on WebGL2. */

import type { Capture } from '../bundle/capture';
import type { LocalGeometry } from '../bundle/local';
import type { Bundle, Cover, Piece, Region, Storey } from '../bundle/types';
import { frustumPlanes } from '../geometry/culling';
import { coversFor } from '../geometry/regions';
import { pictureFromWorld, rayThrough, type View } from '../geometry/view';
import { FillPass } from './fill_pass';
import { deleteLocal, LocalPass, uploadLocal, uploadTexture, type GpuLocal } from './local_pass';
import { columnLimits, cornersExtent, type ColumnLimits } from './plan';
import { deleteCapture, PointPass, setSky, uploadCapture, type DrawnPiece, type GpuCapture, type MirrorUse } from './point_pass';
import { Programs } from './program';
import { kCovered, kInFront, Target } from './target';

/** As engine/view/cracks.h. */
const kCrackReach = 3, kCrackBefore = 1.03;
const kFillReach = 4096, kFillReachWhileLoading = 8;

export interface Scene {
  storey: Storey;
  region: number;
  /** The best that is loaded of a camera. */
  captureOf: (camera: number) => GpuCapture | undefined;
  mayCome: (camera: number) => boolean; // one that is not there yet
  local: GpuLocal | undefined;
}

export interface FrameOptions {
  maxSplatPixels: number;
  holes: boolean; // in a loud colour
  local: boolean;
}

export interface FrameFacts {
  samples: number;
  captures: number[]; // cameras drawn
  missing: number[]; // cameras that are needed and not there
  awaited: boolean; // may any of these still come?
  localTriangles: number;
}

export class Renderer {
  private readonly programs: Programs;
  private readonly target: Target;
  private readonly points: PointPass;
  private readonly fill: FillPass;
  private readonly locals: LocalPass;
  private readonly limits = new WeakMap<Piece, WeakMap<GpuCapture, ColumnLimits>>();
  private nearBand = 1;

  constructor(private readonly gl: WebGL2RenderingContext, private readonly bundle: Bundle) {
    this.programs = new Programs(gl);
    this.target = new Target(gl);
    this.points = new PointPass(gl, this.programs, this.target);
    this.fill = new FillPass(gl, this.programs);
    this.locals = new LocalPass(gl, this.programs, this.target, bundle, () => this.nearest());
    for (const defines of [[], ['OPAQUE']]) this.programs.start('points.vert', 'points.frag', defines);
    for (const file of ['cracks_find.frag', 'cracks_open.frag', 'fill_reduce.frag', 'fill_expand.frag', 'fill_apply.frag', 'copy.frag'] as const)
      this.programs.start('whole_picture.vert', file);
    this.programs.start('whole_picture.vert', 'fill_reduce.frag', ['FROM_FRAME']);
    this.programs.start('background.vert', 'background.frag', ['CAPTURED']);
  }

  /** Can holes be filled at all on this driver? */
  get canFill(): boolean {
    return this.fill.possible;
  }

  uploadCapture = (capture: Capture): GpuCapture => uploadCapture(this.gl, capture);
  deleteCapture = (gpu: GpuCapture): void => deleteCapture(this.gl, gpu);
  uploadLocal = (geometry: LocalGeometry): GpuLocal => uploadLocal(this.gl, geometry);
  deleteLocal = (gpu: GpuLocal): void => deleteLocal(this.gl, gpu);
  uploadTexture(number: number, picture: ImageBitmap): void {
    this.locals.textures[number] = uploadTexture(this.gl, picture, this.bundle.textures[number]);
  }

  /** Of local geometry, metres along the view's axis. */
  private nearest(): number {
    return 0.01 * Math.min(this.nearBand, 1);
  }

  private limitsOf(piece: Piece, capture: GpuCapture, region: Region): ColumnLimits {
    let known = this.limits.get(piece);
    if (!known) this.limits.set(piece, (known = new WeakMap()));
    let limits = known.get(capture);
    if (!limits) known.set(capture, (limits = columnLimits(capture.capture.camera, region, piece)));
    return limits;
  }

  /** Draws the view and shows it on the canvas, scaled to it. */
  draw(scene: Scene, view: View, options: FrameOptions): FrameFacts {
    const { gl, target } = this;
    const region = scene.storey.regions[scene.region];
    this.nearBand = scene.storey.nearBand;
    this.points.samplesDrawn = 0;
    const facts: FrameFacts = { samples: 0, captures: [], missing: [], awaited: false, localTriangles: 0 };
    const drawn = (covers: readonly (Cover | undefined)[]): DrawnPiece[] =>
      covers.flatMap((cover) => cover?.pieces ?? []).flatMap((piece) => {
        const capture = scene.captureOf(piece.camera);
        const list = capture ? facts.captures : facts.missing;
        if (!list.includes(piece.camera)) list.push(piece.camera);
        return capture ? [{ capture, limits: this.limitsOf(piece, capture, region), roles: piece.roles }] : [];
      });
    const covers = coversFor(region, [view.eye[0], view.eye[1]], view.yaw);
    const first = drawn([covers.first]), behind = drawn(covers.behind);
    facts.awaited = facts.missing.some((camera) => scene.mayCome(camera));

    target.resize(view.width, view.height);
    target.begin();
    this.drawBeyondRows(scene.storey, view);
    const anyMirror = [...first, ...behind].some((piece) => piece.capture.reflections);
    if (anyMirror) target.beginMirrors();
    this.drawCover(first, view, options, anyMirror, false);
    if (behind.length > 0) {
      this.openCracks();
      this.drawCover(behind, view, options, anyMirror, true);
    }
    const local = options.local ? scene.local : undefined;
    const marked = anyMirror && local !== undefined && local.geometry.mirrors;
    if (anyMirror) this.drawReflections([...behind, ...first], view, options, marked ? local : undefined);
    if (local) {
      this.locals.drawOpaque(local, view, marked);
      facts.localTriangles = local.geometry.triangles;
    }
    this.fill.draw(target, facts.awaited ? kFillReachWhileLoading : kFillReach, options.holes, this.nearest());
    if (local) this.drawGlass(local, view);
    target.present();
    facts.samples = this.points.samplesDrawn;
    gl.bindVertexArray(null);
    return facts;
  }

  /** Steeper than any capture has rows there is nothing but the background. */
  private drawBeyondRows(storey: Storey, view: View): void {
    const { bounds, sky, exposure } = this.bundle;
    if (!bounds || !(storey.nearBand > 0)) return;
    const steepest = (z: number) => (z - view.eye[2]) / storey.nearBand;
    const above = Math.max(0, steepest(bounds.max[2]), Math.tan(storey.topElevation));
    const below = Math.min(0, steepest(bounds.min[2]), Math.tan(storey.bottomElevation));
    if (!showsSteeper(view, above, below)) return;
    this.beginBackground();
    const program = this.programs.get('background.vert', 'background.frag').use();
    setSky(program, view, sky, exposure);
    program.float('above', above);
    program.float('below', below);
    this.programs.drawWhole();
    this.endPainting();
  }

  private beginBackground(): void {
    const { gl } = this;
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.ALWAYS);
    gl.enable(gl.STENCIL_TEST);
    gl.stencilFunc(gl.EQUAL, 0, 0xff);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.INCR);
  }

  private endPainting(): void {
    const { gl } = this;
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.STENCIL_TEST);
  }

  private drawCover(pieces: readonly DrawnPiece[], view: View, options: FrameOptions, anyMirror: boolean, behind: boolean): void {
    const { gl, target } = this, maxSide = options.maxSplatPixels;
    const planes = frustumPlanes(view, 0.5 * maxSide + 1.5);
    const mirrors: MirrorUse = anyMirror ? 'mark' : 'none';
    target.bindForPieces(anyMirror);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.GREATER);
    gl.enable(gl.STENCIL_TEST);
    if (behind) gl.stencilFunc(gl.EQUAL, kCovered, kInFront);
    else gl.stencilFunc(gl.ALWAYS, kCovered | kInFront, 0xff);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.REPLACE);
    for (const piece of pieces) this.points.draw(piece, view, planes, maxSide, { mirrors });
    // The background lies behind all samples: only what they left open is looked up.
    target.bindForDrawing();
    this.beginBackground();
    for (const piece of pieces) this.points.drawBackground(piece, view, planes, this.bundle.exposure);
    this.endPainting();
    this.points.drawClear(pieces, view, planes, maxSide, { mirrors: anyMirror, behind });
  }

  /** Where samples of a surface do not reach each other, the other cover may show it. */
  private openCracks(): void {
    const { gl, target } = this;
    target.bindForCracks();
    const find = this.programs.whole('cracks_find.frag');
    find.texture('depths', 0, target.depth);
    find.int('reach', kCrackReach);
    find.float('before', kCrackBefore);
    find.float('nearest', this.nearest());
    this.programs.drawWhole();
    target.bindForDrawing();
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.ALWAYS);
    gl.enable(gl.STENCIL_TEST);
    gl.stencilFunc(gl.ALWAYS, 0, 0xff);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.ZERO);
    gl.stencilMask(kInFront);
    gl.colorMask(false, false, false, false);
    const open = this.programs.whole('cracks_open.frag');
    open.texture('leastDepths', 0, target.leastDepths);
    this.programs.drawWhole();
    gl.colorMask(true, true, true, true);
    gl.stencilMask(0xff);
    this.endPainting();
  }

  private drawReflections(pieces: readonly DrawnPiece[], view: View, options: FrameOptions, local: GpuLocal | undefined): void {
    const { gl } = this;
    if (local) this.locals.markMirrors(local, view);
    this.target.beginReflections();
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.GREATER);
    const planes = frustumPlanes(view, 0.5 * options.maxSplatPixels + 1.5);
    for (const piece of pieces)
      this.points.draw(piece, view, planes, options.maxSplatPixels, { mirrors: 'reflect' });
    gl.disable(gl.DEPTH_TEST);
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
