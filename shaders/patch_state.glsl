// What is known of each pixel while patches are painted, front to back (engine/view/patch_kernel.h). Parts: one bit for each
// of a pixel's rays.
const int kPixelParts = 8;
const uint kAllParts = 0xffu;

// Of the words of a pixel's state:
// x: parts that nothing covers yet
// y: parts that show a mirror and wait for what it shows; from bit 16 on its number; or kSecondLook
// z: of the surface that covers most parts: how many, its source from bit 4 on, how densely it is sampled from bit 20 on.
// 0: nothing is painted
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
// The first cover has something here, thinly sampled: nothing waits for what mirrors of the second show.
const uint kSecondLook = 0x100u;
bool isMirror(uvec4 state) { return (state.y & ~kSecondLook) != 0u; }

uint paintedOf(uint number, uint source, uint density) { return number | source << 4 | density << 20; }
uint numberOf(uvec4 state) { return state.z & 15u; }
uint sourceOf(uvec4 state) { return state.z >> 4 & 0xffffu; }
uint densityOf(uvec4 state) { return state.z >> 20; }
// What is sampled more thinly is painted again from the second cover, and shown so where that is denser by this factor (kDenser).
const uint kThinDensity = 2048u;
const uint kMostDensity = 4095u;
// Not through glass, which the other cover may lack, nor for what a mirror shows: then sums.w is not 1. `sums`: of the same cover.
bool isThin(uvec4 first, vec4 sums) { return first.z != 0u && sums.w == 1.0 && densityOf(first) < kThinDensity; }
// Does the second show the same surface, and more densely? Neither lies before the other (Cracks::kBefore).
bool isDenser(uvec4 first, uvec4 second, vec4 sums) {
  if (sums.w != 1.0) return false;
  float one = uintBitsToFloat(first.w), other = uintBitsToFloat(second.w);
  return one < 1.03 * other && other < 1.03 * one && float(densityOf(second)) > 1.25 * float(densityOf(first));
}
