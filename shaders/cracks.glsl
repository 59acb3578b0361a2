// Cracks of the first cover, where the second is drawn before what shows in them.
uniform sampler2D leastDepths;  // 0 where there is none

bool isCrack(ivec2 at) { return texelFetch(leastDepths, at, 0).r != 0.0; }
bool liesBehindCrack(float depth) {
  float least = texelFetch(leastDepths, ivec2(gl_FragCoord.xy), 0).r;
  return least > 0.0 && depth <= least;
}
