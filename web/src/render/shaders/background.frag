// The background: where no capture has rows (engine/view/background.h), or, with CAPTURED, where a capture shows it
// (engine/view/captured_background.h).
#include "colour.glsl"

layout(location = 0) out vec4 colour;
uniform mat3 worldFromPicture;  // pixel centre (x, y from the top, 1) -> a direction
uniform float pictureHeight;
uniform vec3 zenith;
uniform vec3 horizon;
uniform vec3 ground;
uniform float exposure;

#ifdef CAPTURED
uniform highp usampler2D columnRuns;  // first run of each column, and one behind all
uniform highp usampler2D runs;        // first row, and one below the last in the high half; roles
uniform highp sampler2D columns;      // as in points.vert
uniform vec2 middle;               // of the capture's sector
uniform vec2 columnsAndPerRadian;  // of the capture
uniform vec2 topAndRowsPerRadian;
uniform uint roles;

ivec2 texelAt(int i) { return ivec2(i & 2047, i >> 11); }

bool holds(vec3 direction) {
  float ahead = dot(middle, direction.xy);
  if (ahead <= 0.0) return false;  // no sector is wider than half a turn
  float left = middle.x * direction.y - middle.y * direction.x;
  float at = atan(left, ahead) * columnsAndPerRadian.y + 0.5 * columnsAndPerRadian.x;
  if (at < 0.0 || at >= columnsAndPerRadian.x) return false;
  int column = int(at);
  if (texelFetch(columns, texelAt(2 * column + 1), 0).r > 0.0) return false;  // the sky is another piece's
  uint first = texelFetch(columnRuns, texelAt(column), 0).r, end = texelFetch(columnRuns, texelAt(column + 1), 0).r;
  float down = (topAndRowsPerRadian.x - atan(direction.z, length(direction.xy))) * topAndRowsPerRadian.y;
  if (first == end || down < 0.0) return false;
  uint row = uint(down), last = end;
  while (first < last) {  // the first run that ends below the row
    uint between = (first + last) / 2u;
    if ((texelFetch(runs, texelAt(int(between)), 0).r >> 16) <= row) first = between + 1u;
    else last = between;
  }
  if (first >= end) return false;
  uvec4 run = texelFetch(runs, texelAt(int(first)), 0);
  return (run.r & 0xffffu) <= row && (run.g & roles) != 0u;
}
#else
uniform float above;  // row tangents
uniform float below;

bool holds(vec3 direction) {
  float flatLength = length(direction.xy);
  return direction.z > above * flatLength || direction.z < below * flatLength;
}
#endif

void main() {
  vec3 direction = normalize(worldFromPicture * vec3(gl_FragCoord.x, pictureHeight - gl_FragCoord.y, 1.0));
  if (!holds(direction)) discard;
  vec3 radiance = direction.z < 0.0 ? ground : mix(horizon, zenith, min(direction.z, 1.0));
  colour = vec4(srgbFromLinear(toneMap(radiance * exposure)), 1.0);
}
