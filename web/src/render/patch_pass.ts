/**
 * Draws the patches of a plan front to back: for each tile of the picture the list of those that it may show, of all pieces
 * in one. A pixel goes through the list until nothing of it is open (engine/view_gl/patch_pass.h).
 */

import { kTileBytes, type PatchTables } from '../engine/planner';
import { DataTexture, makeTexture, type Program, type Programs } from './program';
import { kCovered, kInFront, kReflection, type Target } from './target';
import type { TexelPool } from './texel_pool';

/** PatchTiles::kSide. */
const kSide = 16;

/** What patches are painted on: of each pixel sums and state (shaders/patch_state.glsl). */
interface Canvas {
  sums: WebGLTexture;
  states: WebGLTexture;
  into: WebGLFramebuffer;
}

export type Show = 'surfaces' | 'behind' | 'reflections';

export class PatchPass {
  private readonly patches: DataTexture;
  private readonly pieces: DataTexture;
  private readonly list: DataTexture;
  private readonly tiles: WebGLBuffer;
  private readonly arrays: WebGLVertexArrayObject;
  private now: Canvas | undefined;
  private before: Canvas | undefined;
  private width = 0;
  private height = 0;

  constructor(
    private readonly gl: WebGL2RenderingContext, private readonly programs: Programs, private readonly target: Target,
    private readonly pool: TexelPool,
  ) {
    this.patches = new DataTexture(gl, gl.RGBA32UI, gl.RGBA_INTEGER, 4);
    this.pieces = new DataTexture(gl, gl.RGBA32UI, gl.RGBA_INTEGER, 4);
    this.list = new DataTexture(gl, gl.R32UI, gl.RED_INTEGER, 1);
    this.tiles = gl.createBuffer()!;
    this.arrays = gl.createVertexArray()!;
    gl.bindVertexArray(this.arrays);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.tiles);
    const attribute = (index: number, type: number, offset: number) => {
      gl.enableVertexAttribArray(index);
      gl.vertexAttribIPointer(index, 2, type, kTileBytes, offset);
      gl.vertexAttribDivisor(index, 1);
    };
    attribute(0, gl.UNSIGNED_SHORT, 0);
    attribute(1, gl.UNSIGNED_INT, 4);
    gl.bindVertexArray(null);
  }

  /** `mirrors`: what those show is drawn later. `localMirrors`: the target says which pixels show mirrors of local geometry. */
  draw(show: Show, tables: PatchTables, mirrors: boolean, localMirrors: boolean): void {
    const { gl, target, programs } = this;
    if (!this.pool.colours || !this.pool.covers) return;
    this.resize(target.width, target.height);
    if (show !== 'surfaces') [this.now, this.before] = [this.before, this.now];
    const defines: string[] = [];
    if (show === 'reflections') defines.push('REFLECT');
    else if (mirrors) defines.push('MIRRORS');
    if (show === 'surfaces' && localMirrors) defines.push('LOCAL_MIRRORS');
    if (show === 'behind') defines.push('BEHIND');
    const patches = this.patches.with(tables.patches), pieces = this.pieces.with(tables.pieces), list = this.list.with(tables.list);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.now!.into);
    gl.viewport(0, 0, target.width, target.height);
    const program = programs.get('patch_tile.vert', 'patches.frag', defines).use();
    program.vec2('pictureSize', target.width, target.height);
    program.float('side', kSide);
    program.float('pictureHeight', target.height);
    program.texture('patchWords', 0, patches);
    program.texture('pieceWords', 1, pieces);
    program.texture('tilePatches', 2, list);
    program.texture('texelColours', 3, this.pool.colours, gl.TEXTURE_2D_ARRAY);
    program.texture('texelCovers', 4, this.pool.covers, gl.TEXTURE_2D_ARRAY);
    if (show === 'surfaces' && localMirrors) program.texture('mirrors', 5, target.mirrors);
    if (show !== 'surfaces') this.useCanvas(program, this.before!, 5, 'Before');
    if (show === 'behind') program.texture('leastDepths', 7, target.leastDepths);
    gl.bindVertexArray(this.arrays);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.tiles);
    gl.bufferData(gl.ARRAY_BUFFER, tables.tiles, gl.STREAM_DRAW);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, tables.tiles.length / kTileBytes);
    this.settle(show, localMirrors);
  }

  private useCanvas(program: Program, canvas: Canvas, unit: number, suffix = ''): void {
    program.texture(`sums${suffix}`, unit, canvas.sums);
    program.texture(`states${suffix}`, unit + 1, canvas.states);
  }

  /** From what was painted to colours, over what the picture holds. */
  private settle(show: Show, localMirrors: boolean): void {
    const { gl, target, programs } = this;
    const before = target.copyColours();
    const defines = show === 'reflections' ? ['MIRRORS'] : show === 'behind' ? ['BEHIND'] : [];
    const program = programs.whole('patches_settle.frag', defines);
    this.useCanvas(program, this.now!, 0);
    program.texture('coloursBefore', 2, before);
    if (show === 'behind') {
      program.texture('leastDepths', 3, target.leastDepths);
      program.texture('statesBefore', 4, this.before!.states);
    }
    target.bindForDrawing();
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.GEQUAL); // what local geometry hides does not matter
    gl.enable(gl.STENCIL_TEST);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.REPLACE);
    gl.stencilFunc(gl.ALWAYS, show === 'behind' ? kCovered : kCovered | kInFront, 0xff);
    if (show === 'reflections') program.int('local', 0);
    programs.drawWhole();
    if (show === 'reflections' && localMirrors) { // which keep their own depth
      gl.disable(gl.DEPTH_TEST);
      gl.stencilFunc(gl.ALWAYS, kReflection, 0xff);
      gl.stencilMask(kReflection);
      program.int('local', 1);
      programs.drawWhole();
      gl.stencilMask(0xff);
    }
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.STENCIL_TEST);
  }

  private releaseCanvases(): void {
    const { gl } = this;
    for (const canvas of [this.now, this.before]) {
      if (!canvas) continue;
      gl.deleteTexture(canvas.sums);
      gl.deleteTexture(canvas.states);
      gl.deleteFramebuffer(canvas.into);
    }
  }

  release(): void {
    this.releaseCanvases();
    for (const words of [this.patches, this.pieces, this.list]) words.release();
    this.gl.deleteBuffer(this.tiles);
    this.gl.deleteVertexArray(this.arrays);
  }

  private resize(width: number, height: number): void {
    if (width === this.width && height === this.height && this.now) return;
    this.releaseCanvases();
    const { gl } = this;
    const make = (): Canvas => {
      const sums = makeTexture(gl, gl.RGBA32UI, width, height), states = makeTexture(gl, gl.RGBA32UI, width, height);
      return { sums, states, into: this.target.framebuffer([sums, states], undefined) };
    };
    this.now = make();
    this.before = make();
    this.width = width;
    this.height = height;
  }
}
