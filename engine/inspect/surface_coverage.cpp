#include "engine/inspect/surface_coverage.h"

#include <algorithm>
#include <cmath>

#include "engine/base/stopwatch.h"
#include "engine/inspect/sampling_rate.h"
#include "engine/layout/drawing_order.h"

namespace acentric {
namespace {

constexpr double kUnder = 0.5, kOver = 2.0;  // samples per pixel

SurfaceClass classOf(double ratio) {
  return ratio < kUnder ? SurfaceClass::under : ratio > kOver ? SurfaceClass::over : SurfaceClass::fine;
}

SurfaceCoverage emptyCoverage(const Scene& scene, const Layout& layout, const SurfaceCoverageOptions& options,
                              double area) {
  SurfaceCoverage coverage;
  coverage.wanted = options.points;
  coverage.squareMetresPerPoint = area / options.points;
  coverage.byMesh.resize(scene.meshes.size() + scene.prototypes.size());
  coverage.byMaterial.resize(scene.materials.size());
  coverage.seenByRegion.resize(layout.regions.size(), 0);
  coverage.missedByRegion.resize(layout.regions.size(), 0);
  return coverage;
}

void add(const Scene& scene, PointCoverage&& point, SurfaceCoverage& coverage) {
  coverage.all.add(point);
  const std::uint32_t placed = point.point.mesh;
  coverage
      .byMesh[scene.isInstance(placed)
                  ? scene.meshes.size() + scene.instances[placed - scene.meshes.size()].prototype
                  : placed]
      .add(point);
  const auto material = std::size_t(scene.meshOf(point.point.mesh).material);
  coverage.byMaterial[material].add(point);
  for (const std::uint32_t region : point.seenFrom) ++coverage.seenByRegion[region];
  for (const std::uint32_t region : point.missedFrom) ++coverage.missedByRegion[region];
  if (point.surfaceClass >= SurfaceClass::under)
    ++coverage.byRatio[std::size_t(ratioBin(point.samplesPerMetre / point.pixelsPerMetre))];
  coverage.points.push_back(std::move(point));
}

}  // namespace

const char* nameOf(SurfaceClass surfaceClass) {
  constexpr const char* kNames[] = {"unseen", "neverSampled", "local", "under", "fine", "over"};
  return kNames[std::size_t(surfaceClass)];
}

Status SurfaceCoverageOptions::check() const {
  if (points < 1 || points > 100'000'000)
    return fail(ErrorKind::invalidArgument, "points must lie in 1..100,000,000", "surface coverage");
  if (!(focalPixels > 0 && std::isfinite(focalPixels)))
    return fail(ErrorKind::invalidArgument, "the focal length must be a positive number of pixels",
                "surface coverage");
  return eyes.check();
}

void CoverageSummary::add(const PointCoverage& point) {
  ++points;
  ++ofClass[std::size_t(point.surfaceClass)];
  if (point.surfaceClass != SurfaceClass::unseen) ++seen;
  if (!point.missedFrom.empty() && point.missedFrom.size() < point.seenFrom.size()) ++partlyMissed;
  eyesSeeing += point.eyesSeeing;
  eyesMissing += point.eyesMissing;
}

double CoverageSummary::share(SurfaceClass surfaceClass) const {
  return seen > 0 ? double(ofClass[std::size_t(surfaceClass)]) / double(seen) : 0;
}

double CoverageSummary::missingShare() const {
  return eyesSeeing > 0 ? double(eyesMissing) / double(eyesSeeing) : 0;
}

int ratioBin(double samplesPerPixel) {
  if (!(samplesPerPixel > 0)) return 0;
  const double step = 2 * std::log2(samplesPerPixel) + 6;  // 0 at 1/8
  return std::clamp(int(std::floor(std::min(step, 1e6))) + 1, 0, kRatioBins - 1);
}

double ratioBinStart(int bin) { return bin <= 0 ? 0 : std::exp2(0.5 * (bin - 1) - 3); }

SurfaceJudge::SurfaceJudge(const CaptureReach& reach, const SurfaceCoverageOptions& options)
    : reach_(reach), options_(options), eyes_(standingEyes(reach.layout(), options.eyes)) {
  covers_.resize(eyes_.size());
  if (options.everyCover)
    for (std::size_t r = 0; r < eyes_.size(); ++r)
      if (!eyes_[r].empty()) covers_[r] = drawnCovers(reach.layout(), int(r));
}

/// Which cameras hold the point at hand: each is asked once for each of its roles.
struct SurfaceJudge::Sampling {
  struct Asked {
    int camera, role;
    bool holds;
  };
  std::vector<Asked> asked;

  bool holds(const CaptureReach& reach, const Piece& piece, const glm::dvec3& point) {
    for (const Asked& known : asked)
      if (known.camera == piece.camera && known.role == piece.role) return known.holds;
    asked.push_back({piece.camera, piece.role, reach.holds(piece.camera, point, piece.role)});
    return asked.back().holds;
  }
};

std::span<const Cover> SurfaceJudge::coversFor(std::size_t region, const glm::dvec3& eye,
                                               const glm::dvec2& place) const {
  if (options_.everyCover) return covers_[region];
  const glm::dvec2 way = place - glm::dvec2(eye);
  return {&chooseCover(reach_.layout().regions[region], {glm::dvec2(eye), {std::atan2(way.y, way.x), 0}}), 1};
}

PointCoverage SurfaceJudge::judge(const SurfacePoint& point) const {
  PointCoverage out;
  out.point = point;
  const glm::dvec2 place(point.position);
  Sampling sampling;
  const auto held = [&](const Cover& cover) {
    const Piece* piece = pieceAt(cover, place);
    return piece != nullptr && sampling.holds(reach_, *piece, point.position);
  };
  glm::dvec3 nearestEye(0);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < eyes_.size(); ++r) {
    if (eyes_[r].empty()) continue;
    const bool local = reach_.layout().regions[r].grown.containsClosed(place);
    std::uint32_t seeing = 0, missing = 0;
    for (const glm::dvec3& eye : eyes_[r]) {
      if (hidden(reach_.tracer(), eye, point.position)) continue;
      ++seeing;
      if (local) continue;
      if (!std::ranges::any_of(coversFor(r, eye, place), held)) {
        ++missing;
        continue;
      }
      const double distance = glm::distance(eye, point.position);
      if (distance < nearest) nearest = distance, nearestEye = eye, out.nearestRegion = int(r);
    }
    out.eyesSeeing += seeing;
    out.eyesMissing += missing;
    if (seeing > 0) out.seenFrom.push_back(std::uint32_t(r));
    if (missing > 0) out.missedFrom.push_back(std::uint32_t(r));
  }
  if (out.eyesSeeing == 0) return out;
  if (out.nearestRegion < 0) {
    out.surfaceClass = out.eyesMissing == out.eyesSeeing ? SurfaceClass::neverSampled : SurfaceClass::local;
    return out;
  }
  out.nearestDistance = nearest;
  const SurfaceAxes axes = axesOf(point.normal);
  const glm::dmat2 pixels = pixelsPerMetre(nearestEye, options_.focalPixels, point.position, axes);
  double best = -1;
  for (const Cover& cover : coversFor(std::size_t(out.nearestRegion), nearestEye, place)) {
    if (!held(cover)) continue;
    const int camera = pieceAt(cover, place)->camera;
    const RateAndNeed found =
        compareRates(samplesPerMetre(reach_.columns(camera), point.position, axes), pixels);
    if (!(found.ratio() > best)) continue;
    best = found.ratio();
    out.camera = camera;
    out.samplesPerMetre = found.rate, out.pixelsPerMetre = found.need;
  }
  out.surfaceClass = classOf(best);
  return out;
}

Result<SurfaceCoveragePtr> measureSurfaceCoverage(ScenePtr scene, const CaptureReach& reach,
                                                  const SurfaceCoverageOptions& options, TaskRunner& runner,
                                                  const std::function<void(const SurfaceCoveragePtr&)>& show,
                                                  std::stop_token stop) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  const SurfacePoints points(scene);
  if (!(points.area() > 0))
    return fail(ErrorKind::notFound, "the scene has no surface to judge", scene->name);
  const SurfaceJudge judge(reach, options);
  SurfaceCoverage coverage = emptyCoverage(*scene, reach.layout(), options, points.area());

  const Stopwatch watch;
  double shownAt = 0, shownLater = options.firstSeconds;
  std::size_t batch = 8 * std::size_t(runner.threads());
  std::vector<PointCoverage> judged;
  while (int(coverage.points.size()) < options.points) {
    const double begun = watch.seconds();
    const std::size_t done = coverage.points.size();
    const std::size_t count = std::min(batch, std::size_t(options.points) - done);
    judged.assign(count, {});
    runner.parallelFor(count, [&](std::size_t i) {
      if (!stop.stop_requested()) judged[i] = judge.judge(points.at(done + i));
    });
    if (stop.stop_requested())
      return fail(ErrorKind::cancelled, "the judging of surfaces was stopped", scene->name);
    for (PointCoverage& point : judged) add(*scene, std::move(point), coverage);
    coverage.complete = int(coverage.points.size()) == options.points;
    // Batches as long as a third of the time between snapshots: neither late nor busy with the change-over.
    const double now = watch.seconds(), perPoint = (now - begun) / double(count);
    batch =
        std::size_t(std::clamp(shownLater / 3 / std::max(perPoint, 1e-9), 1.0 * runner.threads(), 65536.0));
    if (show && !coverage.complete && now - shownAt >= shownLater) {
      show(std::make_shared<const SurfaceCoverage>(coverage));
      shownAt = watch.seconds();
      shownLater = options.laterSeconds;
    }
  }
  const SurfaceCoveragePtr result = std::make_shared<const SurfaceCoverage>(std::move(coverage));
  if (show) show(result);
  return result;
}

}  // namespace acentric
