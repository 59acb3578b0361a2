/** Shader programs by their files and the effects compiled in, made when first used. */

import captureDepth from './shaders/capture_depth.glsl?raw';
import copy from './shaders/copy.frag?raw';
import cracks from './shaders/cracks.glsl?raw';
import cracksFind from './shaders/cracks_find.frag?raw';
import fillApply from './shaders/fill_apply.frag?raw';
import fillReduce from './shaders/fill_reduce.frag?raw';
import localFrag from './shaders/local.frag?raw';
import localVert from './shaders/local.vert?raw';
import patches from './shaders/patches.frag?raw';
// As the engine's own renderer has them.
import background from '../../../shaders/background.frag?raw';
import colour from '../../../shaders/colour.glsl?raw';
import fill from '../../../shaders/fill.glsl?raw';
import fillExpand from '../../../shaders/fill_expand.frag?raw';
import part from '../../../shaders/part.glsl?raw';
import patch from '../../../shaders/patch.glsl?raw';
import patchBegin from '../../../shaders/patch_begin.glsl?raw';
import patchState from '../../../shaders/patch_state.glsl?raw';
import patchTile from '../../../shaders/patch_tile.vert?raw';
import patchesSettle from '../../../shaders/patches_settle.frag?raw';
import wholePicture from '../../../shaders/whole_picture.vert?raw';

const sources = {
  'background.frag': background, 'capture_depth.glsl': captureDepth, 'colour.glsl': colour, 'copy.frag': copy,
  'cracks.glsl': cracks, 'cracks_find.frag': cracksFind, 'fill.glsl': fill, 'fill_apply.frag': fillApply,
  'fill_expand.frag': fillExpand, 'fill_reduce.frag': fillReduce, 'local.frag': localFrag, 'local.vert': localVert,
  'part.glsl': part, 'patch.glsl': patch, 'patch_begin.glsl': patchBegin, 'patch_state.glsl': patchState,
  'patch_tile.vert': patchTile, 'patches.frag': patches, 'patches_settle.frag': patchesSettle,
  'whole_picture.vert': wholePicture,
};
export type ShaderFile = keyof typeof sources;

const kPreamble = '#version 300 es\nprecision highp float;\nprecision highp int;\n';

/** ESSL of a file, its includes put in. */
export function shaderText(file: ShaderFile, defines: readonly string[]): string {
  const expand = (name: ShaderFile): string =>
    sources[name].replace(/^#include "(.*)"$/gm, (_, included: string) => expand(included as ShaderFile));
  return kPreamble + defines.map((name) => `#define ${name}\n`).join('') + expand(file);
}

export class Program {
  private readonly locations = new Map<string, WebGLUniformLocation | null>();

  constructor(private readonly gl: WebGL2RenderingContext, readonly handle: WebGLProgram) {}

  use(): this {
    this.gl.useProgram(this.handle);
    return this;
  }
  at(name: string): WebGLUniformLocation | null {
    let location = this.locations.get(name);
    if (location === undefined) this.locations.set(name, (location = this.gl.getUniformLocation(this.handle, name)));
    return location;
  }
  float = (name: string, value: number) => this.gl.uniform1f(this.at(name), value);
  int = (name: string, value: number) => this.gl.uniform1i(this.at(name), value);
  uint = (name: string, value: number) => this.gl.uniform1ui(this.at(name), value);
  vec2 = (name: string, x: number, y: number) => this.gl.uniform2f(this.at(name), x, y);
  vec3 = (name: string, v: readonly [number, number, number]) => this.gl.uniform3f(this.at(name), ...v);
  vec4 = (name: string, v: readonly [number, number, number, number]) => this.gl.uniform4f(this.at(name), ...v);
  /** `m` row by row. */
  mat3 = (name: string, m: readonly number[]) => this.gl.uniformMatrix3fv(this.at(name), true, m);
  /** A texture at a unit of its own. */
  texture(name: string, unit: number, texture: WebGLTexture, target: number = this.gl.TEXTURE_2D): void {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(target, texture);
    this.gl.uniform1i(this.at(name), unit);
  }
}

/** Compiled or, as drivers do it beside other work, on its way. */
interface Started {
  handle: WebGLProgram;
  shaders: { shader: WebGLShader; file: ShaderFile }[];
  defines: readonly string[];
}

export class Programs {
  private readonly started = new Map<string, Started>();
  private readonly made = new Map<string, Program>();
  private readonly noAttributes: WebGLVertexArrayObject;

  constructor(private readonly gl: WebGL2RenderingContext) {
    this.noAttributes = gl.createVertexArray()!;
  }

  get(vertex: ShaderFile, fragment: ShaderFile, defines: readonly string[] = []): Program {
    const key = [vertex, fragment, ...defines].join(' ');
    let program = this.made.get(key);
    if (!program) this.made.set(key, (program = this.finish(this.start(vertex, fragment, defines))));
    return program;
  }

  /** A program that covers the picture; draw it with `drawWhole`. */
  whole = (fragment: ShaderFile, defines: readonly string[] = []) => this.get('whole_picture.vert', fragment, defines).use();

  drawWhole(): void {
    this.gl.bindVertexArray(this.noAttributes);
    this.gl.drawArrays(this.gl.TRIANGLES, 0, 3);
  }

  /** Begins to compile what will be needed, and does not wait. */
  start(vertex: ShaderFile, fragment: ShaderFile, defines: readonly string[] = []): Started {
    const key = [vertex, fragment, ...defines].join(' ');
    let started = this.started.get(key);
    if (!started) {
      const { gl } = this, handle = gl.createProgram()!;
      const shaders = ([[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const).map(([type, file]) => {
        const shader = gl.createShader(type)!;
        gl.shaderSource(shader, shaderText(file, defines));
        gl.compileShader(shader);
        gl.attachShader(handle, shader);
        return { shader, file };
      });
      gl.linkProgram(handle);
      this.started.set(key, (started = { handle, shaders, defines }));
    }
    return started;
  }

  release(): void {
    const { gl } = this;
    for (const { handle, shaders } of this.started.values()) {
      for (const { shader } of shaders) gl.deleteShader(shader);
      gl.deleteProgram(handle);
    }
    gl.deleteVertexArray(this.noAttributes);
  }

  private finish({ handle, shaders, defines }: Started): Program {
    const { gl } = this;
    if (!gl.getProgramParameter(handle, gl.LINK_STATUS) && !gl.isContextLost()) {
      const logs = shaders.map(({ shader, file }) => `${file} (${defines.join(' ')}): ${gl.getShaderInfoLog(shader) ?? ''}`);
      throw new Error(`this graphics driver does not compile the viewer's shaders: ${gl.getProgramInfoLog(handle)} ${logs.join(' ')}`);
    }
    return new Program(gl, handle);
  }
}

/** One level, nothing between its texels. */
export function makeTexture(gl: WebGL2RenderingContext, format: number, width: number, height: number): WebGLTexture {
  const texture = gl.createTexture()!;
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  return texture;
}

export const kTexelsAcross = 2048; // of textures that hold arrays, as shaders have it

/** Sends an array of texels of `channels` values to what is bound, kTexelsAcross wide. */
function sendArray(gl: WebGL2RenderingContext, format: number, type: number, channels: number, values: Float32Array | Uint32Array | Uint16Array): void {
  const width = kTexelsAcross, texels = values.length / channels, whole = Math.floor(texels / width), rest = texels - whole * width;
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  if (whole > 0) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, whole, format, type, values, 0);
  if (rest > 0) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, whole, rest, 1, format, type, values, whole * width * channels);
}
const rowsFor = (texels: number): number => Math.max(1, Math.ceil(texels / kTexelsAcross));

/** An array of texels of `channels` values as a texture kTexelsAcross wide. */
export function arrayTexture(
  gl: WebGL2RenderingContext, internal: number, format: number, type: number, channels: number,
  values: Float32Array | Uint32Array | Uint16Array,
): WebGLTexture {
  const texture = makeTexture(gl, internal, kTexelsAcross, rowsFor(values.length / channels));
  sendArray(gl, format, type, channels, values);
  return texture;
}

/** Words that change with every frame, as such a texture. */
export class DataTexture {
  private texture: WebGLTexture | undefined;
  private rows = 0;

  constructor(
    private readonly gl: WebGL2RenderingContext, private readonly internal: number, private readonly format: number,
    private readonly channels: number,
  ) {}

  /** Bound to what unit is active: to be called before textures are set. */
  with(values: Uint32Array): WebGLTexture {
    const { gl } = this, rows = rowsFor(values.length / this.channels);
    if (rows > this.rows) {
      if (this.texture) gl.deleteTexture(this.texture);
      this.rows = Math.ceil(1.5 * rows);
      this.texture = makeTexture(gl, this.internal, kTexelsAcross, this.rows);
    } else {
      gl.bindTexture(gl.TEXTURE_2D, this.texture!);
    }
    sendArray(gl, this.format, gl.UNSIGNED_INT, this.channels, values);
    return this.texture!;
  }

  release(): void {
    if (this.texture) this.gl.deleteTexture(this.texture);
  }
}
