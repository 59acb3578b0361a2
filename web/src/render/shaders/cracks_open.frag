// Keeps the pixels that are cracks, for the stencil; only what is nearer than what shows in them may be painted there.
uniform highp usampler2D leastDepths;  // bits of floats, 0 where there is no crack
layout(location = 0) out vec4 colour;

void main() {
  uint least = texelFetch(leastDepths, ivec2(gl_FragCoord.xy), 0).r;
  if (least == 0u) discard;
  colour = vec4(0.0);
  gl_FragDepth = uintBitsToFloat(least);
}
