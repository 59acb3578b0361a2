/** What a frame is drawn into: sRGB codes, depth with a stencil, and for mirrors which of them each pixel shows. */

import type { PixelBox } from './plan';
import { makeTexture } from './program';

/** The stencil: 0 in holes; covered, and inFront where the first cover shows something; tinted where its blended samples lie over an open pixel. */
export const kCovered = 1, kInFront = 2, kTinted = 4;

export class Target {
  width = 0;
  height = 0;
  colour!: WebGLTexture; // RGBA8, codes
  depth!: WebGLTexture;
  private made: (WebGLTexture | WebGLFramebuffer)[] = [];
  private draw!: WebGLFramebuffer;
  private extra: Partial<{
    crackBuffer: WebGLFramebuffer; leastDepths: WebGLTexture;
    pieces: WebGLFramebuffer; mirrors: WebGLTexture;
    reflections: WebGLFramebuffer; reflected: WebGLTexture;
    clear: WebGLFramebuffer; clearLayer: WebGLTexture; behind: WebGLTexture; behindBuffer: WebGLFramebuffer;
    lit: WebGLTexture; litBuffer: WebGLFramebuffer;
  }> = {};

  constructor(private readonly gl: WebGL2RenderingContext) {}

  resize(width: number, height: number): void {
    if (width === this.width && height === this.height) return;
    this.release();
    const { gl } = this;
    this.width = width;
    this.height = height;
    this.colour = this.texture(gl.RGBA8);
    this.depth = this.texture(gl.DEPTH24_STENCIL8);
    this.draw = this.framebuffer([this.colour], this.depth);
  }

  release(): void {
    const { gl } = this;
    for (const thing of this.made)
      if (thing instanceof WebGLTexture) gl.deleteTexture(thing);
      else gl.deleteFramebuffer(thing);
    this.made = [];
    this.extra = {};
    this.width = this.height = 0;
  }

  private texture(format: number): WebGLTexture {
    const texture = makeTexture(this.gl, format, this.width, this.height);
    this.made.push(texture);
    return texture;
  }

  private framebuffer(colours: WebGLTexture[], depthStencil?: WebGLTexture, depthOnly = false): WebGLFramebuffer {
    const { gl } = this, framebuffer = gl.createFramebuffer()!;
    this.made.push(framebuffer);
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    colours.forEach((texture, i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, texture, 0));
    if (depthStencil)
      gl.framebufferTexture2D(gl.FRAMEBUFFER, depthOnly ? gl.DEPTH_ATTACHMENT : gl.DEPTH_STENCIL_ATTACHMENT, gl.TEXTURE_2D, depthStencil, 0);
    gl.drawBuffers(colours.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
    const status = gl.checkFramebufferStatus(gl.FRAMEBUFFER);
    if (status !== gl.FRAMEBUFFER_COMPLETE && !gl.isContextLost())
      throw new Error(`this graphics driver does not draw into the viewer's picture (status ${status.toString(16)})`);
    return framebuffer;
  }

  private bind(framebuffer: WebGLFramebuffer): void {
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, framebuffer);
    this.gl.viewport(0, 0, this.width, this.height);
  }

  /** What is drawn from now on, cleared and copied stays within the box; undefined: anywhere. */
  scissor(box: PixelBox | undefined): void {
    const { gl } = this;
    if (!box) return gl.disable(gl.SCISSOR_TEST);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(box.x0, this.height - box.y1, box.x1 - box.x0, box.y1 - box.y0);
  }

  bindForDrawing(): void {
    this.bind(this.draw);
  }

  /** Clears all. */
  begin(): void {
    const { gl } = this;
    this.bindForDrawing();
    gl.disable(gl.BLEND);
    gl.disable(gl.CULL_FACE);
    gl.colorMask(true, true, true, true);
    gl.depthMask(true);
    gl.stencilMask(0xff);
    gl.clearColor(0, 0, 0, 0);
    gl.clearDepth(0);
    gl.clearStencil(0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
  }

  /** Pieces that say which mirror each pixel shows draw into two pictures. */
  beginMirrors(): void {
    const { gl } = this;
    if (!this.extra.pieces) {
      this.extra.mirrors = this.texture(gl.R8UI);
      this.extra.pieces = this.framebuffer([this.colour, this.extra.mirrors], this.depth);
    }
    this.bindForPieces(true);
    gl.clearBufferuiv(gl.COLOR, 1, [0, 0, 0, 0]);
  }
  bindForPieces(mirrors: boolean): void {
    this.bind(mirrors ? this.extra.pieces! : this.draw);
  }
  get mirrors(): WebGLTexture {
    return this.extra.mirrors!;
  }

  /** Reflections are drawn by a depth of their own; `reflected` is where. */
  beginReflections(): void {
    const { gl } = this;
    if (!this.extra.reflections) {
      this.extra.reflected = this.texture(gl.R8UI);
      this.extra.reflections = this.framebuffer([this.colour, this.extra.reflected], this.texture(gl.DEPTH_COMPONENT24), true);
    }
    this.bind(this.extra.reflections);
    gl.clearBufferuiv(gl.COLOR, 1, [0, 0, 0, 0]);
    gl.clearBufferfv(gl.DEPTH, 0, [0]);
  }
  get reflected(): WebGLTexture {
    return this.extra.reflected!;
  }

  bindForCracks(): void {
    if (!this.extra.crackBuffer) {
      this.extra.leastDepths = this.texture(this.gl.R32UI);
      this.extra.crackBuffer = this.framebuffer([this.extra.leastDepths]);
    }
    this.bind(this.extra.crackBuffer);
  }
  get leastDepths(): WebGLTexture {
    return this.extra.leastDepths!;
  }

  /** An empty layer for blended samples, with the picture's depth and stencil. */
  beginClearLayer(): void {
    const { gl } = this;
    if (!this.extra.clear) {
      this.extra.clearLayer = this.texture(gl.RGBA8);
      this.extra.clear = this.framebuffer([this.extra.clearLayer], this.depth);
      this.extra.behind = this.texture(gl.RGBA8);
      this.extra.behindBuffer = this.framebuffer([this.extra.behind]);
    }
    this.bind(this.extra.clear);
    gl.clearBufferfv(gl.COLOR, 0, [0, 0, 0, 0]);
  }
  /** The picture as it is now, for what is laid over it. */
  copyBehind(): { layer: WebGLTexture; behind: WebGLTexture } {
    const { gl } = this;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.draw);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.extra.behindBuffer!);
    gl.blitFramebuffer(0, 0, this.width, this.height, 0, 0, this.width, this.height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    return { layer: this.extra.clearLayer!, behind: this.extra.behind! };
  }

  /** For a copy of the picture that blends in linear light, with its depth and stencil. */
  bindForBlending(): WebGLTexture {
    if (!this.extra.litBuffer) {
      this.extra.lit = this.texture(this.gl.SRGB8_ALPHA8);
      this.extra.litBuffer = this.framebuffer([this.extra.lit], this.depth);
    }
    this.bind(this.extra.litBuffer);
    return this.extra.lit!;
  }

  /** The picture on the canvas, scaled to it. */
  present(): void {
    const { gl } = this, width = gl.drawingBufferWidth, height = gl.drawingBufferHeight;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.draw);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    const filter = width === this.width && height === this.height ? gl.NEAREST : gl.LINEAR;
    gl.blitFramebuffer(0, 0, this.width, this.height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, filter);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }
}
