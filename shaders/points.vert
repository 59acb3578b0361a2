// One sample of a capture -> one square point. Defines: SPLAT, CLIP_TO_PART, CLIP_TO_PIECE, LAYERED; for captures with clear samples,
// OPAQUE (draws the others) and CLEAR (draws these, one rank at a time); MIRRORS passes on each sample's mirror; UNORDERED
// leaves samples in the order in which they are stored, for a depth test.
//
// A sample of column direction c, row tangent t and inverse horizontal distance w lies, seen from the eye, along
// q = K M (c + t z + w b), where M turns the world into view axes and K multiplies focal length and picture centre in:
// its image position is (q.x, q.y) / q.z. Per column K M c is constant, per capture K M z and K M b.
//
// List priority: the draw calls go through the columns in order; this shader puts the rows of a column, and the
// samples of a pixel, in theirs by exchanging which sample a vertex number stands for.
#include "capture_depth.glsl"

struct Sample {
  uint inverseDistanceAndRoles;  // a float whose last 8 bits are always zero, and in their place who needs the sample
  uint rowAndColumn;  // row in the low half, column in the high half: the column costs no byte and no search
  uint colour;        // sRGB codes, straight alpha
};

struct Column {
  vec4 inPicture;      // K M c, largest inverse distance drawn
  uvec4 parts;         // samples [x, y) lie above the pivot row, [y, z) below; w: 1 = draw towards the pivot, 0 = away
  vec2 inPlan;         // c
  float footInverse;   // samples of a larger inverse distance lie before the foot of the perpendicular from the eye
  float leastInverse;  // of a clipped piece: farther samples are another's
};

float inverseDistanceOf(Sample s) { return uintBitsToFloat(s.inverseDistanceAndRoles & 0xffffff00u); }

layout(std430, binding = 0) readonly buffer Samples { Sample samples[]; };
layout(std430, binding = 1) readonly buffer RowTangents { float rowTangent[]; };
layout(std430, binding = 2) readonly buffer Columns { Column columns[]; };

uniform vec3 upInPicture;        // K M z
uniform vec3 baselineInPicture;  // K M b
uniform vec2 pictureSize;        // pixels
uniform uint roles;              // of the region that the picture is drawn for: samples for others are left out
uniform float clipMargin;        // pixels that the viewport reaches beyond the picture on each side
uniform float maxSide;           // pixels
#ifdef SPLAT
uniform float footprint;     // pixels: side of the splat at q.z = 1, straight ahead, row tangent 0
uniform float inverseFocal;  // 1/pixels
#endif
#ifdef CLIP_TO_PART
#include "part.glsl"
uniform vec2 baselineInPlan;  // b, horizontal
#endif


flat out vec4 pointColour;
#ifdef MIRRORS
layout(std430, binding = 3) readonly buffer Mirrors { uint mirrorsOfFour[]; };
flat out uint pointMirror;
#endif

const vec4 kOutside = vec4(2.0, 2.0, 2.0, 1.0);

#ifndef UNORDERED
#ifdef LAYERED
// How many samples of the same pixel are stored before a sample (low byte) and behind it; kManyLayers: so many or more.
layout(std430, binding = 5) readonly buffer Layers { uint layersOfTwo[]; };
const uint kManyLayers = 255u;
#endif

// The sample that this vertex stands for.
uint orderedSample(uint vertex, Column column) {
  bool above = vertex < column.parts.y;
  bool descending = above != (column.parts.w != 0u);
  uint first = above ? column.parts.x : column.parts.y;
  uint last = above ? column.parts.y : column.parts.z;
  uint index = descending ? first + last - 1u - vertex : vertex;
#ifdef LAYERED
  uint layers = bitfieldExtract(layersOfTwo[index >> 1], int(index & 1u) * 16, 16);
  if (layers != 0u) {
    uint before = layers & 0xffu, behind = layers >> 8;
    uint begin = index - before, end = index + 1u + behind;
    uint row = samples[index].rowAndColumn;
    while (before == kManyLayers && begin > first && samples[begin - 1u].rowAndColumn == row) --begin;
    while (behind == kManyLayers && end < last && samples[end].rowAndColumn == row) ++end;
    uint beforeFoot = begin;  // these as stored, the others reversed
    while (beforeFoot < end && inverseDistanceOf(samples[beforeFoot]) > column.footInverse) ++beforeFoot;
    uint position = begin + (descending ? end - 1u - index : index - begin);
    index = position < beforeFoot ? position : end - 1u - (position - beforeFoot);
  }
#endif
  return index;
}
#endif

#ifdef CLEAR
uniform uint rank;
uniform uint lastRank;

// How many clear samples of the same pixel lie nearer to the camera.
uint rankAmongClear(uint index, uint first) {
  uint nearer = 0u;
  for (uint i = index; i > first && samples[i - 1u].rowAndColumn == samples[index].rowAndColumn; --i)
    if (samples[i - 1u].colour < 0xff000000u) ++nearer;
  return nearer;
}
#endif


void main() {
  uint own = samples[gl_VertexID].rowAndColumn >> 16;
  Column column = columns[own];
#ifdef UNORDERED
  uint index = uint(gl_VertexID);
#else
  uint index = orderedSample(uint(gl_VertexID), column);
#endif
  Sample s = samples[index];
  float w = inverseDistanceOf(s);
  float t = rowTangent[s.rowAndColumn & 0xffffu];
  vec3 q = column.inPicture.xyz + t * upInPicture + w * baselineInPicture;
  vec4 colour = unpackUnorm4x8(s.colour);
  pointColour = colour;
#ifdef MIRRORS
  pointMirror = bitfieldExtract(mirrorsOfFour[index >> 2], int(index & 3u) * 8, 8);
#endif
  gl_PointSize = 1.0;
  gl_Position = kOutside;
  if ((s.inverseDistanceAndRoles & roles) == 0u || w > column.inPicture.w || !(q.z > 0.0)) return;
#ifdef CLIP_TO_PIECE
  if (w < column.leastInverse) return;
#endif
#ifdef OPAQUE
  if (colour.a < 1.0) return;
#endif
#ifdef CLEAR
  if (colour.a == 1.0 || min(rankAmongClear(index, column.parts.x), lastRank) != rank) return;
#endif
#ifdef CLIP_TO_PART
  if (!inPart(column.inPlan + w * baselineInPlan)) return;
#endif
  vec2 position = q.xy / q.z;
  float side = 1.0;
#ifdef SPLAT
  // A sample stands for pitch * distance across; seen under an angle off the view axis the picture stretches it.
  vec2 off = (position - 0.5 * pictureSize) * inverseFocal;
  float stretch = sqrt((1.0 + t * t) * (1.0 + dot(off, off)));
  side = ceil(clamp(stretch / q.z * footprint, 1.0, maxSide));
  gl_PointSize = side;
#endif
  // The square of whole pixels whose centres lie within side/2 of the position: said exactly, so that the rasteriser's
  // sub-pixel rounding has no say.
  vec2 centre = floor(position + 0.5 - 0.5 * side) + 0.5 * side;
  vec2 clip = 2.0 * (centre + clipMargin) / (pictureSize + 2.0 * clipMargin) - 1.0;
  gl_Position = vec4(clip.x, -clip.y, captureDepth(w / q.z), 1.0);
}
