// Cracks of the first cover, where the second is drawn before what shows in them (shaders/cracks.glsl).
uniform highp usampler2D leastDepths;  // bits of floats, 0 where there is none

bool isCrack(ivec2 at) { return texelFetch(leastDepths, at, 0).r != 0u; }
bool liesBehindCrack(float depth) {
  uint least = texelFetch(leastDepths, ivec2(gl_FragCoord.xy), 0).r;
  return least > 0u && depth <= uintBitsToFloat(least);
}
