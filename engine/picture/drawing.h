#pragma once
/// What is drawn with Cairo, as a file or as pixels.

#include <filesystem>
#include <functional>

#include "engine/base/result.h"
#include "engine/image/image.h"

using cairo_surface_t = struct _cairo_surface;

namespace acentric {

struct Drawing {
  double width = 0, height = 0;  ///< pixels
  std::function<Status(cairo_surface_t*)> draw;
};

/// Drawings are .svg or .png.
Status checkDrawingPath(const std::filesystem::path& path);
/// Atomic.
Status writeDrawing(const Drawing& drawing, const std::filesystem::path& path);
Result<ColourImage> pixelsOf(const Drawing& drawing);

}  // namespace acentric
