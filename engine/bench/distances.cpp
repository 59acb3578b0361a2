/// How many bits inverse distances take: where a sample is seen, what it takes on disk, how long it is read.

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <fmt/format.h>

#include "engine/bake/truth.h"
#include "engine/base/stopwatch.h"
#include "engine/bench/numerics.h"
#include "engine/geometry/conventions.h"
#include "engine/measure/statistics.h"
#include "engine/pipeline/trial_folder.h"
#include "engine/store/block_file.h"
#include "engine/view/view_cameras.h"

namespace acentric {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kPixelStep = 3;  ///< of the truth's pixels, down and across
constexpr std::size_t kSynthetic = 50'000;
constexpr double kNearest = 1e-3, kFarthest = 1e4, kHardBaseline = 1;  ///< metres

/// A point as a camera keeps it.
struct Seen {
  glm::dvec3 direction{0};  ///< from the camera, horizontally 1 long
  glm::dvec3 baseline{0};   ///< from the eye to the camera
  double inverseDistance = 0;
  const PerspectiveView* view = nullptr;
  double step = 0;  ///< Capture::distanceStep of the camera
};

glm::dvec2 placeOf(const Seen& seen, double inverseDistance) {
  const glm::dvec3 q = seen.view->viewFromWorld() * (seen.direction + inverseDistance * seen.baseline);
  return seen.view->focalPixels() * glm::dvec2(q) / q.z;
}

/// Of `bits` of a float, its sign and exponent among them.
double rounded(double value, int bits) {
  int exponent = 0;
  const double significand = std::frexp(value, &exponent);
  const int significant = bits - 8;
  return std::ldexp(std::nearbyint(std::ldexp(significand, significant)), exponent - significant);
}

struct Way {
  std::string name;
  std::function<double(const Seen&)> keep;
  bool stored = true;  ///< as floats, which can be written to a file
};

/// What the truth shows in `view`, from the nearest of the cameras that paint it and hold the point.
void addSeen(const OpenProject& open, const PerspectiveView& view, const std::vector<double>& steps,
             TaskRunner& runner, std::vector<Seen>& out) {
  const TruthFrame truth = renderTruth(*open.rays, view, open.project.bake, open.project.exposure, 1, runner);
  const Layout& layout = *open.layout;
  const std::vector<int> cameras = camerasOf(layout, view, open.project.view).cameras;
  for (int x = 0; x < view.width; x += kPixelStep)
    for (int y = 0; y < view.height; y += kPixelStep) {
      const double distance = double(truth.rayDistance.at(x, y));
      if (!std::isfinite(distance)) continue;
      const glm::dvec3 point = view.eye + distance * view.rayThrough(x + 0.5, y + 0.5);
      Seen nearest;
      double least = std::numeric_limits<double>::infinity();
      for (const int c : cameras) {
        const LayoutCamera& camera = layout.cameras[std::size_t(c)];
        const glm::dvec2 plan = glm::dvec2(point) - camera.position;
        const double away = glm::length(plan);
        const double turn = wrapAngle(std::atan2(plan.y, plan.x) - camera.lowAzimuth);
        if (!(away > nearestSample(camera)) || turn > camera.fovRadians || away >= least) continue;
        const glm::dvec3 centre(camera.position, layout.eyeZ());
        least = away;
        nearest = {(point - centre) / away, centre - view.eye, 1 / away, &view, steps[std::size_t(c)]};
      }
      if (std::isfinite(least)) out.push_back(nearest);
    }
}

/// From 1 mm to 10 km, evenly in their logarithms, off the axis by up to half a field of view.
std::vector<Seen> nearAndFar(const PerspectiveView& view) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Seen> all(kSynthetic);
  const glm::dmat3 worldFromView = glm::transpose(view.viewFromWorld());
  for (Seen& seen : all) {
    const double distance = kNearest * std::pow(kFarthest / kNearest, unit(random));
    const glm::dvec3 forward = worldFromView[2] + (unit(random) - 0.5) * 0.8 * worldFromView[0];
    seen.direction = forward / glm::length(glm::dvec2(forward));
    // Beside the eye: nothing passes through it, and all is seen.
    seen.baseline = kHardBaseline * (0.2 * worldFromView[0] + worldFromView[2]);
    seen.inverseDistance = 1 / distance, seen.view = &view;
  }
  return all;
}

struct Storage {
  double bytes = kNone, nanoseconds = kNone;  ///< a distance
};

/// As a lane of a capture is kept.
Result<Storage> storageOf(const std::vector<Seen>& all, const Way& way, int repeats,
                          const std::filesystem::path& folder) {
  if (!way.stored) return Storage{};
  std::vector<float> values(all.size());
  std::ranges::transform(all, values.begin(), [&](const Seen& seen) { return float(way.keep(seen)); });
  const auto path = folder / "distances";
  const ContentKey key{1, 1};
  BlockFileWriter file(BlockFileKind::capture, key);
  if (Status added = file.addRecords(std::array{laneOf(std::as_const(values))}, values.size()); !added)
    return tl::unexpected(added.error());
  if (Status written = file.write(path); !written) return tl::unexpected(written.error());
  Storage storage;
  std::error_code error;
  storage.bytes = double(std::filesystem::file_size(path, error)) / double(all.size());
  std::vector<double> nanoseconds;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const Stopwatch watch;
    auto read = BlockFileReader::open(path, BlockFileKind::capture);
    if (!read) return tl::unexpected(read.error());
    if (Status done = read->nextRecords(std::array{laneOf(values)}, values.size()); !done)
      return tl::unexpected(done.error());
    nanoseconds.push_back(1e9 * watch.seconds() / double(all.size()));
  }
  storage.nanoseconds = spreadOf(std::move(nanoseconds)).median;
  return storage;
}

Status addRows(const std::string& cases, bool hard, const std::vector<Seen>& all,
               const std::vector<Way>& ways, int repeats, NumericsTable& table) {
  auto folder = TrialFolder::make({});
  if (!folder) return tl::unexpected(folder.error());
  for (const Way& way : ways) {
    std::vector<double> shifts;
    for (const Seen& seen : all) {
      const double shift = glm::distance(placeOf(seen, way.keep(seen)), placeOf(seen, seen.inverseDistance));
      if (std::isfinite(shift)) shifts.push_back(shift);
    }
    const Spread spread = spreadOf(std::move(shifts));
    const auto storage = storageOf(all, way, repeats, folder->path());
    if (!storage) return tl::unexpected(storage.error());
    table.rows.push_back({cases,
                          hard,
                          way.name,
                          {spread.median, spread.p99, spread.max, storage->bytes, storage->nanoseconds}});
  }
  return {};
}

std::vector<Way> floatWays() {
  std::vector<Way> ways;
  for (const int bits : {12, 16, 20, 24, 32})
    ways.push_back({fmt::format("{} bits of a float", bits),
                    [bits](const Seen& seen) { return rounded(seen.inverseDistance, bits); }});
  return ways;
}

/// 16 bits of even steps, between the nearest and the farthest.
Way evenSteps(bool ofDistance) {
  constexpr double kCodes = 65535;
  const double low = ofDistance ? kNearest : 1 / kFarthest, high = ofDistance ? kFarthest : 1 / kNearest;
  return {ofDistance ? "16 bits, even steps of distance" : "16 bits, even steps of inverse distance",
          [=](const Seen& seen) {
            const double value = ofDistance ? 1 / seen.inverseDistance : seen.inverseDistance;
            const double code = std::nearbyint((value - low) / (high - low) * kCodes);
            const double kept = low + code / kCodes * (high - low);
            return ofDistance ? 1 / kept : kept;
          },
          false};
}

/// By camera: the step of its capture, 0 where it is not baked.
std::vector<double> stepsOf(const OpenProject& open, const std::vector<PerspectiveView>& views) {
  std::vector<double> steps(open.layout->cameras.size(), -1);
  const auto store = openCaptures(open.file);
  for (const PerspectiveView& view : views)
    for (const int c : camerasOf(*open.layout, view, open.project.view).cameras) {
      double& step = steps[std::size_t(c)];
      if (step >= 0 || !store) continue;
      const auto capture = store->get(open.keys[std::size_t(c)]);
      step = capture ? capture->distanceStep : 0;
    }
  return steps;
}

}  // namespace

Result<NumericsTable> benchDistances(const OpenProject& open, const std::vector<PerspectiveView>& views,
                                     const NumericsBenchOptions& options, TaskRunner& runner,
                                     const std::stop_token& stop) {
  NumericsTable table{
      "Inverse distances: how many bits",
      "How far from its place a sample is seen because its inverse distance is rounded, in pixels of the "
      "picture; what such distances take on disk (compressed as in captures, which keep 24 bits), and how "
      "long reading them back takes. 32 bits are what ray tracing gives.",
      {"median, px", "99 %, px", "largest, px", "bytes a distance", "ns a distance"},
      {}};
  const std::vector<double> steps = stepsOf(open, views);
  std::vector<Seen> walk;
  for (const PerspectiveView& view : views) {
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
    addSeen(open, view, steps, runner, walk);
  }
  std::vector<Way> ways = floatWays();
  ways.push_back({fmt::format("captures: 24 bits and steps of {:g} samples", open.project.bake.distanceShift),
                  [](const Seen& seen) {
                    return double(storedInverseDistance(seen.inverseDistance, std::max(seen.step, 0.0)));
                  }});
  if (Status added = addRows("what the walk shows", false, walk, ways, options.repeats, table); !added)
    return tl::unexpected(added.error());
  std::vector<Way> hard = floatWays();
  hard.push_back(evenSteps(false));
  hard.push_back(evenSteps(true));
  const std::vector<Seen> all = nearAndFar(views.front());
  if (Status added = addRows("1 mm to 10 km, camera 1 m away", true, all, hard, options.repeats, table);
      !added)
    return tl::unexpected(added.error());
  return table;
}

}  // namespace acentric
