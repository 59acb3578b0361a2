// Lays a layer of clear samples over the picture: each pixel once, however many splats of one pane overlap there.
// Blending happens in linear light: the framebuffer encodes. Define MARK_MIRRORS: what is tinted shows no mirror any more.
#include "colour.glsl"

layout(location = 0) out vec4 colour;
#ifdef MARK_MIRRORS
layout(location = 2) out uint mirror;
#endif
uniform sampler2D layer;  // sRGB codes, straight alpha; 0 = nothing

void main() {
  vec4 texel = texelFetch(layer, ivec2(gl_FragCoord.xy), 0);
  if (texel.a == 0.0) discard;
#ifdef MARK_MIRRORS
  mirror = 0u;
#endif
  colour = vec4(linearFromSrgb(texel.rgb), texel.a);
}
