// How far surfaces reach beyond the samples of a patch (engine/view/capture_mesh.h).
const int kLowColumn = 0, kHighColumn = 2, kTopRow = 4, kBottomRow = 6;
uniform vec2 fringes;  // samples: the least, and a step

float fringe(uint steps, int side) { return fringes.x + fringes.y * float(bitfieldExtract(steps, side, 2)); }
