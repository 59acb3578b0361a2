#pragma once
/// Joins triangles of a scene into one mesh that can be decimated: vertices that shading cannot tell apart
/// are one.

#include <memory>
#include <vector>

#include "engine/scene/decimate.h"
#include "engine/scene/local_geometry.h"

namespace acentric {

struct SourceTriangle {
  std::uint32_t mesh = 0, triangle = 0;
};

struct Welded {
  DecimationMesh mesh;
  std::vector<SourceTriangle> triangleSource;
  std::vector<SourceTriangle> vertexSource;  ///< .triangle is the vertex within the mesh
};

class Welder {
 public:
  explicit Welder(const Scene& scene);
  ~Welder();

  /// Not if welding leaves the triangle without three corners.
  bool add(const LocalTriangle& t);

  Welded out;

 private:
  struct Known;
  std::uint32_t vertex(std::uint32_t mesh, std::uint32_t index);

  const Scene& scene_;
  std::unique_ptr<Known> known_;
};

}  // namespace acentric
