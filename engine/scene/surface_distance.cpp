#include "engine/scene/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace acentric {
namespace {

constexpr std::size_t kSurfaceSamples = 20000;

/// Random points on the triangles, as many per area everywhere; always the same ones.
void sampleSurface(const DecimationMesh& mesh, const std::vector<glm::uvec3>& triangles,
                   const TriangleBvh& other, Distances& distances) {
  std::vector<double> upTo;
  double area = 0;
  for (const glm::uvec3& t : triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    upTo.push_back(area += 0.5 * glm::length(glm::cross(b - a, c - a)));
  }
  if (!(area > 0)) return;
  std::mt19937 engine(20240);
  std::uniform_real_distribution<double> share(0, 1);
  for (std::size_t n = 0; n < kSurfaceSamples; ++n) {
    const double at = area * (double(n) + share(engine)) / double(kSurfaceSamples);
    const auto t =
        std::min(std::size_t(std::ranges::upper_bound(upTo, at) - upTo.begin()), triangles.size() - 1);
    const double u = std::sqrt(share(engine)), v = share(engine);
    const glm::uvec3& corners = triangles[t];
    distances.add(
        other
            .nearest(pointOn({glm::dvec3(mesh.positions[corners.x]), glm::dvec3(mesh.positions[corners.y]),
                              glm::dvec3(mesh.positions[corners.z])},
                             {u * (1 - v), u * v}))
            .distance);
  }
}

}  // namespace

TriangleBvh treeOf(const DecimationMesh& mesh, const std::vector<glm::uvec3>& triangles) {
  std::vector<TriangleBvh::Corners> corners;
  corners.reserve(triangles.size());
  for (const glm::uvec3& t : triangles)
    corners.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
  return TriangleBvh(std::move(corners));
}

Distances surfaceDistances(const DecimationMesh& mesh, const TriangleBvh& before, const Decimation& after) {
  Distances distances;
  std::vector<glm::uvec3> triangles;
  std::vector<bool> left(mesh.positions.size(), false);
  for (const DecimatedTriangle& t : after.triangles) {
    triangles.push_back(t.vertices);
    for (int k = 0; k < 3; ++k) left[t.vertices[k]] = true;
  }
  const TriangleBvh tree = treeOf(mesh, triangles);
  // Where a vertex was taken away the distance is largest.
  for (std::size_t v = 0; v < left.size(); ++v)
    if (!left[v]) distances.add(tree.nearest(glm::dvec3(mesh.positions[v])).distance);
  sampleSurface(mesh, mesh.triangles, tree, distances);
  sampleSurface(mesh, triangles, before, distances);
  return distances;
}

}  // namespace acentric
