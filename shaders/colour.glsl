// Display colours, as engine/image/colour.cpp has them.

vec3 linearFromSrgb(vec3 code) {
  return mix(code / 12.92, pow((code + 0.055) / 1.055, vec3(2.4)), greaterThan(code, vec3(0.04045)));
}

vec3 srgbFromLinear(vec3 value) {
  value = clamp(value, 0.0, 1.0);
  return mix(12.92 * value, 1.055 * pow(value, vec3(1.0 / 2.4)) - 0.055, greaterThan(value, vec3(0.0031308)));
}

// Radiance times exposure -> display-linear in [0,1]: the identity up to 0.76, then a shoulder; highlights lose colour.
vec3 toneMap(vec3 colour) {
  const float kStart = 0.76;
  const float kRoom = 1.0 - kStart;
  const float kDesaturation = 0.15;
  const float kBrightest = 1e9;
  colour = mix(vec3(0.0), min(colour, vec3(kBrightest)), greaterThan(colour, vec3(0.0)));  // NaN and negatives: black
  float peak = max(max(colour.r, colour.g), colour.b);
  if (peak <= kStart) return colour;
  float mapped = 1.0 - kRoom * kRoom / (peak - kStart + kRoom);
  float keep = 1.0 / (kDesaturation * (peak - mapped) + 1.0);
  return clamp(vec3(mapped) + (colour * (mapped / peak) - vec3(mapped)) * keep, 0.0, 1.0);
}
