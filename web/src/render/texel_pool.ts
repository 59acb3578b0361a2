/** Texels of all captures that are loaded, in two textures of many layers: shaders name each by one number. */

import { kTexelsAcross } from './program';

const kRows = 2048; // of a layer, as shaders/patches.frag has it

/** Rows of the pool. */
export interface Rows {
  first: number;
  count: number;
}

export class TexelPool {
  colours: WebGLTexture | undefined; // RGBA8
  covers: WebGLTexture | undefined; // R32UI
  private layers = 0;
  private free: Rows[] = []; // by their places, none touching the next

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** Whole rows of texels. */
  add(colours: Uint8Array, covers: Uint32Array): Rows {
    if (covers.length === 0) return { first: 0, count: 0 };
    const { gl } = this, rows = this.take(covers.length / kTexelsAcross);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    for (let row = 0; row < rows.count; ) {
      const at = rows.first + row, count = Math.min(rows.count - row, kRows - (at % kRows)), from = row * kTexelsAcross;
      const send = (texture: WebGLTexture, format: number, type: number, values: ArrayBufferView, first: number) => {
        gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
        gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, at % kRows, Math.floor(at / kRows), kTexelsAcross, count, 1, format, type, values, first);
      };
      send(this.colours!, gl.RGBA, gl.UNSIGNED_BYTE, colours, 4 * from);
      send(this.covers!, gl.RED_INTEGER, gl.UNSIGNED_INT, covers, from);
      row += count;
    }
    return rows;
  }

  remove({ first, count }: Rows): void {
    if (count === 0) return;
    const at = this.free.findIndex((rows) => rows.first > first), place = at < 0 ? this.free.length : at;
    this.free.splice(place, 0, { first, count });
    for (const i of [place, place - 1]) {
      const own = this.free[i], next = this.free[i + 1];
      if (!own || !next || own.first + own.count !== next.first) continue;
      own.count += next.count;
      this.free.splice(i + 1, 1);
    }
  }

  release(): void {
    for (const texture of [this.colours, this.covers]) if (texture) this.gl.deleteTexture(texture);
  }

  private take(count: number): Rows {
    let found = this.free.find((rows) => rows.count >= count);
    if (!found) {
      this.grow(count);
      found = this.free.find((rows) => rows.count >= count)!;
    }
    const taken = { first: found.first, count };
    found.first += count;
    found.count -= count;
    if (found.count === 0) this.free.splice(this.free.indexOf(found), 1);
    return taken;
  }

  /** By half, and at least by as much as is asked for. */
  private grow(rows: number): void {
    const { gl } = this, before = this.layers;
    const layers = Math.max(before + Math.ceil(rows / kRows), Math.ceil(1.5 * before));
    if (layers > (gl.getParameter(gl.MAX_ARRAY_TEXTURE_LAYERS) as number)) throw new Error('the graphics card holds no more captures');
    const made = [[gl.RGBA8, this.colours], [gl.R32UI, this.covers]].map(([format, old]) =>
      this.enlarged(format as number, old as WebGLTexture | undefined, before, layers),
    );
    [this.colours, this.covers] = made;
    this.layers = layers;
    this.remove({ first: before * kRows, count: (layers - before) * kRows });
  }

  private enlarged(format: number, old: WebGLTexture | undefined, before: number, layers: number): WebGLTexture {
    const { gl } = this, texture = gl.createTexture()!;
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
    while (gl.getError() !== gl.NO_ERROR && !gl.isContextLost());
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, format, kTexelsAcross, kRows, layers);
    if (gl.getError() === gl.OUT_OF_MEMORY) {
      gl.deleteTexture(texture);
      throw new Error('the graphics card has no memory for it: lower the limit in the settings');
    }
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D_ARRAY, filter, gl.NEAREST);
    if (!old) return texture;
    const from = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, from);
    for (let layer = 0; layer < before; ++layer) {
      gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, old, 0, layer);
      gl.copyTexSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, layer, 0, 0, kTexelsAcross, kRows);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.deleteFramebuffer(from);
    gl.deleteTexture(old);
    return texture;
  }
}
