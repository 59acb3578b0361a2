// One patch on one pixel, as engine/view/patch_kernel_body.h: `paint`. Before it are included patch_state.glsl and two functions:
//   uint coverAt(uint texel)  the word that engine/view/patch_kernel.h tells of
//   vec4 codesAt(uint texel)  sRGB codes and alpha, 0 to 255
// Defines: MIRRORS (what mirrors show is painted later, in the place of their own colour), REFLECT (painted where the picture
// shows the patch's mirror, and nowhere else).

// From the words of engine/view/patch_tables.h.
struct Patch {
  // Direction from the capture's centre of projection to the place on the plane: ahead along the middle of the strip, left, up;
  // and the inverse depth. At pixel (0, 0), and per pixel down and across.
  vec4 start, down, across;
  vec2 places;  // column and row of the strip's middle, from the patch's first
  float middleTangent;  // of that row
  uint firstTexel;      // of its border; texels lie column by column
  uvec2 size;           // without the border
  uint mirror;
  bool blended;
  bool settled;  // told as densest
};
struct Piece {
  vec2 perRadian;  // columns, rows
  uint roles;      // bits of texels
  uint source;
  vec3 low, high;  // at pixel (0, 0), per pixel across and down: >= 0 inside
  uint part;       // 0 = all of the view, 1 = inside both borders, 2 = inside one of them
};

Patch patchOf(uvec4 start, uvec4 down, uvec4 across, uvec4 places, uvec4 looks) {
  return Patch(uintBitsToFloat(start), uintBitsToFloat(down), uintBitsToFloat(across), uintBitsToFloat(places.xy),
               uintBitsToFloat(places.z), places.w, uvec2(looks.x & 0xffffu, looks.x >> 16), looks.y & 0xffu, (looks.y & 256u) != 0u,
               (looks.y & 512u) != 0u);
}
Piece pieceOf(uvec4 first, uvec4 low, uvec4 high) {
  return Piece(uintBitsToFloat(first.xy), first.z, first.w, uintBitsToFloat(low.xyz), uintBitsToFloat(high.xyz), low.w);
}

// Is the pixel in the part of the view that the piece is painted in?
bool holds(Piece piece, vec2 pixel) {
  bool fromLow = piece.low.x + pixel.x * piece.low.y + pixel.y * piece.low.z >= 0.0;
  bool toHigh = piece.high.x + pixel.x * piece.high.y + pixel.y * piece.high.z > 0.0;
  return piece.part == 0u || (piece.part == 2u ? fromLow || toHigh : fromLow && toHigh);
}

const uint kBlockWhole = 1u << 24;
const uint kBlockInner = 1u << 25;

// Rays of a pixel, from its centre.
const vec2 kParts[kPixelParts] =
    vec2[](vec2(0.0625, -0.1875), vec2(-0.0625, 0.1875), vec2(0.3125, 0.0625), vec2(-0.1875, -0.3125),
           vec2(-0.3125, 0.3125), vec2(-0.4375, -0.0625), vec2(0.1875, 0.4375), vec2(0.4375, -0.4375));

// Of the pixel.
vec4 sum;
uvec4 state;
Piece piece;  // that is being painted

// Is there nothing left to paint?
bool isClosed() {
#ifdef REFLECT
  return mirrorPartsOf(state) == 0u;
#else
  return state.x == 0u;
#endif
}

// No patch reaches so far from the middle of its strip and rows, tangent. Pixels of its tiles may.
const float kFarthest = 0.2;

float angle(float tangent) {
  float square = tangent * tangent;
  return tangent * (1.0 - square * (1.0 / 3.0 - square * 0.2));
}

// Parts of the pixel that the patch covers, by the part of its texel that each ray meets.
uint partsOf(Patch patch_, vec2 place, vec2 across, vec2 down) {
  vec2 last = 4.0 * vec2(patch_.size) + 7.0;  // from the border's first part on; beyond, the border covers nothing
  uint parts = 0u;
  for (int part = 0; part < kPixelParts; ++part) {
    vec2 place4 = 4.0 * place + (4.0 * kParts[part].x * across + 4.0 * kParts[part].y * down);
    uvec2 at = uvec2(clamp(place4 + 4.0, vec2(0.0), last));
    uint cover = coverAt(patch_.firstTexel + (at.x >> 2) * (patch_.size.y + 2u) + (at.y >> 2));
    if ((cover & piece.roles) != 0u) parts |= (cover >> ((at.y & 3u) * 4u + (at.x & 3u)) & 1u) << part;
  }
  return parts;
}

// The two texels by two around a place.
struct Block {
  uint first;  // the upper left one
  vec2 share;  // of the place, from that texel's middle
};

Block blockAt(Patch patch_, vec2 place) {
  vec2 at = clamp(place - 0.5, -1e6, 1e6);
  vec2 first = clamp(floor(at), vec2(-1.0), vec2(patch_.size) - 1.0);
  return Block(patch_.firstTexel + uint(first.x + 1.0) * (patch_.size.y + 2u) + uint(first.y + 1.0), at - first);
}

// Bilinear between the block's texels.
vec4 colourAt(Patch patch_, Block block) {
  vec2 share = clamp(block.share, 0.0, 1.0);
  uint next = block.first + patch_.size.y + 2u;
  return mix(mix(codesAt(block.first), codesAt(block.first + 1u), share.y), mix(codesAt(next), codesAt(next + 1u), share.y),
             share.x);
}

// How densely samples lie on the picture (engine/view/patch_kernel.h: densityOf).
uint densityAt(vec2 across, vec2 down) {
  float area = across.x * down.y - down.x * across.y;
  float squares = (across.x * across.x + across.y * across.y) + (down.x * down.x + down.y * down.y);
  return uint(min(abs(area) / sqrt(max(squares, 1e-20)), 1.0) * float(kMostDensity));
}

void blend(Patch patch_, Block block, uint open, uint parts, float inverseDepth, vec2 across, vec2 down) {
  vec4 colour = colourAt(patch_, block);
  float number = float(partsIn(parts));
  float weight = sum.w * number;
  bool closes = true;
  if (patch_.blended) {
    closes = false;
    float alpha = colour.a / 255.0;
    weight *= alpha;
    sum.w *= 1.0 - alpha * number / float(max(partsIn(open), 1));
  }
#if defined(MIRRORS) && !defined(REFLECT)
  bool waits = patch_.mirror != 0u;
#else
  const bool waits = false;
#endif
  if (!waits) sum.rgb += colour.rgb * colour.rgb * weight;
  if (!closes) return;
#ifdef REFLECT
  state.y -= parts;
#else
  state.x -= parts;
  if (waits && state.y == kSecondLook)
    sum.w = 0.0;
  else if (waits)
    state.y = (mirrorPartsOf(state) | parts) | patch_.mirror << 16;
  if (number > float(numberOf(state))) {
    state.z = paintedOf(uint(number), piece.source, patch_.settled ? kMostDensity : densityAt(across, down));
    state.w = floatBitsToUint(inverseDepth);
  }
#endif
}

void paint(Patch patch_, vec2 pixel) {
#ifdef REFLECT
  uint open = state.y >> 16 == patch_.mirror ? mirrorPartsOf(state) : 0u;
#else
  uint open = state.x;
#endif
  if (open == 0u) return;
  vec4 at = patch_.start + pixel.x * patch_.across + pixel.y * patch_.down;
  if (!(at.x > 0.0 && at.w >= 0.0)) return;
  float slope = at.y / at.x, stretch = sqrt(1.0 + slope * slope), distance = at.x * stretch;
  // Turned down by the middle row.
  vec2 raised = vec2(distance + patch_.middleTangent * at.z, at.z - patch_.middleTangent * distance);
  if (abs(slope) > kFarthest || abs(raised.y) > kFarthest * raised.x) return;
  vec2 place = patch_.places + piece.perRadian * vec2(angle(slope), -angle(raised.y / raised.x));
  vec2 perStep = piece.perRadian / vec2(at.x * stretch * stretch, distance * distance + at.z * at.z);
  vec4 a = patch_.across, d = patch_.down;
  vec2 across = perStep * vec2(a.y - slope * a.x, at.z * ((a.x + slope * a.y) / stretch) - a.z * distance);
  vec2 down = perStep * vec2(d.y - slope * d.x, at.z * ((d.x + slope * d.y) / stretch) - d.z * distance);
  vec2 most = abs(across) + abs(down);
  bool within = most.x <= 1.0 && most.y <= 1.0;  // all rays meet the block
  Block block = blockAt(patch_, place);
  uint cover = coverAt(block.first);
  uint parts = open;
  if ((cover & piece.roles) == 0u || (cover & (within ? kBlockWhole | kBlockInner : kBlockInner)) == 0u)
    parts = partsOf(patch_, place, across, down) & open;
  if (parts != 0u) blend(patch_, block, open, parts, at.w, across, down);
}
