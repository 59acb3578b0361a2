#include "ui/canvas_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace acentric::ui {

void CanvasView::setArea(const glm::dvec2& min, const glm::dvec2& size) {
  areaMin_ = min;
  const glm::dvec2 before = std::exchange(areaSize_, glm::max(size, glm::dvec2(1)));
  if (fitted_ && areaSize_ != before) fit(fitted_->low, fitted_->high, fitted_->margin);
}

glm::dvec2 CanvasView::screenFromWorld(const glm::dvec2& world) const {
  const glm::dvec2 offset = (world - centre_) * pixelsPerMetre_;
  return areaMin_ + 0.5 * areaSize_ + glm::dvec2(offset.x, -offset.y);
}

glm::dvec2 CanvasView::worldFromScreen(const glm::dvec2& screen) const {
  const glm::dvec2 offset = screen - areaMin_ - 0.5 * areaSize_;
  return centre_ + glm::dvec2(offset.x, -offset.y) / pixelsPerMetre_;
}

bool CanvasView::contains(const glm::dvec2& screen) const {
  const glm::dvec2 max = areaMin_ + areaSize_;
  return screen.x >= areaMin_.x && screen.y >= areaMin_.y && screen.x < max.x && screen.y < max.y;
}

void CanvasView::panPixels(const glm::dvec2& delta) {
  if (delta != glm::dvec2(0)) fitted_.reset();
  centre_ -= glm::dvec2(delta.x, -delta.y) / pixelsPerMetre_;
}

void CanvasView::zoomAt(const glm::dvec2& screen, double factor) {
  if (!(factor > 0) || !std::isfinite(factor)) return;
  fitted_.reset();
  const glm::dvec2 held = worldFromScreen(screen);
  pixelsPerMetre_ = std::clamp(pixelsPerMetre_ * factor, kMinPixelsPerMetre, kMaxPixelsPerMetre);
  centre_ += held - worldFromScreen(screen);
}

void CanvasView::fit(const glm::dvec2& worldMin, const glm::dvec2& worldMax, double margin) {
  fitted_ = {worldMin, worldMax, margin};
  const glm::dvec2 extent = glm::max(worldMax - worldMin, glm::dvec2(1e-3));
  centre_ = 0.5 * (worldMin + worldMax);
  const glm::dvec2 scale = areaSize_ * (1 - 2 * margin) / extent;
  pixelsPerMetre_ = std::clamp(std::min(scale.x, scale.y), kMinPixelsPerMetre, kMaxPixelsPerMetre);
}

double niceStep(double pixelsPerMetre, double minPixels) {
  const double least = minPixels / pixelsPerMetre;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double multiple : {1.0, 2.0, 5.0})
    if (multiple * power >= least * (1 - 1e-9)) return multiple * power;
  return 10 * power;
}

}  // namespace acentric::ui
