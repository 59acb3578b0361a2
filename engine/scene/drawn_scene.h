#pragma once
/// What regions draw of a scene, which has state for each triangle: light of its own, local geometry. These
/// are the scene's meshes, and of instances the triangles that reach into some region: as meshes of their own
/// behind the others. Rays meet the scene itself, with all instances whole, so that nothing is met twice and
/// what no region draws is in memory once.

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "engine/scene/scene.h"

namespace acentric {

/// Some triangles of an instance.
struct InstanceExcerpt {
  std::uint32_t instance = 0;            ///< into Scene::instances
  std::vector<std::uint32_t> triangles;  ///< of its prototype, ascending
};
using InstanceExcerpts = std::vector<InstanceExcerpt>;

class DrawnScene {
 public:
  /// Of no instance.
  explicit DrawnScene(ScenePtr traced);
  /// `excerpts`: of `traced`, instances ascending; kept, not copied.
  DrawnScene(ScenePtr traced, std::shared_ptr<const InstanceExcerpts> excerpts);

  /// Its meshes are all that is drawn; `traced` itself where nothing of an instance is. With the same key: it
  /// looks the same.
  const Scene& scene() const { return *drawn_; }
  const ScenePtr& sharedScene() const { return drawn_; }
  /// Around each of its meshes.
  const std::vector<Bounds>& boxes() const { return boxes_; }

  /// A place on a placed mesh of the traced scene, as a ray's hit tells it.
  struct Place {
    std::uint32_t placed = 0, triangle = 0;
    glm::vec2 barycentric{0};  ///< weights of corner 2 and 3
  };
  /// Where rays meet a place of a drawn triangle.
  Place traced(std::uint32_t mesh, std::uint32_t triangle, const glm::vec2& barycentric) const;
  /// The scene-wide number, among drawn triangles, of one that rays meet; none if no region draws it.
  std::optional<std::uint32_t> numberOf(std::uint32_t placed, std::uint32_t triangle) const;

 private:
  ScenePtr traced_, drawn_;
  std::shared_ptr<const InstanceExcerpts> excerpts_;
  std::vector<Bounds> boxes_;
  std::vector<std::uint32_t> firstTriangles_;
};

using DrawnScenePtr = std::shared_ptr<const DrawnScene>;

}  // namespace acentric
