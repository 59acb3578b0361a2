#include "engine/bake/surface_light_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <new>
#include <optional>
#include <span>

#include "engine/bake/abrupt_light.h"
#include "engine/bake/flush_denormals.h"
#include "engine/bake/gathered_light.h"
#include "engine/bake/shading.h"
#include "engine/bake/surface.h"
#include "engine/base/contract.h"
#include "engine/base/stopwatch.h"

namespace acentric {
namespace {

/// Of the ten bits behind the first six are kept: as good as the codes of a display, and half of the bytes.
constexpr int kUnusedBits = 4;
HalfColour packLight(const glm::vec3& light) { return roundedLight(packColour({light, 1}), kUnusedBits); }

constexpr std::uint64_t kMaxSamples = 60'000'000;
constexpr std::size_t kSamplesPerChunk = 2048;
constexpr std::uint32_t kMaxResolution = 256;
constexpr std::uint32_t kFiner = 4;  ///< times, where light changes abruptly

struct TriangleRef {
  std::uint32_t mesh = 0;
  std::uint32_t triangle = 0;
  std::uint32_t sceneTriangle = 0;
  LightSides sides = LightSides::front;
};

struct Plan {
  std::vector<TriangleRef> triangles;  ///< wanted ones, in scene order
  double texel = 0;
};

class SurfaceLightBaker {
 public:
  SurfaceLightBaker(const RayScene& scene, const std::vector<LightSides>& wanted,
                    const std::vector<glm::vec3>& viewer, const BakeSettings& settings,
                    const std::stop_token& stop = {})
      : scene_(scene),
        shader_(scene, settings, stop),
        viewer_(viewer),
        rules_(materialRules(scene.scene(), scene.plan())) {
    plan_.texel = settings.surfaceTexel;
    std::uint32_t number = 0;
    for (std::uint32_t m = 0; m < scene.scene().meshes.size(); ++m)
      for (std::uint32_t t = 0; t < scene.scene().meshes[m].triangles.size(); ++t, ++number)
        if (wanted[number] != LightSides::none) plan_.triangles.push_back({m, t, number, wanted[number]});
  }

  /// Chooses resolutions; a texel that asks for more than the limit grows until it fits.
  Status layOut() {
    const std::size_t count = scene_.scene().triangleCount();
    light_.resolution.assign(count, 0);
    light_.hasBack.assign(count, 0);
    constexpr double kGrowth = 1.2;
    const double coarsest = glm::length(scene_.scene().bounds.size());  // one sample a corner
    while (samplesAt(plan_.texel) > kMaxSamples) {
      plan_.texel *= kGrowth;
      if (plan_.texel > coarsest)
        return fail(
            ErrorKind::tooLarge,
            fmt::format("{} triangles need surface light; even one sample a corner is above the limit of {}. "
                        "Remove regions or simplify the scene",
                        plan_.triangles.size(), kMaxSamples),
            scene_.scene().name);
    }
    for (const TriangleRef& ref : plan_.triangles) {
      light_.resolution[ref.sceneTriangle] = std::uint16_t(resolution(ref, plan_.texel));
      light_.hasBack[ref.sceneTriangle] = hasBack(ref) ? 1 : 0;
    }
    place();
    return {};
  }

  /// Lays out light that is baked anew, with finer grids where it is abrupt. Those triangles are black then,
  /// and to be baked again.
  void refine() {
    const SurfaceLight coarse = std::move(light_);
    const float usual = usualLight(coarse);
    light_.hasBack = coarse.hasBack;
    isFiner_.assign(coarse.resolution.size(), 0);
    for (const TriangleRef& ref : plan_.triangles)
      isFiner_[ref.sceneTriangle] = isAbrupt(coarse, ref.sceneTriangle, usual);
    for (std::uint32_t finer = kFiner; finer >= 1; finer /= 2) {
      light_.resolution = coarse.resolution;
      std::uint64_t samples = 0;
      for (const TriangleRef& ref : plan_.triangles) {
        std::uint16_t& resolution = light_.resolution[ref.sceneTriangle];
        if (isFiner_[ref.sceneTriangle] != 0)
          resolution = std::uint16_t(std::min(resolution * finer, kMaxResolution));
        samples += samplesOf(light_, ref.sceneTriangle);
      }
      if (samples <= kMaxSamples) break;
    }
    place();
    for (const TriangleRef& ref : plan_.triangles) {
      const std::uint32_t t = ref.sceneTriangle;
      isFiner_[t] = light_.resolution[t] != coarse.resolution[t];
      if (!isFiner_[t])
        std::copy(coarse.light.begin() + coarse.firstSample[t],
                  coarse.light.begin() + coarse.firstSample[t + 1],
                  light_.light.begin() + light_.firstSample[t]);
    }
  }

  /// Runs of triangles of about equal work: [starts[i], starts[i + 1]).
  std::vector<std::size_t> chunkStarts() const {
    std::vector<std::size_t> starts{0};
    std::size_t samples = 0;
    for (std::size_t i = 0; i < plan_.triangles.size(); ++i) {
      const std::uint32_t t = plan_.triangles[i].sceneTriangle;
      samples += light_.firstSample[t + 1] - light_.firstSample[t];
      if (samples < kSamplesPerChunk) continue;
      starts.push_back(i + 1);
      samples = 0;
    }
    if (starts.back() != plan_.triangles.size()) starts.push_back(plan_.triangles.size());
    return starts;
  }

  /// Is one of a run's triangles among these?
  bool holdsAny(std::size_t first, std::size_t last, const std::vector<std::uint8_t>& triangles) const {
    return std::any_of(plan_.triangles.begin() + std::ptrdiff_t(first),
                       plan_.triangles.begin() + std::ptrdiff_t(last),
                       [&](const TriangleRef& ref) { return triangles[ref.sceneTriangle] != 0; });
  }

  bool refines(std::size_t first, std::size_t last) const { return holdsAny(first, last, isFiner_); }

  void bakeTriangles(std::size_t first, std::size_t last, const std::stop_token& stop) {
    for (std::size_t i = first; i < last; ++i)
      if (isFiner_.empty() || isFiner_[plan_.triangles[i].sceneTriangle] != 0)
        bakeTriangle(plan_.triangles[i], stop);
  }

  /// The samples of a run of triangles lie one behind the other.
  std::span<HalfColour> samplesOf(std::size_t first, std::size_t last) {
    const std::uint32_t begin = light_.firstSample[plan_.triangles[first].sceneTriangle];
    const std::uint32_t end = light_.firstSample[plan_.triangles[last - 1].sceneTriangle + 1];
    return std::span(light_.light).subspan(begin, end - begin);
  }

  double texel() const { return plan_.texel; }
  SurfaceLight take() { return std::move(light_); }

 private:
  static std::uint64_t samplesOf(const SurfaceLight& light, std::uint32_t t) {
    return light.resolution[t] == 0
               ? 0
               : std::uint64_t(surfaceSampleCount(light.resolution[t])) * (light.hasBack[t] ? 2 : 1);
  }
  /// Gives each triangle its samples, black.
  void place() {
    const std::size_t count = light_.resolution.size();
    light_.firstSample.assign(count + 1, 0);
    for (std::uint32_t t = 0; t < count; ++t)
      light_.firstSample[t + 1] = light_.firstSample[t] + std::uint32_t(samplesOf(light_, t));
    light_.light.assign(light_.firstSample[count], HalfColour(0));
  }
  const Mesh& meshOf(const TriangleRef& ref) const { return scene_.scene().meshes[ref.mesh]; }
  std::uint32_t resolution(const TriangleRef& ref, double texel) const {
    // Unlit surfaces have the light 1 everywhere.
    if (rules_[std::size_t(meshOf(ref).material)].unlit) return 1;
    return resolutionFor(meshOf(ref), ref.triangle, texel, kMaxResolution);
  }
  bool hasBack(const TriangleRef& ref) const {
    const auto material = std::size_t(meshOf(ref).material);
    return ref.sides == LightSides::both || scene_.scene().materials[material].doubleSided ||
           rules_[material].clear();
  }
  std::uint64_t samplesAt(double texel) const {
    std::uint64_t sum = 0;
    for (const TriangleRef& ref : plan_.triangles)
      sum += std::uint64_t(surfaceSampleCount(resolution(ref, texel))) * (hasBack(ref) ? 2 : 1);
    return sum;
  }

  void bakeTriangle(const TriangleRef& ref, const std::stop_token& stop) {
    const Mesh& mesh = meshOf(ref);
    const glm::uvec3& corners = mesh.triangles[ref.triangle];
    const glm::vec3 normal = triangleNormal(mesh, ref.triangle);
    const std::uint32_t r = light_.resolution[ref.sceneTriangle];
    const int sides = light_.hasBack[ref.sceneTriangle] ? 2 : 1;
    RayCounts rays;
    for (int side = 0; side < sides; ++side) {
      const glm::vec3 facing = side == 0 ? normal : -normal;
      const std::uint32_t first =
          light_.firstSample[ref.sceneTriangle] + std::uint32_t(side) * surfaceSampleCount(r);
      for (std::uint32_t i = 0; i <= r; ++i) {
        for (std::uint32_t j = 0; i + j <= r; ++j) {
          if (stop.stop_requested()) return;
          const Hit hit{0, ref.mesh, ref.triangle, surfaceSamplePlace(r, i, j), normal};
          const glm::vec3 position = mesh.positions[corners.x] * (1 - hit.barycentric.x - hit.barycentric.y) +
                                     mesh.positions[corners.y] * hit.barycentric.x +
                                     mesh.positions[corners.z] * hit.barycentric.y;
          const Shaded shaded = shader_.shade(hit, toViewer(ref.sceneTriangle, position, facing), rays);
          light_.light[first + surfaceSampleIndex(r, i, j)] = packLight(shaded.light);
        }
      }
    }
  }

  /// Towards the eye, mirrored to this side if the eye stands behind the surface.
  glm::vec3 toViewer(std::uint32_t sceneTriangle, const glm::vec3& position, const glm::vec3& facing) const {
    const glm::vec3 way = viewer_[sceneTriangle] - position;
    const float square = glm::dot(way, way);
    if (!(square > 0) || !std::isfinite(square)) return facing;
    const glm::vec3 unit = way / std::sqrt(square);
    const float height = glm::dot(unit, facing);
    return height > 0 ? unit : height < 0 ? unit - 2 * height * facing : facing;
  }

  const RayScene& scene_;
  Shader shader_;
  const std::vector<glm::vec3>& viewer_;
  std::vector<MaterialRules> rules_;
  Plan plan_;
  SurfaceLight light_;
  std::vector<std::uint8_t> isFiner_;  ///< by scene triangle, once light is refined; empty before
};

/// What is kept of a bake while it runs.
class PartKeeper {
 public:
  /// `isFine`: of the runs as they are laid out when light is refined, which are counted on behind the
  /// others.
  PartKeeper(SurfaceLightBaker& baker, const std::vector<std::size_t>& starts, bool isFine,
             SurfaceLightParts* parts)
      : baker_(baker),
        starts_(starts),
        firstRun_(isFine ? std::uint32_t(starts.size() - 1) : 0),
        parts_(parts),
        known_(starts.size() - 1, 0) {
    if (isFine)
      for (std::size_t run = 0; run < known_.size(); ++run)
        known_[run] = !baker_.refines(starts_[run], starts_[run + 1]);
    if (parts_ == nullptr) return;
    if (!isFine) parts_->resumed = 0;
    for (const SurfaceLightPart& part : parts_->known) take(part);
    if (isFine) parts_->known.clear();
    if (parts_->only.empty()) return;
    for (std::size_t run = 0; run < known_.size(); ++run)
      leftOut_.push_back(!baker_.holdsAny(starts_[run], starts_[run + 1], parts_->only));
  }

  /// Is this run to be baked?
  bool wants(std::size_t run) const { return known_[run] == 0 && (leftOut_.empty() || !leftOut_[run]); }
  std::size_t wantedRuns() const {
    std::size_t count = 0;
    for (std::size_t run = 0; run < known_.size(); ++run) count += wants(run) ? 1 : 0;
    return count;
  }

  /// By any thread, when the run is baked.
  Status done(std::size_t run) {
    if (parts_ == nullptr || !parts_->keep) return {};
    const std::lock_guard lock(mutex_);
    if (!kept_) return kept_;
    baked_.push_back(std::uint32_t(run));
    if (watch_ && watch_->seconds() < parts_->secondsBetween) return {};
    kept_ = keep();
    watch_.emplace();
    return kept_;
  }
  /// When no thread bakes any more: where runs are left out, somebody comes back for those that are baked.
  Status end() { return leftOut_.empty() || baked_.empty() || !parts_->keep ? Status() : keep(); }

 private:
  std::span<HalfColour> samplesOf(std::size_t run) {
    return baker_.samplesOf(starts_[run], starts_[run + 1]);
  }
  void take(const SurfaceLightPart& part) {
    std::size_t at = 0;
    for (std::size_t r = 0; r < part.runs.size() && r < part.sizes.size(); ++r) {
      const std::size_t run = std::size_t(part.runs[r]) - firstRun_, size = part.sizes[r], from = at;
      if (size > part.light.size() - at) return;
      at += size;
      if (run >= known_.size()) continue;  // also those before the first
      const std::span<HalfColour> samples = samplesOf(run);
      if (samples.size() != size) return;
      std::copy_n(part.light.begin() + std::ptrdiff_t(from), size, samples.begin());
      if (known_[run] == 0) parts_->resumed += size;
      known_[run] = 1;
    }
  }
  Status keep() {
    std::ranges::sort(baked_);
    SurfaceLightPart part;
    for (const std::uint32_t run : baked_) {
      const std::span<const HalfColour> samples = samplesOf(run);
      part.runs.push_back(firstRun_ + run);
      part.sizes.push_back(std::uint32_t(samples.size()));
      part.light.insert(part.light.end(), samples.begin(), samples.end());
    }
    baked_.clear();
    return parts_->keep(part);
  }

  SurfaceLightBaker& baker_;
  const std::vector<std::size_t>& starts_;
  std::uint32_t firstRun_;
  SurfaceLightParts* parts_;
  std::vector<char> known_;    ///< by run; nobody writes it once the bake has begun
  std::vector<bool> leftOut_;  ///< by run; empty: none is
  std::mutex mutex_;
  std::vector<std::uint32_t> baked_;  ///< and not kept yet
  std::optional<Stopwatch> watch_;    ///< since something was kept
  Status kept_;
};

Status bakeRuns(SurfaceLightBaker& baker, const std::vector<std::size_t>& starts, PartKeeper& keeper,
                TaskRunner& runner, const Progress& progress, const std::string& stage,
                const std::stop_token& stop) {
  std::mutex progressMutex;
  const std::size_t total = keeper.wantedRuns();
  std::size_t done = 0;
  Status kept;
  std::atomic<bool> failed = false;
  runner.parallelFor(starts.size() - 1, [&](std::size_t run) {
    if (stop.stop_requested() || failed || !keeper.wants(run)) return;
    const FlushDenormals flush;
    baker.bakeTriangles(starts[run], starts[run + 1], stop);
    if (stop.stop_requested()) return;  // the run may be half baked
    const Status stored = keeper.done(run);
    const std::lock_guard lock(progressMutex);
    if (!stored && !failed.exchange(true)) kept = stored;
    if (progress) progress({double(++done), double(total), stage});
  });
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "the bake was stopped");
  return kept ? keeper.end() : kept;
}

}  // namespace

Result<SurfaceLight> bakeSurfaceLight(const RayScene& scene, const std::vector<LightSides>& wanted,
                                      const std::vector<glm::vec3>& viewer, const BakeSettings& settings,
                                      TaskRunner& runner, const Progress& progress, std::stop_token stop,
                                      SurfaceLightParts* parts) {
  const std::size_t triangles = scene.scene().triangleCount();
  require(wanted.size() == triangles && viewer.size() == triangles,
          "surface light is asked for triangle by triangle");
  if (auto sound = settings.check(); !sound) return tl::unexpected(sound.error());
  try {
    SurfaceLightBaker baker(scene, wanted, viewer, settings, stop);
    if (auto laidOut = baker.layOut(); !laidOut) return tl::unexpected(laidOut.error());
    const auto starts = baker.chunkStarts();
    const std::string coarse =
        baker.texel() > settings.surfaceTexel
            ? fmt::format("baking surface light (texel raised to {:.3g} m to stay within {} million samples)",
                          baker.texel(), kMaxSamples / 1'000'000)
            : std::string("baking surface light");
    const bool isWhole = parts == nullptr || parts->only.empty();
    for (const bool isFine : {false, true}) {
      if (isFine && !isWhole) break;
      if (isFine) baker.refine();
      const std::string stage = isFine ? "baking surface light at the edges of shadows" : coarse;
      PartKeeper keeper(baker, starts, isFine, parts);
      if (Status done = bakeRuns(baker, starts, keeper, runner, progress, stage, stop); !done)
        return tl::unexpected(done.error());
    }
    return baker.take();
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory for surface light; raise the surface texel",
                scene.scene().name);
  }
}

Result<SurfaceLight> layOutSurfaceLight(const RayScene& scene, const std::vector<LightSides>& wanted,
                                        const BakeSettings& settings) {
  require(wanted.size() == scene.scene().triangleCount(), "surface light is asked for triangle by triangle");
  if (auto sound = settings.check(); !sound) return tl::unexpected(sound.error());
  try {
    const std::vector<glm::vec3> noViewer;
    SurfaceLightBaker baker(scene, wanted, noViewer, settings);
    if (auto laidOut = baker.layOut(); !laidOut) return tl::unexpected(laidOut.error());
    return baker.take();
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory for surface light; raise the surface texel",
                scene.scene().name);
  }
}

}  // namespace acentric
