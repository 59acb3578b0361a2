#pragma once
/// Points on the surfaces of a scene, spread evenly over their area: a sequence of which every beginning is
/// spread as evenly as its length allows, so that shares of area are estimated ever better as it goes on. The
/// same scene gives the same points.

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/scene.h"

namespace acentric {

struct SurfacePoint {
  glm::dvec3 position{0};
  glm::dvec3 normal{0, 0, 1};            ///< unit, as wound
  std::uint32_t mesh = 0, triangle = 0;  ///< of the placed mesh (scene/placed_mesh.h)
};

class SurfacePoints {
 public:
  explicit SurfacePoints(ScenePtr scene);

  double area() const { return area_.empty() ? 0 : area_.back(); }  ///< square metres, of one side
  /// The n-th point; each stands for an equal share of the area. The scene must have some.
  SurfacePoint at(std::uint64_t n) const;

 private:
  struct Ref {
    std::uint32_t mesh, triangle;
  };
  /// Of a prototype: its triangles with area, and their areas summed, in its own frame.
  struct Prototype {
    std::vector<std::uint32_t> triangles;
    std::vector<double> area;
  };
  void addInstances();
  std::uint32_t triangleOf(std::uint32_t instance, double share, std::uint64_t n) const;

  ScenePtr scene_;
  std::vector<Ref> triangles_;  ///< of meshes
  std::vector<double> area_;    ///< of the meshes' triangles up to and with each, then of the instances
  std::vector<Prototype> prototypes_;
  std::vector<std::uint32_t> instances_;  ///< those with area
};

}  // namespace acentric
