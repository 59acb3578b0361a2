// A disc with a rim of one pixel that sets it off from what lies below.
flat in vec4 vColour;
in vec2 vAt;
uniform float uRadius;
uniform vec4 uRim;
out vec4 colour;

void main() {
  float distance = length(vAt);
  float inner = clamp(uRadius - 0.5 - distance, 0.0, 1.0);
  float outer = clamp(uRadius + 0.5 - distance, 0.0, 1.0);
  float rim = uRim.a * vColour.a;
  vec3 shade = mix(uRim.rgb, vColour.rgb, inner);
  colour = vec4(shade, outer * mix(rim, vColour.a, inner));
}
