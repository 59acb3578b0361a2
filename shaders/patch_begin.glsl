// The state of a pixel before patches are painted. Before it are included patch_state.glsl and, with BEHIND, cracks.glsl.
// Defines: LOCAL_MIRRORS (of local geometry, whose pixels wait for what they show), BEHIND (before the second cover: it is
// painted where the first shows nothing, in its cracks, and where it is thinly sampled).
#ifdef LOCAL_MIRRORS
uniform highp usampler2D mirrors;  // 0 = none
#endif
#ifdef BEHIND
uniform SUMS sumsBefore;
uniform highp usampler2D statesBefore;
#endif

void beginPixel(ivec2 at, out vec4 sums, out uvec4 states) {
  sums = vec4(0.0, 0.0, 0.0, 1.0);
  states = uvec4(kAllParts, 0u, 0u, 0u);
#ifdef LOCAL_MIRRORS
  uint mirror = texelFetch(mirrors, at, 0).r;
  if (mirror != 0u) states.xy = uvec2(0u, kAllParts | mirror << 16);
#endif
#ifdef BEHIND
  uvec4 before = texelFetch(statesBefore, at, 0);
  if (before.y != 0u) {
    sums = sumsAt(sumsBefore, at);
    states = before;
  } else if (before.z != 0u && !isCrack(at)) {
    if (isThin(before, sumsAt(sumsBefore, at)))
      states.y = kSecondLook;
    else
      states.x = 0u;
  }
#endif
}
