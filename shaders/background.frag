// The background where no capture has rows (engine/view/background.h).
#include "colour.glsl"

layout(location = 0) out vec4 colour;
layout(location = 1) out uint source;
uniform mat3 worldFromPicture;  // pixel centre (x, y from the top, 1) -> a direction
uniform float pictureHeight;
uniform float above;  // row tangents
uniform float below;
uniform vec3 zenith;  // of the sky; all black without one
uniform vec3 horizon;
uniform vec3 ground;
uniform float exposure;
uniform uint sourceOfBackground;

const float kSkyDepth = 1e-30;  // as in points.vert

void main() {
  vec3 direction = normalize(worldFromPicture * vec3(gl_FragCoord.x, pictureHeight - gl_FragCoord.y, 1.0));
  float flatLength = length(direction.xy);
  if (direction.z <= above * flatLength && direction.z >= below * flatLength) discard;
  vec3 radiance = direction.z < 0.0 ? ground : mix(horizon, zenith, min(direction.z, 1.0));
  colour = vec4(srgbFromLinear(toneMap(radiance * exposure)), 1.0);
  source = sourceOfBackground;
  gl_FragDepth = kSkyDepth;
}
