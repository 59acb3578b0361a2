// One instance per triangle in space.
layout(location = 0) in vec3 aFirst;
layout(location = 1) in vec3 aSecond;
layout(location = 2) in vec3 aThird;
layout(location = 3) in uint aColour;
uniform mat4 uClipFromLocal;
uniform vec3 uEye;
uniform vec4 uAreaInTarget;
flat out vec4 vColour;
out vec3 vFromEye;
out vec3 vPicture;

void main() {
  vec3 place = gl_VertexID == 0 ? aFirst : gl_VertexID == 1 ? aSecond : aThird;
  vec4 at = uClipFromLocal * vec4(place, 1.0);
  vColour = colourOf(aColour);
  vFromEye = place - uEye;
  vPicture = at.xyw;
  gl_Position = vec4(uAreaInTarget.xy * at.xy + uAreaInTarget.zw * at.w, 0.0, at.w);
}
