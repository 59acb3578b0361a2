// The walk's picture and its depths, as another camera at the same eye has them. Before it are capture_depth.glsl and
// colour.glsl.
uniform highp sampler2D picture;  // sRGB codes, alpha 0 where nothing is
uniform highp sampler2D depths;
uniform float nearest;
uniform float metresPerUnit;
uniform mat4 projectionMatrix;
#if defined(USE_LOGARITHMIC_DEPTH_BUFFER) || defined(USE_LOGDEPTHBUF)
uniform float logDepthBufFC;
#endif

varying vec2 ray;
varying vec3 place;

// Bilinear between the texels that show something.
vec3 codesAt(vec2 at, ivec2 last) {
  vec2 from = at - 0.5;
  ivec2 first = ivec2(floor(from));
  vec2 share = from - floor(from);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 texel = ivec2(i & 1, i >> 1);
    vec2 weights = mix(1.0 - share, share, vec2(texel));
    vec4 code = texelFetch(picture, clamp(first + texel, ivec2(0), last), 0);
    sum += weights.x * weights.y * code.a * vec4(code.rgb, 1.0);
  }
  return sum.rgb / sum.a;
}

// `inverse`: of the depth along the camera's axis.
float depthOf(float inverse) {
#if defined(USE_LOGARITHMIC_DEPTH_BUFFER) || defined(USE_LOGDEPTHBUF)
  return inverse > 0.0 ? log2(1.0 + 1.0 / inverse) * logDepthBufFC * 0.5 : 1.0;
#else
  float depth = (projectionMatrix * vec4(ray, -1.0, inverse)).z;
#ifdef USE_REVERSED_DEPTH_BUFFER
  return depth;
#else
  return 0.5 * depth + 0.5;
#endif
#endif
}

void main() {
  ivec2 size = textureSize(picture, 0);
  vec2 at = place.xy / place.z;
  at.y = float(size.y) - at.y;
  ivec2 own = clamp(ivec2(floor(at)), ivec2(0), size - 1);
  if (texelFetch(picture, own, 0).a == 0.0) discard;
  gl_FragColor = vec4(linearFromSrgb(codesAt(at, size - 1)), 1.0);
  gl_FragDepth = clamp(depthOf(inverseOfDepth(texelFetch(depths, own, 0).r, nearest) * place.z * metresPerUnit), 0.0, 1.0);
#include <colorspace_fragment>
}
