// Colour of a sample. Defines: MARK_MIRRORS says which mirror the pixel now shows (with MIRRORS the sample's, else none);
// REFLECT paints only the pixels that show the sample's mirror.
#ifdef MIRRORS
flat in uint pointMirror;
#endif
#ifdef REFLECT
uniform highp usampler2D mirrors;
layout(location = 1) out uint reflected;
#endif
#ifdef MARK_MIRRORS
layout(location = 1) out uint mirrorShown;
#endif
flat in vec4 pointColour;
layout(location = 0) out vec4 colour;

void main() {
#ifdef REFLECT
  if (texelFetch(mirrors, ivec2(gl_FragCoord.xy), 0).r != pointMirror) discard;
  reflected = 1u;
#endif
#ifdef MARK_MIRRORS
#ifdef MIRRORS
  mirrorShown = pointMirror;
#else
  mirrorShown = 0u;
#endif
#endif
  colour = pointColour;
}
