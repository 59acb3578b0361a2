// What all meshes of a plan share: from metres beside a tile's origin to the window, and the table of colours.

uniform vec2 uPixelsFromOrigin;  // where the tile's origin lies in the window, pixels, y down
uniform float uPixelsPerMetre;
uniform vec2 uTargetMin, uTargetSize;  // what the viewport shows, window pixels
uniform usampler2D uTable;             // 32-bit words, row after row

vec2 pixelsOf(vec2 metres) { return uPixelsFromOrigin + uPixelsPerMetre * vec2(metres.x, -metres.y); }

vec4 clipOf(vec2 pixels) {
  vec2 share = (pixels - uTargetMin) / uTargetSize;
  return vec4(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y, 0.0, 1.0);
}

uint wordAt(uint n) {
  uint width = uint(textureSize(uTable, 0).x);
  return texelFetch(uTable, ivec2(int(n % width), int(n / width)), 0).r;
}

// Red in the lowest byte.
vec4 colourOf(uint word) {
  return vec4(word & 255u, (word >> 8) & 255u, (word >> 16) & 255u, word >> 24) / 255.0;
}
