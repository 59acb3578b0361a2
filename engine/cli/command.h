#pragma once
/// What all commands share: a report that is both JSON and text, opening a project with progress, renderers
/// by name. A command returns an Error or a report; only main prints it and chooses the exit code.

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/bake/truth.h"
#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/base/task_runner.h"
#include "engine/inspect/storeys.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/scene_scale.h"

namespace acentric::cli {

using Json = nlohmann::ordered_json;

struct Report {
  Json json = Json::object();  ///< printed with --json
  std::string text;            ///< printed otherwise
  bool success = true;         ///< false: printed as usual, but the exit code is 1 (validate with findings)
};

struct Common {
  std::string storey;  ///< of the project, as --storey says; empty = the one where its walk begins
  std::string preset;  ///< of a sweep, that the project is taken with; empty = as it is
  std::filesystem::path presetFrom;     ///< the sweep's folder or file; empty = beside the project
  int threads = 0;                      ///< 0 = all processors
  std::optional<double> walkMegabytes;  ///< for captures in memory; none = a share of the machine's
  /// Something to be known before a command goes on: as a line, or with --json as an event.
  std::function<void(const std::string& text, const Json& event)> notice;
  Progress progress;     ///< empty when not on a terminal or with --json
  std::stop_token stop;  ///< Ctrl-C
  ImportHost host;

  int threadCount() const;
  std::unique_ptr<TaskRunner> runner() const;
  std::size_t walkBytes() const;
};

/// A project's storey by its name, its height with the unit (the nearest floor within half a metre), or its
/// number in the project. Messages list what there is.
Result<int> storeyOf(const Project& project, const std::string& choice);

/// Of that name. Messages list what there is.
Result<Bookmark> bookmarkOf(const Project& project, const std::string& name);

/// The project with the storey and the preset that were chosen.
Result<Project> loadChosen(const std::filesystem::path& file, const Common& common);
/// Opens the storey that was chosen, with the preset.
Result<OpenProject> openChosen(const std::filesystem::path& file, const Common& common);
/// Opens the storey that was chosen; if none was, all of them.
Result<std::vector<OpenProject>> openStoreys(const std::filesystem::path& file, const Common& common);
/// Writes an edited project, whichever storey was chosen: its walk begins where it did.
Status saveEdited(Project project, const std::filesystem::path& file);

/// " (storey 1)" where the project has several.
std::string storeyText(const Project& project);

/// The reports on storeys as one: the only one itself, else a list "storeys" of them with their names; the
/// texts one after another.
Report byStorey(std::span<const OpenProject> storeys, std::vector<Report> reports);
Report byStorey(const std::vector<std::string>& names, std::vector<Report> reports);

/// "85.0 s", "2.3 min", "1.2 h".
std::string timeText(double seconds);

/// What the options of a command change in the project's ViewSettings.
struct Look {
  std::string reconstruction;  ///< empty = the project's
};
Status apply(const Look& look, ViewSettings& settings);

/// Renders frames of a project by any renderer name, including those of OpenGL (headless), and for comparison
/// "truth" (ray-traced), "polygons" and "gl-polygons" (every triangle of the scene, unlit). What is baked is
/// loaded as frames need it, and kept as long as there is room (Common::walkMegabytes).
class FrameMaker {
 public:
  /// `storeys`, at least one, must outlive it.
  /// No name: the project's renderer.
  static Result<std::unique_ptr<FrameMaker>> create(std::span<const OpenProject> storeys,
                                                    const std::string& rendererName, const Common& common,
                                                    TaskRunner& runner, const Look& look = {});
  /// What has been loaded, and is from now on, serves this one too: captures are in memory once, and on the
  /// graphics card.
  void shareWalksOf(const FrameMaker& other) { shared_ = other.shared_; }
  ~FrameMaker();
  /// Loads what a frame needs and opens OpenGL if it is to be used; render() does so too.
  Status load(const PerspectiveView& view);
  Result<Frame> render(const PerspectiveView& view);
  /// What the last frame from there was drawn from; null before it, and of the truth and polygons.
  std::shared_ptr<const LoadedWalk> walkAt(const glm::dvec3& eye) const;
  /// The next frame is made in the memory of one that is no longer needed.
  void recycle(Frame frame) { memory_.frame = std::move(frame); }
  /// Of the last frame that was not drawn by OpenGL, 1/m along the view's axis.
  const FloatImage& inverseZDepth() const { return memory_.inverseZDepth; }
  std::vector<std::string> warnings() const;
  /// Of the renderer that it has become.
  const std::string& name() const { return name_; }
  bool isTruth() const { return shows_ == Shows::truth; }
  ViewSettings settings;
  int truthSamples = 1;  ///< per pixel

 private:
  FrameMaker(std::span<const OpenProject> storeys, const Common& common, TaskRunner& runner);
  struct Shared;
  Status openGl();
  Status openWalk(std::size_t storey);
  std::span<const OpenProject> storeys_;
  const Common& common_;
  TaskRunner& runner_;
  std::shared_ptr<Shared> shared_;
  FrameMemory memory_;
  std::string name_;
  enum class Shows { captures, truth, polygons };
  Shows shows_ = Shows::captures;
};

/// Null where there is no doubt.
Json scaleJson(const std::optional<ScaleDoubt>& doubt);

/// As --up, --metres-per-unit and --light say.
ImportOptions importOptions(const std::string& up, double metresPerUnit, const std::string& light);

/// Of a camera's capture.
double pixelsOf(const OpenProject& open, const LayoutCamera& camera);
/// Of all captures.
double megapixelsOf(const OpenProject& open);

/// "12.3 MB", "1,234,567".
std::string bytesText(std::uint64_t bytes);
std::string countText(std::uint64_t count);
/// "27,126 triangles", "10,000,000 triangles (50,000 unique, 200 instances)".
std::string trianglesText(const Scene& scene);
Json toJson(const RayCounts& rays);
Json toJson(const CaptureSeconds& parts);
Json toJson(const SampleCounts& samples);
Json toJson(const FrameStats& stats);
Json toJson(const glm::dvec3& v);

Report storeysReport(const Storeys& storeys);

/// Fails with a message unless the file exists and is not empty: nothing is reported as done that is not on
/// disk.
Status mustExist(const std::filesystem::path& path);

}  // namespace acentric::cli
