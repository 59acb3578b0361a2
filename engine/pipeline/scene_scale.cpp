#include "engine/pipeline/scene_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/inspect/scale_doubt.h"
#include "engine/pipeline/scene_probe.h"
#include "engine/scene/instances.h"
#include "engine/scene/mesh_attributes.h"
#include "engine/scene/project_origin.h"

namespace acentric {
namespace {

/// Triangles of instances whose texels are measured.
constexpr std::uint64_t kMostOfInstances = 2'000'000;

/// Typical edge of a texel of the base colours, by area, metres; 0 where there are none.
double typicalTexel(const Scene& scene) {
  struct Piece {
    double texel, area;
  };
  std::vector<Piece> pieces;
  double all = 0;
  eachTriangle(scene, kMostOfInstances,
               [&](std::uint32_t, const PlacedMesh& placed, std::uint32_t triangle, double stands) {
                 const Mesh& mesh = placed.mesh();
                 const TextureUse& use = scene.materials[std::size_t(mesh.material)].baseColourTexture;
                 if (!hasCoordinates(mesh, use)) return;
                 const int number = scene.textures[std::size_t(use.texture)].image;
                 if (number < 0) return;
                 const ColourImage& image = *scene.images[std::size_t(number)];
                 const auto& uv = coordinatesOf(mesh, use);
                 const auto corners = placed.corners(triangle);
                 const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
                 const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
                 const auto texelOf = [&](unsigned corner) {
                   return glm::dvec2(use.transform * glm::vec3(uv[corner], 1)) *
                          glm::dvec2(image.width, image.height);
                 };
                 const glm::uvec3& t = mesh.triangles[triangle];
                 const glm::dvec2 p = texelOf(t.x), q = texelOf(t.y) - p, r = texelOf(t.z) - p;
                 const double texels = 0.5 * std::abs(q.x * r.y - q.y * r.x);
                 if (!(area > 0 && texels > 0) || !std::isfinite(area / texels)) return;
                 pieces.push_back({std::sqrt(area / texels), stands * area});
                 all += stands * area;
               });
  std::ranges::sort(pieces, {}, &Piece::texel);
  double passed = 0;
  for (const Piece& piece : pieces)
    if ((passed += piece.area) >= 0.5 * all) return piece.texel;
  return 0;
}

/// A unit that people use, if there is one about there; else two figures.
double readableScale(double metresPerUnit) {
  constexpr double kNear = 1.2;
  for (const double unit : {0.001, 0.01, 0.0254, 0.1, 0.3048, 1.0, 10.0, 100.0, 1000.0})
    if (metresPerUnit < kNear * unit && metresPerUnit > unit / kNear) return unit;
  return std::stod(fmt::format("{:.2g}", metresPerUnit));
}

/// "20 m", "3.1 m", "99 km".
std::string lengthText(double metres) {
  return metres >= 10000 ? fmt::format("{:.0f} km", metres / 1000)
         : metres >= 10  ? fmt::format("{:.0f} m", metres)
                         : fmt::format("{:.2g} m", metres);
}

/// From a place in the project to the same place on the model at another scale.
class Rescaling {
 public:
  Rescaling(const Scene& scene, double factor) : factor_(factor), from_(scene.origin) {
    const glm::dvec3 low = factor * (glm::dvec3(scene.bounds.min) + scene.origin);
    to_ = projectOriginFor(low, factor * (glm::dvec3(scene.bounds.max) + scene.origin));
  }

  glm::dvec2 plan(const glm::dvec2& p) const { return factor_ * (p + glm::dvec2(from_)) - glm::dvec2(to_); }
  double height(double z) const { return factor_ * (z + from_.z) - to_.z; }
  double length(double metres) const { return factor_ * metres; }
  /// Someone's eye over a floor: a person stays as tall.
  glm::dvec3 eye(const glm::dvec3& at, double floor) const {
    return {plan(glm::dvec2(at)), height(floor) + (at.z - floor)};
  }

 private:
  double factor_;
  glm::dvec3 from_, to_;  ///< project origins
};

void rescale(Outline& outline, const Rescaling& to) {
  for (auto& loop : outline.loops)
    for (glm::dvec2& corner : loop) corner = to.plan(corner);
}

void rescale(LayoutSpec& spec, const Rescaling& to) {
  // Cells that were chosen one by one stay where they are; others are as large as suits people.
  // Those of stairs are as large as these.
  if (spec.slope || !(spec.added.empty() && spec.removed.empty() && spec.split.empty()))
    spec.cellSize = std::clamp(to.length(spec.cellSize), kLeastCellSize, kLargestCellSize);
  spec.latticeOrigin = to.plan(spec.latticeOrigin);
  spec.floorHeight = to.height(spec.floorHeight);
  rescale(spec.outline, to);
  if (spec.slope) spec.slope->at = to.plan(spec.slope->at);
  for (auto& [number, apv] : spec.freeApvs) {
    apv.centre = to.plan(apv.centre);
    apv.offset *= to.length(1);
  }
}

}  // namespace

ScaleMeasures measureScale(const RayScene& rays) {
  const Scene& scene = rays.scene();
  const SurfaceProbe probe = probeFor(rays);
  return {measureHeadways(scene.bounds, probe), measureBuiltSizes(scene, probe),
          glm::length(glm::dvec3(scene.bounds.size())), typicalTexel(scene)};
}

std::optional<ScaleDoubt> doubtScale(const RayScene& rays, const ImportOptions& chosen) {
  if (chosen.metresPerUnit > 0) return std::nullopt;
  const auto evidence = weighScale(measureScale(rays));
  if (!evidence) return std::nullopt;
  ScaleDoubt doubt;
  const double now = rays.scene().report.metresPerUnit;
  doubt.metresPerUnit = readableScale(now * evidence->factor);
  doubt.factor = doubt.metresPerUnit / now;
  std::string before, after;
  for (const ScaleFinding& finding : evidence->findings) {
    const bool first = before.empty();
    before += fmt::format("{}{} {} {}", first ? "" : " and ", finding.subject, lengthText(finding.metres),
                          finding.dimension);
    after += (first ? "" : " and ") + lengthText(finding.metres * doubt.factor);
  }
  doubt.text = fmt::format("As the model is scaled now, {}; at {:g} metres per unit {} would be {}", before,
                           doubt.metresPerUnit, evidence->findings.size() == 1 ? "that" : "these", after);
  return doubt;
}

Project atScale(const Project& project, const Scene& scene, double metresPerUnit) {
  Project scaled = project;
  scaled.import.metresPerUnit = metresPerUnit;
  const Rescaling to(scene, metresPerUnit / scene.report.metresPerUnit);
  const auto floorOf = [&](int storey) { return project.storeys[std::size_t(storey)].layout.floorHeight; };
  for (Storey& storey : scaled.storeys) {
    rescale(storey.layout, to);
    rescale(storey.walkable, to);
    storey.spawn.position = to.plan(storey.spawn.position);
  }
  for (Bookmark& bookmark : scaled.bookmarks) bookmark.eye = to.eye(bookmark.eye, floorOf(bookmark.storey));
  for (WalkPath& path : scaled.paths)
    for (PathPose& pose : path.path.poses) pose.eye = to.eye(pose.eye, floorOf(path.storey));
  return scaled;
}

}  // namespace acentric
