// Texels of the fill's pyramid: sRGB codes, and the inverse depth along the view axis (1/m); negative = nothing known.
// A hole opens behind the edge of something near, so what belongs there is the farther surface: a mean takes only texels
// whose inverse depth is within kSameSurface of the smallest.
const float kSameSurface = 1.3;

vec4 farthestMean(vec4 texels[4]) {
  float smallest = 1e30;
  for (int i = 0; i < 4; ++i)
    if (texels[i].a >= 0.0) smallest = min(smallest, texels[i].a);
  vec4 sum = vec4(0.0);
  float total = 0.0;
  for (int i = 0; i < 4; ++i)
    if (texels[i].a >= 0.0 && texels[i].a <= kSameSurface * smallest) {
      sum += texels[i];
      total += 1.0;
    }
  return total > 0.0 ? sum / total : vec4(0.0, 0.0, 0.0, -1.0);
}

// What a coarser level knows about the texel at `at` of the next finer one: near what is near, so that one far texel does
// not spread through all levels; nearer surfaces count for little.
vec4 fromCoarser(sampler2D coarser, ivec2 at) {
  const float kNearerSurface = 0.05;
  vec2 position = (vec2(at) + 0.5) * 0.5 - 0.5;
  ivec2 base = ivec2(floor(position));
  vec2 f = position - vec2(base);
  ivec2 limit = textureSize(coarser, 0) - 1;
  vec4 texels[4];
  float smallest = 1e30;
  for (int i = 0; i < 4; ++i) {
    texels[i] = texelFetch(coarser, clamp(base + ivec2(i & 1, i >> 1), ivec2(0), limit), 0);
    if (texels[i].a >= 0.0) smallest = min(smallest, texels[i].a);
  }
  vec4 sum = vec4(0.0);
  float total = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (texels[i].a < 0.0) continue;
    float weight = ((i & 1) == 1 ? f.x : 1.0 - f.x) * ((i >> 1) == 1 ? f.y : 1.0 - f.y);
    if (texels[i].a > kSameSurface * smallest) weight *= kNearerSurface;
    sum += weight * texels[i];
    total += weight;
  }
  return total > 0.0 ? sum / total : vec4(0.0, 0.0, 0.0, -1.0);
}
