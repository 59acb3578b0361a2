// From what was painted to colours, over what the picture holds: of pixels that show mirrors, or of all others. Defines:
// MIRRORS; BEHIND (of the second cover, over what the first shows: in its cracks only what lies before that, elsewhere only what
// shows the same surface more densely).
#include "capture_depth.glsl"
#include "patch_state.glsl"
#ifdef BEHIND
#include "cracks.glsl"
uniform highp usampler2D statesBefore;
#endif

layout(location = 0) out vec4 colour;
uniform SUMS sums;
uniform highp usampler2D states;
uniform sampler2D coloursBefore;
#ifdef MIRRORS
uniform bool local;  // those of local geometry alone, or all others
#endif
#ifndef GL_ES
layout(location = 1) out uint source;
uniform usampler2D sourcesBefore;
uniform uint hole;
uniform uint background;
#endif

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  uvec4 state = texelFetch(states, at, 0);
#ifdef MIRRORS
  if (!isMirror(state) || local != (state.x == 0u && state.z == 0u)) discard;
#else
  if (isMirror(state)) discard;
#endif
  vec4 sum = sumsAt(sums, at);
  vec4 before = texelFetch(coloursBefore, at, 0);
#ifdef GL_ES
  bool wasHole = before.a == 0.0;
#else
  uint sourceBefore = texelFetch(sourcesBefore, at, 0).r;
  bool wasHole = sourceBefore == hole;
#endif
  bool painted = state.z != 0u;
  int open = partsIn(state.x);
  bool behind = open > 0 && !wasHole;  // what lies behind shows between the parts that are covered
  int shown = kPixelParts - open - partsIn(mirrorPartsOf(state));
  bool real = painted;
#ifdef MIRRORS
  real = real || shown > 0;
#endif
  int number = shown + (behind ? open : 0);
  if (!(behind || real) || number <= 0) discard;
  float depth = captureDepth(painted ? uintBitsToFloat(state.w) : 0.0);
#ifdef BEHIND
  uvec4 first = texelFetch(statesBefore, at, 0);
  if (isCrack(at)) {
    if (liesBehindCrack(depth)) discard;
  } else if (first.z != 0u) {
    if (!isDenser(first, state, sum)) discard;
    depth = max(depth, captureDepth(uintBitsToFloat(first.w)));
  }
#endif
  vec3 codes = before.rgb * 255.0;
  vec3 mean = (sum.rgb + codes * codes * (behind ? float(open) * sum.w : 0.0)) / float(number);
  colour = vec4(min(floor(sqrt(mean) + 0.5), 255.0) / 255.0, 1.0);
#ifndef GL_ES
  source = painted ? sourceOf(state) : wasHole ? background : sourceBefore;
#endif
  gl_FragDepth = depth;
}
