#pragma once
/// A picture of the plan as a value: what every inspection draws. Seen from above, +x to the right, +y up,
/// metres. Regions coloured by a value or a category, outlines, a raster placed in the world, camera sectors
/// and markers; title, legend and a scale bar are laid out around them. Written as SVG or PNG (Cairo).
///
/// Drawn in the order: rasters, polygons, lines, cameras, markers, labels. Colours are sRGB with straight
/// alpha; widths and text sizes are in points of the finished picture.

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/image/image.h"

namespace acentric {

/// The scale for values: dark violet (0) over green to yellow (1), growing evenly in lightness, so that it
/// reads without seeing hues and in grey. NaN gives grey.
Rgba8 scaleColour(double share);
/// Eight colours that stay apart for colour-blind eyes; the ninth is the first again.
Rgba8 categoryColour(int category);

inline constexpr Rgba8 kAlarmColour{196, 30, 58, 255};  ///< over budget, bad placement
inline constexpr Rgba8 kInkColour{33, 37, 41, 255};
inline constexpr Rgba8 kFaintColour{134, 142, 150, 255};

/// How values become colours, and what the legend says of it.
struct PlanScale {
  std::string label;  ///< "triangles per region"
  std::string unit;   ///< after each number in the legend; may be empty
  double low = 0, high = 1;
  bool logarithmic = false;            ///< low > 0
  std::optional<double> limit{};       ///< a line across the legend's bar ...
  std::string limitLabel{};            ///< ... and what it is: "budget"
  double shareOf(double value) const;  ///< in [0, 1]
};

struct PlanPolygon {
  std::vector<glm::dvec2> corners;
  std::optional<double> value{};  ///< fill by PlanPicture::scale
  std::optional<Rgba8> fill{};    ///< else this; else none
  Rgba8 stroke{255, 255, 255, 255};
  double strokeWidth = 0.8;
  bool marked = false;  ///< drawn last, with a heavy border in the alarm colour
  std::string label;    ///< at the middle, left out where it does not fit
};

struct PlanLine {
  std::vector<glm::dvec2> points;
  bool closed = false;
  Rgba8 colour = kInkColour;
  double width = 1.6;
  bool dashed = false;
  bool arrow = false;  ///< a head at the last point
};

/// An image over a box of the plan; row 0 lies along the box's upper side (max.y).
struct PlanRaster {
  ColourImage image;
  glm::dvec2 min{0}, max{0};
  double opacity = 1;
  bool smooth = false;  ///< blend neighbouring pixels instead of showing squares
};

/// A capture camera's sector as a small wedge.
struct PlanCamera {
  glm::dvec2 position{0};
  double lowAzimuth = 0;  ///< radians, counter-clockwise
  double fovRadians = 0;
  Rgba8 colour{52, 58, 64, 255};
};

enum class MarkerShape : std::uint8_t { dot, ring, cross, diamond };

struct PlanMarker {
  glm::dvec2 position{0};
  MarkerShape shape = MarkerShape::dot;
  Rgba8 colour = kInkColour;
  double size = 6;
  std::string label;  ///< to the right of it
};

enum class LegendSwatch : std::uint8_t {
  area,
  line,
  dashedLine,
  markedArea,
  camera,
  dot,
  ring,
  cross,
  diamond
};

struct LegendEntry {
  std::string text;
  Rgba8 colour = kInkColour;
  LegendSwatch swatch = LegendSwatch::area;
};

struct PlanPicture {
  std::string title;
  std::string subtitle;
  std::vector<PlanRaster> rasters;
  std::vector<PlanPolygon> polygons;
  std::vector<PlanLine> lines;
  std::vector<PlanCamera> cameras;
  double cameraRadius = 0;  ///< metres; 0 = a share of the plan's size
  std::vector<PlanMarker> markers;
  std::optional<PlanScale> scale;
  std::vector<LegendEntry> legend;
  std::vector<std::string> notes;  ///< lines under the legend
  int width = 1400;                ///< points (SVG) or pixels (PNG); the height follows from the plan
};

/// By the path's ending, .svg or .png; atomically.
Status writePlanPicture(const PlanPicture& picture, const std::filesystem::path& path);
/// The same picture in memory.
Result<ColourImage> drawPlanPicture(const PlanPicture& picture);

}  // namespace acentric
