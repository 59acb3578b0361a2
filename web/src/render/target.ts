/** What a frame is drawn into: sRGB codes, alpha 0 in holes; depth with a stencil; and which mirror of local geometry each pixel shows. */

import type { PixelBox } from './pixel_box';
import { makeTexture } from './program';

/** The stencil: 0 in holes; covered, and inFront where the first cover shows something; reflection where a mirror of local geometry shows one. */
export const kCovered = 1, kInFront = 2, kReflection = 8;

export class Target {
  width = 0;
  height = 0;
  colour!: WebGLTexture; // RGBA8, codes
  depth!: WebGLTexture;
  private made: (WebGLTexture | WebGLFramebuffer)[] = [];
  private draw!: WebGLFramebuffer;
  private extra: Partial<{
    crackBuffer: WebGLFramebuffer; leastDepths: WebGLTexture;
    marks: WebGLFramebuffer; mirrors: WebGLTexture;
    copy: WebGLTexture; copyBuffer: WebGLFramebuffer;
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
    this.draw = this.own([this.colour], this.depth);
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

  framebuffer(colours: WebGLTexture[], depthStencil?: WebGLTexture): WebGLFramebuffer {
    const { gl } = this, framebuffer = gl.createFramebuffer()!;
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    colours.forEach((texture, i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, texture, 0));
    if (depthStencil) gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_STENCIL_ATTACHMENT, gl.TEXTURE_2D, depthStencil, 0);
    gl.drawBuffers(colours.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
    const status = gl.checkFramebufferStatus(gl.FRAMEBUFFER);
    if (status !== gl.FRAMEBUFFER_COMPLETE && !gl.isContextLost())
      throw new Error(`this graphics driver does not draw into the viewer's picture (status ${status.toString(16)})`);
    return framebuffer;
  }

  /** One that goes with the picture's size. */
  private own(colours: WebGLTexture[], depthStencil?: WebGLTexture): WebGLFramebuffer {
    const framebuffer = this.framebuffer(colours, depthStencil);
    this.made.push(framebuffer);
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

  /** For which mirror of local geometry each pixel shows, first none; and for its depth. */
  beginMirrors(): void {
    const { gl } = this;
    if (!this.extra.marks) {
      this.extra.mirrors = this.texture(gl.R8UI);
      this.extra.marks = this.own([this.extra.mirrors], this.depth);
    }
    this.bind(this.extra.marks);
    gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
  }
  get mirrors(): WebGLTexture {
    return this.extra.mirrors!;
  }

  bindForCracks(): void {
    if (!this.extra.crackBuffer) {
      this.extra.leastDepths = this.texture(this.gl.R32UI);
      this.extra.crackBuffer = this.own([this.extra.leastDepths]);
    }
    this.bind(this.extra.crackBuffer);
  }
  get leastDepths(): WebGLTexture {
    return this.extra.leastDepths!;
  }

  /** A copy of the picture as it is now, for what is laid over it. */
  copyColours(): WebGLTexture {
    const { gl } = this;
    if (!this.extra.copyBuffer) {
      this.extra.copy = this.texture(gl.RGBA8);
      this.extra.copyBuffer = this.own([this.extra.copy]);
    }
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.draw);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.extra.copyBuffer);
    gl.blitFramebuffer(0, 0, this.width, this.height, 0, 0, this.width, this.height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    return this.extra.copy!;
  }

  /** For a copy of the picture that blends in linear light, with its depth and stencil. */
  bindForBlending(): WebGLTexture {
    if (!this.extra.litBuffer) {
      this.extra.lit = this.texture(this.gl.SRGB8_ALPHA8);
      this.extra.litBuffer = this.own([this.extra.lit], this.depth);
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
