// What is known of each pixel while patches are painted, front to back (engine/view/patch_kernel.h). Parts: one bit for each
// of a pixel's rays.
const int kPixelParts = 8;
const uint kAllParts = 0xffu;

// Of the words of a pixel's state:
// x: parts that nothing covers yet
// y: parts that show a mirror and wait for what it shows; from bit 16 on its number
// z: source of the surface that covers most parts, from bit 8 on; below how many it covers. 0: nothing is painted
// w: inverse depth of that surface, a float

// What they add up to: squared codes of what covers parts, and what comes through what is clear before the next.
#ifdef GL_ES
#define SUMS highp usampler2D
vec4 sumsAt(SUMS sums, ivec2 at) { return uintBitsToFloat(texelFetch(sums, at, 0)); }
#else
#define SUMS sampler2D
vec4 sumsAt(SUMS sums, ivec2 at) { return texelFetch(sums, at, 0); }
#endif

// How many of them.
int partsIn(uint parts) {
  parts -= parts >> 1 & 0x55u;
  parts = (parts & 0x33u) + (parts >> 2 & 0x33u);
  return int((parts + (parts >> 4)) & 15u);
}

uint mirrorPartsOf(uvec4 state) { return state.y & kAllParts; }
