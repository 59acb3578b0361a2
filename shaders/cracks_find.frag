// How near a sample must be to lie in a crack: before what shows there, if nearer pixels lie on both sides of it, left and right
// or above and below (engine/view/cracks.h). Elsewhere 0.

layout(location = 0) out float least;
uniform sampler2D depths;
uniform int reach;     // pixels
uniform float before;  // factor

float nearest(ivec2 at, ivec2 step) {
  float found = 0.0;
  ivec2 size = textureSize(depths, 0);
  for (int i = 1; i <= reach; ++i) {
    at += step;
    if (all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size))) found = max(found, texelFetch(depths, at, 0).r);
  }
  return found;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float own = before * texelFetch(depths, at, 0).r;
  float across = min(nearest(at, ivec2(-1, 0)), nearest(at, ivec2(1, 0)));
  float along = min(nearest(at, ivec2(0, -1)), nearest(at, ivec2(0, 1)));
  least = max(across, along) > own ? own : 0.0;
}
