// The background: where no capture has rows (engine/view/background.h), or, with CAPTURED, where a capture shows it
// (engine/view/captured_background.h); CLIP_TO_PART: only in part of the view (part.glsl).
#include "capture_depth.glsl"
#include "colour.glsl"
#ifdef CAPTURED
#include "part.glsl"
#endif

layout(location = 0) out vec4 colour;
uniform mat3 worldFromPicture;  // pixel centre (x, y from the top, 1) -> a direction
uniform float pictureHeight;
uniform vec3 zenith;  // of the sky; all black without one
uniform vec3 horizon;
uniform vec3 ground;
uniform float exposure;
#ifndef GL_ES
layout(location = 1) out uint source;
uniform uint sourceOfBackground;
#endif

#ifdef CAPTURED
// Of columns: first run, and one behind the last; none: equal. Of runs: first row, and one below the last in the high half; roles.
#ifdef GL_ES
uniform highp usampler2D columns;
uniform highp usampler2D runs;
uvec2 columnRuns(uint column) { return texelFetch(columns, ivec2(column & 2047u, column >> 11), 0).xy; }
uvec2 runAt(uint run) { return texelFetch(runs, ivec2(run & 2047u, run >> 11), 0).xy; }
#else
layout(std430, binding = 0) readonly buffer Columns { uvec2 columns[]; };
layout(std430, binding = 1) readonly buffer Runs { uvec2 runs[]; };
uvec2 columnRuns(uint column) { return columns[column]; }
uvec2 runAt(uint run) { return runs[run]; }
#endif
uniform vec2 middle;               // of the capture's sector
uniform vec2 columnsAndPerRadian;  // of the capture
uniform vec2 topAndRowsPerRadian;
uniform uint roles;  // of the region that the picture is drawn for
#else
uniform float above;  // row tangents
uniform float below;
#endif

#ifdef CAPTURED
bool holds(vec3 direction) {
  float ahead = dot(middle, direction.xy);
  if (ahead <= 0.0) return false;  // no sector is wider than half a turn
  float column = atan(left(middle, direction.xy), ahead) * columnsAndPerRadian.y + 0.5 * columnsAndPerRadian.x;
  if (column < 0.0 || column >= columnsAndPerRadian.x) return false;
  uvec2 all = columnRuns(uint(column));
  if (all.x == all.y) return false;
  float down = (topAndRowsPerRadian.x - atan(direction.z, length(direction.xy))) * topAndRowsPerRadian.y;
  if (down < 0.0) return false;
  uint row = uint(down);
  uint first = all.x, last = all.y;  // the first run that ends below the row
  while (first < last) {
    uint between = (first + last) / 2u;
    if ((runAt(between).x >> 16) <= row) first = between + 1u;
    else last = between;
  }
  if (first >= all.y) return false;
  uvec2 run = runAt(first);
  return (run.x & 0xffffu) <= row && (run.y & roles) != 0u;
}
#else
bool holds(vec3 direction) {
  float flatLength = length(direction.xy);
  return direction.z > above * flatLength || direction.z < below * flatLength;
}
#endif

void main() {
  vec3 direction = normalize(worldFromPicture * vec3(gl_FragCoord.x, pictureHeight - gl_FragCoord.y, 1.0));
#ifdef CLIP_TO_PART
  if (!inPart(direction.xy)) discard;
#endif
  if (!holds(direction)) discard;
  vec3 radiance = direction.z < 0.0 ? ground : mix(horizon, zenith, min(direction.z, 1.0));
  colour = vec4(srgbFromLinear(toneMap(radiance * exposure)), 1.0);
#ifndef GL_ES
  source = sourceOfBackground;
#endif
  gl_FragDepth = kSkyDepth;
}
