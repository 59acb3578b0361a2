// Inverse depths of captures are scaled down so far that local geometry (local.vert), whose depth is kNearest / z, always
// lies in front of them, and both share one floating-point depth buffer. Sky is just above the cleared value, a hole.
const float kBackgroundDepthScale = 1e-20;
const float kSkyDepth = 1e-30;

// Of what captures show, by its inverse depth along the view axis (1/m).
float captureDepth(float inverse) { return max(kBackgroundDepthScale * inverse, kSkyDepth); }
