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

/// Beyond one at each corner, which every triangle has.
constexpr std::uint64_t kMaxSamples = 60'000'000;
/// In all.
constexpr std::uint64_t kMostNumbered = std::uint64_t(1) << 31;
constexpr std::size_t kSamplesPerChunk = 2048;
constexpr std::uint32_t kMaxResolution = 256;
constexpr std::uint32_t kFiner = 4;  ///< times, where light changes abruptly

struct TriangleRef {
  std::uint32_t mesh = 0;
  std::uint32_t triangle = 0;
  std::uint32_t sceneTriangle = 0;
};

class SurfaceLightBaker {
 public:
  SurfaceLightBaker(const RayScene& scene, const DrawnScene& drawn, const std::vector<LightSides>& wanted,
                    const std::vector<glm::vec3>& viewer, const BakeSettings& settings,
                    const std::stop_token& stop = {})
      : drawn_(drawn),
        scene_(drawn.scene()),
        shader_(scene, settings, stop),
        wanted_(wanted),
        viewer_(viewer),
        rules_(materialRules(scene.scene(), scene.plan())),
        firstTriangles_(scene_.firstTriangles()),
        texel_(settings.surfaceTexel) {}

  /// Chooses resolutions; a texel that asks for more than the limit grows until it fits.
  Status layOut() {
    const std::size_t count = scene_.triangleCount();
    light_.resolution.assign(count, 0);
    light_.hasBack.assign(count, 0);
    constexpr double kGrowth = 1.2;
    eachWanted(0, count, [&](const TriangleRef& ref) {
      cornerSamples_ += surfaceSampleCount(1) * (hasBack(ref) ? 2 : 1);
    });
    if (cornerSamples_ + kMaxSamples > kMostNumbered)
      return fail(
          ErrorKind::tooLarge,
          fmt::format(
              "surface light has {} samples with one at each corner of what regions draw, and at most "
              "{} can be. Draw a smaller outline, choose a smaller near band, or simplify the scene",
              cornerSamples_, kMostNumbered - kMaxSamples),
          scene_.name);
    while (samplesAt(texel_) > cornerSamples_ + kMaxSamples) texel_ *= kGrowth;
    eachWanted(0, count, [&](const TriangleRef& ref) {
      light_.resolution[ref.sceneTriangle] = std::uint16_t(resolution(ref, texel_));
      light_.hasBack[ref.sceneTriangle] = hasBack(ref) ? 1 : 0;
    });
    place();
    return {};
  }

  /// Lays out light that is baked anew, with finer grids where it is abrupt. Those triangles are black then,
  /// and to be baked again.
  void refine() {
    const SurfaceLight coarse = std::move(light_);
    const float usual = usualLight(coarse);
    const std::size_t count = coarse.resolution.size();
    light_.hasBack = coarse.hasBack;
    isFiner_.assign(count, 0);
    for (std::uint32_t t = 0; t < count; ++t)
      if (isWanted(t)) isFiner_[t] = isAbrupt(coarse, t, usual);
    for (std::uint32_t finer = kFiner; finer >= 1; finer /= 2) {
      light_.resolution = coarse.resolution;
      std::uint64_t samples = 0;
      for (std::uint32_t t = 0; t < count; ++t) {
        if (!isWanted(t)) continue;
        std::uint16_t& resolution = light_.resolution[t];
        if (isFiner_[t] != 0) resolution = std::uint16_t(std::min(resolution * finer, kMaxResolution));
        samples += samplesOf(light_, t);
      }
      if (samples <= cornerSamples_ + kMaxSamples) break;
    }
    place();
    for (std::uint32_t t = 0; t < count; ++t) {
      if (!isWanted(t)) continue;
      isFiner_[t] = light_.resolution[t] != coarse.resolution[t];
      if (!isFiner_[t])
        std::copy(coarse.light.begin() + coarse.firstSample[t],
                  coarse.light.begin() + coarse.firstSample[t + 1],
                  light_.light.begin() + light_.firstSample[t]);
    }
  }

  /// Runs of triangles of about equal work, by scene-wide number: [starts[i], starts[i + 1]).
  std::vector<std::size_t> chunkStarts() const {
    std::vector<std::size_t> starts{0};
    std::size_t samples = 0, last = 0;
    for (std::uint32_t t = 0; t < light_.resolution.size(); ++t) {
      if (!isWanted(t)) continue;
      last = t + 1;
      samples += light_.firstSample[t + 1] - light_.firstSample[t];
      if (samples < kSamplesPerChunk) continue;
      starts.push_back(last);
      samples = 0;
    }
    if (starts.back() < last) starts.push_back(last);
    return starts;
  }

  /// Is one of a run's triangles among these?
  bool holdsAny(std::size_t first, std::size_t last, const std::vector<std::uint8_t>& triangles) const {
    for (std::size_t t = first; t < last; ++t)
      if (isWanted(t) && triangles[t] != 0) return true;
    return false;
  }

  bool refines(std::size_t first, std::size_t last) const { return holdsAny(first, last, isFiner_); }

  void bakeTriangles(std::size_t first, std::size_t last, const std::stop_token& stop) {
    eachWanted(first, last, [&](const TriangleRef& ref) {
      if (isFiner_.empty() || isFiner_[ref.sceneTriangle] != 0) bakeTriangle(ref, stop);
    });
  }

  /// The samples of a run of triangles lie one behind the other.
  std::span<HalfColour> samplesOf(std::size_t first, std::size_t last) {
    const std::uint32_t begin = light_.firstSample[first], end = light_.firstSample[last];
    return std::span(light_.light).subspan(begin, end - begin);
  }

  double texel() const { return texel_; }
  SurfaceLight take() { return std::move(light_); }

 private:
  bool isWanted(std::size_t sceneTriangle) const { return wanted_[sceneTriangle] != LightSides::none; }
  /// Calls `visit` for each triangle that is wanted, of those numbered [first, last).
  template <class Visit>
  void eachWanted(std::size_t first, std::size_t last, const Visit& visit) const {
    auto mesh = std::uint32_t(std::ranges::upper_bound(firstTriangles_, first) - firstTriangles_.begin()) - 1;
    for (std::size_t t = first; t < last; ++t) {
      while (t >= firstTriangles_[mesh + 1]) ++mesh;
      if (isWanted(t)) visit(TriangleRef{mesh, std::uint32_t(t) - firstTriangles_[mesh], std::uint32_t(t)});
    }
  }
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
  const Mesh& meshOf(const TriangleRef& ref) const { return scene_.meshes[ref.mesh]; }
  std::uint32_t resolution(const TriangleRef& ref, double texel) const {
    // Unlit surfaces have the light 1 everywhere.
    if (rules_[std::size_t(meshOf(ref).material)].unlit) return 1;
    return resolutionFor(meshOf(ref), ref.triangle, texel, kMaxResolution);
  }
  bool hasBack(const TriangleRef& ref) const {
    const auto material = std::size_t(meshOf(ref).material);
    return wanted_[ref.sceneTriangle] == LightSides::both || scene_.materials[material].doubleSided ||
           rules_[material].clear();
  }
  std::uint64_t samplesAt(double texel) const {
    std::uint64_t sum = 0;
    eachWanted(0, wanted_.size(), [&](const TriangleRef& ref) {
      sum += std::uint64_t(surfaceSampleCount(resolution(ref, texel))) * (hasBack(ref) ? 2 : 1);
    });
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
          const glm::vec2 at = surfaceSamplePlace(r, i, j);
          const DrawnScene::Place met = drawn_.traced(ref.mesh, ref.triangle, at);
          const Hit hit{0, met.placed, met.triangle, met.barycentric, normal};
          const glm::vec3 position = mesh.positions[corners.x] * (1 - at.x - at.y) +
                                     mesh.positions[corners.y] * at.x + mesh.positions[corners.z] * at.y;
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

  const DrawnScene& drawn_;
  const Scene& scene_;  ///< of what is drawn
  Shader shader_;
  const std::vector<LightSides>& wanted_;  ///< by scene triangle, as is `viewer_`
  const std::vector<glm::vec3>& viewer_;
  std::vector<MaterialRules> rules_;
  std::vector<std::uint32_t> firstTriangles_;
  double texel_;  ///< metres
  SurfaceLight light_;
  std::uint64_t cornerSamples_ = 0;    ///< one at each corner
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

Result<SurfaceLight> bakeSurfaceLight(const RayScene& scene, const DrawnScene& drawn,
                                      const std::vector<LightSides>& wanted,
                                      const std::vector<glm::vec3>& viewer, const BakeSettings& settings,
                                      TaskRunner& runner, const Progress& progress, std::stop_token stop,
                                      SurfaceLightParts* parts) {
  const std::size_t triangles = drawn.scene().triangleCount();
  require(wanted.size() == triangles && viewer.size() == triangles,
          "surface light is asked for triangle by triangle");
  if (auto sound = settings.check(); !sound) return tl::unexpected(sound.error());
  try {
    SurfaceLightBaker baker(scene, drawn, wanted, viewer, settings, stop);
    if (auto laidOut = baker.layOut(); !laidOut) return tl::unexpected(laidOut.error());
    const auto starts = baker.chunkStarts();
    const std::string coarse =
        baker.texel() > settings.surfaceTexel
            ? fmt::format(
                  "baking surface light (texel raised to {:.3g} m to stay within {} million samples "
                  "beside those at corners)",
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

Result<SurfaceLight> layOutSurfaceLight(const RayScene& scene, const DrawnScene& drawn,
                                        const std::vector<LightSides>& wanted, const BakeSettings& settings) {
  require(wanted.size() == drawn.scene().triangleCount(), "surface light is asked for triangle by triangle");
  if (auto sound = settings.check(); !sound) return tl::unexpected(sound.error());
  try {
    const std::vector<glm::vec3> noViewer;
    SurfaceLightBaker baker(scene, drawn, wanted, noViewer, settings);
    if (auto laidOut = baker.layOut(); !laidOut) return tl::unexpected(laidOut.error());
    return baker.take();
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory for surface light; raise the surface texel",
                scene.scene().name);
  }
}

}  // namespace acentric
