// One sample of a capture -> one square point (shaders/points.vert, for a depth test). Defines: OPAQUE (leaves out blended
// samples) or CLEAR (draws these, one rank at a time), of captures that have some; CLIP_TO_PIECE (farther
// samples are another piece's); MIRRORS passes on each sample's mirror.
//
// A sample of column direction c, row tangent t and inverse horizontal distance w lies, seen from the eye, along
// q = K M (c + t z + w b): its image position is (q.x, q.y) / q.z.
#include "depth.glsl"

layout(location = 0) in uvec3 word;  // inverse distance with the roles in its last byte; row, and column above it; RGBA8
#ifdef MIRRORS
layout(location = 1) in uint mirror;
flat out uint pointMirror;
#endif
#ifdef CLEAR
layout(location = 2) in uint rank;
uniform uint drawnRank;
#endif

uniform highp sampler2D columns;   // two texels each: K M c, largest inverse distance; least
uniform highp sampler2D tangents;  // of rows
uniform vec3 upInPicture;          // K M z
uniform vec3 baselineInPicture;    // K M b
uniform vec2 pictureSize;          // pixels
uniform uint roles;                // samples that none of these needs are left out
uniform float clipMargin;          // pixels that the viewport reaches beyond the picture on each side
uniform float maxSide;             // pixels
uniform float footprint;           // pixels: side of the splat at q.z = 1, straight ahead, row tangent 0
uniform float inverseFocal;        // 1/pixels

flat out vec4 pointColour;

ivec2 texelAt(int i) { return ivec2(i & 2047, i >> 11); }

void main() {
  int own = 2 * int(word.y >> 16);
  vec4 column = texelFetch(columns, texelAt(own), 0);
  float t = texelFetch(tangents, texelAt(int(word.y & 0xffffu)), 0).r;
  float w = uintBitsToFloat(word.x & 0xffffff00u);
  vec3 q = column.xyz + t * upInPicture + w * baselineInPicture;
  pointColour = vec4(word.z & 0xffu, (word.z >> 8) & 0xffu, (word.z >> 16) & 0xffu, word.z >> 24) / 255.0;
#ifdef MIRRORS
  pointMirror = mirror;
#endif
  gl_PointSize = 1.0;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if ((word.x & roles) == 0u || w > column.w || !(q.z > 0.0)) return;
#ifdef CLIP_TO_PIECE
  if (w < texelFetch(columns, texelAt(own + 1), 0).r) return;
#endif
#ifdef OPAQUE
  if (word.z < 0xff000000u) return;
#endif
#ifdef CLEAR
  if (word.z >= 0xff000000u || rank != drawnRank) return;
#endif
  vec2 position = q.xy / q.z;
  // A sample stands for pitch * distance across; seen under an angle off the view axis the picture stretches it.
  vec2 off = (position - 0.5 * pictureSize) * inverseFocal;
  float stretch = sqrt((1.0 + t * t) * (1.0 + dot(off, off)));
  float side = ceil(clamp(stretch / q.z * footprint, 1.0, maxSide));
  gl_PointSize = side;
  // The square of whole pixels whose centres lie within side/2 of the position, said exactly.
  vec2 centre = floor(position + 0.5 - 0.5 * side) + 0.5 * side;
  vec2 clip = 2.0 * (centre + clipMargin) / (pictureSize + 2.0 * clipMargin) - 1.0;
  gl_Position = vec4(clip.x, -clip.y, 2.0 * depthOfSample(w / q.z) - 1.0, 1.0);
}
