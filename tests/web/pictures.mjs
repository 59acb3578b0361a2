// Pictures and how alike they are.
import { createRequire } from 'node:module';
import { join } from 'node:path';

/** { width, height, data: RGBA } of a PNG's bytes. */
export const pngReader = (web) => {
  const { PNG } = createRequire(join(web, 'package.json'))('pngjs');
  return (bytes) => PNG.sync.read(bytes);
};

const luma = ({ data }) => Float64Array.from({ length: data.length / 4 }, (_, i) => 0.299 * data[4 * i] + 0.587 * data[4 * i + 1] + 0.114 * data[4 * i + 2]);

/** Mean structural similarity of luma over windows of 8 x 8 pixels, 4 apart (Wang et al. 2004). */
export function ssim(a, b) {
  if (a.width !== b.width || a.height !== b.height) throw new Error(`pictures of ${a.width}x${a.height} and ${b.width}x${b.height}`);
  const x = luma(a), y = luma(b), side = 8, c1 = (0.01 * 255) ** 2, c2 = (0.03 * 255) ** 2;
  let sum = 0, count = 0;
  for (let top = 0; top + side <= a.height; top += 4)
    for (let left = 0; left + side <= a.width; left += 4) {
      let sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
      for (let v = top; v < top + side; ++v)
        for (let u = left; u < left + side; ++u) {
          const i = v * a.width + u;
          sx += x[i], sy += y[i], sxx += x[i] * x[i], syy += y[i] * y[i], sxy += x[i] * y[i];
        }
      const n = side * side, mx = sx / n, my = sy / n;
      const vx = sxx / n - mx * mx, vy = syy / n - my * my, cov = sxy / n - mx * my;
      sum += ((2 * mx * my + c1) * (2 * cov + c2)) / ((mx * mx + my * my + c1) * (vx + vy + c2));
      ++count;
    }
  return sum / count;
}

/** Share of pixels that are black: nothing drawn. */
export const blackShare = ({ data }) => {
  let black = 0;
  for (let i = 0; i < data.length; i += 4) if (data[i] + data[i + 1] + data[i + 2] === 0) ++black;
  return (4 * black) / data.length;
};

/** Of the colours, decibels. */
export function psnr(a, b) {
  let sum = 0;
  for (let i = 0; i < a.data.length; ++i) if (i % 4 !== 3) sum += (a.data[i] - b.data[i]) ** 2;
  return 10 * Math.log10((255 ** 2 * 0.75 * a.data.length) / sum);
}
