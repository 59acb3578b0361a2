layout(location = 0) in vec2 aCorner;
layout(location = 1) in uint aPolygon;
flat out vec4 vColour;

void main() {
  vColour = colourOf(wordAt(3u * aPolygon));
  // What has no colour need not be painted.
  gl_Position = vColour.a > 0.0 ? clipOf(pixelsOf(aCorner)) : vec4(0.0, 0.0, 2.0, 1.0);
}
