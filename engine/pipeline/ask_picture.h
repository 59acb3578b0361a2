#pragma once
/// A pixel of a walk's frame asked about: who painted it and how finely, how far its surroundings are from
/// the ray-traced truth and why, and which changes of the project would bring them nearer, each with its
/// cost.

#include <optional>
#include <string>
#include <vector>

#include "engine/geometry/perspective_view.h"
#include "engine/inspect/surface_points.h"
#include "engine/measure/attribution.h"
#include "engine/pipeline/bake_forecast.h"

namespace acentric {

/// The errors of so many pixels in each direction around the one asked about count as its own.
inline constexpr int kAskedPixels = 12;
inline constexpr int kAskedRays = 4;  ///< per pixel of the truth

struct PixelPainter {
  int camera = 0;      ///< into Layout::cameras
  int layer = 0;       ///< of its capture; 1: the first surface from there. 0: not known, as of reflections
  double metres = 0;   ///< from the camera to the surface
  double radians = 0;  ///< at the surface, between the directions to the camera and to the eye
  double samplesPerPixel = 0;  ///< in the direction on the surface that is worst off
};

struct PictureAnswer {
  PerspectiveView view;
  glm::ivec2 pixel{0};
  PixelSource source = kSourceHole;
  Rgba8 shown{}, truth{};               ///< sRGB, of the pixel
  std::optional<SurfacePoint> surface;  ///< what the truth shows there; nothing: the sky
  std::optional<PixelPainter> painter;  ///< nothing: no capture painted it
  int region = -1;                      ///< where the eye stands; -1: outside
  std::size_t triangles = 0;            ///< of the region's local geometry
  Attribution here;                     ///< within kAskedPixels
  ColourImage truthHere;                ///< of these
};

/// `frame`: of `view`, from captures as `open` bakes them; `walk` as it was drawn from. Traces the truth
/// around the pixel with kAskedRays.
Result<PictureAnswer> askPicture(const OpenProject& open, const WalkScene& walk, const Frame& frame,
                                 const PerspectiveView& view, const glm::ivec2& pixel, TaskRunner& runner,
                                 const std::stop_token& stop = {});

/// A change of the project.
struct Improvement {
  std::string what;     ///< "samples per degree 8 to 12"
  std::string why;      ///< what it is good for, in a few words
  double psnrHere = 0;  ///< dB around the pixel, predicted
  Project project;      ///< with the change
  BakeForecast bake;    ///< of what is not on disk with it
};

/// The changes, at most `most`, that promise the most around the pixel, the best first; none that promises
/// less than a tenth of a dB. Predicted is that errors of captured surfaces fall by what the truth itself,
/// sampled more finely, loses less, and no faster than with the square of the rate, those of surfaces that
/// look different from elsewhere moreover with the square of the angle between camera and eye, that holes
/// close, and that errors of baked light fall with the texel's area.
Result<std::vector<Improvement>> improvementsOf(const OpenProject& open, const PictureAnswer& answer,
                                                std::size_t most, const ImportHost& host, TaskRunner& runner,
                                                const std::stop_token& stop = {});

}  // namespace acentric
