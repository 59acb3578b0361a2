// Faded behind the surfaces of the picture.
flat in vec4 vColour;
in vec3 vFromEye;
in vec3 vPicture;
uniform sampler2D uDistances;
uniform float uMeasured;
uniform float uHidden;
out vec4 colour;

void main() {
  vec2 place = vPicture.xy / vPicture.z;
  vec2 share = vec2(0.5 + 0.5 * place.x, 0.5 - 0.5 * place.y);
  bool hidden = uMeasured > 0.5 && length(vFromEye) > 1.004 * texture(uDistances, share).r;
  colour = vec4(vColour.rgb, vColour.a * (hidden ? uHidden : 1.0));
}
