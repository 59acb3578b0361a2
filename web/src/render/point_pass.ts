/** Draws the samples of captures as splats with a depth test, and where captures show the background. */

import { kSamplesPerBlock, rowTangents, type Background, type Capture, type Samples } from '../bundle/capture';
import type { ColumnCamera } from '../bundle/types';
import type { FrustumPlanes } from '../geometry/culling';
import { directionOf, subtract3, transform, type Mat3, type Vec3 } from '../geometry/vector';
import { pictureFromWorld, worldFromPicture, type View } from '../geometry/view';
import { backgroundExtent, clearExtent, planSamples, RangeList, united, type ColumnLimits, type PixelBox } from './plan';
import { arrayTexture, kTexelsAcross, makeTexture, type Programs } from './program';
import { kCovered, kInFront, kTinted, type Target } from './target';

/** Splats are this much larger than a sample seen face on (engine/view/warp.h). */
const kSlantAllowance = 1.25;

interface GpuSamples {
  arrays: WebGLVertexArrayObject;
  buffers: WebGLBuffer[];
}

/** A capture on the graphics card, and what of it planning reads. */
export interface GpuCapture {
  capture: Capture;
  samples: GpuSamples;
  reflections: GpuSamples | undefined;
  tangents: WebGLTexture;
  columnRuns: WebGLTexture | undefined;
  runs: WebGLTexture | undefined;
}

export interface DrawnPiece {
  capture: GpuCapture;
  limits: ColumnLimits;
  roles: number;
}

export type MirrorUse = 'none' | 'mark' | 'reflect';

function uploadSamples(gl: WebGL2RenderingContext, samples: Samples): GpuSamples {
  const arrays = gl.createVertexArray()!, buffers: WebGLBuffer[] = [];
  gl.bindVertexArray(arrays);
  const attribute = (index: number, data: Uint32Array | Uint8Array, size: number, type: number) => {
    const buffer = gl.createBuffer()!;
    buffers.push(buffer);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(index);
    gl.vertexAttribIPointer(index, size, type, 0, 0);
  };
  attribute(0, samples.words, 3, gl.UNSIGNED_INT);
  if (samples.mirrors) attribute(1, samples.mirrors, 1, gl.UNSIGNED_BYTE);
  if (samples.ranks) attribute(2, samples.ranks, 1, gl.UNSIGNED_BYTE);
  gl.bindVertexArray(null);
  // On this side only planning goes on.
  samples.words = new Uint32Array(0);
  if (samples.mirrors) samples.mirrors = new Uint8Array(0);
  samples.ranks = undefined;
  return { arrays, buffers };
}

/** Takes the samples away from `capture`. */
export function uploadCapture(gl: WebGL2RenderingContext, capture: Capture): GpuCapture {
  const { background } = capture;
  return {
    capture,
    samples: uploadSamples(gl, capture.samples),
    reflections: capture.reflections && uploadSamples(gl, capture.reflections),
    tangents: arrayTexture(gl, gl.R32F, gl.RED, gl.FLOAT, 1, rowTangents(capture.camera)),
    columnRuns: background && arrayTexture(gl, gl.R32UI, gl.RED_INTEGER, gl.UNSIGNED_INT, 1, background.columnStart),
    runs: background && arrayTexture(gl, gl.RG32UI, gl.RG_INTEGER, gl.UNSIGNED_INT, 2, background.runs),
  };
}

export function deleteCapture(gl: WebGL2RenderingContext, gpu: GpuCapture): void {
  for (const samples of [gpu.samples, gpu.reflections]) {
    samples?.buffers.forEach((buffer) => gl.deleteBuffer(buffer));
    if (samples) gl.deleteVertexArray(samples.arrays);
  }
  for (const texture of [gpu.tangents, gpu.columnRuns, gpu.runs]) if (texture) gl.deleteTexture(texture);
}

export class PointPass {
  private readonly multiDraw: WEBGL_multi_draw | null;
  private readonly ranges = new RangeList();
  private columns: WebGLTexture | undefined;
  private columnData = new Float32Array(0);
  /** Of the frame. */
  samplesDrawn = 0;

  constructor(private readonly gl: WebGL2RenderingContext, private readonly programs: Programs, private readonly target: Target) {
    this.multiDraw = gl.getExtension('WEBGL_multi_draw');
  }

  /** Room for the columns of one piece. */
  private prepareColumns(camera: ColumnCamera): void {
    const { gl } = this, texels = 2 * camera.columns, rows = Math.ceil(texels / kTexelsAcross);
    if (this.columnData.length < 4 * rows * kTexelsAcross) {
      this.columnData = new Float32Array(4 * rows * kTexelsAcross);
      if (this.columns) gl.deleteTexture(this.columns);
      this.columns = makeTexture(gl, gl.RGBA32F, kTexelsAcross, rows);
    }
  }

  private sendColumns(camera: ColumnCamera): void {
    const { gl } = this, rows = Math.ceil((2 * camera.columns) / kTexelsAcross);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.columns!);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, rows > 1 ? kTexelsAcross : Math.min(kTexelsAcross, 2 * camera.columns), rows, gl.RGBA, gl.FLOAT, this.columnData);
  }

  /** Into what is bound, with depth and stencil as they are set. `clearRank`: blended samples of that rank instead of opaque ones. */
  draw(
    piece: DrawnPiece, view: View, planes: FrustumPlanes, maxSide: number,
    options: { mirrors: MirrorUse; clearRank?: number },
  ): void {
    const { gl } = this, { capture } = piece, { camera } = capture.capture;
    const reflect = options.mirrors === 'reflect', clear = options.clearRank !== undefined;
    const samples = reflect ? capture.capture.reflections : capture.capture.samples;
    const gpu = reflect ? capture.reflections : capture.samples;
    if (!samples || !gpu) return;
    const baseline: Vec3 = subtract3(camera.centre, view.eye), picture = pictureFromWorld(view);
    this.prepareColumns(camera);
    planSamples(
      camera, samples, piece.limits, piece.roles, planes, baseline, picture, this.ranges, this.columnData, 0,
      kSamplesPerBlock, options.clearRank,
    );
    if (this.ranges.length === 0) return;
    const defines: string[] = [];
    if (samples.clearRanks) defines.push(clear ? 'CLEAR' : 'OPAQUE');
    if (piece.limits.clips) defines.push('CLIP_TO_PIECE');
    if (samples.mirrors && options.mirrors !== 'none') defines.push('MIRRORS');
    if (options.mirrors === 'mark' && !clear) defines.push('MARK_MIRRORS');
    if (reflect) defines.push('REFLECT');
    const program = this.programs.get('points.vert', 'points.frag', defines).use();
    this.sendColumns(camera);
    const pitch = Math.max(camera.fov / camera.columns, (camera.topElevation - camera.bottomElevation) / camera.rows);
    const margin = Math.ceil(maxSide / 2) + 1;
    program.texture('columns', 0, this.columns!);
    program.texture('tangents', 1, capture.tangents);
    program.vec3('upInPicture', transform(picture, [0, 0, 1]));
    program.vec3('baselineInPicture', transform(picture, baseline));
    program.vec2('pictureSize', view.width, view.height);
    program.uint('roles', piece.roles);
    program.float('clipMargin', margin);
    program.float('maxSide', maxSide);
    program.float('footprint', view.focal * pitch * kSlantAllowance);
    program.float('inverseFocal', 1 / view.focal);
    if (reflect) program.texture('mirrors', 3, this.target.mirrors);
    if (clear) program.uint('drawnRank', options.clearRank!);
    // A point whose centre is clipped is gone, splat and all: so the clip volume is larger than the picture.
    gl.viewport(-margin, -margin, view.width + 2 * margin, view.height + 2 * margin);
    gl.bindVertexArray(gpu.arrays);
    this.drawRanges();
    gl.viewport(0, 0, view.width, view.height);
  }

  private drawRanges(): void {
    const { gl, ranges } = this;
    this.samplesDrawn += ranges.samples;
    if (this.multiDraw) {
      this.multiDraw.multiDrawArraysWEBGL(gl.POINTS, ranges.firsts, 0, ranges.counts, 0, ranges.length);
      return;
    }
    for (let i = 0; i < ranges.length; ++i) gl.drawArrays(gl.POINTS, ranges.firsts[i], ranges.counts[i]);
  }

  /**
   * Blended samples, farthest rank first, each rank laid over the picture once: the splats of one pane overlap, within a
   * capture and where two meet, and must tint once.
   */
  drawClear(pieces: readonly DrawnPiece[], view: View, planes: FrustumPlanes, maxSide: number, options: { mirrors: boolean; behind: boolean }): void {
    const { gl, target } = this;
    const ranksOf = (piece: DrawnPiece) => piece.capture.capture.samples.mostRanks;
    const picture = pictureFromWorld(view), margin = 0.5 * maxSide + 1;
    const extentOf = ({ capture: { capture }, limits, roles }: DrawnPiece, rank: number) =>
      clearExtent(capture.camera, capture.samples, limits, roles, planes, subtract3(capture.camera.centre, view.eye), picture, view, margin, rank);
    for (let rank = Math.max(0, ...pieces.map(ranksOf)) - 1; rank >= 0; --rank) {
      const parts = pieces.filter((piece) => ranksOf(piece) > rank).map((piece) => ({ piece, box: extentOf(piece, rank) }));
      const box = parts.reduce<PixelBox | undefined>((all, part) => united(all, part.box), undefined);
      if (!box) continue;
      target.scissor(box);
      target.beginClearLayer();
      gl.enable(gl.DEPTH_TEST);
      gl.depthFunc(gl.GEQUAL);
      gl.depthMask(false);
      gl.enable(gl.STENCIL_TEST);
      if (options.behind) gl.stencilFunc(gl.EQUAL, kCovered, kCovered | kInFront | kTinted);
      else gl.stencilFunc(gl.NOTEQUAL, 0, kCovered); // over a hole there is nothing to tint
      gl.stencilOp(gl.KEEP, gl.KEEP, gl.KEEP);
      for (const { piece, box: own } of parts)
        if (own) this.draw(piece, view, planes, maxSide, { mirrors: 'none', clearRank: rank });
      gl.depthMask(true);
      gl.disable(gl.DEPTH_TEST);
      gl.stencilFunc(gl.ALWAYS, kTinted, 0xff);
      gl.stencilMask(options.behind ? 0 : kTinted);
      gl.stencilOp(gl.KEEP, gl.KEEP, gl.REPLACE);
      const { layer, behind } = target.copyBehind();
      target.bindForPieces(options.mirrors);
      const program = this.programs.whole('clear_layer.frag', options.mirrors ? ['MARK_MIRRORS'] : []);
      program.texture('layer', 0, layer);
      program.texture('behind', 1, behind);
      this.programs.drawWhole();
      gl.stencilMask(0xff);
      gl.disable(gl.STENCIL_TEST);
      target.scissor(undefined);
    }
  }

  /** Where the piece's capture shows the background, on pixels that are still open. */
  drawBackground(piece: DrawnPiece, view: View, planes: FrustumPlanes, exposure: number): void {
    const { capture, limits } = piece, { camera, background } = capture.capture;
    if (!background) return;
    const picture: Mat3 = pictureFromWorld(view);
    const extent = backgroundExtent(capture.capture, limits, planes, picture, view);
    if (!extent) return;
    this.prepareColumns(camera);
    for (let k = 0; k < camera.columns; ++k) this.columnData[8 * k + 4] = limits.least[k];
    const program = this.programs.get('background.vert', 'background.frag', ['CAPTURED']).use();
    this.sendColumns(camera);
    setSky(program, view, background, exposure);
    program.texture('columns', 0, this.columns!);
    program.texture('columnRuns', 1, capture.columnRuns!);
    program.texture('runs', 2, capture.runs!);
    const [mx, my] = directionOf(camera.lowAzimuth + 0.5 * camera.fov);
    program.vec2('middle', mx, my);
    program.vec2('columnsAndPerRadian', camera.columns, camera.columns / camera.fov);
    program.vec2('topAndRowsPerRadian', camera.topElevation, camera.rows / (camera.topElevation - camera.bottomElevation));
    program.uint('roles', piece.roles);
    this.target.scissor(extent);
    this.programs.drawWhole();
    this.target.scissor(undefined);
  }
}

type SkyColours = Pick<Background, 'zenith' | 'horizon' | 'ground'>;

export function setSky(
  program: ReturnType<Programs['whole']>, view: View,
  sky: { readonly [name in keyof SkyColours]: Vec3 }, exposure: number,
): void {
  program.mat3('worldFromPicture', worldFromPicture(view));
  program.float('pictureHeight', view.height);
  program.vec3('zenith', sky.zenith);
  program.vec3('horizon', sky.horizon);
  program.vec3('ground', sky.ground);
  program.float('exposure', exposure);
}
