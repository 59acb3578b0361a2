// What a tile of the picture may show of patches, front to back. Defines: MIRRORS, REFLECT (patch.glsl); LOCAL_MIRRORS, BEHIND
// (patch_begin.glsl).
#include "patch_state.glsl"
#ifdef BEHIND
#include "cracks.glsl"
#endif
#ifdef REFLECT
uniform SUMS sumsBefore;
uniform highp usampler2D statesBefore;
#else
#include "patch_begin.glsl"
#endif

uniform highp usampler2D patchWords;
uniform highp usampler2D pieceWords;
uniform highp usampler2D tilePatches;
uniform highp sampler2DArray texelColours;
uniform highp usampler2DArray texelCovers;

ivec3 placeOf(uint texel) { return ivec3(texel & 2047u, texel >> 11 & 2047u, texel >> 22); }
uint coverAt(uint texel) { return texelFetch(texelCovers, placeOf(texel), 0).r; }
vec4 codesAt(uint texel) { return texelFetch(texelColours, placeOf(texel), 0) * 255.0; }
#include "patch.glsl"

layout(location = 0) out uvec4 sums;
layout(location = 1) out uvec4 states;

flat in uvec2 range;
uniform float pictureHeight;

uvec4 wordsAt(highp usampler2D words, uint at) { return texelFetch(words, ivec2(at & 2047u, at >> 11), 0); }

void main() {
  ivec2 own = ivec2(gl_FragCoord.xy);
#ifdef REFLECT
  sum = sumsAt(sumsBefore, own);
  state = texelFetch(statesBefore, own, 0);
#else
  beginPixel(own, sum, state);
#endif
  vec2 pixel = vec2(float(own.x), pictureHeight - 1.0 - float(own.y));
  uint last = 0xffffffffu;
  bool inside = false;
  for (uint i = range.x; i < range.y && !isClosed(); ++i) {
    uint at = 5u * wordsAt(tilePatches, i).r;
    uvec4 looks = wordsAt(patchWords, at + 4u);
    if (looks.z != last) {
      last = looks.z;
      piece = pieceOf(wordsAt(pieceWords, 3u * last), wordsAt(pieceWords, 3u * last + 1u), wordsAt(pieceWords, 3u * last + 2u));
      inside = holds(piece, pixel);
    }
    if (inside)
      paint(patchOf(wordsAt(patchWords, at), wordsAt(patchWords, at + 1u), wordsAt(patchWords, at + 2u), wordsAt(patchWords, at + 3u),
                    looks), pixel);
  }
  sums = floatBitsToUint(sum);
  states = state;
}
