#pragma once
/// Worlds of solid boxes as the judges of sampling see them, and as scenes of triangles.

#include <array>
#include <memory>

#include "engine/inspect/opaque_tracer.h"
#include "engine/scene/scene.h"
#include "tests/inspect/box_world.h"

namespace acentric::test {

class BoxTracer final : public OpaqueTracer {
 public:
  explicit BoxTracer(std::vector<Box> boxes) : boxes_(std::move(boxes)) {}
  const std::vector<Box>& boxes() const { return boxes_; }

  /// Both faces of every box on the way count, as triangles' do.
  OpaqueHit trace(const glm::dvec3& origin, const glm::dvec3& direction, double nearest,
                  double farthest) const override {
    OpaqueHit found;
    for (const Box& box : boxes_) {
      double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
      int enterAxis = 0, leaveAxis = 0;
      bool hit = true;
      for (int axis = 0; axis < 3 && hit; ++axis) {
        if (direction[axis] == 0) {
          hit = origin[axis] > box.min[axis] && origin[axis] < box.max[axis];
          continue;
        }
        const double a = (box.min[axis] - origin[axis]) / direction[axis];
        const double b = (box.max[axis] - origin[axis]) / direction[axis];
        if (std::min(a, b) > enter) enter = std::min(a, b), enterAxis = axis;
        if (std::max(a, b) < leave) leave = std::max(a, b), leaveAxis = axis;
      }
      if (!hit || enter > leave) continue;
      for (const auto& [distance, axis] : {std::pair{enter, enterAxis}, std::pair{leave, leaveAxis}})
        if (distance >= nearest && distance <= farthest && distance < found.distance) {
          found.distance = distance;
          found.normal = glm::dvec3(0);
          found.normal[axis] = 1;
        }
    }
    return found;
  }

 private:
  std::vector<Box> boxes_;
};

/// One mesh of twelve triangles, and one material, per box.
inline ScenePtr sceneOf(const std::vector<Box>& boxes) {
  auto scene = std::make_shared<Scene>();
  scene->name = "boxes";
  for (const Box& box : boxes) {
    Mesh mesh;
    mesh.name = "box " + std::to_string(scene->meshes.size());
    mesh.material = int(scene->materials.size());
    scene->materials.emplace_back().name = "material " + std::to_string(scene->meshes.size());
    for (int corner = 0; corner < 8; ++corner)
      mesh.positions.emplace_back(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                  corner & 4 ? box.max.z : box.min.z);
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {3, 2, 6, 7}, {2, 0, 4, 6}, {1, 3, 7, 5}}};
    for (const auto& s : kSides) {
      mesh.triangles.emplace_back(s[0], s[1], s[2]);
      mesh.triangles.emplace_back(s[0], s[2], s[3]);
    }
    scene->meshes.push_back(std::move(mesh));
  }
  scene->bounds = boundsOf(*scene);
  return scene;
}

}  // namespace acentric::test
