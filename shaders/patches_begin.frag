// The state of each pixel before patches are painted. Defines: LOCAL_MIRRORS (of local geometry, whose pixels wait for what
// they show), BEHIND (before the second cover: it is painted where the first shows nothing, and in its cracks).
#include "patch_state.glsl"

layout(location = 0) out vec4 sums;
layout(location = 1) out uvec4 state;
#ifdef LOCAL_MIRRORS
uniform usampler2D mirrors;  // 0 = none
#endif
#ifdef BEHIND
uniform sampler2D sumsBefore;
uniform usampler2D statesBefore;
uniform sampler2D leastDepths;
#endif

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  sums = vec4(0.0, 0.0, 0.0, 1.0);
  state = uvec4(kAllParts, 0u, 0u, 0u);
#ifdef LOCAL_MIRRORS
  uint mirror = texelFetch(mirrors, at, 0).r;
  if (mirror != 0u) state.xy = uvec2(0u, kAllParts | mirror << 16);
#endif
#ifdef BEHIND
  uvec4 before = texelFetch(statesBefore, at, 0);
  if (before.y != 0u) {
    sums = texelFetch(sumsBefore, at, 0);
    state = before;
  } else if (before.z != 0u && texelFetch(leastDepths, at, 0).r == 0.0) {
    state.x = 0u;
  }
#endif
}
