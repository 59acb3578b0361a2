// Colour and camera of a sample. Defines: MARK_MIRRORS says which mirror the pixel now shows, of captures with MIRRORS that of
// the sample, else none; REFLECT paints only the pixels that show the sample's mirror; IN_CRACKS paints before what shows in cracks alone.
#ifdef IN_CRACKS
#include "cracks.glsl"
#endif

layout(location = 0) out vec4 colour;
layout(location = 1) out uint source;

flat in vec4 pointColour;
uniform uint sourceOfPiece;
#ifdef MIRRORS
flat in uint pointMirror;
#endif
#ifdef MARK_MIRRORS
layout(location = 2) out uint mirror;
#endif
#ifdef REFLECT
uniform usampler2D mirrors;
#endif


void main() {
#ifdef IN_CRACKS
  if (liesBehindCrack(gl_FragCoord.z)) discard;
#endif
#ifdef REFLECT
  if (texelFetch(mirrors, ivec2(gl_FragCoord.xy), 0).r != pointMirror) discard;
#endif
#ifdef MARK_MIRRORS
#ifdef MIRRORS
  mirror = pointMirror;
#else
  mirror = 0u;
#endif
#endif
  colour = pointColour;
  source = sourceOfPiece;
}
