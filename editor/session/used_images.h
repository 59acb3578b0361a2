#pragma once
/// The images that the walk's picture is painted from, in painting order. Pure.

#include <optional>
#include <string>
#include <vector>

#include "engine/measure/source_colours.h"
#include "engine/pipeline/pipeline.h"

namespace acentric::editor {

enum class ImageState { shown, coarse, missing };

struct UsedImage {
  int camera = 0;  ///< into Layout::cameras
  SourceRole role = SourceRole::ownCover;
  ImageState state = ImageState::shown;  ///< coarse: a preview or draft stands in for it
  double lowDegrees = 0;                 ///< its sector begins here, counter-clockwise from east, 0..360
  double widthDegrees = 0;
  std::optional<double> share;  ///< of the picture's pixels, where the frame says who painted them
};

/// Back to front, what the view needs and is not there too. `frame`: of this view, or null.
std::vector<UsedImage> usedImages(const LoadedWalk& loaded, const PerspectiveView& view,
                                  const ViewSettings& settings, const Frame* frame);
/// "camera 12   90–135°   other hand   3.1 %"
std::string describe(const UsedImage& image);

/// The picture's pixels that a camera painted stand out: clear there, a dark veil elsewhere. Straight alpha.
ColourImage spotlight(const Frame& frame, int camera);

}  // namespace acentric::editor
