#include "engine/bake/edge_on.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/bake/flush_denormals.h"
#include "engine/bake/part_rays.h"
#include "engine/bake/surface_planes.h"
#include "engine/bake/turned_samples.h"
#include "engine/scene/instances.h"
#include "engine/scene/placed_mesh.h"

namespace acentric {
namespace {

/// Parts of a pixel: wider facets are captured as they are; the others are made wider by so much.
constexpr double kWidest = 4, kWidened = 0.75;
/// Parts: turned back, a facet's edges move by its width too.
constexpr double kWidestTurnedBack = 0.7;
/// Tolerances of planes, of a facet's depth over its width: others look alike from everywhere.
constexpr double kDeep = 5;
/// Sine of the angle between a ray and a facet that may be edge on.
constexpr double kSteep = 0.3;
/// Of the camera's distance: a plane nearer to it is taken that far away.
constexpr double kLeastHeight = 1e-4;
/// Sine of the angle between a ray and a line that may be a facet's middle line.
constexpr double kLeastAcross = 0.3;
constexpr std::size_t kTrianglesPerTask = 4096;

/// A triangle as the camera sees it, straight or in a mirror, relative to its centre of projection.
struct Facet {
  std::uint32_t mesh = 0, triangle = 0;
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 normal{0};  ///< unit
  double height = 0;     ///< of its plane: dot(normal, X)
  glm::dvec3 across{0};  ///< unit, normal to the plane through camera and middle line
  double width = 0;      ///< about that line, radians
  SurfacePlane met;      ///< as a ray that meets it tells
};

struct Task {
  std::vector<TurnedSample> added;
  CaptureCounts counts;
};

/// On one thread.
class EdgeOnFacets {
 public:
  /// Seen in a mirror, or straight (null).
  EdgeOnFacets(const ColumnMarch::Setting& setting, const PartAngles& parts, double tolerance,
               const FlatMirror* mirror, Task& out)
      : setting_(setting),
        camera_(setting.columns),
        scene_(setting.shader.scene().scene()),
        parts_(parts),
        tolerance_(tolerance),
        mirror_(mirror),
        out_(out),
        pitch_(std::min(camera_.columnPitch(), camera_.rowPitch())),
        rolesOf_(std::size_t(camera_.columns)) {
    if (setting.sight != nullptr) hints_ = setting.sight->hints();
    if (mirror != nullptr) mirrorHints_ = setting.beyond->hints();
    const double middle = camera_.azimuthAt(0.5 * camera_.columns);
    ahead_ = {std::cos(middle), std::sin(middle)};
    widestCosine_ = std::cos(std::min(0.5 * camera_.fovRadians + pitch_, std::numbers::pi));
  }

  void add(std::uint32_t mesh, std::uint32_t triangle) {
    const std::optional<Facet> facet = facetOf(mesh, triangle);
    if (!facet) return;
    findPixels(*facet);
    for (const Side side : {Side::met, Side::other}) {
      if (side == Side::other && !(facet->width < kWidestTurnedBack * part())) return;
      const double wide = facet->width + kWidened * part();
      const Turn turn{side, (side == Side::met ? 1 : -1) * facet->width / wide};
      for (const std::uint32_t pixel : pixels_) addPixel(*facet, turn, pixel);
    }
  }

 private:
  glm::dvec3 fromCamera(const glm::vec3& position) const {
    const glm::dvec3 at(position);
    return (mirror_ == nullptr ? at : mirror_->imageOf(at)) - camera_.centreOfProjection;
  }

  std::optional<Facet> facetOf(std::uint32_t number, std::uint32_t triangle) {
    const std::array<glm::vec3, 3> corners = PlacedMesh(scene_, number).corners(triangle);
    Facet facet{number, triangle, {}, {}, 0, {}, 0, {}};
    auto& x = facet.corners;
    for (std::size_t k = 0; k < 3; ++k) x[k] = fromCamera(corners[k]);
    const glm::dvec3 cross = glm::cross(x[1] - x[0], x[2] - x[0]), middle = (x[0] + x[1] + x[2]) / 3.0;
    const double area2 = glm::dot(cross, cross), distance2 = glm::dot(middle, middle),
                 volume = glm::dot(cross, x[0]);
    if (!(volume * volume < kSteep * kSteep * area2 * distance2)) return {};
    const auto isAtCamera = [&](const glm::dvec3& corner) {
      return !(glm::length(corner) > nearestSample(setting_.camera));
    };
    if (std::ranges::any_of(x, isAtCamera)) return {};
    const auto isAside = [&](const glm::dvec3& corner) {
      const glm::dvec2 plan(corner);
      return glm::dot(plan, ahead_) < widestCosine_ * glm::length(plan);
    };
    if (std::ranges::all_of(x, isAside)) return {};
    if (mirror_ != nullptr && !mayBeShown(corners, middle)) return {};
    facet.normal = cross / std::sqrt(area2);
    facet.height = glm::dot(facet.normal, x[0]);
    if (const double least = kLeastHeight * std::sqrt(distance2); std::abs(facet.height) < least) {
      const double moved = (facet.height < 0 ? -least : least) - facet.height;
      for (glm::dvec3& corner : x) corner += moved * facet.normal;
      facet.height += moved;
    }
    facet.across = acrossMiddleLine(x, facet.normal);
    for (const glm::dvec3& corner : x)
      facet.width = std::max(facet.width, 2 * std::abs(glm::dot(facet.across, corner)) / glm::length(corner));
    const double slope = glm::dot(facet.normal, facet.across) / facet.height;
    if (!(facet.width < kWidest * part()) || !(std::abs(slope) * facet.width > kDeep * tolerance_)) return {};
    facet.met = planeMet(facet);
    return facet;
  }
  double part() const { return pitch_ / kCoverageParts; }
  bool mayBeShown(const std::array<glm::vec3, 3>& corners, const glm::dvec3& middle) {
    for (const glm::vec3& corner : corners)
      if (!(mirror_->height(glm::dvec3(corner)) > 0)) return false;
    const double distance = glm::length(middle);
    setting_.beyond->spansAlong(camera_.centreOfProjection, middle / distance, spans_);
    return std::ranges::any_of(spans_, [&](const MirrorSight::Span& span) {
      return span.mirror->number == mirror_->number && span.from < distance && distance < span.to;
    });
  }
  /// By the middle of the longest side, along the second longest: both halves of a parallelogram have the
  /// same. Where that runs along the ray, across it.
  static glm::dvec3 acrossMiddleLine(const std::array<glm::dvec3, 3>& x, const glm::dvec3& normal) {
    std::array<std::size_t, 3> sides{0, 1, 2};
    const auto side = [&](std::size_t k) { return x[(k + 1) % 3] - x[k]; };
    std::ranges::sort(sides, std::greater<>(), [&](std::size_t k) { return glm::dot(side(k), side(k)); });
    const glm::dvec3 through = 0.5 * (x[sides[0]] + x[(sides[0] + 1) % 3]);
    const glm::dvec3 line = glm::normalize(side(sides[1])), ray = glm::normalize(through);
    const glm::dvec3 across = glm::cross(ray, line);
    if (glm::length(across) > kLeastAcross) return glm::normalize(across);
    return glm::normalize(glm::cross(ray, glm::cross(normal, ray)));
  }
  SurfacePlane planeMet(const Facet& facet) const {
    const Hit hit{float(glm::length(facet.corners[0])), facet.mesh, facet.triangle, {}, {}};
    const glm::dvec3 way = facet.corners[0];
    return mirror_ == nullptr
               ? planeOf(scene_, hit, camera_.centreOfProjection, glm::vec3(glm::normalize(way)), false)
               : imagePlaneOf(scene_, hit, *mirror_, camera_.centreOfProjection, way, false);
  }

  /// Those that it may cover: along its longest side, and beside that.
  void findPixels(const Facet& facet) {
    pixels_.clear();
    std::array<glm::dvec3, 3> ways;
    for (std::size_t k = 0; k < 3; ++k) ways[k] = glm::normalize(facet.corners[k]);
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (glm::distance(ways[k], ways[(k + 1) % 3]) > glm::distance(ways[longest], ways[(longest + 1) % 3]))
        longest = k;
    const glm::dvec3 &from = ways[longest], &to = ways[(longest + 1) % 3];
    const int steps = 1 + int(2 * glm::distance(from, to) / pitch_);
    for (int i = 0; i <= steps; ++i) {
      const glm::dvec3 way = glm::mix(from, to, double(i) / steps);
      const double elevation = std::atan2(way.z, glm::length(glm::dvec2(way)));
      const double turn =
          std::remainder(std::atan2(way.y, way.x) - camera_.lowAzimuth - 0.5 * camera_.fovRadians,
                         2 * std::numbers::pi) +
          0.5 * camera_.fovRadians;
      const int column = int(std::floor(turn / camera_.columnPitch()));
      const int row = int(std::floor((camera_.topElevation - elevation) / camera_.rowPitch()));
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, camera_.columns - 1); ++c)
        for (int r = std::max(row - 1, 0); r <= std::min(row + 1, camera_.rows - 1); ++r)
          pixels_.push_back(std::uint32_t(c) * std::uint32_t(camera_.rows) + std::uint32_t(r));
    }
    std::ranges::sort(pixels_);
    pixels_.erase(std::unique(pixels_.begin(), pixels_.end()), pixels_.end());
  }

  /// Towards the camera, so that it sees the side that eyes see: that which a ray meets, or the other.
  struct Turn {
    Side side = Side::met;
    double narrower = 1;  ///< the facet's width over what it is made to cover; negative: the other way round
  };
  /// Of the facet, where a direction meets it once it is turned.
  struct Place {
    glm::dvec3 at{0};
    glm::vec2 weights{0};  ///< of corners 2 and 3
  };
  std::optional<Place> placeAlong(const Facet& facet, double narrower, const glm::dvec3& way) const {
    const glm::dvec3 real = way - (1 - narrower) * glm::dot(facet.across, way) * facet.across;
    const double inverse = glm::dot(facet.normal, real) / facet.height;
    if (!(inverse > 0)) return {};
    const auto& x = facet.corners;
    const glm::dvec3 at = real / inverse, from = at - x[0], second = x[1] - x[0], third = x[2] - x[0];
    const double area = glm::dot(glm::cross(second, third), facet.normal);
    const glm::vec2 weights(glm::dot(glm::cross(from, third), facet.normal) / area,
                            glm::dot(glm::cross(second, from), facet.normal) / area);
    if (!(weights.x >= 0 && weights.y >= 0 && weights.x + weights.y <= 1)) return {};
    return Place{at, weights};
  }

  const std::vector<ColumnRole>& rolesOf(int column) {
    std::vector<ColumnRole>& roles = rolesOf_[std::size_t(column)];
    if (roles.empty()) roles = rolesAlong(setting_.camera, camera_.directionAt(column + 0.5));
    return roles;
  }

  void addPixel(const Facet& facet, const Turn& turn, std::uint32_t pixel) {
    const int column = int(pixel / std::uint32_t(camera_.rows)),
              row = int(pixel % std::uint32_t(camera_.rows));
    std::uint16_t coverage = 0;
    Place place;
    float least = 2;
    for (int part = 0; part < kPixelPartCount; ++part) {
      const std::optional<Place> met =
          placeAlong(facet, turn.narrower, parts_.through(column, row, part).unit());
      if (!met) continue;
      coverage |= std::uint16_t(1u << part);
      if (const float off = glm::distance(met->weights, glm::vec2(1.0f / 3)); off < least)
        least = off, place = *met;
    }
    if (coverage == 0) return;
    const double distance = glm::length(place.at);
    glm::dvec3 way = place.at / distance;
    if (mirror_ != nullptr) way = mirror_->reflected(way);
    const glm::vec3 normal = triangleNormal(PlacedMesh(scene_, facet.mesh), facet.triangle);
    const glm::dvec3 virtualPoint = camera_.centreOfProjection + place.at;
    const MetSurface surface(normal, mirror_ == nullptr ? virtualPoint : mirror_->imageOf(virtualPoint),
                             glm::vec3(way));
    const Hit hit{float(distance), facet.mesh, facet.triangle, place.weights, normal};
    ask(surface, rolesOf(column), glm::dvec2(virtualPoint), distance);
    const Seers& seers = turn.side == Side::met ? byMet_ : byOther_;
    if (seers.roles == 0) return;
    const std::optional<glm::vec3> radiance = radianceOf(hit, surface, turn.side, seers, glm::vec3(way));
    if (!radiance) return;
    TurnedSample added{pixel,
                       0,
                       packColour({*radiance, 1}),
                       seers.roles,
                       mirror_ == nullptr ? std::uint8_t(0) : mirror_->number,
                       coverage,
                       {},
                       facet.met};
    const glm::dvec3 plane = facet.normal / facet.height;
    added.plane.normal =
        glm::vec3(plane - (1 - turn.narrower) * glm::dot(plane, facet.across) * facet.across);
    added.met.away = turn.side == Side::other ? 1 : 0;
    const double own = added.plane.inverseDistance(camera_.directionAt(column + 0.5),
                                                   camera_.tangentAt(row + 0.5)),
                 met = 1 / glm::length(glm::dvec2(place.at));
    added.inverseDistance = storedInverseDistance(ownInverseDistance(own, met), setting_.distanceStep);
    out_.added.push_back(added);
  }

  /// Who sees a side.
  struct Seers {
    std::uint8_t roles = 0;
    MirrorSight::Seen inMirror;  ///< one of them
  };
  void ask(const MetSurface& surface, const std::vector<ColumnRole>& roles, const glm::dvec2& place,
           double distance) {
    byMet_ = byOther_ = {};
    const double tolerance = kSameDepth * camera_.rowPitch() * distance;
    const double horizontal = glm::distance(place, glm::dvec2(camera_.centreOfProjection));
    for (const ColumnRole& role : roles) {
      if (!role.holds(place)) continue;
      if (mirror_ != nullptr) {
        const auto seen =
            setting_.beyond->sees(role.index, *mirror_, surface, tolerance, mirrorHints_, out_.counts.rays);
        if (!seen) continue;
        Seers& seers = seen->side == Side::met ? byMet_ : byOther_;
        seers.roles |= role.bit;
        seers.inMirror = *seen;
        continue;
      }
      if (role.exit > horizontal * (1 + kBorderSlack)) continue;
      Side side = Side::met;
      if (setting_.sight != nullptr)
        side = setting_.sight->sees(role.index, surface, tolerance, hints_, out_.counts.rays, true);
      if (side != Side::none) (side == Side::met ? byMet_ : byOther_).roles |= role.bit;
    }
  }
  /// Nothing where it is clear, or a plane mirror.
  std::optional<glm::vec3> radianceOf(const Hit& hit, const MetSurface& surface, Side side,
                                      const Seers& seers, const glm::vec3& way) {
    SampleFootprint footprint = sampleFootprint(setting_, glm::vec3(glm::normalize(way)));
    const bool shown = mirror_ != nullptr;
    const glm::vec3 toViewer =
        shown ? surface.toViewer(side) : towardsEyes(setting_, seers.roles, surface, side);
    if (!shown && setting_.mirrors != nullptr && setting_.mirrors->at(hit.mesh, hit.triangle, toViewer) != 0)
      return {};
    const Shaded shaded =
        setting_.shader.shade(hit, toViewer, out_.counts.rays, shown, footprint.on(scene_, hit, -toViewer));
    if (shaded.alpha < kOpaqueAlpha) return {};
    if (!shown) return shaded.radiance();
    return setting_.shader.flatMirrorUnder(shaded.radiance(), seers.inMirror.mirror, seers.inMirror.toEye)
        .radiance();
  }

  const ColumnMarch::Setting& setting_;
  const ColumnCamera& camera_;
  const Scene& scene_;
  const PartAngles& parts_;
  double tolerance_;  ///< 1/m
  const FlatMirror* mirror_;
  Task& out_;
  double pitch_;
  glm::dvec2 ahead_{0};  ///< the camera's middle direction
  double widestCosine_ = -1;
  std::vector<std::vector<ColumnRole>> rolesOf_;  ///< by column
  std::vector<std::uint32_t> pixels_;             ///< of the facet
  Seers byMet_, byOther_;
  RegionSight::Hints hints_;
  MirrorSight::Hints mirrorHints_;
  std::vector<MirrorSight::Span> spans_;
};

/// Which instances may have a facet in the picture, so that a forest need not be looked through leaf by leaf.
class InstanceSight {
 public:
  InstanceSight(const Scene& scene, const ColumnCamera& camera)
      : scene_(scene), camera_(camera), bounds_(boundsOf(scene.prototypes)) {
    for (const Mesh& mesh : scene.prototypes) {
      double longest = 0;
      for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
          longest =
              std::max(longest, double(glm::distance(mesh.positions[t[k]], mesh.positions[t[(k + 1) % 3]])));
      longest_.push_back(longest);
    }
    const double middle = camera.azimuthAt(0.5 * camera.columns);
    ahead_ = {std::cos(middle), std::sin(middle)};
  }

  /// False where all its triangles are smaller than a part of a pixel: none is a line of its own. `straight`:
  /// also where it stands beside the picture; mirrors show what does.
  bool mayShow(std::uint32_t placed, bool straight) const {
    const Instance& instance = scene_.instances[placed - scene_.meshes.size()];
    const Bounds box = boundsOf(instance, bounds_[instance.prototype]);
    const glm::dvec3 eye = camera_.centreOfProjection;
    const glm::dvec3 nearest = glm::clamp(eye, glm::dvec3(box.min), glm::dvec3(box.max));
    const double part = std::min(camera_.columnPitch(), camera_.rowPitch()) / kCoverageParts;
    if (stretchOf(instance.worldFromPrototype) * longest_[instance.prototype] <
        part * glm::distance(nearest, eye))
      return false;
    if (!straight) return true;
    const glm::dvec2 to(glm::dvec3(box.centre()) - eye);
    const double reach = 0.5 * glm::length(glm::dvec2(box.size())), distance = glm::length(to);
    if (!(reach < distance)) return true;
    const double off = std::acos(std::clamp(glm::dot(to, ahead_) / distance, -1.0, 1.0));
    return off - std::asin(reach / distance) <= 0.5 * camera_.fovRadians + 2 * camera_.columnPitch();
  }

 private:
  /// No less than the most that a length grows: by Gershgorin's bound of the eigenvalues of its square.
  static double stretchOf(const glm::mat4x3& m) {
    double most = 0;
    for (int row = 0; row < 3; ++row) {
      double sum = 0;
      for (int column = 0; column < 3; ++column)
        sum += std::abs(glm::dot(glm::dvec3(m[row]), glm::dvec3(m[column])));
      most = std::max(most, sum);
    }
    return std::sqrt(most);
  }

  const Scene& scene_;
  const ColumnCamera& camera_;
  std::vector<Bounds> bounds_;   ///< by prototype, in its frame
  std::vector<double> longest_;  ///< side of a triangle, by prototype
  glm::dvec2 ahead_{0};
};

}  // namespace

void turnEdgeOnFacets(const ColumnMarch::Setting& setting, Capture& capture, TaskRunner& runner,
                      CaptureCounts& counts, const std::stop_token& stop) {
  const Scene& scene = setting.shader.scene().scene();
  struct Range {
    std::uint32_t mesh, first, end;
  };
  const InstanceSight sight(scene, setting.columns);
  const auto rangesOf = [&](bool straight) {
    std::vector<Range> ranges;
    for (std::uint32_t mesh = 0; mesh < scene.placedCount(); ++mesh) {
      const MaterialRules& rule = setting.shader.rules()[std::size_t(scene.meshOf(mesh).material)];
      if (rule.clear() || rule.masked) continue;
      if (scene.isInstance(mesh) && !sight.mayShow(mesh, straight)) continue;
      const std::size_t count = scene.meshOf(mesh).triangles.size();
      for (std::size_t first = 0; first < count; first += kTrianglesPerTask)
        ranges.push_back(
            {mesh, std::uint32_t(first), std::uint32_t(std::min(first + kTrianglesPerTask, count))});
    }
    return ranges;
  };
  const PartAngles parts(setting.columns);
  const int rows = setting.columns.rows;
  const auto turn = [&](const std::vector<const FlatMirror*>& mirrors, CaptureSamples& list) {
    if (mirrors.empty()) return;
    const std::vector<Range> ranges = rangesOf(mirrors.front() == nullptr);
    std::vector<Task> tasks(ranges.size() * mirrors.size());
    runner.parallelFor(tasks.size(), [&](std::size_t number) {
      const FlushDenormals flush;
      const Range& range = ranges[number % ranges.size()];
      Task task;
      EdgeOnFacets facets(setting, parts, capture.planeTolerance, mirrors[number / ranges.size()], task);
      for (std::uint32_t t = range.first; t < range.end && !stop.stop_requested(); ++t)
        facets.add(range.mesh, t);
      tasks[number] = std::move(task);
    });
    std::vector<TurnedSample> added;
    for (Task& task : tasks) {
      counts += task.counts;
      added.insert(added.end(), task.added.begin(), task.added.end());
      task = {};
    }
    if (added.empty() || stop.stop_requested()) return;
    mergeTurned(std::move(added), rows, list);
  };
  const auto before = countsOf(capture);
  turn({nullptr}, capture);
  const auto after = countsOf(capture);
  for (std::size_t layer = 0; layer < SampleCounts::kLayers; ++layer)
    counts.samples.kept[layer] += after.kept[layer] - before.kept[layer];
  std::array<bool, 256> shows{};
  for (const std::uint8_t mirror : capture.reflections.mirror) shows[mirror] = true;
  std::vector<const FlatMirror*> mirrors;
  if (setting.beyond != nullptr) mirrors = setting.beyond->mirrors();
  std::erase_if(mirrors, [&](const FlatMirror* mirror) { return !shows[mirror->number]; });
  const std::size_t shown = capture.reflections.sampleCount();
  turn(mirrors, capture.reflections);
  counts.reflections += capture.reflections.sampleCount() - shown;
}

}  // namespace acentric
