// Covers the picture. Behind the eye where nothing is to be shown.
uniform mat3 pictureFromRay;
uniform bool shown;

varying vec2 ray;    // on the camera's axes, at z = -1
varying vec3 place;  // in the walk's picture: (u z, v z, z), from its top left

void main() {
  ray = (position.xy + projectionMatrix[2].xy) / vec2(projectionMatrix[0][0], projectionMatrix[1][1]);
  place = pictureFromRay * vec3(ray, -1.0);
  gl_Position = shown ? vec4(position.xy, 0.0, 1.0) : vec4(0.0, 0.0, 0.0, -1.0);
}
