#pragma once
/// How far a decimated surface lies from the one it was, by samples on each.

#include "engine/scene/decimate.h"
#include "engine/scene/triangle_bvh.h"

namespace acentric {

/// How far two surfaces lie apart, by samples on each.
class Distances {
 public:
  void add(double distance) { max = std::max(max, distance), sum_ += distance, ++count; }
  double mean() const { return count == 0 ? 0 : sum_ / double(count); }
  double max = 0;
  std::size_t count = 0;

 private:
  double sum_ = 0;
};

TriangleBvh treeOf(const DecimationMesh& mesh, const std::vector<glm::uvec3>& triangles);

/// `before`: of the triangles of `mesh`.
Distances surfaceDistances(const DecimationMesh& mesh, const TriangleBvh& before, const Decimation& after);

}  // namespace acentric
