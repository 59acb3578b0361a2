// A tile of the picture, two triangles of it.
layout(location = 0) in uvec2 place;  // its first pixel
layout(location = 1) in uvec2 patches;  // of the list: first, and one behind the last

uniform vec2 pictureSize;  // pixels
uniform float side;        // of a tile, pixels

flat out uvec2 range;

void main() {
  range = patches;
  vec2 corner = vec2(place) + side * vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 clip = 2.0 * min(corner, pictureSize) / pictureSize - 1.0;
  gl_Position = vec4(clip.x, -clip.y, 0.0, 1.0);
}
