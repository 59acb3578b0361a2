// The patches of one piece that a tile of the picture may show, front to back. Defines: MIRRORS, REFLECT (patch.glsl).
#include "patch_state.glsl"

layout(std430, binding = 0) readonly buffer Patches { uvec4 patchWords[]; };
layout(std430, binding = 1) readonly buffer TilePatches { uint tilePatches[]; };
layout(std430, binding = 2) readonly buffer Colours { uint colours[]; };
layout(std430, binding = 3) readonly buffer Covers { uint covers[]; };

uint coverAt(uint texel) { return covers[texel]; }
vec4 codesAt(uint texel) { return unpackUnorm4x8(colours[texel]) * 255.0; }
#include "patch.glsl"

layout(rgba32f, binding = 0) uniform restrict image2D sums;
layout(rgba32ui, binding = 1) uniform restrict uimage2D states;

flat in uvec2 range;
uniform float pictureHeight;
uniform uvec4 pieceWords[3];

void main() {
  ivec2 own = ivec2(gl_FragCoord.xy);
  vec2 pixel = vec2(float(own.x), pictureHeight - 1.0 - float(own.y));
  piece = pieceOf(pieceWords[0], pieceWords[1], pieceWords[2]);
  if (!holds(piece, pixel)) return;
  state = imageLoad(states, own);
  if (isClosed()) return;
  sum = imageLoad(sums, own);
  for (uint i = range.x; i < range.y && !isClosed(); ++i) {
    uint at = 5u * tilePatches[i];
    paint(patchOf(patchWords[at], patchWords[at + 1u], patchWords[at + 2u], patchWords[at + 3u], patchWords[at + 4u]), pixel);
  }
  imageStore(sums, own, sum);
  imageStore(states, own, state);
}
