// One triangle that covers the picture, at the distance of the sky.
#include "depth.glsl"

void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 2.0 * kSky - 1.0, 1.0);
}
