// How near a sample must be to lie in a crack: before what shows there, if nearer pixels lie on both sides of it, left and right
// or above and below (engine/view/cracks.h). Elsewhere 0.
#include "capture_depth.glsl"

layout(location = 0) out uint least;
uniform highp sampler2D depths;
uniform int reach;     // pixels
uniform float before;  // factor of inverse depth
uniform float nearest;

float inverseAt(ivec2 at) { return inverseOfDepth(texelFetch(depths, at, 0).r, nearest); }

float nearestAlong(ivec2 at, ivec2 step) {
  float found = 0.0;
  ivec2 size = textureSize(depths, 0);
  for (int i = 1; i <= reach; ++i) {
    at += step;
    if (all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size))) found = max(found, texelFetch(depths, at, 0).r);
  }
  return found > 0.0 ? inverseOfDepth(found, nearest) : 0.0;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depths, at, 0).r;
  least = 0u;
  if (depth == 0.0) return;
  float own = before * inverseOfDepth(depth, nearest);
  float across = min(nearestAlong(at, ivec2(-1, 0)), nearestAlong(at, ivec2(1, 0)));
  float along = min(nearestAlong(at, ivec2(0, -1)), nearestAlong(at, ivec2(0, 1)));
  if (max(across, along) > own) least = floatBitsToUint(captureDepth(own));
}
