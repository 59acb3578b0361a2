// A picture to one of the same size: codes to linear values, or with TO_CODES the other way round.
#include "colour.glsl"

layout(location = 0) out vec4 colour;
uniform sampler2D picture;

void main() {
  vec3 texel = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
#ifdef TO_CODES
  colour = vec4(srgbFromLinear(texel), 1.0);
#else
  colour = vec4(linearFromSrgb(texel), 1.0);
#endif
}
