#include "engine/scene/loosen.h"

#include <OpenMesh/Core/Geometry/QuadricT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string>

namespace acentric {
namespace {

using Quadric = OpenMesh::Geometry::Quadricd;

/// Of an open edge's upright plane, against a triangle as large as the edge's square.
constexpr double kBorderWeight = 4;

/// Of the plane through `point`, `normal` of unit length.
Quadric planeQuadric(const glm::dvec3& normal, const glm::dvec3& point, double weight) {
  Quadric quadric(normal.x, normal.y, normal.z, -glm::dot(normal, point));
  quadric *= weight;
  return quadric;
}

std::array<glm::dvec3, 3> cornersOf(const HalfEdgeMesh& mesh, HalfEdgeMesh::FaceHandle face) {
  std::array<glm::dvec3, 3> corners;
  std::ranges::transform(mesh.fv_range(face), corners.begin(),
                         [&](const auto vertex) { return toGlm(mesh.point(vertex)); });
  return corners;
}
/// Square to the triangle, twice its area long.
glm::dvec3 crossOf(const std::array<glm::dvec3, 3>& p) { return glm::cross(p[1] - p[0], p[2] - p[0]); }

class LooseQuadric : public OpenMesh::Decimater::ModBaseT<HalfEdgeMesh> {
 public:
  using Base = OpenMesh::Decimater::ModBaseT<HalfEdgeMesh>;
  using Handle = OpenMesh::Decimater::ModHandleT<LooseQuadric>;
  using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<HalfEdgeMesh>;

  explicit LooseQuadric(HalfEdgeMesh& mesh) : Base(mesh, false) {}
  const std::string& name() const override { return name_; }

  void initialize() override {
    const HalfEdgeMesh& mesh = Base::mesh();
    quadrics_.assign(mesh.n_vertices(), Quadric());
    for (const auto face : mesh.faces()) {
      const std::array<glm::dvec3, 3> p = cornersOf(mesh, face);
      const glm::dvec3 cross = crossOf(p);
      const double twice = glm::length(cross);
      if (!(twice > 0)) continue;
      const glm::dvec3 normal = cross / twice;
      const Quadric own = planeQuadric(normal, p[0], 0.5 * twice);
      for (const auto vertex : mesh.fv_range(face)) of(vertex) += own;
      for (const auto edge : mesh.fh_range(face)) {
        if (!mesh.is_boundary(mesh.edge_handle(edge))) continue;
        const auto from = mesh.from_vertex_handle(edge), to = mesh.to_vertex_handle(edge);
        const glm::dvec3 along = toGlm(mesh.point(to)) - toGlm(mesh.point(from));
        const glm::dvec3 upright = glm::normalize(glm::cross(along, normal));
        const Quadric border =
            planeQuadric(upright, toGlm(mesh.point(from)), kBorderWeight * glm::dot(along, along));
        of(from) += border, of(to) += border;
      }
    }
  }

  float collapse_priority(const CollapseInfo& collapse) override {
    const HalfEdgeMesh& mesh = Base::mesh();
    const glm::dvec3 from = toGlm(collapse.p0), to = toGlm(collapse.p1);
    for (const auto edge : mesh.voh_range(collapse.v0)) {
      if (!edge.face().is_valid()) continue;
      const auto a = edge.to(), b = edge.next().to();
      if (a == collapse.v1 || b == collapse.v1) continue;
      const glm::dvec3 pa = toGlm(mesh.point(a)), pb = toGlm(mesh.point(b));
      if (glm::dot(glm::cross(pa - from, pb - from), glm::cross(pa - to, pb - to)) <= 0)
        return float(Base::ILLEGAL_COLLAPSE);
    }
    Quadric both = of(collapse.v0);
    both += of(collapse.v1);
    return float(std::max(both(collapse.p1), 0.0));
  }
  void postprocess_collapse(const CollapseInfo& collapse) override { of(collapse.v1) += of(collapse.v0); }

 private:
  Quadric& of(HalfEdgeMesh::VertexHandle vertex) { return quadrics_[std::size_t(vertex.idx())]; }

  const std::string name_ = "LooseQuadric";
  std::vector<Quadric> quadrics_;  ///< by vertex
};

struct Piece {
  double area = 0;
  std::vector<HalfEdgeMesh::FaceHandle> faces;
};

/// Triangles that hang together, copies of a vertex being one.
std::vector<Piece> piecesOf(const HalfEdgeMesh& mesh) {
  std::map<std::uint32_t, std::uint32_t> parents;  // by vertex of the input
  const auto rootOf = [&](std::uint32_t vertex) {
    parents.try_emplace(vertex, vertex);
    while (parents[vertex] != vertex) vertex = parents[vertex] = parents[parents[vertex]];
    return vertex;
  };
  for (const auto face : mesh.faces()) {
    const std::uint32_t first = mesh.data(*mesh.cfv_iter(face)).input;
    for (const auto vertex : mesh.fv_range(face)) {
      const std::uint32_t a = rootOf(first), b = rootOf(mesh.data(vertex).input);
      parents[a] = b;
    }
  }
  std::map<std::uint32_t, Piece> byRoot;
  for (const auto face : mesh.faces()) {
    Piece& piece = byRoot[rootOf(mesh.data(*mesh.cfv_iter(face)).input)];
    piece.faces.push_back(face);
    piece.area += 0.5 * glm::length(crossOf(cornersOf(mesh, face)));
  }
  std::vector<Piece> pieces;
  for (auto& [root, piece] : byRoot) pieces.push_back(std::move(piece));
  std::ranges::stable_sort(pieces, {}, &Piece::area);
  return pieces;
}

}  // namespace

void loosen(HalfEdgeMesh& mesh, std::size_t mostTriangles, const std::stop_token& stop, Decimation& out) {
  for (const auto vertex : mesh.vertices()) mesh.status(vertex).set_locked(false);
  OpenMesh::Decimater::DecimaterT<HalfEdgeMesh> decimater(mesh);
  OpenMesh::Decimater::ModHandleT<LooseQuadric> module;
  decimater.add(module);
  DecimationStop observer(stop);
  decimater.set_observer(&observer);
  if (!decimater.initialize()) return;
  decimater.decimate_to_faces(0, mostTriangles);
  mesh.garbage_collection();
  std::size_t left = mesh.n_faces();
  if (left <= mostTriangles || stop.stop_requested()) return;
  for (const Piece& piece : piecesOf(mesh)) {
    if (left <= mostTriangles) break;
    for (const auto face : piece.faces) mesh.delete_face(face);
    left -= piece.faces.size();
    ++out.piecesLeftOut, out.trianglesLeftOut += piece.faces.size();
  }
  mesh.garbage_collection();
}

}  // namespace acentric
