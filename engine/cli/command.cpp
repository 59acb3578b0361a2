#include "engine/cli/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "engine/base/contract.h"
#include "engine/pipeline/scene_storeys.h"
#include "engine/view_gl/gl_renderer.h"

namespace acentric::cli {

int Common::threadCount() const {
  return threads > 0 ? threads : std::max(1, int(std::thread::hardware_concurrency()));
}

std::unique_ptr<TaskRunner> Common::runner() const { return std::make_unique<TaskRunner>(threadCount() - 1); }

namespace {
constexpr double kNearStorey = 0.5;  // metres
}

struct FrameMaker::Gl {
  std::unique_ptr<HeadlessContext> context;
  std::unique_ptr<GlRenderer> renderer;  // destroyed before its context
  ~Gl() { renderer.reset(); }
};

FrameMaker::FrameMaker(std::span<const OpenProject> storeys, const Common& common, TaskRunner& runner)
    : storeys_(storeys), common_(common), runner_(runner), walks_(std::make_shared<Walks>(storeys.size())) {}
FrameMaker::~FrameMaker() = default;

Result<std::unique_ptr<FrameMaker>> FrameMaker::create(std::span<const OpenProject> storeys,
                                                       const std::string& rendererName, const Common& common,
                                                       TaskRunner& runner,
                                                       const std::string& reconstruction) {
  std::unique_ptr<FrameMaker> maker(new FrameMaker(storeys, common, runner));
  maker->settings = storeys.front().project.view;
  maker->truth_ = rendererName == "truth";
  if (maker->truth_) return maker;
  const auto renderer = parseRenderer(rendererName);
  if (!renderer) return tl::unexpected(renderer.error());
  maker->settings.renderer = *renderer;
  if (!reconstruction.empty()) {
    const auto parsed = parseReconstruction(reconstruction);
    if (!parsed) return tl::unexpected(parsed.error());
    maker->settings.reconstruction = *parsed;
  }
  if (*renderer == Renderer::gl) {
    maker->gl_ = std::make_unique<Gl>();
    auto context = HeadlessContext::create();
    if (!context) return tl::unexpected(context.error());
    maker->gl_->context = std::move(*context);
    auto gl = GlRenderer::create();
    if (!gl) return tl::unexpected(gl.error());
    maker->gl_->renderer = std::move(*gl);
  }
  return maker;
}

Status FrameMaker::load(const glm::dvec3& eye) {
  const std::size_t storey = storeyAt(storeys_, eye);
  if (truth_ || (*walks_)[storey]) return {};
  const OpenProject& open = storeys_[storey];
  auto loaded = loadWalk(open, nullptr, runner_, common_.progress, common_.stop);
  if (!loaded) return tl::unexpected(loaded.error());
  if (loaded->missing == int(loaded->keys.size()))
    return fail(ErrorKind::notFound,
                storeys_.size() == 1
                    ? "nothing is baked yet; run `acentric bake` on it first"
                    : fmt::format("nothing is baked yet of {}; run `acentric bake` on it first",
                                  open.project.storeys[storey].name),
                open.file.string());
  (*walks_)[storey] = std::move(*loaded);
  return {};
}

Result<Frame> FrameMaker::render(const PerspectiveView& view) {
  if (Status sound = view.check(); !sound) return tl::unexpected(sound.error());
  const OpenProject& open = storeys_.front();
  if (truth_) {
    TruthFrame truth =
        renderTruth(*open.rays, view, open.project.bake, open.project.exposure, truthSamples, runner_);
    Frame frame;
    frame.colour = std::move(truth.colour);
    frame.source = Image<PixelSource>(view.width, view.height, kSourceLocal);
    return frame;
  }
  if (Status loaded = load(view.eye); !loaded) return tl::unexpected(loaded.error());
  const WalkScene& walk = (*walks_)[storeyAt(storeys_, view.eye)]->walk;
  if (!gl_) return renderFrame(walk, view, settings, runner_, memory_);
  auto stats = gl_->renderer->draw(walk, view, settings);
  if (!stats) return tl::unexpected(stats.error());
  Frame frame = gl_->renderer->readBack();
  frame.stats = *stats;
  return frame;
}

std::vector<std::string> FrameMaker::warnings() const {
  std::vector<std::string> all;
  if (gl_ && settings.reconstruction == Reconstruction::filtered)
    all.push_back("the OpenGL renderer draws splats where filtered samples are asked for");
  for (const auto& walk : *walks_)
    if (walk) {
      all.insert(all.end(), walk->warnings.begin(), walk->warnings.end());
      if (walk->coarse > 0) all.push_back(coarseText(*walk));
    }
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

Result<OpenProject> openChosen(const std::filesystem::path& file, const Common& common) {
  auto project = loadProject(file);
  if (!project) return tl::unexpected(project.error());
  if (!common.storey.empty()) {
    const auto storey = storeyOf(*project, common.storey);
    if (!storey) return tl::unexpected(storey.error());
    project->storey = *storey;
  }
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

ImportOptions importOptions(const std::string& up, double metresPerUnit) {
  ImportOptions options;
  options.metresPerUnit = metresPerUnit;
  options.up = up == "y" ? UpAxis::y : up == "z" ? UpAxis::z : UpAxis::guess;
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

std::string countText(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (int at = int(digits.size()) - 3; at > 0; at -= 3) digits.insert(std::size_t(at), ",");
  return digits;
}

Json toJson(const RayCounts& rays) {
  return {{"primary", rays.primary},       {"visibility", rays.visibility}, {"shadow", rays.shadow},
          {"softShadow", rays.softShadow}, {"ambient", rays.ambient},       {"bounce", rays.bounce},
          {"mirror", rays.mirror},         {"through", rays.through},       {"gathered", rays.gathered}};
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
