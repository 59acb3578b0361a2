// Lays a layer of clear samples over the picture: each pixel once, however many splats of one pane overlap there.
// Blending happens in linear light: the framebuffer encodes.
#include "colour.glsl"

layout(location = 0) out vec4 colour;
uniform sampler2D layer;  // sRGB codes, straight alpha; 0 = nothing

void main() {
  vec4 texel = texelFetch(layer, ivec2(gl_FragCoord.xy), 0);
  if (texel.a == 0.0) discard;
  colour = vec4(linearFromSrgb(texel.rgb), texel.a);
}
