// A sector of less than half a turn: filled thinly, with a line of one pixel around it.
flat in vec4 vColour;
flat in vec2 vLow, vHigh;
in vec2 vAt;
uniform float uRadius;
uniform float uFill, uLine;  // opacities
out vec4 colour;

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

void main() {
  // Beyond each border and beyond the arc, pixels; y points down, so counter-clockwise is a negative turn.
  float beyond = max(length(vAt) - uRadius, max(cross2(vLow, vAt), -cross2(vHigh, vAt)));
  float fill = uFill * clamp(0.5 - beyond, 0.0, 1.0);
  float line = uLine * clamp(1.0 - abs(beyond), 0.0, 1.0);
  colour = vec4(vColour.rgb, vColour.a * (fill + line * (1.0 - fill)));
}
