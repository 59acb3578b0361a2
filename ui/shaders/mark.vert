// One instance per mark: a square on the window around its place.
layout(location = 0) in vec2 aPlace;
layout(location = 1) in vec2 aSector;  // low azimuth and width, radians, counter-clockwise in the world
layout(location = 2) in uint aMark;
uniform float uRadius;  // pixels
uniform float uOpacity;
flat out vec4 vColour;
flat out vec2 vLow, vHigh;  // the sector's borders, on the window
out vec2 vAt;               // pixels from the place, y down

void main() {
  vColour = colourOf(wordAt(aMark));
  vColour.a *= uOpacity;
  vLow = vec2(cos(aSector.x), -sin(aSector.x));
  vHigh = vec2(cos(aSector.x + aSector.y), -sin(aSector.x + aSector.y));
  vec2 corner = vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, (gl_VertexID & 2) == 0 ? -1.0 : 1.0);
  vAt = corner * (uRadius + 1.0);
  gl_Position = clipOf(pixelsOf(aPlace) + vAt);
}
