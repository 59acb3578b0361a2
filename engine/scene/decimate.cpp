#include "engine/scene/decimate.h"

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "engine/scene/loosen.h"
#include "engine/scene/triangle_bvh.h"

namespace acentric {
namespace {

/// Places where one vertex may stand in several sheets; more of them get triangles apart.
constexpr std::size_t kSheets = 4;
/// Triangles may turn by so much in one collapse: cosine of 60 degrees.
constexpr double kLeastCosine = 0.5;
constexpr float kColourTolerance = 6.0f / 255;

/// The quadric's priority for collapses that keep the surface, and what is painted on it, within the
/// tolerance of every vertex taken away so far; no others.
class GuardedQuadric : public OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh> {
 public:
  using Quadric = OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>;
  using Base = OpenMesh::Decimater::ModBaseT<HalfEdgeMesh>;
  using Handle = OpenMesh::Decimater::ModHandleT<GuardedQuadric>;
  using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<HalfEdgeMesh>;

  explicit GuardedQuadric(HalfEdgeMesh& mesh) : Quadric(mesh) {}
  const std::string& name() const override { return name_; }
  void guard(const DecimationMesh& input, double tolerance) { input_ = &input, tolerance_ = tolerance; }

  /// The decimater asks for all of a vertex's collapses in a row and takes the least: whoever is not less
  /// than an allowed one before it need not be looked at closely.
  float collapse_priority(const CollapseInfo& collapse) override {
    const float priority = Quadric::collapse_priority(collapse);
    if (priority < 0) return priority;
    if (collapse.v0 != asked_) asked_ = collapse.v0, leastAllowed_ = std::numeric_limits<float>::max();
    if (priority >= leastAllowed_) return priority;
    if (!land(collapse)) return float(Base::ILLEGAL_COLLAPSE);
    return leastAllowed_ = priority;
  }
  void preprocess_collapse(const CollapseInfo& collapse) override { land(collapse); }
  void postprocess_collapse(const CollapseInfo& collapse) override {
    Quadric::postprocess_collapse(collapse);
    for (const Fan& fan : fans_) Base::mesh().data(fan.face).stoodHere.clear();
    for (const Landing& landing : landings_)
      Base::mesh().data(landing.face).stoodHere.push_back(landing.vertex);
    asked_ = Vertex();
  }

 private:
  /// A triangle around the vertex, as it will be after the collapse.
  struct Fan {
    HalfEdgeMesh::FaceHandle face;
    std::array<glm::dvec3, 3> corners;
    std::array<std::uint32_t, 3> inputs;
  };
  struct Landing {
    std::uint32_t vertex = 0;
    HalfEdgeMesh::FaceHandle face;
  };

  /// Finds where on the new triangles everything lands that stood on the old ones. False if that is too far,
  /// or the surface folds over.
  bool land(const CollapseInfo& collapse) {
    HalfEdgeMesh& mesh = Base::mesh();
    const glm::dvec3 from = toGlm(collapse.p0), to = toGlm(collapse.p1);
    fans_.clear(), landings_.clear(), landing_.assign(1, mesh.data(collapse.v0).input);
    for (const auto edge : mesh.voh_range(collapse.v0)) {
      if (!edge.face().is_valid()) continue;
      const auto& stood = mesh.data(edge.face()).stoodHere;
      landing_.insert(landing_.end(), stood.begin(), stood.end());
      const Vertex a = edge.to(), b = edge.next().to();
      if (a == collapse.v1 || b == collapse.v1) continue;
      const glm::dvec3 pa = toGlm(mesh.point(a)), pb = toGlm(mesh.point(b));
      const glm::dvec3 before = glm::cross(pa - from, pb - from), after = glm::cross(pa - to, pb - to);
      const double lengths = glm::length(before) * glm::length(after);
      if (!(lengths > 0) || glm::dot(before, after) < kLeastCosine * lengths) return false;
      fans_.push_back({edge.face(),
                       {to, pa, pb},
                       {mesh.data(collapse.v1).input, mesh.data(a).input, mesh.data(b).input}});
    }
    return std::ranges::all_of(landing_, [&](std::uint32_t vertex) { return landOne(vertex); });
  }

  bool landOne(std::uint32_t vertex) {
    const glm::dvec3 point(input_->positions[vertex]);
    double least = std::numeric_limits<double>::infinity();
    const Fan* nearest = nullptr;
    glm::dvec2 weights(0);
    for (const Fan& fan : fans_) {
      const glm::dvec2 at = nearestOnTriangle(fan.corners, point);
      const glm::dvec3 offset = pointOn(fan.corners, at) - point;
      if (const double d = glm::dot(offset, offset); d < least) least = d, nearest = &fan, weights = at;
    }
    if (nearest == nullptr || least > tolerance_ * tolerance_ || !paintFits(vertex, *nearest, weights))
      return false;
    landings_.push_back({vertex, nearest->face});
    return true;
  }

  /// Does what is painted on the vertex still lie there, within the tolerance?
  bool paintFits(std::uint32_t vertex, const Fan& fan, const glm::dvec2& weights) const {
    const auto blend = [&](const auto& values) {
      return values[fan.inputs[0]] * float(1 - weights.x - weights.y) +
             values[fan.inputs[1]] * float(weights.x) + values[fan.inputs[2]] * float(weights.y);
    };
    if (!input_->colours.empty()) {
      const glm::vec4 change = glm::abs(blend(input_->colours) - input_->colours[vertex]);
      if (std::max({change.x, change.y, change.z, change.w}) > kColourTolerance) return false;
    }
    if (input_->uv.empty()) return true;
    const double slide = glm::length(glm::dvec2(blend(input_->uv) - input_->uv[vertex]));
    if (slide < 1e-6) return true;
    const glm::dvec2 u(input_->uv[fan.inputs[1]] - input_->uv[fan.inputs[0]]),
        v(input_->uv[fan.inputs[2]] - input_->uv[fan.inputs[0]]);
    const double area =
        glm::length(glm::cross(fan.corners[1] - fan.corners[0], fan.corners[2] - fan.corners[0]));
    return slide * std::sqrt(area) <= tolerance_ * std::sqrt(std::abs(u.x * v.y - u.y * v.x));
  }

  const std::string name_ = "GuardedQuadric";
  const DecimationMesh* input_ = nullptr;
  double tolerance_ = 0;
  Vertex asked_;
  float leastAllowed_ = 0;
  std::vector<Fan> fans_;  ///< of the collapse looked at last
  std::vector<Landing> landings_;
  std::vector<std::uint32_t> landing_;
};

class Builder {
 public:
  explicit Builder(const DecimationMesh& input) : input_(input), sheets_(input.positions.size()) {}

  /// Returns the triangles that needed copies of vertices.
  std::size_t build(HalfEdgeMesh& mesh) {
    std::size_t split = 0;
    for (std::size_t t = 0; t < input_.triangles.size(); ++t) {
      std::size_t sheet = 0;
      HalfEdgeMesh::FaceHandle face;
      for (; !face.is_valid() && sheet < kSheets; ++sheet) face = addFace(mesh, t, sheet);
      if (!face.is_valid()) face = addApart(mesh, t);
      if (sheet > 1) ++split;
      mesh.data(face).input = std::uint32_t(t);
    }
    for (const auto vertex : mesh.vertices())
      if (copies_.size() > mesh.data(vertex).input && copies_[mesh.data(vertex).input] > 1)
        mesh.status(vertex).set_locked(true);
    for (const auto vertex : mesh.vertices())
      if (vertex.is_boundary()) mesh.status(vertex).set_locked(true);
    return split;
  }

 private:
  Vertex makeVertex(HalfEdgeMesh& mesh, std::uint32_t input) {
    const glm::vec3& p = input_.positions[input];
    const Vertex made = mesh.add_vertex({double(p.x), double(p.y), double(p.z)});
    mesh.data(made).input = input;
    copies_.resize(input_.positions.size());
    ++copies_[input];
    return made;
  }

  HalfEdgeMesh::FaceHandle addFace(HalfEdgeMesh& mesh, std::size_t triangle, std::size_t sheet) {
    Vertex corners[3];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t input = input_.triangles[triangle][k];
      Vertex& vertex = sheets_[input][sheet];
      if (!vertex.is_valid()) vertex = makeVertex(mesh, input);
      corners[k] = vertex;
    }
    return mesh.add_face(corners[0], corners[1], corners[2]);
  }

  HalfEdgeMesh::FaceHandle addApart(HalfEdgeMesh& mesh, std::size_t triangle) {
    const glm::uvec3& t = input_.triangles[triangle];
    return mesh.add_face(makeVertex(mesh, t.x), makeVertex(mesh, t.y), makeVertex(mesh, t.z));
  }

  const DecimationMesh& input_;
  std::vector<std::array<Vertex, kSheets>> sheets_;  ///< by input vertex; invalid: not there yet
  std::vector<std::uint32_t> copies_;                ///< by input vertex
};

/// OpenMesh writes of complex edges to the error stream; they are expected here, and counted.
void quietOpenMesh() {
  static std::once_flag once;
  std::call_once(once, [] { omerr().disable(); });
}

std::vector<DecimatedTriangle> collect(const HalfEdgeMesh& mesh, const DecimationMesh& input) {
  std::vector<DecimatedTriangle> out;
  for (const auto face : mesh.faces()) {
    DecimatedTriangle triangle;
    int k = 0;
    for (const auto vertex : mesh.fv_range(face)) triangle.vertices[k++] = mesh.data(vertex).input;
    // As in the input, up to where it begins.
    const std::uint32_t from = mesh.data(face).input;
    glm::uvec3 turned = triangle.vertices;
    for (int turn = 0; turn < 3; ++turn, turned = {turned.y, turned.z, turned.x})
      if (turned == input.triangles[from]) triangle = {turned, from};
    out.push_back(triangle);
  }
  return out;
}

}  // namespace

Result<Decimation> decimate(const DecimationMesh& input, const DecimationOptions& options,
                            std::stop_token stop) {
  quietOpenMesh();
  try {
    HalfEdgeMesh mesh;
    const std::size_t split = Builder(input).build(mesh);
    OpenMesh::Decimater::DecimaterT<HalfEdgeMesh> decimater(mesh);
    OpenMesh::Decimater::ModHandleT<GuardedQuadric> module;
    decimater.add(module);
    decimater.module(module).guard(input, options.tolerance);
    DecimationStop observer(stop);
    decimater.set_observer(&observer);
    if (!decimater.initialize()) return fail(ErrorKind::internal, "the mesh decimater could not be set up");
    decimater.decimate_to_faces(0, options.mostTriangles);
    Decimation out;
    mesh.garbage_collection();
    if (options.reach && mesh.n_faces() > options.mostTriangles && !stop.stop_requested()) {
      out.loosenedFrom = mesh.n_faces();
      loosen(mesh, options.mostTriangles, stop, out);
    }
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "simplifying was cancelled");
    out.triangles = collect(mesh, input);
    out.split = split;
    return out;
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "there is not enough memory to simplify the region's geometry");
  } catch (const std::exception& problem) {
    return fail(ErrorKind::internal, problem.what(), "mesh decimation");
  }
}

}  // namespace acentric
