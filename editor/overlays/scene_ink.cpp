#include "editor/overlays/scene_ink.h"

#include <algorithm>
#include <vector>

#include "editor/tools/orbit_camera.h"
#include "ui/canvas_draw.h"
#include "ui/theme.h"

namespace acentric::editor {
namespace {

namespace palette = ui::palette;

constexpr double kDash = 7, kGap = 5;
constexpr double kMostDashes = 400;  ///< of one line: what leaves the window far off is not worth more

/// Far outside of any window a draw list loses its precision.
bool drawable(const glm::dvec2& a, const glm::dvec2& b) {
  constexpr double kFar = 1e6;
  return glm::length(a) < kFar && glm::length(b) < kFar;
}

}  // namespace

ImVec2 SceneInk::onWindow(const glm::dvec2& pixel) const { return ui::imVec(areaMin_ + pixel); }

std::optional<ImVec2> SceneInk::at(const glm::dvec3& place) const {
  const Projected seen = project(view_, place);
  if (seen.depth <= 0 || !drawable(seen.pixel, seen.pixel)) return std::nullopt;
  return onWindow(seen.pixel);
}

void SceneInk::line(const glm::dvec3& from, const glm::dvec3& to, const ui::Colour& colour,
                    float thickness) const {
  const auto stroke = strokeOf(view_, from, to);
  if (stroke && drawable(stroke->from, stroke->to))
    list_.AddLine(onWindow(stroke->from), onWindow(stroke->to), colour.packed(), ui::scaled(thickness));
}

void SceneInk::dashed(const glm::dvec3& from, const glm::dvec3& to, const ui::Colour& colour,
                      float thickness) const {
  const auto stroke = strokeOf(view_, from, to);
  if (!stroke || !drawable(stroke->from, stroke->to)) return;
  const glm::dvec2 along = stroke->to - stroke->from;
  const double length = glm::length(along),
               step = std::max(double(ui::scaled(kDash + kGap)), length / kMostDashes);
  for (double at = 0; at < length; at += step) {
    const double end = std::min(length, at + step * kDash / (kDash + kGap));
    list_.AddLine(onWindow(stroke->from + at / length * along), onWindow(stroke->from + end / length * along),
                  colour.packed(), ui::scaled(thickness));
  }
}

void SceneInk::loop(std::span<const glm::dvec2> corners, double height, const ui::Colour& colour,
                    float thickness, bool dashes) const {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec3 from(corners[k], height), to(corners[(k + 1) % corners.size()], height);
    if (dashes)
      dashed(from, to, colour, thickness);
    else
      line(from, to, colour, thickness);
  }
}

void SceneInk::fill(std::span<const glm::dvec2> corners, double height, const ui::Colour& colour) const {
  std::vector<glm::dvec3> places;
  for (const glm::dvec2& corner : corners) places.emplace_back(corner, height);
  std::vector<ImVec2> points;
  for (const glm::dvec2& pixel : cornersBeforeEye(view_, places)) {
    if (!drawable(pixel, pixel)) return;
    points.push_back(onWindow(pixel));
  }
  if (points.size() >= 3) list_.AddConvexPolyFilled(points.data(), int(points.size()), colour.packed());
}

void SceneInk::dot(const glm::dvec3& place, const ui::Colour& colour, float radius) const {
  const auto centre = at(place);
  if (!centre) return;
  list_.AddCircleFilled(*centre, ui::scaled(radius + 1.6F), palette::backdrop.withOpacity(0.85F).packed());
  list_.AddCircleFilled(*centre, ui::scaled(radius), colour.packed());
}

void SceneInk::square(const glm::dvec3& place, const ui::Colour& colour, float half, bool filled) const {
  const auto centre = at(place);
  if (!centre) return;
  const float side = ui::scaled(half);
  const ImVec2 low(centre->x - side, centre->y - side), high(centre->x + side, centre->y + side);
  list_.AddRectFilled(low, high, (filled ? colour : ui::Colour(palette::backdrop)).packed());
  list_.AddRect(low, high, (filled ? ui::Colour(palette::backdrop) : colour).packed(), 0, 0,
                ui::scaled(1.4F));
}

void SceneInk::plus(const glm::dvec3& place, const ui::Colour& colour) const {
  const auto centre = at(place);
  if (!centre) return;
  const float arm = ui::scaled(3);
  list_.AddCircleFilled(*centre, ui::scaled(6), palette::backdrop.packed());
  list_.AddCircle(*centre, ui::scaled(6), colour.packed(), 0, ui::scaled(1.6F));
  list_.AddLine({centre->x - arm, centre->y}, {centre->x + arm, centre->y}, colour.packed(),
                ui::scaled(1.4F));
  list_.AddLine({centre->x, centre->y - arm}, {centre->x, centre->y + arm}, colour.packed(),
                ui::scaled(1.4F));
}

}  // namespace acentric::editor
