/** Linear radiance as captures hold it to the codes that a screen shows: engine/image/colour.cpp. */

const kShoulderStart = 0.76;
const kHighlightDesaturation = 0.15;
const kBrightest = 1e9;

export function numberOfHalf(half: number): number {
  const sign = half & 0x8000 ? -1 : 1, exponent = (half >> 10) & 31, fraction = half & 0x3ff;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

/** Of every half, by its bits. */
export const halfTable: () => Float32Array = (() => {
  let table: Float32Array | undefined;
  return () => (table ??= Float32Array.from({ length: 65536 }, (_, half) => numberOfHalf(half)));
})();

export const linearFromSrgb = (code: number): number =>
  code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;

/** The nearest 8-bit code of a display-linear value. */
function srgbCode(linear: number): number {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  return Math.round(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055));
}

/** Straight colours of four halves each to RGBA8 words. */
export class DisplayColours {
  private readonly codes = new Uint8Array(65536); // of a half that is not on the curve's shoulder
  private readonly lastOnLine: number; // the largest half up to which the curve is the identity

  constructor(private readonly exposure: number) {
    const halves = halfTable();
    let last = 0;
    for (let half = 0; half < 0x7c00; ++half) {
      const value = halves[half] * exposure;
      this.codes[half] = srgbCode(value);
      if (value <= kShoulderStart) last = half;
    }
    this.lastOnLine = last;
  }

  encode(r: number, g: number, b: number, a: number): number {
    const alpha = a === 0x3c00 ? 255 : Math.round(255 * Math.min(1, Math.max(0, halfTable()[a] || 0)));
    const last = this.lastOnLine;
    // Negative ones and NaN have larger bits than all others.
    if (r <= last && g <= last && b <= last)
      return (this.codes[r] | (this.codes[g] << 8) | (this.codes[b] << 16) | (alpha << 24)) >>> 0;
    return (this.onShoulder(r, g, b) | (alpha << 24)) >>> 0;
  }

  private onShoulder(r: number, g: number, b: number): number {
    const halves = halfTable();
    const usable = (half: number) => {
      const value = halves[half] * this.exposure;
      return value > 0 ? Math.min(value, kBrightest) : 0;
    };
    const colour = [usable(r), usable(g), usable(b)];
    const peak = Math.max(...colour);
    if (peak <= kShoulderStart) return srgbCode(colour[0]) | (srgbCode(colour[1]) << 8) | (srgbCode(colour[2]) << 16);
    const room = 1 - kShoulderStart;
    const mapped = 1 - (room * room) / (peak - kShoulderStart + room);
    const keep = 1 / (kHighlightDesaturation * (peak - mapped) + 1);
    const code = (value: number) => srgbCode(mapped + (value * (mapped / peak) - mapped) * keep);
    return code(colour[0]) | (code(colour[1]) << 8) | (code(colour[2]) << 16);
  }
}
