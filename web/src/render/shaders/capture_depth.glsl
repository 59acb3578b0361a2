// One depth buffer for samples and for local geometry, which always lies before them. Stored is: 0 a hole; then the sky;
// up to a half samples, s / (s + kScale) of inverse depth s (1/m) along the view's axis; above it local geometry, by n / z.
const float kScale = 0.25;
const float kSkyDepth = 4e-7;

// Of what captures show, by its inverse depth along the view axis (1/m).
float captureDepth(float inverse) { return inverse > 0.0 ? max(0.5 * inverse / (inverse + kScale), 2.0 * kSkyDepth) : kSkyDepth; }

// Of local geometry that is `nearest` away and farther.
float inverseOfDepth(float depth, float nearest) {
  if (depth > 0.5) return (2.0 * depth - 1.0) / nearest;
  if (depth < 1.5 * kSkyDepth) return 0.0;
  return kScale * 2.0 * depth / (1.0 - 2.0 * depth);
}
