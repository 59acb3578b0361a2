// A point of local geometry: base colour times baked light, plus emission (engine/view/local_shading.h).
// Defines, one per effect that is on: TEXTURE, VERTEX_COLOURS, ALPHA_TEST, ALPHA_BLEND, EMISSION, EMISSION_TEXTURE,
// FRESNEL (transmission), SURFACE_LIGHT. CLEAR: blended, so the framebuffer encodes; else the shader does. MARK_MIRROR says
// which mirror the surface is and nothing more.
#include "colour.glsl"

#ifdef MARK_MIRROR
layout(location = 0) out uint mirrorShown;
uniform uint mirrorNumber;
#else
layout(location = 0) out vec4 pixel;
#endif

in vec2 atBarycentric;
in vec2 atBaseUv;
in vec2 atEmissiveUv;
in vec4 atColour;
flat in uvec2 atLight;  // first sample; resolution, bit 16: has a back side
#ifdef FRESNEL
in vec3 atFromEye;
in vec3 atNormal;
uniform float transmission;
#endif

uniform vec4 baseColour;
uniform float exposure;
#ifdef TEXTURE
uniform sampler2D baseTexture;
#endif
#ifdef ALPHA_TEST
uniform float alphaCutoff;
#endif
#ifdef EMISSION
uniform vec3 emission;
#ifdef EMISSION_TEXTURE
uniform sampler2D emissionTexture;
#endif
#endif

#ifdef SURFACE_LIGHT
uniform highp sampler2D lightSamples;

vec3 lightSample(uint first, uint resolution, uint i, uint j) {
  // Rows of i: resolution + 1 samples, then one less each. Written so that nothing is negative at i = 0.
  int at = int(first + i * (resolution + 1u) - (i * (max(i, 1u) - 1u)) / 2u + j);
  return texelFetch(lightSamples, ivec2(at & 2047, at >> 11), 0).rgb;
}

// SurfaceLight::at.
vec3 surfaceLight() {
  uint r = atLight.y & 0xffffu;
  if (r == 0u) return vec3(0.0);
  uint first = atLight.x;
  if (!gl_FrontFacing && (atLight.y & 0x10000u) != 0u) first += (r + 1u) * (r + 2u) / 2u;
  float size = float(r);
  vec2 at = clamp(atBarycentric, 0.0, 1.0) * size;
  float excess = at.x + at.y - size;
  if (excess > 0.0) {
    at.x = max(0.0, at.x - 0.5 * excess);
    at.y = min(max(0.0, at.y - 0.5 * excess), size - at.x);
  }
  uint i = min(uint(at.x), r - 1u);
  uint j = min(uint(at.y), r - 1u);
  if (i + j > r - 1u) {
    if (i > j)
      i = r - 1u - j;
    else
      j = r - 1u - i;
  }
  float fx = at.x - float(i);
  float fy = at.y - float(j);
  if (fx + fy <= 1.0 || i + j + 2u > r)
    return (1.0 - fx - fy) * lightSample(first, r, i, j) + fx * lightSample(first, r, i + 1u, j) +
           fy * lightSample(first, r, i, j + 1u);
  return (fx + fy - 1.0) * lightSample(first, r, i + 1u, j + 1u) + (1.0 - fy) * lightSample(first, r, i + 1u, j) +
         (1.0 - fx) * lightSample(first, r, i, j + 1u);
}
#endif

void main() {
  vec4 base = baseColour;
#ifdef TEXTURE
  base *= texture(baseTexture, atBaseUv);
#endif
#ifdef VERTEX_COLOURS
  base *= atColour;
#endif
#ifdef ALPHA_TEST
  if (base.a < alphaCutoff) discard;
#endif
#ifdef MARK_MIRROR
  mirrorShown = mirrorNumber;
#else
  vec3 radiance = base.rgb;
#ifdef SURFACE_LIGHT
  radiance *= surfaceLight();
#endif
#ifdef EMISSION
  vec3 emitted = emission;
#ifdef EMISSION_TEXTURE
  emitted *= texture(emissionTexture, atEmissiveUv).rgb;
#endif
  radiance += emitted;
#endif
  float alpha = 1.0;
#ifdef ALPHA_BLEND
  alpha = clamp(base.a, 0.0, 1.0);
#endif
#ifdef FRESNEL
  // engine/scene/surface_alpha.h: a film by Schlick's term, and a body that keeps back part of what lies behind.
  vec3 toEye = -normalize(atFromEye);
  float grazing = 1.0 - clamp(abs(dot(normalize(atNormal), toEye)), 0.0, 1.0);
  float film = min(1.0, 0.08 + 0.04 + 0.96 * pow(grazing, 5.0));
  float passing = clamp(transmission * dot(base.rgb, vec3(0.2126, 0.7152, 0.0722)), 0.0, 1.0);
  alpha *= film + (1.0 - film) * (1.0 - passing);
#endif
  vec3 display = toneMap(radiance * exposure);
#ifdef CLEAR
  pixel = vec4(display, alpha);
#else
  pixel = vec4(srgbFromLinear(display), 1.0);
#endif
#endif
}
