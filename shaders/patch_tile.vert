// A tile of the picture, two triangles of it.

struct Tile {
  uint place;       // x | y << 16 of its first pixel
  uint first, end;  // of its patches
};
layout(std430, binding = 5) readonly buffer Tiles { Tile tiles[]; };

uniform vec2 pictureSize;  // pixels
uniform float side;        // of a tile, pixels

flat out uvec2 range;

void main() {
  Tile tile = tiles[gl_InstanceID];
  range = uvec2(tile.first, tile.end);
  vec2 corner = vec2(tile.place & 0xffffu, tile.place >> 16) + side * vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 clip = 2.0 * min(corner, pictureSize) / pictureSize - 1.0;
  gl_Position = vec4(clip.x, -clip.y, 0.0, 1.0);
}
