// Lays a layer of blended samples over a copy of the picture, in linear light: each pixel once, however many splats of one
// pane overlap there. Define MARK_MIRRORS: what is tinted shows no mirror any more.
#include "colour.glsl"

layout(location = 0) out vec4 colour;
#ifdef MARK_MIRRORS
layout(location = 1) out uint mirrorShown;
#endif
uniform sampler2D layer;  // sRGB codes, straight alpha; 0 = nothing
uniform sampler2D behind;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 texel = texelFetch(layer, at, 0);
  if (texel.a == 0.0) discard;
#ifdef MARK_MIRRORS
  mirrorShown = 0u;
#endif
  vec3 mixed = mix(linearFromSrgb(texelFetch(behind, at, 0).rgb), linearFromSrgb(texel.rgb), texel.a);
  colour = vec4(srgbFromLinear(mixed), 1.0);
}
