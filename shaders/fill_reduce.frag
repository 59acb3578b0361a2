// One level of the fill's pyramid from the next finer one. Define FROM_FRAME: from the frame itself.
#include "fill.glsl"

layout(location = 0) out vec4 texel;
#ifdef FROM_FRAME
uniform sampler2D frameColour;
uniform sampler2D frameDepth;
#else
uniform sampler2D finer;
#endif

const float kNearest = 1e-7;               // as in local.vert
const float kBackgroundDepthScale = 1e-20; // as in capture_depth.glsl
const float kLargestBackground = 1e-14;

vec4 finerTexel(ivec2 at) {
#ifdef FROM_FRAME
  float depth = texelFetch(frameDepth, at, 0).r;
  if (depth == 0.0) return vec4(0.0, 0.0, 0.0, -1.0);
  float inverseZDepth = depth > kLargestBackground ? depth / kNearest : depth / kBackgroundDepthScale;
  return vec4(texelFetch(frameColour, at, 0).rgb, min(inverseZDepth, 6e4));
#else
  return texelFetch(finer, at, 0);
#endif
}

void main() {
#ifdef FROM_FRAME
  ivec2 limit = textureSize(frameColour, 0) - 1;
#else
  ivec2 limit = textureSize(finer, 0) - 1;
#endif
  ivec2 base = 2 * ivec2(gl_FragCoord.xy);
  vec4 texels[4];
  for (int i = 0; i < 4; ++i) texels[i] = finerTexel(min(base + ivec2(i & 1, i >> 1), limit));
  texel = farthestMean(texels);
}
