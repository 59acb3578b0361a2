#include "engine/bench/representations.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/bench/panorama_places.h"
#include "engine/geometry/conventions.h"
#include "engine/inspect/random_poses.h"

namespace acentric {
namespace {

constexpr const char* kOwn = "project";

struct RingWay {
  const char* name;
  Configuration configuration;
};
constexpr RingWay kRings[] = {{"rings-45", Configuration::a},
                              {"rings-60", Configuration::b},
                              {"rings-90", Configuration::e},
                              {"rings-120", Configuration::g}};
constexpr const char *kMesh = "mesh", *kRooms = "rooms", *kGrid = "grid", *kGreedy = "greedy",
                     *kBoxes = "boxes";
constexpr const char* kPanoramas[] = {kRooms, kGrid, kGreedy, kBoxes};

/// Ray-traced, of one view.
struct Truth {
  ColourImage colour;
  FloatImage rayDistance;
};

class RepresentationsBench {
 public:
  RepresentationsBench(const OpenProject& open, const RepresentationBenchOptions& options, Workplace at)
      : open_(open), options_(options), at_(std::move(at)) {}

  Result<RepresentationBench> run(std::vector<ViewSet> sets) {
    bench_.sets = std::move(sets);
    for (const std::string& name : representationNames())
      if (isWanted(name)) names_.push_back(name);
    if (Status placed = placePanoramas(); !placed) return tl::unexpected(placed.error());
    if (options_.tell)
      if (Status told = foretell(); !told) return tl::unexpected(told.error());
    if (Status traced = traceTruth(); !traced) return tl::unexpected(traced.error());
    for (const std::string& name : names_) {
      const auto made = make(name);
      if (!made) return fail(made.error().kind, made.error().message, name + ": " + made.error().where);
      if (name == kOwn) own_ = made->cost;
      auto result = measure(*made);
      if (!result) return tl::unexpected(result.error());
      bench_.results.push_back(std::move(*result));
    }
    return std::move(bench_);
  }

 private:
  /// The project's own is the measure of the others.
  bool isWanted(const std::string& name) const {
    if (name == kOwn) return true;
    for (const RingWay& way : kRings)
      if (name == way.name && way.configuration == open_.project.layout().configuration) return false;
    return options_.only.empty() || std::ranges::find(options_.only, name) != options_.only.end();
  }

  Result<Representation> make(const std::string& name) const {
    if (at_.progress) at_.progress({0, 0, "making " + name});
    const LayoutSpec& spec = open_.project.layout();
    if (name == kOwn) return makeRings(at_, name, spec, {});
    if (name == kMesh) return makeMesh(at_, name, own_.triangles);
    const SizeTarget target{double(own_.bytes()), options_.tolerance};
    for (const RingWay& way : kRings)
      if (name == way.name) return makeRings(at_, name, relaid(spec, way.configuration), target);
    const PanoramaSet& panoramas = panoramas_.at(name);
    return makePanoramas(at_, name, descriptionOf(name, panoramas), panoramas, name == kBoxes, target);
  }

  /// What make() will bake, of all but the project's own.
  Result<RepresentationBake> bakeOf(const std::string& name, double bytes, std::size_t triangles) const {
    if (name == kMesh) return bakeOfMesh(at_, name, triangles);
    const SizeTarget target{bytes, options_.tolerance};
    for (const RingWay& way : kRings)
      if (name == way.name)
        return bakeOfRings(at_, name, relaid(open_.project.layout(), way.configuration), target);
    return bakeOfPanoramas(at_, name, panoramas_.at(name), name == kBoxes, target);
  }

  /// The others are as large as the project's own, which tells how large they will be.
  Status foretell() const {
    const auto own = bakeOfRings(at_, kOwn, open_.project.layout(), {});
    if (!own) return tl::unexpected(own.error());
    auto forecast = forecastOf(*own, true);
    if (!forecast) return tl::unexpected(forecast.error());
    const double lightBytes = forecast->lightBytes,
                 bytes = forecast->packedBytes + lightBytes + double(own->bytesThere);
    std::size_t triangles = 0;
    if (forecast->nothing() && std::ranges::count(names_, kMesh) > 0) {
      const auto made = make(kOwn);
      if (!made) return tl::unexpected(made.error());
      triangles = made->cost.triangles;
    }
    for (const std::string& name : names_) {
      if (name == kOwn) continue;
      auto bake = bakeOf(name, bytes, triangles);
      if (!bake) return tl::unexpected(bake.error());
      if (bake->light && bake->packedBytes) *bake->packedBytes -= lightBytes;
      const auto next = forecastOf(*bake, forecast->cameras == 0);
      if (!next) return tl::unexpected(next.error());
      *forecast += *next;
    }
    options_.tell(*forecast);
    return {};
  }
  Result<BakeForecast> forecastOf(const RepresentationBake& bake, bool gathers) const {
    BakeShare share = bake.share();
    share.trial->gathers = gathers;
    return forecastBake(std::span(&share, 1), {}, at_.runner, at_.progress, at_.stop);
  }

  Status placePanoramas() {
    for (const std::string& name : names_) {
      if (std::ranges::count(kPanoramas, name) == 0) continue;
      if (at_.progress) at_.progress({0, 0, "placing " + name});
      auto panoramas = panoramasOf(name);
      if (!panoramas)
        return fail(panoramas.error().kind, panoramas.error().message, name + ": " + panoramas.error().where);
      panoramas_.emplace(name, std::move(*panoramas));
    }
    return {};
  }

  Result<PanoramaSet> panoramasOf(const std::string& name) const {
    const std::size_t count = options_.panoramas > 0 ? options_.panoramas : panoramasIn(*open_.layout);
    if (name == kRooms) return roomPanoramas(at_);
    if (name == kGrid) return gridPanoramas(at_, count);
    if (name == kGreedy) return greedyPanoramas(at_, count);
    return boxPanoramas(at_, std::max<std::size_t>(1, count / 2));
  }
  static std::string descriptionOf(const std::string& name, const PanoramaSet& set) {
    const std::size_t count = set.groups.size();
    if (name == kRooms) return fmt::format("RGB-D panoramas, one in each of {} rooms", count);
    if (name == kGrid) return fmt::format("{} RGB-D panoramas on a square grid", count);
    if (name == kGreedy) return fmt::format("{} RGB-D panoramas, each where most is unseen yet", count);
    return fmt::format("{} head boxes of {} RGB-D panoramas each, merged", count, kPanoramasOfBox);
  }

  Status traceTruth() {
    std::size_t all = 0;
    for (const ViewSet& set : bench_.sets) all += set.views.size();
    for (const ViewSet& set : bench_.sets)
      for (const PerspectiveView& view : set.views) {
        if (at_.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
        if (at_.progress) at_.progress({double(truth_.size()), double(all), "tracing the truth"});
        TruthFrame frame = renderTruth(*open_.rays, view, open_.project.bake, open_.project.exposure,
                                       options_.truthSamples, at_.runner);
        truth_.push_back({std::move(frame.colour), std::move(frame.rayDistance)});
      }
    return {};
  }

  Result<RepresentationResult> measure(const Representation& made) const {
    RepresentationResult result{made.name, made.description, made.cost, {}};
    FrameMemory memory;
    std::size_t n = 0;
    for (const ViewSet& set : bench_.sets) {
      ViewSetResult& of = result.sets.emplace_back();
      for (const PerspectiveView& view : set.views) {
        if (at_.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
        if (at_.progress) at_.progress({double(n), double(truth_.size()), "measuring " + made.name});
        auto frame = made.view->render(view, at_.runner, memory);
        if (!frame) return tl::unexpected(frame.error());
        const Truth& truth = truth_[n++];
        const auto comparison = compare(*frame, truth.colour, truth.rayDistance);
        if (!comparison) return tl::unexpected(comparison.error());
        of.comparisons.push_back(*comparison);
        of.frameSeconds.push_back(frame->stats.totalSeconds);
        memory.frame = std::move(*frame);
      }
    }
    return result;
  }

  const OpenProject& open_;
  const RepresentationBenchOptions& options_;
  Workplace at_;
  RepresentationBench bench_;
  std::vector<std::string> names_;  ///< that are wanted
  std::map<std::string, PanoramaSet> panoramas_;
  std::vector<Truth> truth_;  ///< of all sets' views, one after the other
  RepresentationCost own_;
};

}  // namespace

Status RepresentationBenchOptions::check() const {
  if (!(tolerance > 0 && tolerance <= 1))
    return fail(ErrorKind::invalidArgument, "the tolerance of bytes must lie above 0 and up to 1",
                "bench representations");
  for (const std::string& name : only)
    if (std::ranges::count(representationNames(), name) == 0)
      return fail(ErrorKind::invalidArgument,
                  fmt::format("there is no representation '{}'; there are {}", name,
                              fmt::join(representationNames(), ", ")),
                  "bench representations");
  return {};
}

std::vector<std::string> representationNames() {
  std::vector<std::string> names{kOwn};
  for (const RingWay& way : kRings) names.emplace_back(way.name);
  names.emplace_back(kMesh);
  names.insert(names.end(), std::begin(kPanoramas), std::end(kPanoramas));
  return names;
}

Result<ViewSet> randomViews(const OpenProject& open, const RepresentationBenchOptions& options) {
  RandomPoseOptions random;
  random.count = options.poses, random.seed = options.seed;
  const auto poses = randomPoses(standingAreaOf(*open.layout), random);
  if (!poses) return tl::unexpected(poses.error());
  ViewSet set{"random poses", {}};
  const double fov = options.fovDegrees > 0 ? options.fovDegrees : open.project.fovDegrees;
  for (const RandomPose& pose : *poses) {
    PerspectiveView view;
    view.eye = glm::dvec3(pose.place, open.layout->eyeZ());
    view.yawRadians = pose.yawRadians, view.pitchRadians = pose.pitchRadians;
    view.fovRadians = radians(fov);
    view.width = options.width, view.height = options.height;
    if (Status sound = view.check(); !sound) return tl::unexpected(sound.error());
    set.views.push_back(view);
  }
  return set;
}

Result<RepresentationBench> benchRepresentations(const OpenProject& open, const std::vector<ViewSet>& paths,
                                                 const std::filesystem::path& folder,
                                                 const RepresentationBenchOptions& options,
                                                 TaskRunner& runner, const Progress& progress,
                                                 std::stop_token stop) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  auto random = randomViews(open, options);
  if (!random) return tl::unexpected(random.error());
  std::vector<ViewSet> sets{std::move(*random)};
  const StandingArea area = standingAreaOf(*open.layout);
  for (const ViewSet& path : paths) {
    ViewSet& set = sets.emplace_back(ViewSet{path.name, {}});
    for (const PerspectiveView& view : path.views)
      if (area.contains(glm::dvec2(view.eye))) set.views.push_back(view);
  }
  return RepresentationsBench(open, options, {open, folder, runner, progress, std::move(stop)})
      .run(std::move(sets));
}

}  // namespace acentric
