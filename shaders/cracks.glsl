// Cracks of the first cover, where the second is drawn before what shows in them.
uniform sampler2D leastDepths;  // 0 where there is none

bool liesBehindCrack(float depth) {
  float least = texelFetch(leastDepths, ivec2(gl_FragCoord.xy), 0).r;
  return least > 0.0 && depth <= least;
}
