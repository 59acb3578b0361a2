// One instance per edge: a strip of four vertices, as wide on the window as the line and its soft rim.
layout(location = 0) in vec2 aFrom;
layout(location = 1) in vec2 aTo;
layout(location = 2) in uint aPolygon;
uniform float uOpacity;
flat out vec4 vColour;
flat out float vHalf;
out float vAcross;  // pixels from the middle of the line

void main() {
  vColour = colourOf(wordAt(3u * aPolygon + 1u));
  vColour.a *= uOpacity;
  vHalf = 0.5 * uintBitsToFloat(wordAt(3u * aPolygon + 2u));
  vec2 from = pixelsOf(aFrom);
  vec2 to = pixelsOf(aTo);
  vec2 along = to - from;
  float size = length(along);
  along = size > 0.0 ? along / size : vec2(1.0, 0.0);
  float reach = vHalf + 0.5;
  vAcross = (gl_VertexID & 1) == 0 ? -reach : reach;
  vec2 end = (gl_VertexID & 2) == 0 ? from - vHalf * along : to + vHalf * along;
  gl_Position =
      vColour.a > 0.0 ? clipOf(end + vAcross * vec2(-along.y, along.x)) : vec4(0.0, 0.0, 2.0, 1.0);
}
