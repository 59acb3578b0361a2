#pragma once
/// The plan's backdrop: the scene from above, cut at eye height. What is above the cut is gone; surfaces that
/// cross it are drawn as dark lines, and the insides of solids as dark areas.

#include <memory>
#include <optional>
#include <stop_token>

#include "engine/bake/ray_scene.h"
#include "engine/base/task_runner.h"
#include "engine/image/image.h"
#include "engine/layout/layout.h"

namespace acentric::editor {

struct Backdrop {
  ColourImage picture;  ///< transparent where nothing lies below the cut
  glm::dvec2 min{0};    ///< plan, metres: lower left corner of the picture
  glm::dvec2 max{0};
};

/// What the backdrop shows: what is laid out, and ground near it where cells can be laid, with room around,
/// but no more than the scene.
struct PlanBox {
  glm::dvec2 min{0}, max{0};
  bool operator==(const PlanBox&) const = default;
};
PlanBox planBoxOf(const Bounds& scene, const Layout& layout, const Outline& walkable);

/// Of about `pixels` x `pixels` pixels in all, whatever its shape. Nothing if stopped.
std::optional<Backdrop> drawBackdrop(const RayScene& scene, double cutHeight, const PlanBox& box, int pixels,
                                     TaskRunner& runner, std::stop_token stop = {});

}  // namespace acentric::editor
