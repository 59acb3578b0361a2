// One capture: per pixel a march along the camera's ray through the exits of the regions it serves.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>

#include "engine/bake/bake.h"
#include "engine/bake/flush_denormals.h"
#include "engine/bake/shading.h"

namespace acentric {
namespace {

constexpr int kColumnsPerChunk = 4;
/// Surfaces met along one ray at most; a guard, not a quality setting.
constexpr int kMaxMarch = 4096;

/// Samples of some neighbouring columns, in capture order.
struct Samples {
  std::vector<std::uint32_t> perColumn;
  std::vector<std::uint16_t> row;
  std::vector<float> inverseDistance;
  std::vector<HalfColour> colour;
  RayCounts rays;

  void add(int r, float w, const glm::vec3& radiance, float alpha) {
    row.push_back(std::uint16_t(r));
    inverseDistance.push_back(w);
    colour.push_back(packColour({radiance, alpha}));
  }
};

/// Plan distances at which a column's ray leaves each served polygon, sorted, each once.
std::vector<double> exitDistances(const LayoutCamera& camera, const glm::dvec2& origin,
                                  const glm::dvec2& direction) {
  std::vector<double> exits;
  const double nearest = nearestSample(camera);
  for (const ConvexPolygon& polygon : camera.served) {
    const auto span = polygon.raySpan(origin, direction);
    exits.push_back(span ? std::max(span->second, nearest) : nearest);
  }
  std::sort(exits.begin(), exits.end());
  exits.erase(std::unique(exits.begin(), exits.end()), exits.end());
  return exits;
}

class PixelMarch {
 public:
  PixelMarch(const Shader& shader, const BakeSettings& settings)
      : shader_(shader), maxLayers_(settings.maxLayers) {}

  /// `exits` sorted. Each surface found beyond some exits serves all of those; an opaque one settles them,
  /// and the march goes on from the next exit beyond it.
  void run(const glm::dvec3& origin, const glm::dvec2& columnDirection, double elevation, int row,
           const std::vector<double>& exits, Samples& out) const {
    const double flat = std::cos(elevation);
    const glm::vec3 direction(columnDirection.x * flat, columnDirection.y * flat, std::sin(elevation));
    Ray ray{glm::vec3(origin), direction, float(exits.front() / flat)};
    std::size_t next = 0;  // first exit not yet settled
    int stored = 0;
    for (int step = 0; step < kMaxMarch && stored < maxLayers_; ++step) {
      ++out.rays.primary;
      const Hit hit = shader_.scene().trace(ray);
      if (!hit.found()) {
        out.add(row, 0, shader_.background(direction), 1);
        return;
      }
      const Shaded shaded = shader_.shade(hit, -direction, out.rays);
      const bool opaque = shaded.alpha >= kOpaqueAlpha;
      const double horizontal = double(hit.distance) * flat;
      // The last place is kept for an opaque surface: a blended sample never stands alone.
      if (opaque || (shaded.alpha >= kInvisibleAlpha && stored + 1 < maxLayers_)) {
        out.add(row, float(1 / horizontal), shaded.radiance(), opaque ? 1 : shaded.alpha);
        ++stored;
      }
      ray.nearest = justBehind(hit.distance);
      if (!opaque) continue;
      // A surface on the border itself settles its region too, whichever way the distance was rounded.
      while (next < exits.size() && exits[next] < horizontal * (1 + 1e-6)) ++next;
      if (next == exits.size()) return;
      ray.nearest = std::max(ray.nearest, float(exits[next] / flat));
    }
  }

 private:
  const Shader& shader_;
  int maxLayers_;
};

void bakeColumns(const Shader& shader, const LayoutCamera& camera, const ColumnCamera& columns,
                 const BakeSettings& settings, int first, int last, const std::stop_token& stop,
                 Samples& out) {
  const PixelMarch march(shader, settings);
  const glm::dvec3& origin = columns.centreOfProjection;
  for (int k = first; k < last; ++k) {
    const std::size_t before = out.row.size();
    const glm::dvec2 direction = columns.directionAt(k + 0.5);
    const auto exits = exitDistances(camera, glm::dvec2(origin), direction);
    for (int r = 0; r < columns.rows && !exits.empty(); ++r) {
      if (stop.stop_requested()) return;
      march.run(origin, direction, columns.elevationAt(r + 0.5), r, exits, out);
    }
    out.perColumn.push_back(std::uint32_t(out.row.size() - before));
  }
}

Capture joined(const ColumnCamera& columns, const std::vector<Samples>& chunks, std::size_t total) {
  Capture capture;
  capture.camera = columns;
  capture.columnStart.reserve(std::size_t(columns.columns) + 1);
  capture.columnStart.push_back(0);
  capture.row.reserve(total);
  capture.inverseDistance.reserve(total);
  capture.colour.reserve(total);
  for (const Samples& s : chunks) {
    for (const std::uint32_t count : s.perColumn)
      capture.columnStart.push_back(capture.columnStart.back() + count);
    capture.row.insert(capture.row.end(), s.row.begin(), s.row.end());
    capture.inverseDistance.insert(capture.inverseDistance.end(), s.inverseDistance.begin(),
                                   s.inverseDistance.end());
    capture.colour.insert(capture.colour.end(), s.colour.begin(), s.colour.end());
  }
  return capture;
}

}  // namespace

Result<Capture> bakeCamera(const RayScene& scene, const LayoutCamera& camera,
                           const ColumnCamera& columnCamera, const BakeSettings& settings, TaskRunner& runner,
                           RayCounts& rays, std::stop_token stop) {
  if (auto sound = settings.check(); !sound) return tl::unexpected(sound.error());
  if (auto sound = columnCamera.check(); !sound) return tl::unexpected(sound.error());
  const auto noMemory = [&] {
    return fail(ErrorKind::outOfSpace, "not enough memory for this capture; lower the samples per degree",
                scene.scene().name);
  };
  try {
    const Shader shader(scene, settings);
    const std::size_t chunkCount =
        std::size_t((columnCamera.columns + kColumnsPerChunk - 1) / kColumnsPerChunk);
    std::vector<Samples> chunks(chunkCount);
    std::atomic<std::size_t> total = 0;
    std::atomic<bool> full = false;  // of memory
    runner.parallelFor(chunkCount, [&](std::size_t chunk) {
      if (stop.stop_requested() || full || total > kMaxCaptureSamples) return;
      const FlushDenormals flush;
      const int first = int(chunk) * kColumnsPerChunk;
      const int last = std::min(first + kColumnsPerChunk, columnCamera.columns);
      try {
        bakeColumns(shader, camera, columnCamera, settings, first, last, stop, chunks[chunk]);
        total += chunks[chunk].row.size();
      } catch (const std::bad_alloc&) {
        full = true;
      }
    });
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "the bake was stopped");
    if (full) return noMemory();
    if (total > kMaxCaptureSamples)
      return fail(ErrorKind::tooLarge, "more than 2^31 samples in one capture; lower the samples per degree",
                  scene.scene().name);
    for (const Samples& s : chunks) rays += s.rays;
    return joined(columnCamera, chunks, total);
  } catch (const std::bad_alloc&) {
    return noMemory();
  }
}

}  // namespace acentric
