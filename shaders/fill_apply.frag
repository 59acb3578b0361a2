// Paints the holes (the stencil lets only them through) and marks them as invented.
#include "fill.glsl"

layout(location = 0) out vec4 colour;
layout(location = 1) out uint source;
uniform sampler2D coarser;
uniform uint invented;

void main() {
  vec4 texel = fromCoarser(coarser, ivec2(gl_FragCoord.xy));
  if (texel.a < 0.0) discard;
  colour = vec4(texel.rgb, 1.0);
  source = invented;
}
