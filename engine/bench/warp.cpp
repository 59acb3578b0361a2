/// The warp in floats against the same in doubles.

#include <cmath>
#include <limits>
#include <numeric>

#include "engine/bake/truth.h"
#include "engine/bench/numerics.h"
#include "engine/measure/compare.h"
#include "engine/measure/statistics.h"
#include "engine/pipeline/walk_stream.h"
#include "engine/view/render.h"
#include "engine/view/view_cameras.h"

namespace acentric {
namespace {

constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();
const glm::dvec3 kFarOut(5e6, 4.9e6, 0);  ///< metres, as map coordinates are
constexpr double kAbove = 0.1;            ///< metres

struct WarpWay {
  const char* name;
  Renderer renderer;
};
constexpr WarpWay kWays[] = {{"double, one sample at a time", Renderer::precise},
                             {"float, one sample at a time", Renderer::scalar},
                             {"float, vectors", Renderer::list}};

/// A place as floats would hold it. Through volatile ones: g++ 12 at -O2 takes a vector's conversion to
/// floats and back for none.
glm::dvec3 inFloats(const glm::dvec3& place) {
  glm::dvec3 out;
  for (int axis = 0; axis < 3; ++axis) {
    const volatile float rounded = float(place[axis]);
    out[axis] = double(rounded);
  }
  return out;
}

struct HardCase {
  std::string name;
  std::vector<glm::dvec3> eyes;
};

/// Captures are read as views need them.
class WarpBench {
 public:
  WarpBench(const OpenProject& open, const NumericsBenchOptions& options, TaskRunner& runner,
            WalkStream& stream, const Progress& progress, const std::stop_token& stop)
      : open_(open), options_(options), runner_(runner), stream_(stream), progress_(progress), stop_(stop) {}

  Result<NumericsTable> run(const std::vector<PerspectiveView>& views) {
    table_ = {"The warp: float and double",
              "Pictures whose samples were placed in floats against those placed in doubles: pixels that "
              "differ at all, PSNR between the two, PSNR against ray tracing where it was traced, and "
              "milliseconds that drawing captures takes (medians).",
              {"pixels that differ, %", "worst frame, %", "PSNR to double, dB", "PSNR to the truth, dB",
               "captures, ms"},
              {}};
    std::vector<ColourImage> truths;
    for (const PerspectiveView& view : views) {
      if (stop_.stop_requested()) return stopped();
      truths.push_back(
          renderTruth(*open_.rays, view, open_.project.bake, open_.project.exposure, 1, runner_, stop_)
              .colour);
    }
    if (Status done = measure("frames of the walk", false, views, truths); !done)
      return tl::unexpected(done.error());
    for (const HardCase& hard : hardCases(views)) {
      std::vector<PerspectiveView> at;
      for (const glm::dvec3& eye : hard.eyes)
        for (const double turn : {0.0, 2.0, 4.0}) {
          PerspectiveView view = views.front();
          view.eye = eye, view.yawRadians += turn;
          at.push_back(view);
        }
      if (at.empty()) continue;
      if (Status done = measure(hard.name, true, at, {}); !done) return tl::unexpected(done.error());
    }
    if (Status done = measureFarAway(views); !done) return tl::unexpected(done.error());
    return std::move(table_);
  }

 private:
  static tl::unexpected<Error> stopped() { return fail(ErrorKind::cancelled, "stopped"); }

  Result<std::shared_ptr<const LoadedWalk>> walkFor(const PerspectiveView& view) {
    const ViewCameras needed = camerasOf(*open_.layout, view, open_.project.view);
    if (needed.region < 0)
      return fail(ErrorKind::invalidArgument, "a view stands outside all regions", "bench numerics");
    if (Status read =
            stream_.complete(needed.cameras, std::span(&needed.region, 1), runner_, progress_, stop_);
        !read)
      return tl::unexpected(read.error());
    return stream_.walk();
  }

  ViewSettings settingsOf(Renderer renderer) const {
    ViewSettings settings = open_.project.view;
    settings.renderer = renderer;
    // Of the ways to draw captures this is about those that warp samples: they exist in double precision.
    if (settings.reconstruction == Reconstruction::patches) settings.reconstruction = Reconstruction::splat;
    return settings;
  }

  /// What of a way is compared, frame by frame.
  struct Tally {
    std::vector<double> differing, toDouble, toTruth, milliseconds;
    void compare(const Frame& frame, const ColourImage& precise) {
      std::size_t changed = 0;
      for (std::size_t i = 0; i < precise.pixels.size(); ++i)
        changed += frame.colour.pixels[i] != precise.pixels[i] ? 1 : 0;
      differing.push_back(100 * double(changed) / double(precise.pixels.size()));
      toDouble.push_back(psnrOf(frame.colour, precise));
    }
    NumericsRow row(const std::string& cases, bool hard, const std::string& way, bool reference) {
      const auto median = [](const std::vector<double>& values) {
        return values.empty() ? kNoFigure : spreadOf(values).median;
      };
      const double worst = spreadOf(differing).max;
      return {cases,
              hard,
              way,
              {reference ? kNoFigure : median(differing), reference ? kNoFigure : worst,
               reference ? kNoFigure : median(toDouble), median(toTruth), median(milliseconds)}};
    }
  };

  /// The median of its repeats' times; all its frames are alike.
  Result<Frame> render(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                       Tally& tally) {
    std::vector<double> milliseconds;
    Result<Frame> frame = Frame{};
    for (int repeat = 0; repeat < options_.repeats; ++repeat) {
      if (stop_.stop_requested()) return stopped();
      frame = renderFrame(scene, view, settings, runner_, memory_);
      if (!frame) return frame;
      milliseconds.push_back(1e3 * frame->stats.warpSeconds);
    }
    tally.milliseconds.push_back(spreadOf(std::move(milliseconds)).median);
    return frame;
  }

  Status measure(const std::string& cases, bool hard, const std::vector<PerspectiveView>& views,
                 const std::vector<ColourImage>& truths) {
    std::vector<Tally> tallies(std::size(kWays));
    for (std::size_t v = 0; v < views.size(); ++v) {
      if (progress_) progress_({double(v), double(views.size()), "numerics: " + cases});
      const auto walk = walkFor(views[v]);
      if (!walk) return tl::unexpected(walk.error());
      ColourImage precise;
      for (std::size_t w = 0; w < std::size(kWays); ++w) {
        auto frame = render((*walk)->walk, views[v], settingsOf(kWays[w].renderer), tallies[w]);
        if (!frame) return tl::unexpected(frame.error());
        if (w == 0) precise = frame->colour;
        tallies[w].compare(*frame, precise);
        if (!truths.empty()) tallies[w].toTruth.push_back(psnrOf(frame->colour, truths[v]));
      }
    }
    for (std::size_t w = 0; w < std::size(kWays); ++w)
      table_.rows.push_back(tallies[w].row(cases, hard, kWays[w].name, w == 0));
    return {};
  }

  /// Eyes around the region in which the walk begins.
  std::vector<HardCase> hardCases(const std::vector<PerspectiveView>& views) const {
    const Layout& layout = *open_.layout;
    const double z = layout.eyeZ();
    const auto at = layout.regionAt(glm::dvec2(views.front().eye));
    const Region& region = layout.regions[std::size_t(at.value_or(0))];
    const std::vector<glm::dvec2>& corners = region.polygon.corners;
    HardCase centre{"the eye at a centre of projection", {}}, above{"the eye straight above one", {}},
        border{"the eye on a region's border", {}}, column{"the epipole between two columns", {}};
    const auto add = [&](HardCase& hard, const glm::dvec2& place, double height) {
      if (layout.regionAt(place)) hard.eyes.emplace_back(place, height);
    };
    const glm::dvec2 middle =
        std::accumulate(corners.begin(), corners.end(), glm::dvec2(0)) / double(corners.size());
    for (std::size_t k = 0; k < corners.size(); ++k) {
      add(centre, corners[k], z);
      add(above, corners[k], z + kAbove);
      add(border, 0.5 * (corners[k] + corners[(k + 1) % corners.size()]), z);
    }
    for (const Cover& cover : region.covers)
      for (const Piece& piece : cover.pieces) {
        const LayoutCamera& camera = layout.cameras[std::size_t(piece.camera)];
        const ColumnCamera columns = columnCameraFor(camera, layout, open_.scene->bounds, open_.project.bake);
        const glm::dvec2 along = columns.directionAt(columns.columns / 3);  // where two columns meet
        const glm::dvec2 place = camera.position - 0.5 * glm::distance(camera.position, middle) * along;
        add(column, place, z);
      }
    return {centre, above, border, column};
  }

  /// The project as it would be with its origin there, against the same near zero.
  Status measureFarAway(const std::vector<PerspectiveView>& views) {
    LayoutSpec spec = open_.layout->spec;
    const glm::dvec2 away(kFarOut);
    spec.latticeOrigin += away;
    for (auto& loop : spec.outline.loops)
      for (glm::dvec2& corner : loop) corner += away;
    for (auto& [number, apv] : spec.freeApvs) apv.centre += away;
    auto layout = buildLayout(spec);
    if (!layout) return tl::unexpected(layout.error());
    if (layout->cameras.size() != open_.layout->cameras.size()) return {};
    const auto moved = std::make_shared<const Layout>(std::move(*layout));
    Tally near, far, naive;
    for (const PerspectiveView& view : views) {
      if (progress_) progress_({0, 0, "numerics: far from zero"});
      const auto walk = walkFor(view);
      if (!walk) return tl::unexpected(walk.error());
      ViewSettings settings = settingsOf(Renderer::precise);
      settings.localGeometry = false;  // stands where it was
      auto precise = render((*walk)->walk, view, settings, near);
      if (!precise) return tl::unexpected(precise.error());
      const ColourImage reference = precise->colour;
      settings.renderer = Renderer::list;
      PerspectiveView there = view;
      there.eye += kFarOut;
      const WalkScene scene = movedScene((*walk)->walk, moved, view);
      auto frame = render(scene, there, settings, far);
      if (!frame) return tl::unexpected(frame.error());
      far.compare(*frame, reference);
      there.eye = inFloats(there.eye);
      auto rounded = render(withPlacesInFloats(scene), there, settings, naive);
      if (!rounded) return tl::unexpected(rounded.error());
      naive.compare(*rounded, reference);
    }
    const std::string cases = "5000 km from zero, without polygons";
    table_.rows.push_back(far.row(cases, true, "float, vectors", false));
    table_.rows.push_back(naive.row(cases, true, "places in floats too", false));
    return {};
  }

  static WalkScene withPlacesInFloats(WalkScene scene) {
    for (auto& capture : scene.captures) {
      if (!capture) continue;
      auto copy = std::make_shared<DisplayCapture>(*capture);
      copy->camera.centreOfProjection = inFloats(copy->camera.centreOfProjection);
      capture = std::move(copy);
    }
    return scene;
  }

  WalkScene movedScene(const WalkScene& walk, const std::shared_ptr<const Layout>& layout,
                       const PerspectiveView& view) const {
    WalkScene moved = walk;
    moved.layout = layout;
    moved.local.assign(layout->regions.size(), nullptr);
    moved.captures.assign(walk.captures.size(), nullptr);
    for (const int c : camerasOf(*open_.layout, view, open_.project.view).cameras) {
      const auto& original = walk.captures[std::size_t(c)];
      if (!original) continue;
      auto copy = std::make_shared<DisplayCapture>(*original);
      copy->camera.centreOfProjection += kFarOut;
      if (original->reflections) {
        auto reflections = std::make_shared<DisplayCapture>(*original->reflections);
        reflections->camera.centreOfProjection += kFarOut;
        copy->reflections = std::move(reflections);
      }
      moved.captures[std::size_t(c)] = std::move(copy);
    }
    return moved;
  }

  const OpenProject& open_;
  const NumericsBenchOptions& options_;
  TaskRunner& runner_;
  WalkStream& stream_;
  const Progress& progress_;
  const std::stop_token& stop_;
  FrameMemory memory_;
  NumericsTable table_;
};

}  // namespace

Result<NumericsTable> benchWarp(const OpenProject& open, const std::vector<PerspectiveView>& views,
                                const NumericsBenchOptions& options, TaskRunner& runner,
                                const Progress& progress, const std::stop_token& stop) {
  auto start = startWalk(open, nullptr);
  if (!start) return tl::unexpected(start.error());
  WalkStreamOptions reading;
  reading.threads = 0;
  WalkStream stream(std::move(*start), reading);
  return WarpBench(open, options, runner, stream, progress, stop).run(views);
}

}  // namespace acentric
