// What a level of the fill's pyramid does not know, from the next coarser one.
#include "fill.glsl"

layout(location = 0) out vec4 texel;
uniform sampler2D own;
uniform sampler2D coarser;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  texel = texelFetch(own, at, 0);
  if (texel.a < 0.0) texel = fromCoarser(coarser, at);
}
