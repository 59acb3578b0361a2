// One instance per line in space: a strip of four vertices, as wide on the window as the line and its soft rim.
layout(location = 0) in vec3 aFrom;
layout(location = 1) in vec3 aTo;
layout(location = 2) in float aPixels;
layout(location = 3) in uint aColour;
uniform mat4 uClipFromLocal;  // of the picture: x, y within -w..w
uniform vec3 uEye;            // local
uniform vec4 uAreaInTarget;   // of picture coordinates: scale, then offset
uniform vec2 uAreaSize;       // pixels
flat out vec4 vColour;
flat out float vHalf;
flat out float vLength;  // pixels; 0: a dot
noperspective out vec2 vAt;  // pixels along the line and across it
out vec3 vFromEye;       // metres
out vec3 vPicture;       // homogeneous place in the picture

void main() {
  vColour = colourOf(aColour);
  vHalf = 0.5 * aPixels;
  vec4 from = uClipFromLocal * vec4(aFrom, 1.0);
  vec4 to = uClipFromLocal * vec4(aTo, 1.0);
  bool dot = aFrom == aTo;
  vec3 fromPlace = aFrom, toPlace = aTo;
  float near = 1e-3 * max(from.w, to.w);  // what is nearer still is cut off
  if (near <= 0.0) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
  if (from.w < near) {
    float t = (near - from.w) / (to.w - from.w);
    from = mix(from, to, t);
    fromPlace = mix(aFrom, aTo, t);
  } else if (to.w < near) {
    float t = (near - to.w) / (from.w - to.w);
    to = mix(to, from, t);
    toPlace = mix(aTo, aFrom, t);
  }
  vec2 fromPixel = 0.5 * uAreaSize * from.xy / from.w;
  vec2 toPixel = 0.5 * uAreaSize * to.xy / to.w;
  vec2 along = toPixel - fromPixel;
  vLength = dot ? 0.0 : length(along);
  along = vLength > 1e-6 ? along / vLength : vec2(1.0, 0.0);
  bool atEnd = (gl_VertexID & 2) != 0;
  float reach = vHalf + 1.0;
  vAt = vec2(atEnd ? vLength + reach : -reach, (gl_VertexID & 1) == 0 ? -reach : reach);
  vec4 end = atEnd ? to : from;
  vec2 off = along * (atEnd ? reach : -reach) + vAt.y * vec2(-along.y, along.x);
  end.xy += off / (0.5 * uAreaSize) * end.w;
  vFromEye = (atEnd ? toPlace : fromPlace) - uEye;
  vPicture = end.xyw;
  gl_Position = vec4(uAreaInTarget.xy * end.xy + uAreaInTarget.zw * end.w, 0.0, end.w);
}
