/** Screen-space fill of what no sample shows (shaders/fill*): each hole continues the farther side of its border. */

import { makeTexture, type Programs } from './program';
import type { Target } from './target';

interface Level {
  width: number;
  height: number;
  reduced: WebGLTexture;
  expanded: WebGLTexture;
  intoReduced: WebGLFramebuffer;
  intoExpanded: WebGLFramebuffer;
}

export class FillPass {
  private levels: Level[] = [];
  private width = 0;
  private height = 0;
  /** Can this driver draw into half floats? */
  readonly possible: boolean;

  constructor(private readonly gl: WebGL2RenderingContext, private readonly programs: Programs) {
    this.possible = !!(gl.getExtension('EXT_color_buffer_float') ?? gl.getExtension('EXT_color_buffer_half_float'));
  }

  private resize(width: number, height: number): void {
    if (width === this.width && height === this.height) return;
    this.release();
    const { gl } = this;
    this.width = width;
    this.height = height;
    const into = (texture: WebGLTexture) => {
      const framebuffer = gl.createFramebuffer()!;
      gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
      return framebuffer;
    };
    for (let w = width, h = height; w > 1 || h > 1 || this.levels.length === 0; ) {
      w = Math.ceil(w / 2);
      h = Math.ceil(h / 2);
      const reduced = makeTexture(gl, gl.RGBA16F, w, h), expanded = makeTexture(gl, gl.RGBA16F, w, h);
      this.levels.push({ width: w, height: h, reduced, expanded, intoReduced: into(reduced), intoExpanded: into(expanded) });
    }
  }

  release(): void {
    const { gl } = this;
    for (const level of this.levels) {
      [level.reduced, level.expanded].forEach((texture) => gl.deleteTexture(texture));
      [level.intoReduced, level.intoExpanded].forEach((framebuffer) => gl.deleteFramebuffer(framebuffer));
    }
    this.levels = [];
  }

  /** `reach`: how far colours spread into a hole, pixels. `loud`: holes are painted in a colour that nothing has. */
  draw(target: Target, reach: number, loud: boolean, nearest: number): void {
    const { gl, programs } = this;
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    gl.disable(gl.STENCIL_TEST);
    if (!loud && !this.possible) return;
    const known = loud ? undefined : this.pyramid(target, reach, nearest);
    target.bindForDrawing();
    gl.enable(gl.STENCIL_TEST);
    gl.stencilFunc(gl.EQUAL, 0, 0xff);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.INCR); // covered from now on
    const apply = programs.whole('fill_apply.frag', loud ? ['LOUD'] : []);
    if (known) {
      apply.texture('coarser', 0, known);
      gl.enable(gl.DEPTH_TEST);
      gl.depthFunc(gl.ALWAYS);
    }
    programs.drawWhole();
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.STENCIL_TEST);
  }

  private pyramid(target: Target, reach: number, nearest: number): WebGLTexture {
    const { gl, programs } = this;
    this.resize(target.width, target.height);
    let used = 1; // level n knows what is within about 2^(n+1) pixels
    while (used < this.levels.length && 2 << used <= reach) ++used;
    for (let n = 0; n < used; ++n) {
      const level = this.levels[n];
      gl.bindFramebuffer(gl.FRAMEBUFFER, level.intoReduced);
      gl.viewport(0, 0, level.width, level.height);
      const reduce = programs.whole('fill_reduce.frag', n === 0 ? ['FROM_FRAME'] : []);
      if (n === 0) {
        reduce.texture('frameColour', 0, target.colour);
        reduce.texture('frameDepth', 1, target.depth);
        reduce.float('nearest', nearest);
      } else {
        reduce.texture('finer', 0, this.levels[n - 1].reduced);
      }
      programs.drawWhole();
    }
    let known = this.levels[used - 1].reduced;
    for (let n = used - 2; n >= 0; --n) {
      const level = this.levels[n];
      gl.bindFramebuffer(gl.FRAMEBUFFER, level.intoExpanded);
      gl.viewport(0, 0, level.width, level.height);
      const expand = programs.whole('fill_expand.frag');
      expand.texture('own', 0, level.reduced);
      expand.texture('coarser', 1, known);
      programs.drawWhole();
      known = level.expanded;
    }
    return known;
  }
}
