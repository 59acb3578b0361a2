// A corner of local geometry. Define FRESNEL passes on what glass needs.
layout(location = 0) in vec3 position;  // relative to the region's origin, metres
layout(location = 1) in vec2 barycentric;
layout(location = 2) in vec2 baseUv;
layout(location = 3) in vec2 emissiveUv;
layout(location = 4) in vec4 colour;
layout(location = 5) in uvec2 light;
layout(location = 6) in vec3 normal;

uniform vec3 originFromEye;
uniform mat3 viewFromWorld;
uniform vec2 clipScale;  // clip.xy = clipScale * view.xy
uniform float nearest;   // metres along the view's axis; nearer surfaces are not drawn

out vec2 atBarycentric;
out vec2 atBaseUv;
out vec2 atEmissiveUv;
out vec4 atColour;
flat out uvec2 atLight;
#ifdef FRESNEL
out vec3 atFromEye;
out vec3 atNormal;
#endif

// The same to the last bit in all programs: what shades is drawn where what told mirrors apart was nearest.
invariant gl_Position;

void main() {
  vec3 fromEye = position + originFromEye;
  vec3 q = viewFromWorld * fromEye;
  gl_Position = vec4(clipScale.x * q.x, -clipScale.y * q.y, nearest, q.z);  // stored: above a half, nearer is larger
  atBarycentric = barycentric;
  atBaseUv = baseUv;
  atEmissiveUv = emissiveUv;
  atColour = colour;
  atLight = light;
#ifdef FRESNEL
  atFromEye = fromEye;
  atNormal = normal;
#endif
}
