/// Session's dealings with baking: the bake itself, and what it would take.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "editor/session/engine_texts.h"
#include "editor/session/session.h"
#include "engine/base/file.h"
#include "engine/base/priority.h"
#include "engine/pipeline/bake_guard.h"
#include "engine/pipeline/estimate_bake.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

/// Of all storeys, the current one first: each with its own order.
struct StoreysToBake {
  std::vector<OpenProject> storeys;
  std::vector<std::vector<int>> order;
};

Result<StoreysToBake> planStoreys(const OpenProject& open, const std::optional<glm::dvec2>& from,
                                  const ImportHost& host, const std::stop_token& stop) {
  auto storeys = openStoreys(open, host, {}, stop);
  if (!storeys) return tl::unexpected(storeys.error());
  StoreysToBake plan{std::move(*storeys), {}};
  std::ranges::rotate(plan.storeys, plan.storeys.begin() + open.project.storey);
  for (const OpenProject& storey : plan.storeys)
    plan.order.push_back(from ? bakingOrder(storey, *from) : bakingOrder(storey));
  return plan;
}

std::vector<QueuedCamera> queueOf(const StoreysToBake& plan) {
  std::vector<QueuedCamera> queue;
  for (std::size_t s = 0; s < plan.storeys.size(); ++s) {
    const OpenProject& open = plan.storeys[s];
    const std::vector<bool> baked = bakedCameras(open);
    for (const int camera : plan.order[s]) {
      const ColumnCamera columns =
          columnCameraFor(open.layout->cameras[std::size_t(camera)], open.layout->eyeZ(),
                          open.layout->spec.nearBand, open.scene->bounds, open.project.bake);
      queue.push_back({.storey = open.project.storey,
                       .camera = camera,
                       .pixels = double(columns.columns) * columns.rows,
                       .stage = baked[std::size_t(camera)] ? CameraStage::reused : CameraStage::waiting,
                       .key = open.keys[std::size_t(camera)]});
    }
  }
  return queue;
}

/// `known`: what was predicted before; it does where that is what there is to bake.
Result<BakeForecast> predict(const StoreysToBake& plan, const std::optional<BakeForecast>& known,
                             std::size_t memoryBytes, TaskRunner& runner, const Job::Context& context) {
  std::vector<BakeShare> shares;
  for (std::size_t s = 0; s < plan.storeys.size(); ++s) {
    BakeRequest request;
    request.cameras = plan.order[s];
    request.coarseFirst = true;
    shares.push_back(missingOf(plan.storeys[s], request));
  }
  int cameras = 0, lights = 0;
  for (const BakeShare& share : shares) cameras += int(share.cameras.size()), lights += int(share.light);
  if (known && known->cameras == cameras && known->lights == lights && known->memoryBytes == memoryBytes)
    return *known;
  BakeForecastOptions options;
  options.enoughSeconds = BakeForecastOptions::kUsuallyEnough;
  options.memoryBytes = memoryBytes;
  return forecastBake(shares, options, runner, context.progress(), context.stop());
}

/// Lets through what is new of a camera, and of how far it is traced about 20 times a second.
class NewsGate {
 public:
  bool open(const CameraNews& news) {
    const auto now = std::chrono::steady_clock::now();
    const bool moved = news.stage == CameraStage::tracing && news.columnsDone > 0;
    if (moved && now - last_ < std::chrono::milliseconds(50)) return false;
    if (moved) last_ = now;
    return true;
  }

 private:
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace

void Session::compareWithBake() {
  const std::set<ContentKey> used(built_->keys.begin(), built_->keys.end());
  outdatedInBake_ = int(std::ranges::count_if(bakeQueue_.cameras(), [&](const QueuedCamera& camera) {
    return camera.storey == built_->project.storey && !used.contains(camera.key);
  }));
}

int Session::bakeThreads() const {
  const int wanted = preferences_.bakeThreads > 0 ? preferences_.bakeThreads : processors_ - 1;
  return std::clamp(wanted, 1, processors_);
}

void Session::startBake(const std::optional<glm::dvec2>& from, bool takeOver) {
  if (!built_ || baking_.running() || walkRefuses(tr("Baking"))) return;
  estimating_.abandon();  // it would compete; the bake predicts for itself
  bakeQueue_.begin({});
  bakeForecast_.reset();
  neededBytes_.reset();
  bakeGate_.open();
  outdatedInBake_ = 0;
  baking_.restart(
      tr("Baking"), [this, open = built_, from, takeOver, known = knownForecast(), threads = bakeThreads(),
                     memory = std::size_t(preferences_.bakeMegabytes) * 1'000'000,
                     host = options_.importHost](const Job::Context& context) {
        lowerThreadPriority();  // the window comes first
        TaskRunner runner(threads - 1, &bakeGate_);
        auto guard = BakeGuard::begin(
            open->file,
            {{}, takeOver, tr("wait until it has ended, or take over its bake (Walk, Take over bake)")});
        Result<ProjectBakeReport> report;
        if (guard) {
          // Whether it had changed before is told elsewhere: what is shown may be baked all the same.
          guard->watch(modelFiles(open->file, open->project, host, std::filesystem::file_time_type::max()));
          if (!guard->note().empty())
            context.post(
                [this, note = guard->note()] { messages_.add(MessageLevel::warning, engineText(note)); });
          report = bakeStoreys(*open, from, known, memory, host, *guard, runner, context);
        } else {
          report = tl::unexpected(guard.error());
        }
        context.post([this, report] { bakeEnded(report); });
      });
}

/// Progress runs from 0 to 1 over all storeys.
Result<ProjectBakeReport> Session::bakeStoreys(const OpenProject& open, const std::optional<glm::dvec2>& from,
                                               const std::optional<BakeForecast>& known,
                                               std::size_t memoryBytes, const ImportHost& host,
                                               const BakeGuard& guard, TaskRunner& runner,
                                               const Job::Context& context) {
  const auto plan = planStoreys(open, from, host, context.stop());
  if (!plan) return tl::unexpected(plan.error());
  context.post([this, queue = queueOf(*plan)] {
    bakeQueue_.begin(queue);
    compareWithBake();
  });
  const auto forecast = predict(*plan, known, memoryBytes, runner, context);
  if (!forecast) return tl::unexpected(forecast.error());
  context.post([this, told = *forecast] {
    bakeForecast_ = told;
    neededBytes_ = told.bytes();
  });
  ProjectBakeReport all;
  for (std::size_t s = 0; s < plan->storeys.size(); ++s) {
    const OpenProject& storey = plan->storeys[s];
    const Progress part = [&](const ProgressState& state) {
      if (plan->storeys.size() == 1) return context.progress()(state);
      const double done = state.total > 0 ? state.done / state.total : 0;
      context.progress()({(double(s) + done) / double(plan->storeys.size()), 1,
                          storey.project.current().name + ": " + state.stage});
    };
    BakeRequest request;
    request.memoryBytes = memoryBytes;
    request.coarseFirst = true;
    request.from = from;
    request.cameras = plan->order[s];
    request.mayGoOn = [&] { return guard.check(); };
    request.watch = [&, gate = std::make_shared<NewsGate>()](const CameraNews& news) {
      if (gate->open(news))
        context.post([this, s = storey.project.storey, news] { bakeQueue_.tell(now_, s, news); });
    };
    const auto report = bakeProject(storey, request, runner, part, context.stop());
    if (!report) return report;
    all.add(*report);
  }
  return all;
}

void Session::lookAtDisk() {
  constexpr double kInterval = 2;
  if (!built_ || shipped_) return freeBytes_.reset();
  if (now_ < nextLookAtDisk_) return;
  nextLookAtDisk_ = now_ + kInterval;
  const auto free = freeSpace(captureFolderFor(file_));
  freeBytes_ = free ? std::optional(*free) : std::nullopt;
}

/// Without the scene there is nothing to predict from.
void Session::followBakeCosts() {
  const bool scene = sceneFiles_.state != SceneFiles::State::missing || sceneFiles_.fromCache;
  const bool still = built_ && !shipped_ && !rebuilding_.running() && scene && !opening_.running() &&
                     !baking_.running() && !estimating_.running() && !history_->previewing();
  if (!still) return bakeCosts_.follow(std::nullopt, false, now_);
  bakeCosts_.follow(BakeCostRequest{built_, options_.importHost, bakeThreads(),
                                    std::size_t(preferences_.bakeMegabytes) * 1'000'000},
                    costsShown_ && !working(), now_);  // what is waited for comes first
}

void Session::pauseBake(bool paused) {
  if (!baking_.running() || baking_.cancelling()) return;
  bakeQueue_.pause();
  paused ? bakeGate_.close() : bakeGate_.open();
}

void Session::cancelBake() {
  baking_.cancel();
  bakeGate_.open();  // what is paused must see that it is to stop
}

void Session::bakeEnded(const Result<ProjectBakeReport>& report) {
  bakeQueue_.end();
  const int finished = bakeQueue_.count(CameraStage::done) + bakeQueue_.count(CameraStage::reused);
  loadWanted_ = true;
  nextLoad_ = 0;
  if (!report && report.error().kind == ErrorKind::cancelled)
    return messages_.add(MessageLevel::info, trf("Baking was cancelled: {} captures and {} previews are kept",
                                                 finished, bakeQueue_.previewed()));
  if (!report) return messages_.addFailure(tr("Baking"), report.error());
  lastBake_ = *report;
  const BakeReport& captures = report->captures;
  messages_.add(MessageLevel::good,
                trf("Baked {} captures, {} were there already", captures.baked, captures.reused));
  for (const std::string& refused : report->refused)
    messages_.add(MessageLevel::error, trf("Baked, and could not be written: {}", engineText(refused)));
}

void Session::estimateBake() { estimateBake(false); }

void Session::glanceAtBake() { estimateBake(true); }

void Session::estimateBake(bool glance) {
  if (!built_ || baking_.running() || walkRefuses(tr("Estimating the bake"))) return;
  estimate_.reset();
  estimating_.restart(tr("Estimating the bake"), [this, glance, open = built_, threads = bakeThreads(),
                                                  memory = std::size_t(preferences_.bakeMegabytes) *
                                                           1'000'000](const Job::Context& context) {
    const std::vector<bool> baked = bakedCameras(*open);
    std::vector<int> missing;
    for (std::size_t camera = 0; camera < baked.size(); ++camera)
      if (!baked[camera]) missing.push_back(int(camera));
    EstimateOptions options;
    options.surfaceLight = !surfaceLightBaked(*open);
    options.memoryBytes = memory;
    options.brief = options.glance = glance;
    Result<BakeEstimate> estimate = BakeEstimate{};
    if (!missing.empty() || options.surfaceLight) {
      TaskRunner runner(threads - 1);
      estimate = estimateProjectBake(*open, missing, options, runner, context.progress(), context.stop());
    }
    const EffectCosts costs =
        measureEffectCosts(*open->rays, *open->layout, open->project.bake, context.stop());
    context.post([this, glance, open, threads, estimate, costs] {
      if (!estimate) return messages_.addFailure(tr("Estimating the bake"), estimate.error());
      estimate_ = Estimate{open, threads, *estimate, costs, glance};
    });
  });
}

const BakeEstimate* Session::estimate() const {
  const bool current = estimate_ && built_ && estimate_->of->keys == built_->keys &&
                       estimate_->of->surfaceLightKey == built_->surfaceLightKey &&
                       estimate_->threads == bakeThreads();
  return current && !(estimate_->glance && costAsSet()) ? &estimate_->figures : nullptr;
}

const BakeCost* Session::costAsSet() const {
  const BakeCost* cost = bakeCosts_.of(project().bake);
  return cost != nullptr && cost->forecast.threads == bakeThreads() ? cost : nullptr;
}

std::optional<BakeForecast> Session::knownForecast() const {
  const BakeEstimate* figures = estimate();
  if (figures == nullptr) {
    const BakeCost* cost = costAsSet();
    return cost != nullptr ? std::optional(cost->forecast) : std::nullopt;
  }
  BakeForecast forecast;
  forecast.cameras = figures->cameras;
  forecast.lights = figures->lightSamples.value > 0 ? 1 : 0;
  forecast.threads = estimate_->threads;
  forecast.captureSeconds = figures->captureSeconds.value,
  forecast.lightSeconds = figures->lightSeconds.value;
  forecast.captureBytes = figures->captureBytes.value, forecast.lightBytes = figures->lightBytes.value;
  forecast.relativeError = figures->seconds.relativeError;
  forecast.memoryBytes = std::size_t(preferences_.bakeMegabytes) * 1'000'000;
  return forecast;
}

std::optional<double> Session::bakeSecondsLeft() const {
  if (!baking_.running()) return std::nullopt;
  // The first cameras gather light for those that come after: their pace is not the bake's.
  constexpr int kTelling = 8;
  const auto left = bakeQueue_.secondsLeft(now_);
  if (!bakeForecast_ || (left && bakeQueue_.count(CameraStage::done) >= kTelling)) return left;
  return bakeForecast_->captureSeconds * (1 - bakeQueue_.share()) + bakeForecast_->lightSeconds;
}

const EffectCosts* Session::effectCosts() const {
  const bool current = estimate_ && built_ && estimate_->costs.pixels > 0 &&
                       estimate_->of->rays == built_->rays &&
                       estimate_->of->project.bake == built_->project.bake;
  return current ? &estimate_->costs : nullptr;
}

}  // namespace acentric::editor
