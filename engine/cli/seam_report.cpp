#include "engine/cli/seam_report.h"

#include <fmt/format.h>

#include "engine/measure/compare.h"
#include "engine/measure/statistics.h"

namespace acentric::cli {
namespace {

PathPose poseOf(const PerspectiveView& view) { return {view.eye, view.yawRadians, view.pitchRadians}; }

PerspectiveView viewOf(const PathPose& pose, PerspectiveView view) {
  view.eye = pose.eye, view.yawRadians = pose.yawRadians, view.pitchRadians = pose.pitchRadians;
  return view;
}

/// On into the new region, or else back in the old one, as the walk goes; nothing if both are smaller.
std::optional<std::pair<PerspectiveView, PerspectiveView>> ordinaryStep(const Layout& layout, const Pop& pop,
                                                                        const glm::dvec2& along) {
  const glm::dvec3 step(kOrdinaryStep * along, 0);
  PerspectiveView on = pop.after, back = pop.before;
  on.eye += step, back.eye -= step;
  if (layout.regionAt(glm::dvec2(on.eye)) == pop.crossing.to) return std::pair(pop.after, on);
  if (layout.regionAt(glm::dvec2(back.eye)) == pop.crossing.from) return std::pair(back, pop.before);
  return std::nullopt;
}

Json toJson(const Change& change) {
  return {{"psnr", change.psnr}, {"ssim", change.ssim}, {"changedShare", change.changedShare}};
}

}  // namespace

std::vector<Pop> crossingsAlong(const PathWalk& walk, int most) {
  std::vector<Pop> pops;
  for (std::size_t i = 0; i + 1 < walk.views.size(); ++i) {
    const PerspectiveView &a = walk.views[i], &b = walk.views[i + 1];
    const std::size_t storey = storeyAt(walk.storeys, a.eye);
    if (storeyAt(walk.storeys, b.eye) != storey) continue;  // a staircase between them
    for (const RegionCrossing& crossing :
         crossingsBetween(*walk.storeys[storey].layout, poseOf(a), poseOf(b))) {
      Pop pop;
      pop.storey = storey;
      pop.crossing = crossing;
      pop.before = viewOf(crossing.before, a);
      pop.after = viewOf(crossing.after, a);
      pops.push_back(pop);
    }
  }
  return evenly(pops, most);
}

Result<std::vector<Pop>> measurePopping(const PathWalk& walk, int most, FrameMaker& maker, int truthSamples,
                                        TaskRunner& runner, const Common& common) {
  std::vector<Pop> pops = crossingsAlong(walk, most);
  const OpenProject& open = walk.storeys.front();
  for (std::size_t i = 0; i < pops.size(); ++i) {
    if (common.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
    if (common.progress) common.progress({double(i), double(pops.size()), "measuring where regions meet"});
    Pop& pop = pops[i];
    const auto before = maker.render(pop.before);
    if (!before) return tl::unexpected(before.error());
    const auto after = maker.render(pop.after);
    if (!after) return tl::unexpected(after.error());
    pop.change = changeBetween(before->colour, after->colour);
    const TruthFrame truth =
        renderTruth(*open.rays, pop.after, open.project.bake, open.project.exposure, truthSamples, runner);
    pop.psnrBefore = psnrOf(before->colour, truth.colour);
    pop.psnrAfter = psnrOf(after->colour, truth.colour);

    const Layout& layout = *walk.storeys[pop.storey].layout;
    const glm::dvec2 across(pop.crossing.after.eye - pop.crossing.before.eye);
    const auto step = ordinaryStep(layout, pop, glm::normalize(across));
    if (!step) continue;
    const auto from = maker.render(step->first), to = maker.render(step->second);
    if (!from) return tl::unexpected(from.error());
    if (!to) return tl::unexpected(to.error());
    pop.step = changeBetween(from->colour, to->colour);
  }
  return pops;
}

SeamReport reportPopping(const std::vector<Pop>& pops) {
  SeamReport report;
  std::vector<double> psnr, ssim, changed, stepPsnr, stepSsim, stepChanged;
  Json list = Json::array();
  for (const Pop& pop : pops) {
    psnr.push_back(pop.change.psnr), ssim.push_back(pop.change.ssim);
    changed.push_back(pop.change.changedShare);
    Json entry = {{"eye", cli::toJson(pop.after.eye)}, {"fromRegion", pop.crossing.from},
                  {"toRegion", pop.crossing.to},       {"pop", toJson(pop.change)},
                  {"psnrBefore", pop.psnrBefore},      {"psnrAfter", pop.psnrAfter}};
    if (pop.step) {
      stepPsnr.push_back(pop.step->psnr), stepSsim.push_back(pop.step->ssim);
      stepChanged.push_back(pop.step->changedShare);
      entry["step"] = toJson(*pop.step);
    }
    list.push_back(std::move(entry));
  }
  const auto spreads = [](const Spread& p, const Spread& s, const Spread& c) {
    return Json{{"psnrMedian", p.median}, {"psnrWorst", p.min},        {"ssimMedian", s.median},
                {"ssimWorst", s.min},     {"changedMedian", c.median}, {"changedWorst", c.max}};
  };
  const Spread p = spreadOf(psnr), s = spreadOf(ssim), c = spreadOf(changed);
  const Spread sp = spreadOf(stepPsnr), ss = spreadOf(stepSsim), sc = spreadOf(stepChanged);
  report.json = {{"crossings", pops.size()},
                 {"visibleStepCodes", kVisibleStep},
                 {"pop", spreads(p, s, c)},
                 {"ordinaryStepMetres", kOrdinaryStep},
                 {"ordinaryStep", spreads(sp, ss, sc)},
                 {"list", std::move(list)}};
  if (pops.empty()) {
    report.text = "  the path crosses no border between regions\n";
    return report;
  }
  const auto line = [](const char* what, const Spread& psnrs, const Spread& ssims, const Spread& changes) {
    return fmt::format(
        "  {:<34} PSNR {:5.1f} dB median {:5.1f} dB worst; SSIM {:.4f}, {:.4f}; pixels changed {:.2f} %, "
        "{:.2f} "
        "%\n",
        what, psnrs.median, psnrs.min, ssims.median, ssims.min, 100 * changes.median, 100 * changes.max);
  };
  report.text = line(fmt::format("{} changes of region", pops.size()).c_str(), p, s, c);
  if (sp.count > 0)
    report.text +=
        line(fmt::format("beside each a step of {:.0f} mm", 1e3 * kOrdinaryStep).c_str(), sp, ss, sc);
  return report;
}

SeamReport reportSeam(const SeamSums& sums) {
  SeamReport report;
  report.json = {{"pairs", sums.across.pairs},
                 {"silhouettePairs", sums.silhouettes},
                 {"localRms", sums.localError()},
                 {"capturedRms", sums.capturedError()},
                 {"meanExcess", sums.across.meanExcess()},
                 {"visibleShare", sums.across.visibleShare()},
                 {"within",
                  {{"pairs", sums.within.pairs},
                   {"meanExcess", sums.within.meanExcess()},
                   {"visibleShare", sums.within.visibleShare()}}}};
  if (sums.across.pairs == 0) {
    report.text = "  no surface goes on from local geometry to what cameras painted in these frames\n";
    return report;
  }
  report.text = fmt::format(
      "  border of local geometry: {} pairs of pixels on one surface (and {} at silhouettes)\n"
      "    error beside it   local {:.2f} codes RMS, captured {:.2f}\n"
      "    step more than in the truth   {:.2f} codes mean, visible at {:.2f} %; elsewhere {:.2f} and {:.2f} "
      "%\n",
      countText(sums.across.pairs), countText(sums.silhouettes), sums.localError(), sums.capturedError(),
      sums.across.meanExcess(), 100 * sums.across.visibleShare(), sums.within.meanExcess(),
      100 * sums.within.visibleShare());
  return report;
}

}  // namespace acentric::cli
