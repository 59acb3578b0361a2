#include "engine/scene/simplify.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/base/contract.h"
#include "engine/base/stopwatch.h"
#include "engine/scene/decimate.h"
#include "engine/scene/mesh_attributes.h"
#include "engine/scene/surface_distance.h"
#include "engine/scene/triangle_bvh.h"
#include "engine/scene/weld.h"

namespace acentric {
namespace {

constexpr int kAttempts = 3;
constexpr double kMaxLightResolution = 64;
/// Light samples look for their place a little inside the triangle: at a corner several surfaces meet.
constexpr float kInset = 0.02f;

bool isWhole(const LocalGeometry& full, const LocalTriangle& t) {
  return full.vertices[t.vertices.x].barycentric == glm::vec2(0, 0) &&
         full.vertices[t.vertices.y].barycentric == glm::vec2(1, 0) &&
         full.vertices[t.vertices.z].barycentric == glm::vec2(0, 1);
}

/// Puts the result together: meshes of the vertices that are left, and where the light comes from.
class Assembler {
 public:
  Assembler(const Scene& scene, const LocalGeometry& full, const SimplifyOptions& options)
      : scene_(scene),
        full_(full),
        options_(options),
        ownMesh_(scene.meshes.size(), TriangleBvh::kNone),
        ownVertex_(scene.meshes.size()),
        firstTriangles_(scene.firstTriangles()) {}

  /// A triangle of the full geometry, as it is.
  void keep(const LocalTriangle& t) {
    const glm::uvec3& corners = scene_.meshes[t.mesh].triangles[t.triangle];
    const auto first = std::uint32_t(out.vertices.size());
    for (int k = 0; k < 3; ++k) out.vertices.push_back(full_.vertices[t.vertices[k]]);
    place(t.mesh, corners, first, {firstTriangles_[t.mesh] + t.triangle, 0, {}});
  }

  /// A triangle after decimation.
  void add(const DecimatedTriangle& t, const Welded& welded, const TriangleBvh& before) {
    const std::uint32_t mesh = welded.vertexSource[t.vertices.x].mesh;
    glm::uvec3 corners;
    for (int k = 0; k < 3; ++k) corners[k] = welded.vertexSource[t.vertices[k]].triangle;
    Light light;
    if (t.original != DecimatedTriangle::kChanged) {
      const SourceTriangle& source = welded.triangleSource[t.original];
      corners = scene_.meshes[mesh].triangles[source.triangle];
      light.from = firstTriangles_[mesh] + source.triangle;
    } else {
      light = resample(t, welded, before);
    }
    const auto first = std::uint32_t(out.vertices.size());
    constexpr glm::vec2 kWeights[3]{{0, 0}, {1, 0}, {0, 1}};
    for (int k = 0; k < 3; ++k)
      out.vertices.push_back({scene_.meshes[mesh].positions[corners[k]], kWeights[k]});
    place(mesh, corners, first, std::move(light));
  }

  /// Numbers the light through the meshes in order.
  void finish() {
    for (std::vector<Light>& lights : lights_)
      for (Light& light : lights) {
        out.lightFrom.push_back(light.from);
        out.lightResolution.push_back(light.resolution);
        out.lightPlaces.insert(out.lightPlaces.end(), light.places.begin(), light.places.end());
      }
  }

  SimplifiedLocal out;

 private:
  struct Light {
    std::uint32_t from = SimplifiedLocal::kResampled;
    std::uint16_t resolution = 0;
    std::vector<SurfacePlace> places;
  };

  void place(std::uint32_t sceneMesh, const glm::uvec3& corners, std::uint32_t firstVertex, Light light) {
    std::uint32_t& own = ownMesh_[sceneMesh];
    if (own == TriangleBvh::kNone) {
      own = std::uint32_t(out.meshes.size());
      out.meshes.push_back({sceneMesh, {}, {}});
      lights_.emplace_back();
      ownVertex_[sceneMesh].assign(scene_.meshes[sceneMesh].positions.size(), TriangleBvh::kNone);
    }
    glm::uvec3 triangle;
    for (int k = 0; k < 3; ++k) triangle[k] = vertex(sceneMesh, corners[k], out.meshes[own]);
    out.triangles.push_back({{firstVertex, firstVertex + 1, firstVertex + 2},
                             own,
                             std::uint32_t(out.meshes[own].triangles.size())});
    out.meshes[own].triangles.push_back(triangle);
    lights_[own].push_back(std::move(light));
  }

  std::uint32_t vertex(std::uint32_t sceneMesh, std::uint32_t index, SimplifiedMesh& mesh) {
    std::uint32_t& own = ownVertex_[sceneMesh][index];
    if (own == TriangleBvh::kNone) {
      own = std::uint32_t(mesh.sceneVertices.size());
      mesh.sceneVertices.push_back(index);
    }
    return own;
  }

  /// Each light sample takes the light of the nearest place on the same mesh that faces the same way.
  Light resample(const DecimatedTriangle& t, const Welded& welded, const TriangleBvh& before) const {
    const std::array<glm::dvec3, 3> corners{welded.mesh.positions[t.vertices.x],
                                            welded.mesh.positions[t.vertices.y],
                                            welded.mesh.positions[t.vertices.z]};
    const glm::dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double longest =
        std::max({glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]),
                  glm::distance(corners[2], corners[0])});
    const double size = std::min(longest, 4 * std::sqrt(0.5 * glm::length(cross)));  // needles need fewer
    Light light;
    light.resolution =
        std::uint16_t(std::clamp(std::ceil(size / options_.lightTexel), 1.0, kMaxLightResolution));
    const std::uint32_t mesh = welded.vertexSource[t.vertices.x].mesh;
    const auto sameMesh = [&](std::uint32_t n) { return welded.triangleSource[n].mesh == mesh; };
    const auto sameWay = [&](std::uint32_t n) {
      if (!sameMesh(n)) return false;
      const auto& c = before.triangle(n);
      return glm::dot(glm::cross(glm::dvec3(c[1] - c[0]), glm::dvec3(c[2] - c[0])), cross) > 0;
    };
    const std::uint32_t r = light.resolution;
    for (std::uint32_t i = 0; i <= r; ++i)
      for (std::uint32_t j = 0; i + j <= r; ++j) {
        const glm::vec2 at = glm::mix(glm::vec2(float(i), float(j)) / float(r), glm::vec2(1.0f / 3), kInset);
        const glm::dvec3 point = pointOn(corners, at);
        TriangleBvh::Nearest found = before.nearest(point, 2 * longest, sameWay);
        if (!found.found()) found = before.nearest(point, std::numeric_limits<double>::infinity(), sameMesh);
        const SourceTriangle& source = welded.triangleSource[found.triangle];
        light.places.push_back({firstTriangles_[source.mesh] + source.triangle, glm::vec2(found.weights)});
      }
    return light;
  }

  const Scene& scene_;
  const LocalGeometry& full_;
  const SimplifyOptions& options_;
  std::vector<std::uint32_t> ownMesh_;
  std::vector<std::vector<std::uint32_t>> ownVertex_;
  std::vector<std::uint32_t> firstTriangles_;
  std::vector<std::vector<Light>> lights_;  ///< by own mesh
};

/// Decimates; where the measured error is larger than allowed, again with less tolerance.
Result<Decimation> decimateWithin(const Welded& welded, const TriangleBvh& before, DecimationOptions options,
                                  SimplifyReport& report, const std::stop_token& stop) {
  const double maxError = options.tolerance;
  for (int attempt = 1;; ++attempt) {
    auto decimated = decimate(welded.mesh, options, stop);
    if (!decimated) return decimated;
    const Distances distances = surfaceDistances(welded.mesh, before, *decimated);
    report.maxError = distances.max;
    report.meanError = distances.mean();
    report.errorSamples = distances.count;
    report.split = decimated->split;
    report.loosenedFrom = decimated->loosenedFrom;
    report.piecesLeftOut = decimated->piecesLeftOut;
    report.trianglesLeftOut = decimated->trianglesLeftOut;
    report.withinError = distances.max <= maxError;
    if (report.withinError || options.reach || attempt == kAttempts) return decimated;
    options.tolerance *= 0.8 * maxError / distances.max;
  }
}

}  // namespace

Status SimplifyOptions::check() const {
  if (!(maxError > 0 && maxError <= 10))
    return fail(ErrorKind::invalidArgument,
                fmt::format("simplifying needs an error above 0 and up to 10 m, not {:g}", maxError));
  if (reach && mostTriangles == 0)
    return fail(ErrorKind::invalidArgument, "a budget that must be reached needs a number of triangles");
  if (!(lightTexel > 0)) return fail(ErrorKind::invalidArgument, "light samples must be some distance apart");
  return {};
}

Result<SimplifiedLocal> simplify(const Scene& scene, const LocalGeometry& full,
                                 const SimplifyOptions& options, std::stop_token stop) {
  if (auto sound = options.check(); !sound) return tl::unexpected(sound.error());
  require(!full.surfaces, "what is simplified was clipped from the scene");
  const Stopwatch watch;
  Welder welder(scene);
  std::vector<const LocalTriangle*> kept;
  for (const LocalTriangle& t : full.triangles)
    if (!isWhole(full, t) || !welder.add(t)) kept.push_back(&t);
  const Welded& welded = welder.out;
  const TriangleBvh before = treeOf(welded.mesh, welded.mesh.triangles);

  SimplifyReport report;
  report.before = full.triangles.size();
  report.rim = kept.size();
  const std::size_t most = options.mostTriangles > kept.size() ? options.mostTriangles - kept.size() : 0;
  const auto decimated =
      decimateWithin(welded, before, {most, options.maxError, options.reach}, report, stop);
  if (!decimated) return tl::unexpected(decimated.error());

  Assembler assembler(scene, full, options);
  for (const LocalTriangle* t : kept) assembler.keep(*t);
  for (std::size_t n = 0; n < decimated->triangles.size(); ++n) {
    if (n % 4096 == 0 && stop.stop_requested())
      return fail(ErrorKind::cancelled, "simplifying was cancelled");
    assembler.add(decimated->triangles[n], welded, before);
  }
  assembler.finish();
  report.after = assembler.out.triangles.size();
  report.withinBudget = options.mostTriangles == 0 || report.after <= options.mostTriangles;
  report.seconds = watch.seconds();
  assembler.out.report = report;
  return std::move(assembler.out);
}

namespace {

Mesh meshOf(const SimplifiedMesh& simplified, const Scene& scene) {
  Mesh mesh = withVertices(scene.meshes[simplified.sceneMesh], simplified.sceneVertices);
  mesh.triangles = simplified.triangles;
  return mesh;
}

SurfaceLight lightOf(const SimplifiedLocal& simplified, const SurfaceLight& sceneLight) {
  SurfaceLight light;
  const SurfacePlace* places = simplified.lightPlaces.data();
  for (std::size_t t = 0; t < simplified.lightFrom.size(); ++t) {
    light.firstSample.push_back(std::uint32_t(light.light.size()));
    const std::uint32_t from = simplified.lightFrom[t];
    if (from != SimplifiedLocal::kResampled) {
      light.resolution.push_back(sceneLight.resolution[from]);
      light.hasBack.push_back(sceneLight.hasBack[from]);
      light.light.insert(light.light.end(), sceneLight.light.begin() + sceneLight.firstSample[from],
                         sceneLight.light.begin() + sceneLight.firstSample[from + 1]);
      continue;
    }
    const std::uint16_t resolution = simplified.lightResolution[t];
    const std::span<const SurfacePlace> mine(places, surfaceSampleCount(resolution));
    places += mine.size();
    const bool back = sceneLight.hasBack[mine[0].sceneTriangle] != 0;
    light.resolution.push_back(resolution);
    light.hasBack.push_back(back ? 1 : 0);
    for (const bool behind : {false, true})
      for (const SurfacePlace& place : mine)
        if (back || !behind)
          light.light.push_back(
              packColour(glm::vec4(sceneLight.at(place.sceneTriangle, place.barycentric,
                                                 behind && sceneLight.hasBack[place.sceneTriangle] != 0),
                                   1)));
  }
  light.firstSample.push_back(std::uint32_t(light.light.size()));
  return light;
}

}  // namespace

Status SimplifiedLocal::check(const Scene& scene) const {
  const auto wrong = [](const char* what) {
    return fail(ErrorKind::malformed, std::string("simplified geometry does not fit the scene: ") + what);
  };
  const std::size_t sceneTriangles = scene.triangleCount();
  std::size_t ownTriangles = 0, places = 0;
  for (const SimplifiedMesh& mesh : meshes) {
    if (mesh.sceneMesh >= scene.meshes.size()) return wrong("a mesh");
    for (const std::uint32_t vertex : mesh.sceneVertices)
      if (vertex >= scene.meshes[mesh.sceneMesh].positions.size()) return wrong("a vertex");
    for (const glm::uvec3& t : mesh.triangles)
      if (std::max({t.x, t.y, t.z}) >= mesh.sceneVertices.size()) return wrong("a corner");
    ownTriangles += mesh.triangles.size();
  }
  for (const LocalTriangle& t : triangles)
    if (t.mesh >= meshes.size() || t.triangle >= meshes[t.mesh].triangles.size() ||
        std::max({t.vertices.x, t.vertices.y, t.vertices.z}) >= vertices.size())
      return wrong("a triangle");
  if (lightFrom.size() != ownTriangles || lightResolution.size() != ownTriangles) return wrong("its light");
  for (std::size_t t = 0; t < ownTriangles; ++t) {
    if (lightFrom[t] != kResampled && lightFrom[t] >= sceneTriangles) return wrong("a triangle's light");
    if (lightFrom[t] == kResampled && (lightResolution[t] < 1 || lightResolution[t] > kMaxLightResolution))
      return wrong("a light's resolution");
    places += lightFrom[t] == kResampled ? surfaceSampleCount(lightResolution[t]) : 0;
  }
  if (places != lightPlaces.size()) return wrong("the number of light samples");
  for (const SurfacePlace& place : lightPlaces)
    if (place.sceneTriangle >= sceneTriangles || !(place.barycentric.x >= 0 && place.barycentric.x <= 1) ||
        !(place.barycentric.y >= 0 && place.barycentric.y <= 1))
      return wrong("a light's place");
  for (const LocalVertex& vertex : vertices)
    if (!std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z + vertex.barycentric.x +
                       vertex.barycentric.y))
      return wrong("a position");
  return {};
}

LocalGeometry localGeometryOf(const SimplifiedLocal& simplified, const Scene& scene,
                              const ConvexPolygon& polygon, const SurfaceLight* sceneLight) {
  LocalGeometry local{polygon, simplified.vertices, simplified.triangles, nullptr};
  auto surfaces = std::make_shared<LocalSurfaces>();
  for (const SimplifiedMesh& mesh : simplified.meshes) surfaces->meshes.push_back(meshOf(mesh, scene));
  if (sceneLight != nullptr && !sceneLight->empty()) surfaces->light = lightOf(simplified, *sceneLight);
  local.surfaces = std::move(surfaces);
  return local;
}

}  // namespace acentric
