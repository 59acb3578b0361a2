// A patch of a capture's mesh (engine/view/capture_mesh.h) -> two triangles. Defines: see mesh.frag.
//
// Of column direction c, row tangent t and inverse distance w a corner is seen along q = K M (c + t z + w b), as a sample is
// (points.vert). q.z stays undivided: then the card's interpolation is that of the plane itself.
#include "capture_depth.glsl"
#include "fringe.glsl"

struct Patch {
  uint columnAndRow;  // the first of its samples; row in the high half
  uint sizesAndFringes;  // bytes: columns, rows, fringes (two bits a MeshSide), roles
  uint firstTexel;
  float inverseDistance[4];  // low and high column of the top, then of the bottom
};

layout(std430, binding = 0) readonly buffer Shown { uint shown[]; };  // numbers of the patches that the piece needs
layout(std430, binding = 1) readonly buffer Patches { Patch patches[]; };
layout(std430, binding = 2) readonly buffer Borders { float borders[]; };  // directions of columns, then tangents of rows

uniform vec3 eastInPicture;  // K M x
uniform vec3 northInPicture;
uniform vec3 upInPicture;
uniform vec3 baselineInPicture;  // K M b
uniform vec2 pictureSize;        // pixels
uniform uint firstTangent;       // among the borders
uniform vec2 pitches;            // of columns and rows, radians

smooth out vec3 local;  // c along the middle of the patch and to its left, t
flat out float middleTangent;
flat out uvec4 block;  // first texel, columns, rows, first column

const int kCorners[6] = int[6](0, 1, 2, 2, 1, 3);

vec2 directionAt(uint column) { return vec2(borders[2u * column], borders[2u * column + 1u]); }
float tangentAt(uint row) { return borders[firstTangent + row]; }

void main() {
  Patch p = patches[shown[gl_VertexID / 6]];
  int corner = kCorners[gl_VertexID % 6];
  uint column = p.columnAndRow & 0xffffu, row = p.columnAndRow >> 16;
  uint columns = p.sizesAndFringes & 0xffu, rows = bitfieldExtract(p.sizesAndFringes, 8, 8);
  uint steps = bitfieldExtract(p.sizesAndFringes, 16, 8);
  vec2 low = directionAt(column), high = directionAt(column + columns);
  float top = tangentAt(row), bottom = tangentAt(row + rows);

  bool isHigh = (corner & 1) != 0, isBottom = corner >= 2;
  vec2 c = isHigh ? high : low;
  c += (isHigh ? fringe(steps, kHighColumn) : -fringe(steps, kLowColumn)) * pitches.x * vec2(-c.y, c.x);
  float t = isBottom ? bottom : top;
  t += (isBottom ? -fringe(steps, kBottomRow) : fringe(steps, kTopRow)) * pitches.y * (1.0 + t * t);
  float w = p.inverseDistance[corner];

  vec2 middle = normalize(low + high);
  local = vec3(dot(middle, c), middle.x * c.y - middle.y * c.x, t);
  vec2 middleRow = normalize(vec2(1.0, top)) + normalize(vec2(1.0, bottom));
  middleTangent = middleRow.y / middleRow.x;
  block = uvec4(p.firstTexel, columns, rows, column);

  vec3 q = c.x * eastInPicture + c.y * northInPicture + t * upInPicture + w * baselineInPicture;
  vec2 clip = 2.0 * q.xy / pictureSize - q.z;
  gl_Position = vec4(clip.x, -clip.y, kBackgroundDepthScale * w, q.z);
}
