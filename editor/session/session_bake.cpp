/// Session's dealings with baking: the bake itself, and what it would take.

#include <algorithm>

#include "editor/session/session.h"
#include "engine/base/priority.h"
#include "engine/pipeline/estimate_bake.h"

namespace acentric::editor {
namespace {

/// The current storey first; progress runs from 0 to 1 over all of them.
Result<ProjectBakeReport> bakeAllStoreys(const OpenProject& open, const std::optional<glm::dvec2>& from,
                                         std::size_t memoryBytes, const ImportHost& host, TaskRunner& runner,
                                         const Progress& progress, std::stop_token stop) {
  auto storeys = openStoreys(open, host, {}, stop);
  if (!storeys) return tl::unexpected(storeys.error());
  std::rotate(storeys->begin(), storeys->begin() + open.project.storey, storeys->end());
  ProjectBakeReport all;
  for (std::size_t s = 0; s < storeys->size(); ++s) {
    const Progress part = [&](const ProgressState& state) {
      if (storeys->size() == 1) return progress(state);
      const double done = state.total > 0 ? state.done / state.total : 0;
      progress({(double(s) + done) / double(storeys->size()), 1,
                (*storeys)[s].project.current().name + ": " + state.stage});
    };
    BakeRequest request;
    request.memoryBytes = memoryBytes;
    request.coarseFirst = true;
    if (from) request.cameras = bakingOrder((*storeys)[s], *from);
    const auto report = bakeProject((*storeys)[s], request, runner, part, stop);
    if (!report) return report;
    all.add(*report);
  }
  return all;
}

}  // namespace

int Session::bakeThreads() const {
  const int wanted = preferences_.bakeThreads > 0 ? preferences_.bakeThreads : processors_ - 1;
  return std::clamp(wanted, 1, processors_);
}

void Session::startBake(const std::optional<glm::dvec2>& from) {
  if (!built_ || baking_.running()) return;
  eta_.reset();
  bakeProgressSeen_ = 0;
  bakeGate_.open();
  baking_.restart("Baking", [this, open = built_, from, threads = bakeThreads(),
                             memory = std::size_t(preferences_.bakeMegabytes) * 1'000'000,
                             host = options_.importHost](const Job::Context& context) {
    lowerThreadPriority();  // the window comes first
    TaskRunner runner(threads - 1, &bakeGate_);
    const auto report = bakeAllStoreys(*open, from, memory, host, runner, context.progress(), context.stop());
    context.post([this, report] { bakeEnded(report); });
  });
}

void Session::pauseBake(bool paused) {
  if (!baking_.running() || baking_.cancelling()) return;
  eta_.reset();  // the pause is no part of the rate
  paused ? bakeGate_.close() : bakeGate_.open();
}

void Session::cancelBake() {
  baking_.cancel();
  bakeGate_.open();  // what is paused must see that it is to stop
}

void Session::bakeEnded(const Result<ProjectBakeReport>& report) {
  loadWanted_ = true;
  nextLoad_ = 0;
  if (!report) return messages_.addFailure("Baking", report.error());
  lastBake_ = *report;
  const BakeReport& captures = report->captures;
  messages_.add(MessageLevel::good, "Baked " + std::to_string(captures.baked) + " captures, " +
                                        std::to_string(captures.reused) + " were there already");
}

void Session::estimateBake() {
  if (!built_ || baking_.running()) return;
  estimate_.reset();
  estimating_.restart(
      "Estimating the bake", [this, open = built_, threads = bakeThreads()](const Job::Context& context) {
        const std::vector<bool> baked = bakedCameras(*open);
        std::vector<int> missing;
        for (std::size_t camera = 0; camera < baked.size(); ++camera)
          if (!baked[camera]) missing.push_back(int(camera));
        EstimateOptions options;
        const auto store = CaptureStore::open(captureFolderFor(open->file));
        options.surfaceLight = !store || !store->hasSurfaceLight(open->surfaceLightKey);
        Result<BakeEstimate> estimate = BakeEstimate{};
        if (!missing.empty() || options.surfaceLight) {
          TaskRunner runner(threads - 1);
          estimate = estimateProjectBake(*open, missing, options, runner, context.progress(), context.stop());
        }
        const EffectCosts costs =
            measureEffectCosts(*open->rays, *open->layout, open->project.bake, context.stop());
        context.post([this, open, threads, estimate, costs] {
          if (!estimate) return messages_.addFailure("Estimating the bake", estimate.error());
          estimate_ = Estimate{open, threads, *estimate, costs};
        });
      });
}

const BakeEstimate* Session::estimate() const {
  const bool current = estimate_ && built_ && estimate_->of->keys == built_->keys &&
                       estimate_->of->surfaceLightKey == built_->surfaceLightKey &&
                       estimate_->threads == bakeThreads();
  return current ? &estimate_->figures : nullptr;
}

const EffectCosts* Session::effectCosts() const {
  const bool current = estimate_ && built_ && estimate_->costs.pixels > 0 &&
                       estimate_->of->rays == built_->rays &&
                       estimate_->of->project.bake == built_->project.bake;
  return current ? &estimate_->costs : nullptr;
}

}  // namespace acentric::editor
