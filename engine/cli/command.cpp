#include "engine/cli/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "engine/view_gl/gl_renderer.h"

namespace acentric::cli {

int Common::threadCount() const {
  return threads > 0 ? threads : std::max(1, int(std::thread::hardware_concurrency()));
}

std::unique_ptr<TaskRunner> Common::runner() const { return std::make_unique<TaskRunner>(threadCount() - 1); }

struct FrameMaker::Gl {
  std::unique_ptr<HeadlessContext> context;
  std::unique_ptr<GlRenderer> renderer;  // destroyed before its context
  ~Gl() { renderer.reset(); }
};

FrameMaker::FrameMaker(const OpenProject& open, TaskRunner& runner) : open_(open), runner_(runner) {}
FrameMaker::~FrameMaker() = default;

Result<std::unique_ptr<FrameMaker>> FrameMaker::create(const OpenProject& open,
                                                       const std::string& rendererName, const Common& common,
                                                       TaskRunner& runner) {
  std::unique_ptr<FrameMaker> maker(new FrameMaker(open, runner));
  maker->settings = open.project.view;
  maker->truth_ = rendererName == "truth";
  if (maker->truth_) return maker;
  const auto renderer = parseRenderer(rendererName);
  if (!renderer) return tl::unexpected(renderer.error());
  maker->settings.renderer = *renderer;
  auto loaded = loadWalk(open, nullptr, runner, common.progress, common.stop);
  if (!loaded) return tl::unexpected(loaded.error());
  maker->loaded_ = std::move(*loaded);
  if (maker->loaded_.missing == int(maker->loaded_.keys.size()))
    return fail(ErrorKind::notFound, "nothing is baked yet; run `acentric bake` on it first",
                open.file.string());
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

Result<Frame> FrameMaker::render(const PerspectiveView& view) {
  if (Status sound = view.check(); !sound) return tl::unexpected(sound.error());
  if (truth_) {
    TruthFrame truth =
        renderTruth(*open_.rays, view, open_.project.bake, open_.project.exposure, truthSamples, runner_);
    Frame frame;
    frame.colour = std::move(truth.colour);
    frame.source = Image<PixelSource>(view.width, view.height, kSourceLocal);
    return frame;
  }
  if (!gl_) return renderFrame(loaded_.walk, view, settings, runner_);
  auto stats = gl_->renderer->draw(loaded_.walk, view, settings);
  if (!stats) return tl::unexpected(stats.error());
  Frame frame = gl_->renderer->readBack();
  frame.stats = *stats;
  return frame;
}

ImportOptions importOptions(const std::string& up, double metresPerUnit) {
  ImportOptions options;
  options.metresPerUnit = metresPerUnit;
  options.up = up == "y" ? UpAxis::y : up == "z" ? UpAxis::z : UpAxis::guess;
  return options;
}

double megapixelsOf(const OpenProject& open) {
  double pixels = 0;
  for (const LayoutCamera& camera : open.layout->cameras) {
    const ColumnCamera c = columnCameraFor(camera, open.layout->eyeZ(), open.project.layout.nearBand,
                                           open.scene->bounds, open.plan.on(Effect::sky), open.project.bake);
    pixels += double(c.columns) * c.rows;
  }
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
  return {
      {"primary", rays.primary}, {"shadow", rays.shadow}, {"ambient", rays.ambient}, {"mirror", rays.mirror}};
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
