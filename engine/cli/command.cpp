#include "engine/cli/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "engine/base/contract.h"
#include "engine/base/stopwatch.h"
#include "engine/pipeline/knobs.h"
#include "engine/pipeline/scene_storeys.h"
#include "engine/pipeline/walk_stream.h"
#include "engine/scene/instances.h"
#include "engine/scene/local_geometry.h"
#include "engine/view/view_cameras.h"
#include "engine/view_gl/gl_renderer.h"

namespace acentric::cli {

int Common::threadCount() const {
  return threads > 0 ? threads : std::max(1, int(std::thread::hardware_concurrency()));
}

std::unique_ptr<TaskRunner> Common::runner() const { return std::make_unique<TaskRunner>(threadCount() - 1); }

std::size_t Common::walkBytes() const {
  return walkMegabytes ? std::size_t(*walkMegabytes * 1e6) : usualWalkMemory();
}

namespace {
constexpr double kNearStorey = 0.5;  // metres
/// Triangles, instances and all, that are drawn all at once: they take some hundred bytes each.
constexpr std::uint64_t kMostPolygons = 12'000'000;
}  // namespace

struct FrameMaker::Shared {
  std::vector<std::unique_ptr<WalkStream>> walks;  // of storeys_
  std::optional<WalkScene> polygons;  // of the first: no captures, the whole scene as local geometry
  std::vector<std::string> told;      // what was wrong
  std::unique_ptr<HeadlessContext> context;
  std::unique_ptr<GlRenderer> gl;  // destroyed before its context
};

FrameMaker::FrameMaker(std::span<const OpenProject> storeys, const Common& common, TaskRunner& runner)
    : storeys_(storeys), common_(common), runner_(runner), shared_(std::make_shared<Shared>()) {
  shared_->walks.resize(storeys.size());
}
FrameMaker::~FrameMaker() = default;

Result<std::unique_ptr<FrameMaker>> FrameMaker::create(std::span<const OpenProject> storeys,
                                                       const std::string& rendererName, const Common& common,
                                                       TaskRunner& runner, const Look& look) {
  std::unique_ptr<FrameMaker> maker(new FrameMaker(storeys, common, runner));
  maker->settings = storeys.front().project.view;
  maker->name_ = rendererName.empty() ? nameOf(maker->settings.renderer) : rendererName;
  if (rendererName == "truth") {
    maker->shows_ = Shows::truth;
    return maker;
  }
  const bool onCpu = rendererName == "polygons";
  if (onCpu || rendererName == "gl-polygons") {
    maker->shows_ = Shows::polygons;
    maker->settings.renderer = onCpu ? Renderer::list : Renderer::gl;
    maker->settings.localGeometry = true;
    maker->settings.fillHoles = false;
    return maker;
  }
  const auto renderer = parseRenderer(maker->name_);
  if (!renderer) return tl::unexpected(renderer.error());
  maker->settings.renderer = *renderer;
  if (Status applied = apply(look, maker->settings); !applied) return tl::unexpected(applied.error());
  return maker;
}

Status apply(const Look& look, ViewSettings& settings) {
  if (!look.reconstruction.empty()) {
    const auto parsed = parseReconstruction(look.reconstruction);
    if (!parsed) return tl::unexpected(parsed.error());
    settings.reconstruction = *parsed;
  }
  return settings.check();
}

Status FrameMaker::openGl() {
  if (shared_->gl) return {};
  auto context = HeadlessContext::create();
  if (!context) return tl::unexpected(context.error());
  auto gl = GlRenderer::create({.runner = &runner_});
  if (!gl) return tl::unexpected(gl.error());
  shared_->context = std::move(*context);
  shared_->gl = std::move(*gl);
  return {};
}

/// A walk that shows every triangle, wherever the eye is, and nothing else.
Result<WalkScene> polygonsOf(const OpenProject& open) {
  if (open.imported->shownTriangleCount() > kMostPolygons && !open.imported->instances.empty())
    return fail(
        ErrorKind::tooLarge,
        fmt::format("the polygons renderer draws every triangle; the scene has {} with all instances, "
                    "more than {}",
                    open.imported->shownTriangleCount(), kMostPolygons),
        open.project.scene.string());
  const ScenePtr scene = open.imported->instances.empty()
                             ? open.scene
                             : std::make_shared<const Scene>(flattened(*open.imported));
  glm::dvec2 low(open.scene->bounds.min), high(open.scene->bounds.max);
  const glm::dvec2 room = 0.01 * (high - low) + 1e-3;
  low -= room, high += room;
  const auto all = std::make_shared<const LocalGeometry>(
      clipToPolygon(*scene, {{low, {high.x, low.y}, high, {low.x, high.y}}}));
  WalkScene walk;
  walk.scene = scene, walk.layout = open.layout, walk.plan = open.plan;
  walk.exposure = open.project.exposure;
  walk.captures.resize(open.layout->cameras.size());
  walk.local.assign(open.layout->regions.size(), all);
  return walk;
}

/// What walks of all storeys hold together keeps to the limit: where it does not, others are closed.
Status FrameMaker::openWalk(std::size_t storey) {
  auto& walks = shared_->walks;
  std::size_t bytes = 0;
  for (const auto& walk : walks) bytes += walk ? walk->stats().bytes : 0;
  if (bytes > common_.walkBytes())
    for (std::size_t s = 0; s < walks.size(); ++s)
      if (s != storey) walks[s].reset();
  if (walks[storey]) return {};
  const OpenProject& open = storeys_[storey];
  auto start = startWalk(open, nullptr);
  if (!start) return tl::unexpected(start.error());
  if (start->walk.missing == int(start->walk.keys.size()))
    return fail(ErrorKind::notFound,
                storeys_.size() == 1
                    ? "nothing is baked yet; run `acentric bake` on it first"
                    : fmt::format("nothing is baked yet of {}; run `acentric bake` on it first",
                                  open.project.storeys[storey].name),
                open.file.string());
  std::ranges::copy(start->walk.warnings, std::back_inserter(shared_->told));
  if (start->walk.coarse > 0) shared_->told.push_back(coarseText(start->walk));
  WalkStreamOptions options;
  options.memoryBytes = common_.walkBytes();
  options.threads = 0;
  walks[storey] = std::make_unique<WalkStream>(std::move(*start), options);
  return {};
}

Status FrameMaker::load(const PerspectiveView& view) {
  if (isTruth()) return {};
  if (onOpenGl(settings.renderer))
    if (Status opened = openGl(); !opened) return opened;
  if (shows_ == Shows::polygons) {
    if (shared_->polygons) return {};
    auto polygons = polygonsOf(storeys_.front());
    if (!polygons) return tl::unexpected(polygons.error());
    shared_->polygons = std::move(*polygons);
    return {};
  }
  const std::size_t storey = storeyAt(storeys_, view.eye);
  if (Status opened = openWalk(storey); !opened) return opened;
  const ViewCameras needed = camerasOf(*storeys_[storey].layout, view, settings);
  if (needed.region < 0) return {};  // the renderer says so
  WalkStream& walk = *shared_->walks[storey];
  const Status loaded =
      walk.complete(needed.cameras, std::span(&needed.region, 1), runner_, common_.progress, common_.stop);
  std::ranges::move(walk.takeWarnings(), std::back_inserter(shared_->told));
  return loaded;
}

Result<Frame> FrameMaker::render(const PerspectiveView& view) {
  if (Status sound = view.check(); !sound) return tl::unexpected(sound.error());
  const OpenProject& open = storeys_.front();
  if (isTruth()) {
    const Stopwatch watch;
    TruthFrame truth =
        renderTruth(*open.rays, view, open.project.bake, open.project.exposure, truthSamples, runner_);
    Frame frame;
    frame.colour = std::move(truth.colour);
    frame.source = Image<PixelSource>(view.width, view.height, kSourceLocal);
    frame.stats.totalSeconds = watch.seconds();
    return frame;
  }
  if (Status there = load(view); !there) return tl::unexpected(there.error());
  const auto loaded = walkAt(view.eye);
  const WalkScene& walk = loaded ? loaded->walk : *shared_->polygons;
  if (!onOpenGl(settings.renderer)) return renderFrame(walk, view, settings, runner_, memory_);
  auto stats = shared_->gl->draw(walk, view, settings);
  if (!stats) return tl::unexpected(stats.error());
  Frame frame = shared_->gl->readBack();
  frame.stats = *stats;
  return frame;
}

std::shared_ptr<const LoadedWalk> FrameMaker::walkAt(const glm::dvec3& eye) const {
  if (shows_ != Shows::captures) return nullptr;
  const auto& walk = shared_->walks[storeyAt(storeys_, eye)];
  return walk ? walk->walk() : nullptr;
}

std::vector<std::string> FrameMaker::warnings() const {
  std::vector<std::string> all = shared_->told;
  for (const auto& walk : shared_->walks)
    if (walk)
      if (const std::string simplified = simplifiedText(*walk->walk()); !simplified.empty())
        all.push_back(simplified);
  return all;
}

Result<int> storeyOf(const Project& project, const std::string& choice) {
  const std::vector<Storey>& storeys = project.storeys;
  for (std::size_t s = 0; s < storeys.size(); ++s)
    if (storeys[s].name == choice) return int(s);
  if (const auto parsed = parseStoreyChoice(choice); parsed && parsed->number) {
    if (std::size_t(*parsed->number) < storeys.size()) return *parsed->number;
  } else if (parsed) {
    const auto away = [&](const Storey& s) { return std::abs(s.layout.floorHeight - *parsed->height); };
    const auto nearest = std::ranges::min_element(storeys, {}, away);
    if (away(*nearest) <= kNearStorey) return int(nearest - storeys.begin());
  }
  std::string list;
  for (std::size_t s = 0; s < storeys.size(); ++s)
    list += fmt::format("{}{}: {} ({:.2f} m)", s == 0 ? "" : ", ", s, storeys[s].name,
                        storeys[s].layout.floorHeight);
  return fail(ErrorKind::notFound, fmt::format("the project has no storey '{}'; it has {}", choice, list),
              "--storey");
}

Result<Bookmark> bookmarkOf(const Project& project, const std::string& name) {
  const auto found = std::ranges::find(project.bookmarks, name, &Bookmark::name);
  if (found != project.bookmarks.end()) return *found;
  std::vector<std::string> names;
  for (const Bookmark& bookmark : project.bookmarks) names.push_back("'" + bookmark.name + "'");
  return fail(ErrorKind::invalidArgument,
              names.empty()
                  ? fmt::format("there is no bookmark '{}': the project has none", name)
                  : fmt::format("there is no bookmark '{}'; there are {}", name, fmt::join(names, ", ")),
              "--bookmark");
}

Result<Project> loadChosen(const std::filesystem::path& file, const Common& common) {
  auto project = loadProject(file);
  if (!project) return tl::unexpected(project.error());
  if (!common.storey.empty()) {
    const auto storey = storeyOf(*project, common.storey);
    if (!storey) return tl::unexpected(storey.error());
    project->storey = *storey;
  }
  if (common.preset.empty()) return project;
  const auto setting = presetOf(sweepFileOf(file, common.presetFrom), common.preset);
  if (!setting) return tl::unexpected(setting.error());
  return applySetting(std::move(*project), *setting);
}

Result<OpenProject> openChosen(const std::filesystem::path& file, const Common& common) {
  const auto project = loadChosen(file, common);
  if (!project) return tl::unexpected(project.error());
  return openUnsaved(file, *project, common.host, common.progress, common.stop);
}

Result<std::vector<OpenProject>> openStoreys(const std::filesystem::path& file, const Common& common) {
  auto open = openChosen(file, common);
  if (!open) return tl::unexpected(open.error());
  if (!common.storey.empty()) return std::vector<OpenProject>{std::move(*open)};
  return acentric::openStoreys(*open, common.host, common.progress, common.stop);
}

std::string storeyText(const Project& project) {
  return project.storeys.size() < 2 ? "" : fmt::format(" ({})", project.current().name);
}

std::string timeText(double seconds) {
  if (seconds < 100) return fmt::format("{:.1f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.1f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

Report byStorey(std::span<const OpenProject> storeys, std::vector<Report> reports) {
  std::vector<std::string> names;
  for (const OpenProject& open : storeys) names.push_back(open.project.current().name);
  return byStorey(names, std::move(reports));
}

Report byStorey(const std::vector<std::string>& names, std::vector<Report> reports) {
  require(!reports.empty() && reports.size() == names.size(), "each storey has a report");
  if (reports.size() == 1) return std::move(reports.front());
  Report all;
  all.json["storeys"] = Json::array();
  for (std::size_t s = 0; s < reports.size(); ++s) {
    Json json = {{"storey", names[s]}};
    json.update(reports[s].json);
    all.json["storeys"].push_back(std::move(json));
    all.text += reports[s].text;
    all.success = all.success && reports[s].success;
  }
  return all;
}

Status saveEdited(Project project, const std::filesystem::path& file) {
  const auto before = loadProject(file);
  if (!before) return tl::unexpected(before.error());
  const std::string& begins = before->storeys[std::size_t(before->storey)].name;
  const auto found = std::ranges::find(project.storeys, begins, &Storey::name);
  if (found != project.storeys.end()) project.storey = int(found - project.storeys.begin());
  return saveProject(project, file);
}

Json scaleJson(const std::optional<ScaleDoubt>& doubt) {
  if (!doubt) return nullptr;
  return {{"metresPerUnit", doubt->metresPerUnit}, {"factor", doubt->factor}, {"text", doubt->text}};
}

ImportOptions importOptions(const std::string& up, double metresPerUnit, const std::string& light) {
  ImportOptions options;
  options.metresPerUnit = metresPerUnit;
  options.up = up == "y" ? UpAxis::y : up == "z" ? UpAxis::z : UpAxis::guess;
  options.lighting = light == "in-textures" ? Lighting::inTextures
                     : light == "computed"  ? Lighting::computed
                                            : Lighting::guess;
  return options;
}

double pixelsOf(const OpenProject& open, const LayoutCamera& camera) {
  const ColumnCamera c = columnCameraFor(camera, *open.layout, open.scene->bounds, open.project.bake);
  return double(c.columns) * c.rows;
}

double megapixelsOf(const OpenProject& open) {
  double pixels = 0;
  for (const LayoutCamera& camera : open.layout->cameras) pixels += pixelsOf(open, camera);
  return pixels / 1e6;
}

std::string bytesText(std::uint64_t bytes) {
  if (bytes < 10'000) return fmt::format("{} bytes", bytes);
  if (bytes < 10'000'000) return fmt::format("{:.0f} kB", double(bytes) / 1e3);
  if (bytes < 10'000'000'000) return fmt::format("{:.1f} MB", double(bytes) / 1e6);
  return fmt::format("{:.2f} GB", double(bytes) / 1e9);
}

std::string trianglesText(const Scene& scene) {
  std::string text = countText(scene.shownTriangleCount()) + " triangles";
  if (!scene.instances.empty())
    text += fmt::format(" ({} unique, {} instances)", countText(scene.uniqueTriangleCount()),
                        countText(scene.instances.size()));
  return text;
}

std::string countText(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (int at = int(digits.size()) - 3; at > 0; at -= 3) digits.insert(std::size_t(at), ",");
  return digits;
}

Json toJson(const RayCounts& rays) {
  return {{"primary", rays.primary},   {"visibility", rays.visibility},
          {"shadow", rays.shadow},     {"softShadow", rays.softShadow},
          {"ambient", rays.ambient},   {"bounce", rays.bounce},
          {"mirror", rays.mirror},     {"through", rays.through},
          {"gathered", rays.gathered}, {"gatherSeconds", rays.gatherSeconds}};
}

Json toJson(const CaptureSeconds& parts) {
  return {{"testEyes", parts.testEyes},       {"eyeViews", parts.eyeViews}, {"march", parts.march},
          {"silhouettes", parts.silhouettes}, {"edgeOn", parts.edgeOn},     {"rounding", parts.rounding}};
}

Json toJson(const SampleCounts& samples) {
  return {{"kept", samples.keptInAll()},
          {"keptByLayer", samples.kept},
          {"backgroundPixels", samples.background},
          {"droppedHidden", samples.hidden},
          {"droppedOverLimit", samples.overLimit}};
}

Json toJson(const FrameStats& stats) {
  return {{"images", stats.images},
          {"missingImages", stats.missingImages},
          {"samplesRead", stats.samplesRead},
          {"samplesDrawn", stats.samplesDrawn},
          {"localTriangles", stats.localTriangles},
          {"warpMs", stats.warpSeconds * 1e3},
          {"localMs", stats.localSeconds * 1e3},
          {"fillMs", stats.fillSeconds * 1e3},
          {"totalMs", stats.totalSeconds * 1e3}};
}

Json toJson(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

Status mustExist(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error || size == 0) return fail(ErrorKind::unreadable, "was not written", path.string());
  return {};
}

}  // namespace acentric::cli
