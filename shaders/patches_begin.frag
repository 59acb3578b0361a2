// The state of each pixel before patches are painted. Defines: LOCAL_MIRRORS, BEHIND (patch_begin.glsl).
#include "patch_state.glsl"
#ifdef BEHIND
#include "cracks.glsl"
#endif
#include "patch_begin.glsl"

layout(location = 0) out vec4 sums;
layout(location = 1) out uvec4 state;

void main() { beginPixel(ivec2(gl_FragCoord.xy), sums, state); }
