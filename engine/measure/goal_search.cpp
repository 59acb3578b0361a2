#include "engine/measure/goal_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "engine/base/contract.h"

namespace acentric {
namespace {

using Known = std::map<SweepSetting, GoalFigures>;

/// log2 of bytes per pixel, log2 of milliseconds, dB.
using Effects = std::array<double, 3>;
/// Of twice the resolution, before anything is known.
constexpr Effects kUsualSlope{-0.1, 0.2, 3.5};
/// What an untried choice may do for each.
constexpr Effects kHope{-0.3, -0.3, 1.5};
constexpr double kLeastGain = 0.01;  ///< of a score; less is noise
constexpr std::size_t kTips = 3;     ///< of the best settings, that is begun from

Effects plus(Effects a, const Effects& b, double times = 1) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += times * b[k];
  return a;
}

class Model {
 public:
  Model(const GoalChoices& choices, const GoalHost& host) : choices_(choices), host_(host) {}

  /// log2, over the project's.
  double resolutionOf(const SweepSetting& setting) const {
    const auto own = std::ranges::find(setting, choices_.resolution, &KnobChoice::knob);
    double value = choices_.usualResolution;
    if (own != setting.end())
      std::from_chars(own->value.data(), own->value.data() + own->value.size(), value);
    return std::log2(value / choices_.usualResolution);
  }

  void learn(const Known& known) {
    struct Seen {
      const SweepSetting* setting;
      double resolution;
      Effects effects;
    };
    std::vector<Seen> all;
    const Effects base = measured({}, known.at({}));
    for (const auto& [setting, figures] : known)
      all.push_back({&setting, resolutionOf(setting), plus(measured(setting, figures), base, -1)});
    effects_.clear();
    slope_ = kUsualSlope;
    for (const Seen& seen : all)
      for (const KnobChoice& choice : *seen.setting)
        if (choice.knob != choices_.resolution) effects_[choice];
    // Gauss-Seidel: each in turn fits what the others leave.
    constexpr int kRounds = 30;
    constexpr double kTrust = 0.25;  // in the usual slope, as in so many settings at twice the resolution
    for (int round = 0; round < kRounds; ++round) {
      for (auto& [choice, effect] : effects_) {
        Effects sum{};
        double count = 0;
        for (const Seen& seen : all)
          if (std::ranges::find(*seen.setting, choice) != seen.setting->end())
            sum = plus(plus(sum, seen.effects), plus(changeBy(*seen.setting), effect, -1), -1), ++count;
        for (double& each : sum) each /= count;
        effect = sum;
      }
      Effects sum{};
      double squares = kTrust;
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = kTrust * kUsualSlope[k];
      for (const Seen& seen : all) {
        const Effects rest = plus(plus(seen.effects, changeBy(*seen.setting), -1), slope_, seen.resolution);
        sum = plus(sum, rest, seen.resolution);
        squares += seen.resolution * seen.resolution;
      }
      for (std::size_t k = 0; k < sum.size(); ++k) slope_[k] = sum[k] / squares;
    }
    slope_[2] = std::max(slope_[2], 0.1);  // more resolution is never worse by much
  }

  bool tried(const KnobChoice& choice) const { return effects_.contains(choice); }

  /// From what is known of another setting.
  std::optional<GoalFigures> predict(const SweepSetting& setting, const SweepSetting& from,
                                     const GoalFigures& known, bool hope) const {
    const double pixels = host_.pixels(setting), before = host_.pixels(from);
    if (!(pixels > 0 && before > 0)) return std::nullopt;
    Effects change = plus(changeBy(setting), changeBy(from), -1);
    if (hope)
      for (const KnobChoice& choice : setting)
        if (choice.knob != choices_.resolution && !tried(choice)) change = plus(change, kHope);
    return GoalFigures{known.bytes * pixels / before * std::exp2(change[0]),
                       known.frameMs * std::exp2(change[1]), known.psnr + change[2]};
  }

 private:
  Effects measured(const SweepSetting& setting, const GoalFigures& figures) const {
    return {std::log2(figures.bytes / std::max(host_.pixels(setting), 1.0)), std::log2(figures.frameMs),
            figures.psnr};
  }
  Effects changeBy(const SweepSetting& setting) const {
    Effects change{};
    for (const KnobChoice& choice : setting)
      if (const auto known = effects_.find(choice); known != effects_.end())
        change = plus(change, known->second);
    return plus(change, slope_, resolutionOf(setting));
  }

  const GoalChoices& choices_;
  const GoalHost& host_;
  std::map<KnobChoice, Effects> effects_;
  Effects slope_ = kUsualSlope;
};

class Search {
 public:
  Search(Known known, const Goals& goals, const GoalChoices& choices, const GoalHost& host)
      : known_(std::move(known)), goals_(goals), choices_(choices), host_(host), model_(choices, host) {}

  Result<Known> run() {
    while (host_.goOn()) {
      model_.learn(known_);
      const std::optional<SweepSetting> next = mostPromising();
      if (!next) break;
      const auto figures = host_.measure(*next);
      if (!figures) return tl::unexpected(figures.error());
      if (*figures)
        known_[*next] = **figures;
      else
        refuse(*next);
    }
    return std::move(known_);
  }

 private:
  SweepSetting with(const SweepSetting& setting, const std::string& knob, const std::string& value) const {
    SweepSetting changed = setting;
    std::erase_if(changed, [&](const KnobChoice& each) { return each.knob == knob; });
    if (!value.empty()) changed.push_back({knob, value});
    return host_.inOrder(std::move(changed));
  }

  /// At the resolution that is predicted to be best for it.
  SweepSetting atBestResolution(const SweepSetting& setting, const SweepSetting& from) const {
    const auto at = [&](double doublings) {
      const double value = std::clamp(choices_.usualResolution * std::exp2(doublings),
                                      choices_.leastResolution, choices_.mostResolution);
      return with(setting, choices_.resolution, fmt::format("{:.3g}", value));
    };
    const auto score = [&](double doublings) {
      const auto figures = model_.predict(at(doublings), from, known_.at(from), true);
      return figures ? scoreOf(goals_, *figures) : std::numeric_limits<double>::infinity();
    };
    // The score falls and rises but once; the figures are rounded, so that neighbours may be equal.
    constexpr int kSteps = 24;
    constexpr double kReach = 1.5;  // doublings from what is known: no farther is the model to be trusted
    const double middle = model_.resolutionOf(from);
    double best = middle, least = score(middle);
    for (int n = -kSteps; n <= kSteps; ++n) {
      const double doublings = middle + kReach * n / kSteps;
      if (const double here = score(doublings); here < least) least = here, best = doublings;
    }
    return at(best);
  }

  std::vector<SweepSetting> tips() const {
    std::vector<std::pair<double, SweepSetting>> all;
    for (const auto& [setting, figures] : known_) all.emplace_back(scoreOf(goals_, figures), setting);
    std::ranges::sort(all);
    if (all.size() > kTips) all.resize(kTips);
    std::vector<SweepSetting> best;
    for (auto& [score, setting] : all) best.push_back(std::move(setting));
    return best;
  }

  std::optional<SweepSetting> mostPromising() const {
    const std::vector<SweepSetting> from = tips();
    const double now = scoreOf(goals_, known_.at(from.front()));
    double most = 0;  // score a second
    std::optional<SweepSetting> best;
    const auto offer = [&](SweepSetting setting, const SweepSetting& tip) {
      if (known_.contains(setting) || refused(setting)) return;
      const auto figures = model_.predict(setting, tip, known_.at(tip), true);
      const double gain = figures ? now - scoreOf(goals_, *figures) : 0;
      if (gain < kLeastGain) return;
      if (const double rate = gain / host_.seconds(setting); rate > most)
        most = rate, best = std::move(setting);
    };
    for (const SweepSetting& tip : from) {
      offer(atBestResolution(tip, tip), tip);
      for (const KnobChoice& choice : choices_.choices)
        for (const std::string& value : {choice.value, std::string()}) {
          const SweepSetting changed = with(tip, choice.knob, value);
          if (changed == tip || refused(changed)) continue;
          offer(changed, tip);
          offer(atBestResolution(changed, tip), tip);
        }
    }
    return best;
  }

  /// One that could not be measured at one resolution is not tried at another.
  SweepSetting withoutResolution(SweepSetting setting) const {
    std::erase_if(setting, [&](const KnobChoice& each) { return each.knob == choices_.resolution; });
    return setting;
  }
  bool refused(const SweepSetting& setting) const {
    return refused_.contains(setting) || unfit_.contains(withoutResolution(setting));
  }
  void refuse(const SweepSetting& setting) {
    refused_.insert(setting);
    const SweepSetting rest = withoutResolution(setting);
    if (!rest.empty() && !known_.contains(rest)) unfit_.insert(rest);
  }

  Known known_;
  const Goals& goals_;
  const GoalChoices& choices_;
  const GoalHost& host_;
  Model model_;
  std::set<SweepSetting> refused_, unfit_;
};

}  // namespace

Result<Known> searchForGoals(Known known, const Goals& goals, const GoalChoices& choices,
                             const GoalHost& host) {
  require(known.contains({}), "a search begins with the project as it is");
  require(choices.usualResolution > 0, "the project has a resolution");
  return Search(std::move(known), goals, choices, host).run();
}

}  // namespace acentric
