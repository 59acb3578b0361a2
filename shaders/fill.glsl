// Texels of the fill's pyramid: sRGB codes, and the inverse depth along the view axis (1/m); negative = nothing known.
// A hole opens behind the edge of something near, so what belongs there is the farther surface: a mean takes only texels
// whose inverse depth is within kSameSurface of the smallest.
const float kSameSurface = 1.3;

vec4 farthestMean(vec4 texels[4], float weights[4]) {
  float smallest = 1e30;
  for (int i = 0; i < 4; ++i)
    if (texels[i].a >= 0.0 && weights[i] > 0.0) smallest = min(smallest, texels[i].a);
  vec4 sum = vec4(0.0);
  float total = 0.0;
  for (int i = 0; i < 4; ++i)
    if (texels[i].a >= 0.0 && texels[i].a <= kSameSurface * smallest + 1e-6) {
      sum += weights[i] * texels[i];
      total += weights[i];
    }
  return total > 0.0 ? sum / total : vec4(0.0, 0.0, 0.0, -1.0);
}

// What a coarser level knows about the texel at `at` of the next finer one.
vec4 fromCoarser(sampler2D coarser, ivec2 at) {
  vec2 position = (vec2(at) + 0.5) * 0.5 - 0.5;
  ivec2 base = ivec2(floor(position));
  vec2 f = position - vec2(base);
  ivec2 limit = textureSize(coarser, 0) - 1;
  vec4 texels[4];
  float weights[4];
  for (int i = 0; i < 4; ++i) {
    ivec2 offset = ivec2(i & 1, i >> 1);
    texels[i] = texelFetch(coarser, clamp(base + offset, ivec2(0), limit), 0);
    weights[i] = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
  }
  return farthestMean(texels, weights);
}
