#pragma once
/// Cairo's context with an owner, and the few strokes that pictures are made of. Cairo keeps an error state
/// instead of failing call by call: ask `status()` at the end.

#include <cairo.h>

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/image/image.h"

namespace acentric {

using SurfacePtr = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

/// What was drawn on an image surface, opaque.
ColourImage pixelsOf(cairo_surface_t* surface);

enum class Align { left, middle, right };

class CairoCanvas {
 public:
  /// `unitsPerWidth` canvas units make up `width` points or pixels of the surface.
  CairoCanvas(cairo_surface_t* surface, double scale);

  void setColour(const Rgba8& colour, double opacity = 1);
  void fillRectangle(const glm::dvec2& min, const glm::dvec2& max, const Rgba8& colour);
  void strokeRectangle(const glm::dvec2& min, const glm::dvec2& max, const Rgba8& colour, double width);
  void path(const std::vector<glm::dvec2>& points, bool closed);
  void fillPath(const Rgba8& colour);                               ///< keeps the path
  void strokePath(const Rgba8& colour, double width, bool dashed);  ///< ends the path
  void wedge(const glm::dvec2& centre, double radius, double fromAngle, double toAngle);
  void circle(const glm::dvec2& centre, double radius);
  void image(const ColourImage& image, const glm::dvec2& min, const glm::dvec2& max, double opacity,
             bool smooth);
  void endPath() { cairo_new_path(context_.get()); }
  void clipTo(const glm::dvec2& min, const glm::dvec2& max);
  void endClip() { cairo_restore(context_.get()); }

  /// The text's baseline begins (ends, has its middle) at `at`. Bytes that are not UTF-8 become '?'.
  void text(const std::string& text, const glm::dvec2& at, double size, const Rgba8& colour,
            Align align = Align::left, bool bold = false);
  /// The same with a light border, readable over anything.
  void haloText(const std::string& text, const glm::dvec2& at, double size, const Rgba8& colour, Align align);
  double textWidth(const std::string& text, double size, bool bold = false);
  /// The text cut into lines no wider than `width`, at spaces.
  std::vector<std::string> wrap(const std::string& text, double size, double width, bool bold = false);

  Status status() const;

 private:
  std::string sound(const std::string& text);
  void setFont(double size, bool bold);
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context_;
};

}  // namespace acentric
