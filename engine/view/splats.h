#pragma once
/// From samples of one capture column to squares on the picture.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/view/canvas.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// A square of whole pixels.
struct Splat {
  int x = 0, y = 0;         ///< of its top left pixel
  int side = 1;             ///< pixels
  std::uint32_t index = 0;  ///< of its sample in the column
  CanvasPixel pixel = 0;    ///< what its pixels become, of the colour without its alpha
};

enum class PartTest {
  none,
  within,   ///< part at most half a turn wide: left of its low border and right of its high one
  without,  ///< wider: not within the rest
};

/// Everything that is constant over a column. Directions are in view axes with focal length and picture
/// centre multiplied in: sample (t, w) has q = a + t * z + w * b, image position u = q.x / q.z, v = q.y /
/// q.z, and depth q.z / w along the view axis.
template <class T>
struct ProjectColumn {
  T a[3], z[3], b[3];
  T maxInverseDistance;  ///< nearer samples are dropped
  T minInverseDistance;  ///< farther ones too; 0: none
  T footprint;           ///< splat side at q.z = 1, straight ahead, row tangent 0; 0: points
  T maxSide;
  std::uint32_t roles;  ///< samples that none of these needs are dropped
  T centreX, centreY;   ///< picture centre, pixels
  T inverseFocal;       ///< 1/pixels
  PixelRect canvas;     ///< splats that miss it are dropped
  std::uint32_t slot;   ///< of the canvas, 1..255
  PartTest partTest;
  T direction[2];     ///< column direction in plan
  T baseline[2];      ///< b in plan, metres
  T low[2], high[2];  ///< border directions of the part
};

/// The samples of a column.
template <class T>
struct SampleColumn {
  const T* rowTangent = nullptr;  ///< the capture's table
  std::span<const PackedSample> samples;
  const Rgba8* colour = nullptr;  ///< of each
};

/// The splats of the column that touch the canvas, in the order of its samples; they lie in `memory`. For
/// floats, and for doubles from constants and tangents that were never rounded to floats, as a reference.
template <class T>
std::span<const Splat> projectSamples(const ProjectColumn<T>& column, const SampleColumn<T>& samples,
                                      std::vector<Splat>& memory);

}  // namespace acentric
