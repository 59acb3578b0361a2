// Round at its ends, soft at its rim, faded behind the surfaces of the picture.
flat in vec4 vColour;
flat in float vHalf;
flat in float vLength;
noperspective in vec2 vAt;
in vec3 vFromEye;
in vec3 vPicture;
uniform sampler2D uDistances;
uniform float uMeasured;
uniform float uHidden;
out vec4 colour;

float nearer(vec2 place) {
  vec2 share = vec2(0.5 + 0.5 * place.x, 0.5 - 0.5 * place.y);
  vec2 texel = 0.5 / vec2(textureSize(uDistances, 0));
  // The farthest of the pixels around: slanted surfaces do not hide what lies on them.
  float a = texture(uDistances, share + texel).r, b = texture(uDistances, share - texel).r;
  float c = texture(uDistances, share + vec2(texel.x, -texel.y)).r;
  float d = texture(uDistances, share + vec2(-texel.x, texel.y)).r;
  return max(max(a, b), max(c, d));
}

void main() {
  float beyond = max(max(-vAt.x, vAt.x - vLength), 0.0);
  float cover = clamp(vHalf + 0.5 - length(vec2(beyond, vAt.y)), 0.0, 1.0);
  bool hidden = uMeasured > 0.5 && length(vFromEye) > 1.004 * nearer(vPicture.xy / vPicture.z);
  colour = vec4(vColour.rgb, vColour.a * cover * (hidden ? uHidden : 1.0));
}
