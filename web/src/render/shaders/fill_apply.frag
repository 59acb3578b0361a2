// Paints the holes (the stencil lets only them through). Define LOUD: in a colour that nothing has.
#ifdef LOUD
layout(location = 0) out vec4 colour;

void main() { colour = vec4(1.0, 0.0, 0.86, 1.0); }
#else
#include "capture_depth.glsl"
#include "fill.glsl"

layout(location = 0) out vec4 colour;
uniform sampler2D coarser;

void main() {
  vec4 texel = fromCoarser(coarser, ivec2(gl_FragCoord.xy));
  if (texel.a < 0.0) discard;
  colour = vec4(texel.rgb, 1.0);
  gl_FragDepth = captureDepth(texel.a);
}
#endif
