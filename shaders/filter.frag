// Each pixel's colour from the samples in it and in the eight pixels around it, by where in their pixels they lie
// (engine/view/pixel_filter.h): in integers, as there. Define LOCAL_MIRRORS: without what local geometry hides beside those of
// its surfaces that are mirrors.

layout(location = 0) out vec4 colour;
uniform sampler2D codes;
uniform usampler2D sources;
uniform usampler2D places;  // bits 0..3 eighths of a pixel to the right of the middle, 4..7 below it, 8..10 how far it spreads
uniform uint hole;
#ifdef LOCAL_MIRRORS
uniform usampler2D mirrors;
uniform sampler2D depths;

const float kLargestBackground = 1e-14;  // as in fill_reduce.frag

bool isLocal(ivec2 at) { return texelFetch(depths, at, 0).r > kLargestBackground; }
bool isLocalMirror(ivec2 at) { return isLocal(at) && texelFetch(mirrors, at, 0).r != 0u; }

bool isHiddenBesideMirror(ivec2 at, ivec2 size) {
  if (!isLocal(at) || isLocalMirror(at)) return false;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      if (isLocalMirror(clamp(at + ivec2(x, y), ivec2(0), size - 1))) return true;
  return false;
}
#endif

// 0..256.
int weightAlong(int place, int pixelsAway, int perEighth) {
  return max(256 - abs(place + 8 * pixelsAway) * perEighth, 0);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 size = textureSize(codes, 0);
  vec4 own = texelFetch(codes, at, 0);
  colour = own;
  if (texelFetch(sources, at, 0).r == hole) return;
  int weights = 0;
  ivec3 squares = ivec3(0);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      ivec2 near = at + ivec2(x, -y);  // y counts downwards
      if (any(lessThan(near, ivec2(0))) || any(greaterThanEqual(near, size))) continue;
      if (texelFetch(sources, near, 0).r == hole) continue;
#ifdef LOCAL_MIRRORS
      if (isHiddenBesideMirror(near, size)) continue;
#endif
      int place = int(texelFetch(places, near, 0).r);
      int perEighth = 32 - 4 * (place >> 8);
      int weight = (weightAlong(bitfieldExtract(place, 0, 4), x, perEighth) *
                    weightAlong(bitfieldExtract(place, 4, 4), y, perEighth)) >> 9;
      ivec3 code = ivec3(texelFetch(codes, near, 0).rgb * 255.0 + 0.5);
      weights += weight;
      squares += weight * code * code;
    }
  if (weights > 0) colour.rgb = floor(sqrt(vec3(squares) / float(weights)) + 0.5) / 255.0;
}
