/** Local geometry: opaque, then blended back to front; and where a scene has them, which mirrors it shows. */

import { kCornerBytes, kNoPlane, type LocalBatch, type LocalGeometry } from '../engine/local_reader';
import type { Bundle, Texture, TextureUse, Wrap } from '../bundle/types';
import { dot3, subtract3, type Vec3 } from '../geometry/vector';
import { viewFromWorld, type View } from '../geometry/view';
import { arrayTexture, type Program, type Programs } from './program';
import { kCovered, kReflection, type Target } from './target';

export interface GpuLocal {
  geometry: LocalGeometry;
  arrays: WebGLVertexArrayObject;
  vertices: WebGLBuffer;
  indices: WebGLBuffer; // of the blended triangles, rewritten in each frame's order
  light: WebGLTexture | undefined;
}

export function uploadLocal(gl: WebGL2RenderingContext, geometry: LocalGeometry): GpuLocal {
  const arrays = gl.createVertexArray()!, vertices = gl.createBuffer()!, indices = gl.createBuffer()!;
  gl.bindVertexArray(arrays);
  gl.bindBuffer(gl.ARRAY_BUFFER, vertices);
  gl.bufferData(gl.ARRAY_BUFFER, geometry.corners, gl.STATIC_DRAW);
  const attribute = (index: number, size: number, type: number, normalized: boolean, offset: number) => {
    gl.enableVertexAttribArray(index);
    gl.vertexAttribPointer(index, size, type, normalized, kCornerBytes, offset);
  };
  attribute(0, 3, gl.FLOAT, false, 0);
  attribute(1, 2, gl.FLOAT, false, 12);
  attribute(2, 2, gl.FLOAT, false, 20);
  attribute(3, 2, gl.FLOAT, false, 28);
  attribute(4, 4, gl.UNSIGNED_SHORT, true, 36);
  gl.enableVertexAttribArray(5);
  gl.vertexAttribIPointer(5, 2, gl.UNSIGNED_INT, kCornerBytes, 44);
  attribute(6, 3, gl.FLOAT, false, 52);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
  gl.bindVertexArray(null);
  const light = geometry.light && arrayTexture(gl, gl.RGBA16F, gl.RGBA, gl.HALF_FLOAT, 4, geometry.light);
  geometry.corners = new Uint8Array(0);
  geometry.light = undefined;
  return { geometry, arrays, vertices, indices, light };
}

export function deleteLocal(gl: WebGL2RenderingContext, gpu: GpuLocal): void {
  gl.deleteVertexArray(gpu.arrays);
  gl.deleteBuffer(gpu.vertices);
  gl.deleteBuffer(gpu.indices);
  if (gpu.light) gl.deleteTexture(gpu.light);
}

export function uploadTexture(gl: WebGL2RenderingContext, picture: ImageBitmap, texture: Texture): WebGLTexture {
  const made = gl.createTexture()!;
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
  gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE, picture);
  const filter = texture.nearest ? gl.NEAREST : gl.LINEAR;
  const wraps: { [wrap in Wrap]: number } = { repeat: gl.REPEAT, mirror: gl.MIRRORED_REPEAT, clamp: gl.CLAMP_TO_EDGE };
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, wraps[texture.wrapU]);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, wraps[texture.wrapV]);
  return made;
}

/** Numbers of the blended triangles, farthest corner first. */
function farToNear(geometry: LocalGeometry, eye: Vec3): number[] {
  const at = geometry.clearPositions, count = at.length / 9;
  const farthest = new Float32Array(count);
  for (let n = 0; n < count; ++n)
    for (let c = 9 * n; c < 9 * n + 9; c += 3) {
      const x = at[c] - eye[0], y = at[c + 1] - eye[1], z = at[c + 2] - eye[2];
      farthest[n] = Math.max(farthest[n], x * x + y * y + z * z);
    }
  return Array.from({ length: count }, (_, n) => n).sort((a, b) => farthest[b] - farthest[a] || a - b);
}

export class LocalPass {
  /** By number; undefined: not there yet, or not to be had. */
  readonly textures: (WebGLTexture | undefined)[] = [];

  constructor(
    private readonly gl: WebGL2RenderingContext, private readonly programs: Programs, private readonly target: Target,
    private readonly bundle: Bundle, private readonly nearest: (view: View) => number,
  ) {}

  release(): void {
    for (const texture of this.textures) if (texture) this.gl.deleteTexture(texture);
  }

  private prepare(gpu: GpuLocal, batch: LocalBatch, view: View, what: 'looks' | 'mirror'): Program {
    const { gl, bundle } = this, material = bundle.materials[batch.material], looks = what === 'looks';
    const { clear } = batch, masked = material.alphaMode === 'mask', coloured = looks || masked;
    const textureOf = (use: TextureUse | undefined, has: boolean) => (use && has ? this.textures[use.texture] : undefined);
    const base = coloured ? textureOf(material.baseTexture, batch.baseUv) : undefined;
    const emits = looks && !material.unlit && material.emissive.some((value) => value !== 0);
    const emission = emits ? textureOf(material.emissiveTexture, batch.emissiveUv) : undefined;
    const fresnel = material.transmission > 0 && !material.unlit;
    const defines: string[] = [];
    const define = (on: unknown, name: string) => on && defines.push(name);
    define(base, 'TEXTURE');
    define(coloured && batch.colours, 'VERTEX_COLOURS');
    define(masked, 'ALPHA_TEST');
    define(material.alphaMode === 'blend', 'ALPHA_BLEND');
    define(emits, 'EMISSION');
    define(emission, 'EMISSION_TEXTURE');
    define(fresnel, 'FRESNEL');
    define(looks && gpu.light && !material.unlit, 'SURFACE_LIGHT');
    define(clear, 'CLEAR');
    define(!looks, 'MARK_MIRROR');
    const program = this.programs.get('local.vert', 'local.frag', defines).use();
    program.vec3('originFromEye', subtract3(gpu.geometry.origin, view.eye));
    program.mat3('viewFromWorld', viewFromWorld(view));
    program.vec2('clipScale', (2 * view.focal) / view.width, (2 * view.focal) / view.height);
    program.float('nearest', this.nearest(view));
    program.vec4('baseColour', material.baseColour);
    program.float('exposure', bundle.exposure);
    if (masked) program.float('alphaCutoff', material.alphaCutoff);
    if (fresnel) program.float('transmission', material.transmission);
    if (emits) program.vec3('emission', material.emissive);
    if (base) program.texture('baseTexture', 0, base);
    if (emission) program.texture('emissionTexture', 1, emission);
    if (gpu.light) program.texture('lightSamples', 2, gpu.light);
    if (!looks) program.uint('mirrorNumber', this.mirrorSeen(batch.plane, view.eye));
    gl.bindVertexArray(gpu.arrays);
    return program;
  }

  /** Number of the mirror that an eye sees of a plane; 0 without one. */
  private mirrorSeen(plane: number, eye: Vec3): number {
    const mirror = plane === kNoPlane ? undefined : this.bundle.mirrors[plane];
    return mirror ? 1 + 2 * plane + (dot3(mirror.normal, subtract3(eye, mirror.point)) < 0 ? 1 : 0) : 0;
  }

  private opaqueBatches = (gpu: GpuLocal) =>
    gpu.geometry.batches.filter((batch) => !batch.clear);

  private drawBatch(batch: LocalBatch): void {
    this.gl.drawArrays(this.gl.TRIANGLES, 3 * batch.firstTriangle, 3 * batch.triangles);
  }

  /** Which mirrors the local geometry shows, and its depth. */
  markMirrors(gpu: GpuLocal, view: View): void {
    const { gl } = this;
    this.target.beginMirrors();
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.GREATER);
    for (const batch of this.opaqueBatches(gpu)) {
      this.prepare(gpu, batch, view, 'mirror');
      this.drawBatch(batch);
    }
    gl.disable(gl.DEPTH_TEST);
  }

  /** `marked`: markMirrors and the reflections were drawn. */
  drawOpaque(gpu: GpuLocal, view: View, marked: boolean): void {
    const { gl } = this;
    this.target.bindForDrawing();
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(marked ? gl.GEQUAL : gl.GREATER);
    gl.enable(gl.STENCIL_TEST);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.REPLACE);
    for (const batch of this.opaqueBatches(gpu)) {
      if (marked && batch.plane !== kNoPlane) gl.stencilFunc(gl.NOTEQUAL, kCovered | kReflection, kReflection);
      else gl.stencilFunc(gl.ALWAYS, kCovered, 0xff);
      this.prepare(gpu, batch, view, 'looks');
      this.drawBatch(batch);
    }
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.STENCIL_TEST);
  }

  /** Into a target that blends in linear light, which is bound. */
  drawClear(gpu: GpuLocal, view: View): void {
    const { gl } = this, { geometry } = gpu;
    const order = farToNear(geometry, subtract3(view.eye, geometry.origin));
    const indices = new Uint32Array(3 * order.length);
    order.forEach((n, i) => [0, 1, 2].forEach((c) => (indices[3 * i + c] = 3 * (geometry.firstClear + n) + c)));
    gl.bindVertexArray(gpu.arrays);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STREAM_DRAW);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ZERO, gl.ONE);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.GREATER);
    gl.depthMask(false);
    gl.enable(gl.STENCIL_TEST);
    gl.stencilFunc(gl.NOTEQUAL, 0, 0xff); // over a hole there is nothing to tint
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.KEEP);
    const batchOf = (triangle: number) =>
      geometry.batches.find((b) => triangle >= b.firstTriangle && triangle < b.firstTriangle + b.triangles)!;
    for (let n = 0; n < order.length; ) {
      const batch = batchOf(geometry.firstClear + order[n]);
      let end = n + 1;
      while (end < order.length && batchOf(geometry.firstClear + order[end]) === batch) ++end;
      this.prepare(gpu, batch, view, 'looks');
      gl.drawElements(gl.TRIANGLES, 3 * (end - n), gl.UNSIGNED_INT, 12 * n);
      n = end;
    }
    gl.depthMask(true);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.STENCIL_TEST);
    gl.disable(gl.BLEND);
  }
}
