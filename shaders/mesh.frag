// The sample of a patch that a pixel shows, if the piece needs it. Defines: CLIP_TO_PART; PLACES says where in the pixel the
// sample lies; MARK_MIRRORS says which mirror the pixel now shows, of captures with MIRRORS that of the sample, else none;
// IN_CRACKS draws before what shows in cracks alone.
#include "capture_depth.glsl"
#include "fringe.glsl"
#ifdef IN_CRACKS
#include "cracks.glsl"
#endif
#ifdef CLIP_TO_PART
#include "part.glsl"
uniform mat3 worldFromPicture;  // pixel centre (x, y from the top, 1) -> a direction
uniform float pictureHeight;
#endif

layout(location = 0) out vec4 colour;
layout(location = 1) out uint source;
#ifdef MARK_MIRRORS
layout(location = 2) out uint mirror;
#endif
#ifdef PLACES
layout(location = 3) out uint place;
#endif
layout(depth_less) out float gl_FragDepth;

smooth in vec3 local;
flat in float middleTangent;
flat in uvec4 block;

layout(std430, binding = 4) readonly buffer Texels { uvec2 texels[]; };  // inverse distance and roles, colour and fringes
layout(std430, binding = 5) readonly buffer Limits { vec2 limits[]; };   // by column: largest and least inverse distance
#ifdef MIRRORS
layout(std430, binding = 3) readonly buffer Mirrors { uint mirrorsOfFour[]; };
#endif

uniform vec2 pitches;
uniform uint roles;  // of the region that the picture is drawn for: samples for others are left out
uniform uint sourceOfPiece;
uniform float fringeDepth;  // by how much a fringe lies behind, as inverse distance

vec2 smallAngle(vec2 tangent) { return tangent - tangent * tangent * tangent / 3.0; }

void main() {
#ifdef CLIP_TO_PART
  if (!inPart((worldFromPicture * vec3(gl_FragCoord.x, pictureHeight - gl_FragCoord.y, 1.0)).xy)) discard;
#endif
  float t = local.z / length(local.xy);
  vec2 fromMiddle = smallAngle(vec2(local.y / local.x, (middleTangent - t) / (1.0 + t * middleTangent)));
  vec2 size = vec2(block.yz);
  vec2 at = fromMiddle / pitches + 0.5 * size;  // in samples, from the patch's first column and row
#ifdef PLACES
  mat2 pixelsPerSample = inverse(mat2(dFdx(at), dFdy(at)));  // upwards
#endif
  vec2 inside = clamp(floor(at), vec2(0.0), size - 1.0);
  uint texel = block.x + uint(inside.x) * block.z + uint(inside.y);
  uvec2 sampled = texels[texel];
  float w = uintBitsToFloat(sampled.x & 0xffffff00u);
  vec2 limit = limits[block.w + uint(inside.x)];
  if ((sampled.x & roles) == 0u || w > limit.x || w < limit.y) discard;
  vec2 beyond = max(-at, at - size);
  if (any(greaterThan(beyond, vec2(0.0)))) {
    uint steps = sampled.y >> 24;
    if (beyond.x > fringe(steps, at.x < 0.0 ? kLowColumn : kHighColumn) ||
        beyond.y > fringe(steps, at.y < 0.0 ? kTopRow : kBottomRow)) discard;
    float behind = gl_FragCoord.z - kBackgroundDepthScale * fringeDepth * gl_FragCoord.w;
    gl_FragDepth = max(max(behind, 0.25 * gl_FragCoord.z), kSkyDepth);  // still before the background
  } else {
    gl_FragDepth = max(gl_FragCoord.z, kSkyDepth);
  }
#ifdef IN_CRACKS
  if (liesBehindCrack(gl_FragDepth)) discard;
#endif
#ifdef PLACES
  vec2 fromCentre = pixelsPerSample * (inside + 0.5 - at);
  ivec2 eighths = clamp(ivec2(floor(vec2(fromCentre.x, -fromCentre.y) * 8.0 + 0.5)), -8, 7) & 15;
  vec2 spacing = abs(pixelsPerSample[0]) + abs(pixelsPerSample[1]);
  int spread = int(clamp(floor(8.5 - 8.0 / min(spacing.x, spacing.y)), 0.0, 7.0));
  place = uint(eighths.x | eighths.y << 4 | spread << 8);
#endif
#ifdef MARK_MIRRORS
#ifdef MIRRORS
  mirror = bitfieldExtract(mirrorsOfFour[texel >> 2], int(texel & 3u) * 8, 8);
#else
  mirror = 0u;
#endif
#endif
  colour = vec4(unpackUnorm4x8(sampled.y).rgb, 1.0);
  source = sourceOfPiece;
}
