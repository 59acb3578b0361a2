// Keeps the pixels that are cracks, for the stencil.

uniform sampler2D leastDepths;

void main() {
  if (texelFetch(leastDepths, ivec2(gl_FragCoord.xy), 0).r == 0.0) discard;
}
