// The patches of one piece that a tile of the picture may show, front to back: engine/view/patch_kernel_body.h, one pixel at a
// time. Defines: CLIP_TO_PART, BLENDED, MIRRORS (what mirrors show is painted later, in the place of their own colour),
// REFLECT (painted where the picture shows the patch's mirror, and nowhere else).
#include "patch_state.glsl"

struct Patch {
  // Direction from the capture's centre of projection to the place on the plane: ahead along the middle of the strip, left, up;
  // and the inverse depth. At pixel (0, 0), and per pixel down and across.
  vec4 start, down, across;
  vec4 places;   // column and row of the strip's middle, from the patch's first; tangent of that row
  uvec4 texels;  // first; columns | rows << 16; mirror; is it blended?
};
layout(std430, binding = 0) readonly buffer Patches { Patch patches[]; };
layout(std430, binding = 1) readonly buffer TilePatches { uint tilePatches[]; };
layout(std430, binding = 2) readonly buffer Colours { uint colours[]; };  // column by column, with a border
layout(std430, binding = 3) readonly buffer Covers { uint covers[]; };    // as engine/view/patch_kernel.h has them

layout(rgba32f, binding = 0) uniform restrict image2D sums;  // of squared codes; w: what comes through what is clear
layout(rgba32ui, binding = 1) uniform restrict uimage2D states;

const uint kBlockWhole = 1u << 24;
const uint kBlockInner = 1u << 25;

flat in uvec2 range;

uniform float pictureHeight;
uniform vec2 perRadian;  // columns, rows
uniform uint roles;      // bits of texels
uniform uint sourceOfPiece;
#ifdef CLIP_TO_PART
uniform vec3 low, high;  // at pixel (0, 0), per pixel across and down: >= 0 inside
uniform bool partIsWide;
#endif

// Rays of a pixel, from its centre.
const vec2 kParts[kPixelParts] =
    vec2[](vec2(0.0625, -0.1875), vec2(-0.0625, 0.1875), vec2(0.3125, 0.0625), vec2(-0.1875, -0.3125),
           vec2(-0.3125, 0.3125), vec2(-0.4375, -0.0625), vec2(0.1875, 0.4375), vec2(0.4375, -0.4375));

vec4 sum;
uvec4 state;

// No patch reaches so far from the middle of its strip and rows, tangent. Pixels of its tiles may.
const float kFarthest = 0.2;

float angle(float tangent) {
  float square = tangent * tangent;
  return tangent * (1.0 - square * (1.0 / 3.0 - square * 0.2));
}

uvec2 sizeOf(Patch patch_) { return uvec2(patch_.texels.y & 0xffffu, patch_.texels.y >> 16); }

// Parts of the pixel that the patch covers, by the part of its texel that each ray meets.
uint partsOf(Patch patch_, vec2 place, vec2 across, vec2 down) {
  uvec2 size = sizeOf(patch_);
  vec2 last = 4.0 * vec2(size) + 7.0;  // from the border's first part on; beyond, the border covers nothing
  uint parts = 0u;
  for (int part = 0; part < kPixelParts; ++part) {
    vec2 place4 = 4.0 * place + (4.0 * kParts[part].x * across + 4.0 * kParts[part].y * down);
    uvec2 at = uvec2(clamp(place4 + 4.0, vec2(0.0), last));
    uint cover = covers[patch_.texels.x + (at.x >> 2) * (size.y + 2u) + (at.y >> 2)];
    if ((cover & roles) != 0u) parts |= (cover >> ((at.y & 3u) * 4u + (at.x & 3u)) & 1u) << part;
  }
  return parts;
}

// The two texels by two around a place.
struct Block {
  uint first;  // the upper left one
  vec2 share;  // of the place, from that texel's middle
};

Block blockAt(Patch patch_, vec2 place) {
  uvec2 size = sizeOf(patch_);
  vec2 at = clamp(place - 0.5, -1e6, 1e6);
  vec2 first = clamp(floor(at), vec2(-1.0), vec2(size) - 1.0);
  return Block(patch_.texels.x + uint(first.x + 1.0) * (size.y + 2u) + uint(first.y + 1.0), at - first);
}

vec4 colourOf(uint texel) { return unpackUnorm4x8(colours[texel]) * 255.0; }

// Bilinear between the block's texels.
vec4 colourAt(Patch patch_, Block block) {
  vec2 share = clamp(block.share, 0.0, 1.0);
  uint next = block.first + sizeOf(patch_).y + 2u;
  return mix(mix(colourOf(block.first), colourOf(block.first + 1u), share.y), mix(colourOf(next), colourOf(next + 1u), share.y),
             share.x);
}

void blend(Patch patch_, Block block, uint open, uint parts, float inverseDepth) {
  vec4 colour = colourAt(patch_, block);
  uint mirror = patch_.texels.z & 0xffu;
  float number = float(bitCount(parts));
  float weight = sum.w * number;
  bool closes = true;
#ifdef BLENDED
  if (patch_.texels.w != 0u) {
    closes = false;
    float alpha = colour.a / 255.0;
    weight *= alpha;
    sum.w *= 1.0 - alpha * number / float(max(bitCount(open), 1));
  }
#endif
#if defined(MIRRORS) && !defined(REFLECT)
  bool waits = mirror != 0u;
#else
  const bool waits = false;
#endif
  if (!waits) sum.rgb += colour.rgb * colour.rgb * weight;
  if (!closes) return;
#ifdef REFLECT
  state.y -= parts;
#else
  state.x -= parts;
  if (waits) state.y = (mirrorPartsOf(state) | parts) | mirror << 16;
  if (number > float(state.z & 0xffu)) {
    state.z = uint(number) | sourceOfPiece << 8;
    state.w = floatBitsToUint(inverseDepth);
  }
#endif
}

void paint(Patch patch_, vec2 pixel) {
#ifdef REFLECT
  uint open = state.y >> 16 == (patch_.texels.z & 0xffu) ? mirrorPartsOf(state) : 0u;
#else
  uint open = state.x;
#endif
  if (open == 0u) return;
  vec4 at = patch_.start + pixel.x * patch_.across + pixel.y * patch_.down;
  if (!(at.x > 0.0 && at.w >= 0.0)) return;
  float slope = at.y / at.x, stretch = sqrt(1.0 + slope * slope), distance = at.x * stretch;
  vec2 raised = vec2(distance + patch_.places.z * at.z, at.z - patch_.places.z * distance);  // turned down by the middle row
  if (abs(slope) > kFarthest || abs(raised.y) > kFarthest * raised.x) return;
  vec2 place = patch_.places.xy + perRadian * vec2(angle(slope), -angle(raised.y / raised.x));
  vec2 perStep = perRadian / vec2(at.x * stretch * stretch, distance * distance + at.z * at.z);
  vec4 a = patch_.across, d = patch_.down;
  vec2 across = perStep * vec2(a.y - slope * a.x, at.z * ((a.x + slope * a.y) / stretch) - a.z * distance);
  vec2 down = perStep * vec2(d.y - slope * d.x, at.z * ((d.x + slope * d.y) / stretch) - d.z * distance);
  vec2 most = abs(across) + abs(down);
  bool within = most.x <= 1.0 && most.y <= 1.0;  // all rays meet the block
  Block block = blockAt(patch_, place);
  uint cover = covers[block.first];
  uint parts = open;
  if ((cover & roles) == 0u || (cover & (within ? kBlockWhole | kBlockInner : kBlockInner)) == 0u)
    parts = partsOf(patch_, place, across, down) & open;
  if (parts != 0u) blend(patch_, block, open, parts, at.w);
}

void main() {
  ivec2 own = ivec2(gl_FragCoord.xy);
  vec2 pixel = vec2(float(own.x), pictureHeight - 1.0 - float(own.y));
#ifdef CLIP_TO_PART
  bool fromLow = low.x + pixel.x * low.y + pixel.y * low.z >= 0.0;
  bool toHigh = high.x + pixel.x * high.y + pixel.y * high.z > 0.0;
  if (!(partIsWide ? fromLow || toHigh : fromLow && toHigh)) return;
#endif
  state = imageLoad(states, own);
#ifdef REFLECT
  if (mirrorPartsOf(state) == 0u) return;
#else
  if (state.x == 0u) return;
#endif
  sum = imageLoad(sums, own);
  for (uint i = range.x; i < range.y; ++i) {
    paint(patches[tilePatches[i]], pixel);
#ifdef REFLECT
    if (mirrorPartsOf(state) == 0u) break;
#else
    if (state.x == 0u) break;
#endif
  }
  imageStore(sums, own, sum);
  imageStore(states, own, state);
}
