#include "editor/session/bake_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "editor/session/engine_texts.h"
#include "editor/session/session.h"
#include "engine/base/priority.h"
#include "engine/pipeline/bake_plan.h"
#include "engine/pipeline/fit_resolution.h"
#include "engine/pipeline/knobs.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr double kStill = 4;             ///< seconds without a change
constexpr double kStillOnceOpened = 1;   ///< seconds
constexpr double kSizeTolerance = 0.03;  ///< of the bytes asked for
constexpr double kFar = 0.1;
constexpr std::size_t kMostKnown = 64;  ///< settings that are remembered

/// Does what is predicted of one hold for the other, for the same bake settings?
bool sameBasis(const BakeCostRequest& a, const BakeCostRequest& b) {
  if (a.threads != b.threads || a.memoryBytes != b.memoryBytes || a.open->rays != b.open->rays) return false;
  if (a.open == b.open) return true;
  Project same = b.open->project;
  same.bake = a.open->project.bake;
  same.storey = a.open->project.storey;
  return onlyViewDiffers(a.open->project, same);
}

Result<BakeCost> predict(const BakeCostRequest& request, const BakeSettings& bake, bool glance,
                         TaskRunner& runner, const Job::Context& context) {
  Project project = request.open->project;
  project.bake = bake;
  const auto open = reopenProject(*request.open, project, request.host, {}, context.stop());
  if (!open) return tl::unexpected(open.error());
  const auto storeys = openStoreys(*open, request.host, {}, context.stop());
  if (!storeys) return tl::unexpected(storeys.error());
  BakeCost cost;
  std::vector<BakeShare> shares;
  for (const OpenProject& storey : *storeys) {
    shares.push_back({&storey, allCamerasOf(*storey.layout), !storey.layout->cameras.empty()});
    cost.bakeKeys.push_back(bakeKeyOf(storey));
  }
  BakeForecastOptions options;
  options.glance = glance;
  options.memoryBytes = request.memoryBytes;
  auto forecast = forecastBake(shares, options, runner, context.progress(), context.stop());
  if (!forecast) return tl::unexpected(forecast.error());
  cost.forecast = *forecast;
  return cost;
}

Result<SizeProposal> fitSize(const BakeCostRequest& request, double bytes, TaskRunner& runner,
                             const Job::Context& context) {
  const BakeSettings& own = request.open->project.bake;
  const auto settingsAt = [&](double samplesPerDegree) {
    BakeSettings bake = own;
    bake.samplesPerDegree = std::round(samplesPerDegree * 100) / 100;
    return bake;
  };
  std::map<double, BakeCost> tried;  // by samples per degree
  const auto captureBytes = [&](double samplesPerDegree, bool glance) -> Result<double> {
    auto cost = predict(request, settingsAt(samplesPerDegree), glance, runner, context);
    if (!cost) return tl::unexpected(cost.error());
    return (tried[samplesPerDegree] = std::move(*cost)).forecast.captureBytes;
  };
  if (const auto first = captureBytes(own.samplesPerDegree, true); !first)
    return tl::unexpected(first.error());
  const BakeForecast asItIs = tried[own.samplesPerDegree].forecast;
  if (asItIs.cameras == 0)
    return fail(ErrorKind::invalidArgument, tr("there are no cells, so nothing to bake"));
  if (bytes <= asItIs.lightBytes)
    return fail(ErrorKind::invalidArgument,
                trf("light on near geometry alone takes about {:.1f} MB: ask for more, or make the "
                    "surface texel coarser",
                    asItIs.lightBytes / 1e6));
  const auto fitted = fitResolution(
      own.samplesPerDegree, bytes - asItIs.lightBytes, kSizeTolerance,
      [&](double samples) { return captureBytes(samples, true); },
      [&](double samples) { return captureBytes(samples, false); });
  if (!fitted) return tl::unexpected(fitted.error());
  return SizeProposal{bytes, settingsAt(*fitted), tried[*fitted]};
}

}  // namespace

bool SizeProposal::far() const { return std::abs(cost.forecast.bytes() / askedBytes - 1) > kFar; }

void BakeCosts::follow(const std::optional<BakeCostRequest>& project, bool shown, double now) {
  still_ = project.has_value();
  if (!project) {
    if (predicting_.running()) predicting_.abandon();
    if (sizing_.running()) sizing_.abandon();
    return;
  }
  if (!request_ || !sameBasis(*request_, *project)) {
    const bool opened = !request_ || request_->open->file != project->open->file;
    known_.clear();
    proposal_.reset();
    trouble_.clear();
    sizeTrouble_.clear();
    predicting_.abandon();
    sizing_.abandon();
    beginAt_ = now + (opened ? kStillOnceOpened : kStill);
  } else if (request_->open->project.bake != project->open->project.bake) {
    beginAt_ = now + kStill;
  }
  request_ = project;
  if (shown && now >= beginAt_ && !predicting_.running() && !sizing_.running()) predictNext();
}

const BakeCost* BakeCosts::of(const BakeSettings& bake) const {
  const auto found = std::ranges::find(known_, bake, &std::pair<BakeSettings, BakeCost>::first);
  return found == known_.end() ? nullptr : &found->second;
}

/// As it is first: that is what a bake will do now.
void BakeCosts::predictNext() {
  if (!trouble_.empty()) return;
  const BakeSettings& own = request_->open->project.bake;
  std::vector<BakeSettings> all{own};
  for (const BakePreset preset : kBakePresets) all.push_back(withPreset(own, preset));
  const auto next = std::ranges::find_if(all, [&](const BakeSettings& bake) { return of(bake) == nullptr; });
  if (next == all.end()) return;
  predicting_.restart(tr("Predicting bakes"),
                      [this, request = *request_, bake = *next](const Job::Context& context) {
                        lowerThreadPriority();
                        TaskRunner runner(request.threads - 1);
                        const auto cost = predict(request, bake, true, runner, context);
                        context.post([this, bake, cost] {
                          if (!cost && cost.error().kind != ErrorKind::cancelled)
                            trouble_ = engineText(cost.error());
                          if (cost) remember(bake, *cost);
                        });
                      });
}

/// The newest holds.
void BakeCosts::remember(const BakeSettings& bake, const BakeCost& cost) {
  std::erase_if(known_, [&](const auto& each) { return each.first == bake; });
  if (known_.size() >= kMostKnown) known_.erase(known_.begin());
  known_.emplace_back(bake, cost);
}

void BakeCosts::propose(double bytes) {
  if (!still_ || !(bytes > 0)) return;
  predicting_.abandon();  // it would compete, and goes on afterwards
  proposal_.reset();
  sizeTrouble_.clear();
  sizing_.restart(tr("Looking for a resolution"),
                  [this, request = *request_, bytes](const Job::Context& context) {
                    lowerThreadPriority();
                    TaskRunner runner(request.threads - 1);
                    const auto fitted = fitSize(request, bytes, runner, context);
                    context.post([this, fitted] {
                      if (fitted) proposal_ = *fitted, remember(fitted->bake, fitted->cost);
                      if (!fitted && fitted.error().kind != ErrorKind::cancelled)
                        sizeTrouble_ = engineText(fitted.error().message);
                    });
                  });
}

const SizeProposal* BakeCosts::proposal() const {
  if (!proposal_ || !request_) return nullptr;
  BakeSettings now = request_->open->project.bake;
  now.samplesPerDegree = proposal_->bake.samplesPerDegree;
  return now == proposal_->bake ? &*proposal_ : nullptr;
}

const SweepPoint* measuredWith(const Sweep& sweep, const BakeCost& cost) {
  for (const SweepPoint& point : sweep.points) {
    const bool drawnAlike = std::ranges::all_of(point.setting, [](const KnobChoice& choice) {
      const auto knob = knobOf(choice.knob);
      return knob && (*knob)->bakes;
    });
    if (point.measured() && drawnAlike &&
        std::ranges::find(cost.bakeKeys, point.bakeKey) != cost.bakeKeys.end())
      return &point;
  }
  return nullptr;
}

}  // namespace acentric::editor
