#pragma once
/// The last resort of a decimation that must reach its number of triangles.

#include <OpenMesh/Tools/Decimater/Observer.hh>
#include <stop_token>

#include "engine/scene/decimate.h"
#include "engine/scene/half_edge_mesh.h"

namespace acentric {

class DecimationStop : public OpenMesh::Decimater::Observer {
 public:
  static constexpr std::size_t kCollapsesBetweenLooks = 1024;
  explicit DecimationStop(std::stop_token stop) : Observer(kCollapsesBetweenLooks), stop_(std::move(stop)) {}
  void notify(std::size_t) override {}
  bool abort() const override { return stop_.stop_requested(); }

 private:
  std::stop_token stop_;
};

/// Frees all vertices and collapses edges by quadrics of the triangles and of the planes that stand upright
/// on open edges, so that those move last; no triangle turns over. Where that does not suffice it leaves out
/// the pieces of the least area, and says so in `out`. `mesh` has no deleted parts, before and after.
void loosen(HalfEdgeMesh& mesh, std::size_t mostTriangles, const std::stop_token& stop, Decimation& out);

}  // namespace acentric
