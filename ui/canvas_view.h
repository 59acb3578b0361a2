#pragma once
/// The transform of a pannable, zoomable plan: world metres (x right, y up) to window pixels (y down). Pure.

#include <glm/glm.hpp>
#include <optional>

namespace acentric::ui {

class CanvasView {
 public:
  static constexpr double kMinPixelsPerMetre = 1e-3;
  static constexpr double kMaxPixelsPerMetre = 2e4;

  /// The rectangle on the window, pixels. What was fitted into it stays so while it changes its size, until
  /// it is panned or zoomed.
  void setArea(const glm::dvec2& min, const glm::dvec2& size);

  glm::dvec2 screenFromWorld(const glm::dvec2& world) const;
  glm::dvec2 worldFromScreen(const glm::dvec2& screen) const;
  double pixelsPerMetre() const { return pixelsPerMetre_; }
  const glm::dvec2& centre() const { return centre_; }
  const glm::dvec2& areaMin() const { return areaMin_; }
  const glm::dvec2& areaSize() const { return areaSize_; }
  bool contains(const glm::dvec2& screen) const;

  void panPixels(const glm::dvec2& delta);
  /// The world point under `screen` stays there.
  void zoomAt(const glm::dvec2& screen, double factor);
  /// Shows a world box with a margin (fraction of the area on each side).
  void fit(const glm::dvec2& worldMin, const glm::dvec2& worldMax, double margin = 0.06);

 private:
  struct Fitted {
    glm::dvec2 low{0}, high{0};
    double margin = 0;
  };
  std::optional<Fitted> fitted_;
  glm::dvec2 areaMin_{0};
  glm::dvec2 areaSize_{1, 1};
  glm::dvec2 centre_{0};
  double pixelsPerMetre_ = 50;
};

/// The step 1, 2 or 5 times a power of ten, in metres, that is at least `minPixels` wide.
double niceStep(double pixelsPerMetre, double minPixels);

}  // namespace acentric::ui
