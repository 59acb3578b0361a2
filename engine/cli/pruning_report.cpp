#include "engine/cli/pruning_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/bake/test_eyes.h"
#include "engine/pipeline/pruning_classes.h"

namespace acentric::cli {
namespace {

constexpr std::size_t kLooks = 1'000'000;  // of all regions, to judge each row by
constexpr double kLosses[] = {0, 0.005, 0.002, 0.001, 0.0005, 0.0002, 0.0001};
constexpr std::uint64_t kJudge = 0x6a75646765;  // a seed that the search for eyes has no use for

/// What the test eyes lose that are asked when pruning may lose so much.
struct EyesOfRegions {
  std::size_t eyes = 0, most = 0, worst = 0;
  PruningLoss loss, worstLoss;

  void add(std::size_t region, std::size_t count, const PruningLoss& of) {
    eyes += count;
    most = std::max(most, count);
    loss += of;
    if (region == 0 || of.share() > worstLoss.share()) worst = region, worstLoss = of;
  }
};

EyesOfRegions eyesOfRegions(const OpenProject& open, const BakeSettings& settings, TaskRunner& runner,
                            std::stop_token stop) {
  const auto& regions = open.layout->regions;
  const std::size_t looks = std::max<std::size_t>(1000, kLooks / regions.size());
  EyesOfRegions out;
  RayCounts rays;
  for (std::size_t r = 0; r < regions.size() && !stop.stop_requested(); ++r) {
    const Region& region = regions[r];
    const auto found = findTestEyes(*open.rays, region.polygon, region.grown, open.layout->eyeZ(), settings,
                                    runner, rays, stop);
    const RandomLooks judge(*open.rays, region.polygon, region.grown, open.layout->eyeZ(), settings);
    out.add(r, found.eyes.size(), judge.loss(found.eyes, looks, kJudge, runner, rays, nullptr, stop));
  }
  return out;
}

Json toJson(const PruningClasses& classes) {
  Json rows = Json::array();
  for (const PruningClass& c : classes)
    rows.push_back({{"seenByFewerThan", c.seenByFewerThan},
                    {"looks", c.loss.looks},
                    {"lost", c.loss.lost},
                    {"share", c.loss.share()}});
  return rows;
}

std::string textOf(const PruningClasses& classes) {
  double looks = 0;
  for (const PruningClass& c : classes) looks += double(c.loss.looks);
  std::string text = "  with the project's, by how many of a region's eyes see it\n";
  double from = 0;
  for (const PruningClass& c : classes) {
    text += fmt::format("  {:>4.0f} to {:>3.0f} % of eyes: {:7.3f} % lost of {:7.3f} % of looks\n",
                        100 * from, 100 * c.seenByFewerThan, 100 * c.loss.share(),
                        looks > 0 ? 100 * double(c.loss.looks) / looks : 0);
    from = c.seenByFewerThan;
  }
  return text;
}

}  // namespace

Result<Report> lossesOfPruning(const std::filesystem::path& project, const Common& common) {
  const auto open = openChosen(project, common);
  if (!open) return tl::unexpected(open.error());
  BakeSettings settings = open->project.bake;
  if (!settings.pruning)
    return fail(ErrorKind::invalidArgument, "the project's bakes do not prune: nothing is lost",
                project.string());
  const auto runner = common.runner();
  std::vector<double> losses(std::begin(kLosses), std::end(kLosses));
  const double own = settings.pruningLoss;
  if (std::ranges::find(losses, own) == losses.end()) losses.push_back(own);
  std::ranges::sort(losses, [](double a, double b) { return a == 0 || (b != 0 && a > b); });
  const auto regions = open->layout->regions.size();
  Report report;
  Json rows = Json::array();
  report.text = fmt::format(
      "{} regions; what pruning loses of what random eyes see, 95 % sure in brackets\n"
      "     may lose   eyes a region  most                  lost   worst region\n",
      regions);
  for (const double loss : losses) {
    if (common.progress)
      common.progress({double(rows.size()), double(losses.size()), "looking from test eyes"});
    settings.pruningLoss = loss;
    const EyesOfRegions found = eyesOfRegions(*open, settings, *runner, common.stop);
    if (common.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
    const double eyes = double(found.eyes) / double(regions);
    rows.push_back({{"mayLose", loss},
                    {"eyesPerRegion", eyes},
                    {"mostEyes", found.most},
                    {"looks", found.loss.looks},
                    {"lost", found.loss.lost},
                    {"share", found.loss.share()},
                    {"atMost", found.loss.atMost()},
                    {"worstRegion", found.worst},
                    {"worstShare", found.worstLoss.share()},
                    {"worstAtMost", found.worstLoss.atMost()}});
    const auto percent = [](const PruningLoss& of) {
      return fmt::format("{:.4f} % (< {:.4f} %)", 100 * of.share(), 100 * of.atMost());
    };
    report.text += fmt::format("  {:>11}   {:13.1f}  {:4}  {:>20}   {} in {}{}\n",
                               loss == 0 ? "any" : fmt::format("{:.4g} %", 100 * loss), eyes, found.most,
                               percent(found.loss), percent(found.worstLoss), found.worst,
                               loss == own ? "   <- the project" : "");
  }
  const PruningClasses classes = pruningClassesOf(*open, *runner, common.stop);
  if (common.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
  report.text += textOf(classes);
  report.json = {{"project", project.string()},
                 {"regions", regions},
                 {"placedEyes", settings.testEyes},
                 {"byLoss", std::move(rows)},
                 {"byEyes", toJson(classes)}};
  return report;
}

}  // namespace acentric::cli
