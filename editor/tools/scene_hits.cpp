#include "editor/tools/scene_hits.h"

#include <cmath>

#include "editor/tools/orbit_camera.h"

namespace acentric::editor {
namespace {

constexpr double kReachPixels = 9;
constexpr double kSlack = 1.01;  ///< of the distance: the floor under the lattice does not hide it

}  // namespace

double latticeHeight(const LayoutSpec& spec) {
  constexpr double kLift = 0.015;
  return spec.floorHeight + kLift * spec.eyeHeight;
}

double latticeHeight(const Layout& layout) { return latticeHeight(layout.spec); }

std::optional<CellId> cellUnder(const Layout& layout, const glm::dvec3& eye, const glm::dvec3& ray,
                                double surfaceDistance) {
  const double distance = (latticeHeight(layout) - eye.z) / ray.z;
  const bool onFloor = distance > 0 && distance <= surfaceDistance * kSlack;
  if (!onFloor && !std::isfinite(surfaceDistance)) return std::nullopt;
  const auto region = layout.regionAt(glm::dvec2(eye + (onFloor ? distance : surfaceDistance) * ray));
  if (!region) return std::nullopt;
  return layout.regions[std::size_t(*region)].id;
}

std::optional<int> cameraUnder(const Layout& layout, const PerspectiveView& view, const glm::dvec2& pixel,
                               double surfaceDistance) {
  std::optional<int> found;
  double least = kReachPixels;
  for (std::size_t c = 0; c < layout.cameras.size(); ++c) {
    const glm::dvec3 at(layout.cameras[c].position, layout.eyeZ());
    const Projected seen = project(view, at);
    if (seen.depth <= 0) continue;
    double away = glm::distance(seen.pixel, pixel);
    if (away > kReachPixels) continue;
    if (glm::distance(at, view.eye) > surfaceDistance * kSlack) away = 0.5 * (away + kReachPixels);
    if (away < least) least = away, found = int(c);
  }
  return found;
}

}  // namespace acentric::editor
