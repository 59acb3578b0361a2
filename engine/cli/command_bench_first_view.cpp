#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <set>

#include "engine/base/stopwatch.h"
#include "engine/cli/bake_notice.h"
#include "engine/cli/commands.h"
#include "engine/pipeline/trial_folder.h"

namespace acentric::cli {
namespace fs = std::filesystem;
namespace {

/// What of the first view is on disk, and since when.
class FirstView {
 public:
  FirstView(const std::vector<int>& cameras, std::stop_source enough)
      : cameras_(cameras.begin(), cameras.end()), enough_(std::move(enough)) {}

  void tell(const CameraNews& news) {
    const std::lock_guard lock(mutex_);
    if (!cameras_.contains(news.camera)) return end();
    if (news.stage != CameraStage::done && news.stage != CameraStage::reused) return;
    std::set<int>& done = news.preview ? coarse_ : full_;
    done.insert(news.camera);
    if (done.size() < cameras_.size()) return;
    std::optional<double>& seconds = news.preview ? coarseSeconds : fullSeconds;
    if (!seconds) seconds = watch_.seconds();
  }
  /// Another camera is begun, or all is baked.
  void end() {
    if (fullSeconds && !lightSeconds) lightSeconds = watch_.seconds();
    if (fullSeconds) enough_.request_stop();
  }

  std::optional<double> coarseSeconds, fullSeconds, lightSeconds;

 private:
  std::set<int> cameras_, coarse_, full_;
  std::stop_source enough_;
  std::mutex mutex_;
  Stopwatch watch_;
};

struct Model {
  OpenProject open;
  double importSeconds = 0;  ///< and making the project, with nothing of the model remembered
  double openSeconds = 0;    ///< from the project's file to where a bake can begin
};

Result<Model> makeModel(const fs::path& scene, const fs::path& folder, const BenchFirstViewOptions& options,
                        const Common& common, TaskRunner& runner) {
  ImportHost host = common.host;
  host.cacheFolder = folder / "cache";
  const fs::path file = folder / "first.acentric.json";
  NewProjectOptions choices;
  choices.import.metresPerUnit = options.metresPerUnit;
  choices.cellSize = options.cellSize;
  choices.samplesPerDegree = options.samplesPerDegree;
  choices.bakeMinutes = 0;  // first views of layouts of the same size, however fast the machine is
  const Stopwatch importing;
  const auto collected =
      collectModel(scene, file, choices.import, Collect::link, host, common.progress, common.stop);
  if (!collected) return tl::unexpected(collected.error());
  const auto project =
      makeProject(folder / collected->scene, file, choices, host, runner, common.progress, common.stop);
  if (!project) return tl::unexpected(project.error());
  if (Status saved = saveProject(project->open.project, file); !saved) return tl::unexpected(saved.error());
  Model model;
  model.importSeconds = importing.seconds();
  const Stopwatch opening;
  auto open = openProject(file, host, common.progress, common.stop);
  if (!open) return tl::unexpected(open.error());
  model.open = std::move(*open);
  model.openSeconds = opening.seconds();
  return model;
}

Result<Report> benchScene(const fs::path& scene, const BenchFirstViewOptions& options, const Common& common,
                          TaskRunner& runner) {
  std::error_code error;
  const auto folder = TrialFolder::make(fs::temp_directory_path(error));
  if (!folder) return tl::unexpected(folder.error());
  const auto model = makeModel(scene, folder->path(), options, common, runner);
  if (!model) return tl::unexpected(model.error());
  const OpenProject& open = model->open;
  const std::vector<int> cameras = firstViewCameras(open, open.project.spawn().position);
  if (cameras.empty())
    return fail(ErrorKind::notFound, "the walk begins outside all regions: there is no first view",
                scene.string());

  std::stop_source enough;
  const std::stop_callback stopToo(common.stop, [&] { enough.request_stop(); });
  BakeRequest request;
  request.coarseFirst = true;
  const BakeShare all = missingOf(open, request);
  if (const auto told = foretellBake({&all, 1}, request.memoryBytes, common, runner); !told)
    return tl::unexpected(told.error());
  FirstView view(cameras, enough);
  request.watch = [&](const CameraNews& news) { view.tell(news); };
  const auto baked = bakeProject(open, request, runner, common.progress, enough.get_token());
  if (baked) view.end();
  if (!baked && (baked.error().kind != ErrorKind::cancelled || common.stop.stop_requested()))
    return tl::unexpected(baked.error());
  if (!view.coarseSeconds || !view.fullSeconds || !view.lightSeconds)
    return fail(ErrorKind::internal, "the bake ended before its first view was there", scene.string());

  Report report;
  const std::string name = scene.parent_path().filename() / scene.filename();
  report.json = {{"scene", name},
                 {"triangles", open.scene->triangleCount()},
                 {"cellSize", open.layout->spec.cellSize},
                 {"cameras", open.layout->cameras.size()},
                 {"firstCameras", cameras.size()},
                 {"importSeconds", model->importSeconds},
                 {"openSeconds", model->openSeconds},
                 {"coarseSeconds", *view.coarseSeconds},
                 {"fullSeconds", *view.fullSeconds},
                 {"lightSeconds", *view.lightSeconds}};
  report.text = fmt::format("{:<40} {:>9} {:>4} of {:>4} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f}\n", name,
                            countText(open.scene->triangleCount()), cameras.size(),
                            open.layout->cameras.size(), model->importSeconds + model->openSeconds,
                            *view.coarseSeconds, *view.fullSeconds, *view.lightSeconds);
  return report;
}

}  // namespace

Result<Report> runBenchFirstView(const BenchFirstViewOptions& options, const Common& common) {
  const auto runner = common.runner();
  Report report;
  report.json = {{"threads", runner->threads()}, {"scenes", Json::array()}};
  report.text = fmt::format(
      "seconds with {} threads: of the import, then from the beginning of the bake\n"
      "{:<40} {:>9} {:>12} {:>9} {:>9} {:>9} {:>9}\n",
      runner->threads(), "scene", "triangles", "cameras", "import", "coarse", "full", "its light");
  for (const fs::path& scene : options.scenes) {
    auto one = benchScene(scene, options, common, *runner);
    if (!one) return one;
    report.json["scenes"].push_back(std::move(one->json));
    report.text += one->text;
  }
  return report;
}

}  // namespace acentric::cli
