#pragma once
/// What all commands share: a report that is both JSON and text, opening a project with progress, renderers
/// by name. A command returns an Error or a report; only main prints it and chooses the exit code.

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>

#include "engine/bake/truth.h"
#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/base/task_runner.h"
#include "engine/inspect/storeys.h"
#include "engine/pipeline/pipeline.h"

namespace acentric::cli {

using Json = nlohmann::ordered_json;

struct Report {
  Json json = Json::object();  ///< printed with --json
  std::string text;            ///< printed otherwise
  bool success = true;         ///< false: printed as usual, but the exit code is 1 (validate with findings)
};

struct Common {
  int threads = 0;       ///< 0 = all processors
  Progress progress;     ///< empty when not on a terminal or with --json
  std::stop_token stop;  ///< Ctrl-C
  ImportHost host;

  int threadCount() const;
  std::unique_ptr<TaskRunner> runner() const;
};

/// Renders frames of one project by any renderer name, including "gl" (headless) and "truth".
class FrameMaker {
 public:
  static Result<std::unique_ptr<FrameMaker>> create(const OpenProject& open, const std::string& rendererName,
                                                    const Common& common, TaskRunner& runner);
  ~FrameMaker();
  Result<Frame> render(const PerspectiveView& view);
  const LoadedWalk& loaded() const { return loaded_; }
  bool isTruth() const { return truth_; }
  ViewSettings settings;
  int truthSamples = 1;  ///< per pixel

 private:
  FrameMaker(const OpenProject& open, TaskRunner& runner);
  struct Gl;
  const OpenProject& open_;
  TaskRunner& runner_;
  LoadedWalk loaded_;
  bool truth_ = false;
  std::unique_ptr<Gl> gl_;
};

/// As --up and --metres-per-unit say.
ImportOptions importOptions(const std::string& up, double metresPerUnit);

/// Of all captures.
double megapixelsOf(const OpenProject& open);

/// "12.3 MB", "1,234,567".
std::string bytesText(std::uint64_t bytes);
std::string countText(std::uint64_t count);
Json toJson(const RayCounts& rays);
Json toJson(const FrameStats& stats);
Json toJson(const glm::dvec3& v);

Report storeysReport(const Storeys& storeys);

/// Fails with a message unless the file exists and is not empty: nothing is reported as done that is not on
/// disk.
Status mustExist(const std::filesystem::path& path);

}  // namespace acentric::cli
