#include "engine/measure/sweep_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "engine/base/contract.h"

namespace acentric {
namespace {

using Known = std::map<SweepSetting, Objectives>;

/// Leads below this are rounding.
constexpr double kLeastLead = 1e-9;

std::vector<SweepSetting> frontOf(const Known& known) {
  std::vector<SweepSetting> settings, front;
  std::vector<Objectives> points;
  for (const auto& [setting, objectives] : known) settings.push_back(setting), points.push_back(objectives);
  for (const std::size_t i : paretoFront(points)) front.push_back(settings[i]);
  return front;
}

/// Times what one choice does, relative to the project as it is.
bool scale(Objectives& objectives, const Known& known, const KnobChoice& choice, double power) {
  const auto single = known.find({choice});
  if (single == known.end()) return false;
  const Objectives& base = known.at({});
  for (std::size_t k = 0; k < objectives.size(); ++k)
    objectives[k] *= std::pow(single->second[k] / base[k], power);
  return true;
}

struct Candidate {
  SweepSetting setting;
  Objectives foretold;
};

/// All that differ from a front setting by one knob.
std::vector<Candidate> neighboursOf(const SweepSetting& from, const Known& known, const SearchHost& host) {
  std::vector<Candidate> all;
  const auto offer = [&](SweepSetting setting, const Objectives& foretold) {
    all.push_back({host.inOrder(std::move(setting)), foretold});
  };
  for (const auto& [single, ignored] : known) {
    if (single.size() != 1) continue;
    const KnobChoice& choice = single.front();
    Candidate next{from, known.at(from)};
    const auto same = std::ranges::find(next.setting, choice.knob, &KnobChoice::knob);
    if (same != next.setting.end()) {
      if (!scale(next.foretold, known, *same, -1)) continue;
      next.setting.erase(same);
      offer(next.setting, next.foretold);  // one less
    }
    if (!scale(next.foretold, known, choice, 1)) continue;
    next.setting.push_back(choice);
    offer(std::move(next.setting), next.foretold);
  }
  return all;
}

}  // namespace

double lead(const Objectives& objectives, std::span<const Objectives> others) {
  double least = std::numeric_limits<double>::infinity();
  for (const Objectives& other : others) {
    require(other.size() == objectives.size(), "points are compared in the same respects");
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < objectives.size(); ++k)
      most = std::max(most, std::log(other[k] / objectives[k]));
    least = std::min(least, most);
  }
  return least;
}

Result<Known> searchCombinations(Known known, const SearchHost& host) {
  require(known.contains({}), "a search begins with the project as it is");
  std::set<SweepSetting> refused;
  while (host.goOn()) {
    std::vector<Objectives> front;
    const std::vector<SweepSetting> settings = frontOf(known);
    for (const SweepSetting& setting : settings) front.push_back(known.at(setting));
    SweepSetting best;
    double most = kLeastLead;
    for (const SweepSetting& setting : settings)
      for (const Candidate& candidate : neighboursOf(setting, known, host)) {
        if (known.contains(candidate.setting) || refused.contains(candidate.setting)) continue;
        const double ahead = lead(candidate.foretold, front);
        if (ahead > most || (ahead == most && candidate.setting < best))
          most = ahead, best = candidate.setting;
      }
    if (best.empty()) break;
    const auto measured = host.measure(best);
    if (!measured) return tl::unexpected(measured.error());
    if (*measured)
      known[best] = **measured;
    else
      refused.insert(best);
  }
  return known;
}

}  // namespace acentric
