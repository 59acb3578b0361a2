#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <optional>

#include "engine/bake/bake.h"
#include "engine/bake/chunk_samples.h"
#include "engine/bake/column_march.h"
#include "engine/bake/column_rays.h"
#include "engine/bake/column_roles.h"
#include "engine/bake/edge_on.h"
#include "engine/bake/flush_denormals.h"
#include "engine/bake/silhouettes.h"
#include "engine/bake/surface_planes.h"
#include "engine/base/work_clock.h"
#include "engine/image/plane_numbers.h"

namespace acentric {
namespace {

constexpr int kColumnsPerChunk = 4;
/// Of a region, for what mirrors show: through a mirror, as through a window, places are seen from parts of a
/// region that lie between the test eyes.
constexpr int kEyesBeforeMirrors = 16;

/// The largest step of inverse distances that shifts no picture from a served region by more than `shift`
/// samples: a sample off by dw is seen off by dw times the eye's distance from the camera. 0: no step.
double distanceStepFor(const LayoutCamera& camera, const ColumnCamera& columns, double shift) {
  const double reach = reachOf(camera);
  if (!(reach > 0) || !(shift > 0)) return 0;
  const double largest = shift * std::min(columns.columnPitch(), columns.rowPitch()) / reach;
  return std::ldexp(1.0, std::ilogb(largest));
}

/// By role.
std::vector<glm::dvec3> middleEyes(const LayoutCamera& camera, double eyeZ) {
  std::vector<glm::dvec3> eyes;
  for (const Role& role : camera.roles) {
    glm::dvec2 sum(0);
    for (const glm::dvec2& corner : role.polygon.corners) sum += corner;
    eyes.emplace_back(sum / double(std::max<std::size_t>(role.polygon.corners.size(), 1)), eyeZ);
  }
  return eyes;
}

/// Opacity in few steps, which take a third of the bytes: what lies behind a clear sample is seen off by
/// 1/256 at most, and its own light stays as it is.
void roundAlpha(CaptureSamples& samples) {
  constexpr float kSteps = 128;
  for (HalfColour& colour : samples.colour) {
    const glm::vec4 exact = unpackColour(colour);
    if (!(exact.a > 0 && exact.a < 1)) continue;
    const float alpha = std::clamp(std::round(kSteps * exact.a), 1.0f, kSteps - 1) / kSteps;
    colour = packColour({glm::vec3(exact) * (exact.a / alpha), alpha});
  }
}

}  // namespace

std::uint64_t traceFirstRays(const RayScene& scene, const LayoutCamera& camera, const ColumnCamera& columns,
                             TaskRunner& runner) {
  std::atomic<std::uint64_t> hits = 0;
  const RowAngles rows(columns);
  runner.parallelFor(std::size_t(columns.columns), [&](std::size_t column) {
    const FlushDenormals flush;
    const glm::dvec2 direction = columns.directionAt(double(column) + 0.5);
    const auto roles = rolesAlong(camera, direction);
    std::uint64_t found = 0;
    for (int row = 0; row < columns.rows && !roles.empty(); row += RayPacket::kSize)
      found += std::uint64_t(
          scene.countHits(firstRays(columns, rows, direction, row,
                                    std::min(row + RayPacket::kSize, columns.rows), roles.front().exit)));
    hits += found;
  });
  return hits;
}

CaptureSeconds& CaptureSeconds::operator+=(const CaptureSeconds& other) {
  testEyes += other.testEyes;
  eyeViews += other.eyeViews;
  march += other.march;
  silhouettes += other.silhouettes;
  edgeOn += other.edgeOn;
  rounding += other.rounding;
  return *this;
}

CaptureCounts& CaptureCounts::operator+=(const CaptureCounts& other) {
  rays += other.rays;
  samples += other.samples;
  reflections += other.reflections;
  eyeViews += other.eyeViews;
  seconds += other.seconds;
  return *this;
}

CameraBaker::CameraBaker(const RayScene& scene, const BakeSettings& settings, MemoryBudget* budget)
    : scene_(scene),
      settings_(settings),
      ownBudget_(budget == nullptr ? std::make_unique<MemoryBudget>() : nullptr),
      budget_(budget == nullptr ? *ownBudget_ : *budget) {}
CameraBaker::~CameraBaker() = default;

TestEyeSummary CameraBaker::testEyes() const { return testEyes_ ? testEyes_->summary() : TestEyeSummary(); }

Result<Capture> CameraBaker::bake(const LayoutCamera& camera, const ColumnCamera& columns, TaskRunner& runner,
                                  CaptureCounts& counts, std::stop_token stop, const Traced& traced) {
  if (auto sound = settings_.check(); !sound) return tl::unexpected(sound.error());
  if (auto sound = columns.check(); !sound) return tl::unexpected(sound.error());
  const auto noMemory = [&] {
    return fail(ErrorKind::outOfSpace, "not enough memory for this capture; lower the samples per degree",
                scene_.scene().name);
  };
  const auto stopped = [] { return fail(ErrorKind::cancelled, "the bake was stopped"); };
  WorkClock watch;
  const auto split = [&watch](double& seconds) {
    seconds += watch.seconds();
    watch = {};
  };
  try {
    if (!shader_ || shaderStop_ != stop) {
      shader_ = std::make_unique<Shader>(scene_, settings_, stop);
      shaderStop_ = stop;
    }
    if (!mirrors_) mirrors_ = std::make_unique<FlatMirrors>(scene_.scene(), scene_.plan());
    if (!textures_ && shader_->detail().any())
      textures_ = std::make_unique<TexturePyramids>(scene_.scene(), shader_->detail(), runner);
    std::optional<RegionSight> sight;
    if (settings_.pruning) {
      const ElevationRange elevations{columns.bottomElevation, columns.topElevation};
      if (!testEyes_) testEyes_ = std::make_unique<TestEyes>(scene_, settings_);
      if (!views_) views_ = std::make_unique<EyeViews>(scene_, elevations, settings_, budget_);
      if (!skies_) skies_ = std::make_unique<RegionSkies>(scene_, settings_, budget_);
      watch = {};
      const int before = views_->traced();
      const double eyeZ = columns.centreOfProjection.z;
      if (!RegionSight::findEyes(camera, eyeZ, *testEyes_, runner, counts.rays, stop)) return stopped();
      split(counts.seconds.testEyes);
      sight =
          RegionSight::look(scene_, camera, eyeZ, *testEyes_, *views_, *skies_, runner, counts.rays, stop);
      if (!sight) return stopped();
      counts.eyeViews += views_->traced() - before;
      split(counts.seconds.eyeViews);
    }
    const FlatMirrors* mirrors = mirrors_->any() ? mirrors_.get() : nullptr;
    std::optional<RegionSight> intoMirrors;
    std::optional<MirrorSight> beyond;
    if (sight && mirrors != nullptr) {
      intoMirrors = sight->withEyes(kEyesBeforeMirrors, camera, columns.centreOfProjection.z, settings_);
      beyond.emplace(scene_, *mirrors, *intoMirrors);
    }
    const RowAngles rows(columns);
    const ColumnMarch::Setting setting{*shader_,
                                       camera,
                                       columns,
                                       rows,
                                       settings_,
                                       sight ? &*sight : nullptr,
                                       mirrors,
                                       beyond && beyond->any() ? &*beyond : nullptr,
                                       textures_ && textures_->any() ? textures_.get() : nullptr,
                                       distanceStepFor(camera, columns, settings_.distanceShift),
                                       middleEyes(camera, columns.centreOfProjection.z)};
    const std::size_t chunkCount = std::size_t((columns.columns + kColumnsPerChunk - 1) / kColumnsPerChunk);
    std::vector<ChunkSamples> chunks(chunkCount);
    std::atomic<std::size_t> total = 0;
    std::atomic<int> columnsTraced = 0;
    std::atomic<std::uint64_t> raysTraced = counts.rays.total();
    std::atomic<bool> full = false;  // of memory
    runner.parallelFor(chunkCount, [&](std::size_t chunk) {
      if (stop.stop_requested() || full || total > kMaxCaptureSamples) return;
      const FlushDenormals flush;
      const int first = int(chunk) * kColumnsPerChunk;
      const int last = std::min(first + kColumnsPerChunk, columns.columns);
      const std::size_t pixels = std::size_t(last - first) * std::size_t(columns.rows);
      try {
        ChunkSamples samples;  // not in `chunks`, where another thread works on the next
        samples.held = MemoryBudget::Share(budget_);
        if (!samples.held.setWhenRoom(pixels * ChunkSamples::kBytes, stop)) return;
        samples.reserve(pixels);
        ColumnMarch march(setting, samples);
        for (int column = first; column < last && march.run(column, stop);) ++column;
        samples.close();
        total += samples.row.size() + samples.reflections.row.size();
        columnsTraced += last - first;
        raysTraced += samples.counts.rays.total();
        chunks[chunk] = std::move(samples);
        if (traced) traced(columnsTraced, raysTraced);
      } catch (const std::bad_alloc&) {
        full = true;
      }
    });
    if (stop.stop_requested()) return stopped();
    if (full) return noMemory();
    if (total > kMaxCaptureSamples)
      return fail(ErrorKind::tooLarge, "more than 2^31 samples in one capture; lower the samples per degree",
                  scene_.scene().name);
    split(counts.seconds.march);
    CaptureCounts counted;
    for (const ChunkSamples& s : chunks) counted += s.counts;
    counts += counted;
    MemoryBudget::Share whole(budget_);
    if (!whole.setWhenRoom(total * ChunkSamples::kBytes, stop)) return stopped();
    Capture capture = joined(chunks, counted.reflections > 0, runner, stop);
    if (stop.stop_requested()) return stopped();
    capture.camera = columns;
    capture.distanceStep = setting.distanceStep;
    if (capture.background.runCount() > 0) capture.background.sky = shader_->sky();
    if (settings_.silhouettes) {
      split(counts.seconds.rounding);
      capture.planeTolerance = planeToleranceFor(camera, columns);
      traceSilhouettes(setting, capture, runner, counts, stop);
      split(counts.seconds.silhouettes);
      if (!stop.stop_requested()) turnEdgeOnFacets(setting, capture, runner, counts, stop);
      split(counts.seconds.edgeOn);
    }
    if (stop.stop_requested()) return stopped();
    if (!capture.hasSilhouettes() && !capture.reflections.hasSilhouettes()) capture.planeTolerance = 0;
    if (settings_.silhouettes)
      for (CaptureSamples* list : {static_cast<CaptureSamples*>(&capture), &capture.reflections}) {
        numberPlanes(*list, capture.distanceStep);
        roundPlanes(*list, columns, capture.distanceStep);
        roundAlpha(*list);
      }
    split(counts.seconds.rounding);
    return capture;
  } catch (const std::bad_alloc&) {
    return noMemory();
  }
}

}  // namespace acentric
