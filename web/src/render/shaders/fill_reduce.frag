// One level of the fill's pyramid from the next finer one. Define FROM_FRAME: from the frame itself.
#include "capture_depth.glsl"
#include "fill.glsl"

layout(location = 0) out vec4 texel;
#ifdef FROM_FRAME
uniform sampler2D frameColour;
uniform highp sampler2D frameDepth;
uniform float nearest;
#else
uniform sampler2D finer;
#endif

vec4 finerTexel(ivec2 at) {
#ifdef FROM_FRAME
  float depth = texelFetch(frameDepth, at, 0).r;
  if (depth == 0.0) return vec4(0.0, 0.0, 0.0, -1.0);
  return vec4(texelFetch(frameColour, at, 0).rgb, min(inverseOfDepth(depth, nearest), 6e4));
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
