#include <algorithm>

#include "engine/bench/bake_to_size.h"
#include "engine/bench/make_representation.h"
#include "engine/bench/merged_bake.h"

namespace acentric {
namespace {

class PanoramaView final : public RepresentationView {
 public:
  PanoramaView(const OpenProject& open, std::shared_ptr<const PanoramaSet> set,
               std::vector<std::shared_ptr<const DisplayCapture>> captures)
      : set_(std::move(set)),
        settings_(open.project.view),
        patches_(settings_.reconstruction == Reconstruction::patches && open.project.bake.silhouettes) {
    walk_.scene = open.scene, walk_.plan = open.plan, walk_.exposure = open.project.exposure;
    walk_.layout = std::shared_ptr<const Layout>(set_, &set_->layout);
    walk_.captures = std::move(captures);
    settings_.renderer = patches_ ? Renderer::list : Renderer::zbuffer;
  }
  Result<Frame> render(const PerspectiveView& view, TaskRunner& runner, FrameMemory& memory) const override {
    std::vector<int> cameras = set_->camerasFor(glm::dvec2(view.eye));
    if (patches_) std::ranges::reverse(cameras);  // the nearest is painted over the others
    const auto plan = planCaptures(walk_, view, settings_, cameras);
    if (!plan) return tl::unexpected(plan.error());
    return renderPlan(walk_, view, settings_, *plan, runner, memory);
  }

 private:
  std::shared_ptr<const PanoramaSet> set_;
  WalkScene walk_;
  ViewSettings settings_;
  bool patches_;  ///< in order; else splats by depth test
};

Result<std::vector<std::shared_ptr<const DisplayCapture>>> loadCaptures(const Workplace& at,
                                                                        const SizedCaptures& sized) {
  std::vector<std::shared_ptr<const DisplayCapture>> captures;
  for (const ContentKey& key : sized.open.keys) {
    if (at.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
    const auto capture = sized.store.get(key);
    if (!capture) return tl::unexpected(capture.error());
    captures.push_back(
        std::make_shared<const DisplayCapture>(prepareForDisplay(*capture, at.open.project.exposure)));
  }
  return captures;
}

/// How they are baked, within `set`.
CaptureBake bakeOf(const Workplace& at, const std::string& name,
                   const std::shared_ptr<const PanoramaSet>& set, bool merged) {
  const auto openAt = [&at, name, set](double samplesPerDegree) -> Result<OpenProject> {
    OpenProject open = at.open;
    open.file = at.fileOf(name);
    open.project.bake.samplesPerDegree = samplesPerDegree;
    open.project.bake.maxLayers = 1;
    open.project.bake.pruning = false;
    open.layout = std::shared_ptr<const Layout>(set, &set->layout);
    open.keys = captureKeys(*open.scene, open.plan, open.project.bake, *open.layout);
    return open;
  };
  const std::size_t together = std::size_t(set->groups.front().cameras);
  return merged ? mergedBake(at, openAt, together) : plainBake(at, openAt);
}

}  // namespace

Result<RepresentationBake> bakeOfPanoramas(const Workplace& at, const std::string& name,
                                           const PanoramaSet& panoramas, bool merged,
                                           const SizeTarget& target) {
  const CaptureBake captures = bakeOf(at, name, std::make_shared<const PanoramaSet>(panoramas), merged);
  const auto there = isBakedToSize(at, name, captures, target.bytes, target.tolerance);
  if (!there) return tl::unexpected(there.error());
  auto open = captures.at(at.open.project.bake.samplesPerDegree);
  if (!open) return tl::unexpected(open.error());
  RepresentationBake bake{std::move(*open)};
  if (!*there) bake.cameras = allCamerasOf(*bake.open.layout);
  bake.packedBytes = target.bytes;
  return bake;
}

Result<Representation> makePanoramas(const Workplace& at, const std::string& name, std::string description,
                                     PanoramaSet panoramas, bool merged, const SizeTarget& target) {
  const auto set = std::make_shared<const PanoramaSet>(std::move(panoramas));
  auto sized = bakeToSize(at, name, bakeOf(at, name, set, merged), target.bytes, target.tolerance);
  if (!sized) return tl::unexpected(sized.error());
  auto captures = loadCaptures(at, *sized);
  if (!captures) return tl::unexpected(captures.error());
  Representation made{name, std::move(description), sized->cost, nullptr};
  for (const auto& capture : *captures) made.cost.samples += capture->samples.size();
  made.view = std::make_unique<const PanoramaView>(at.open, set, std::move(*captures));
  return made;
}

}  // namespace acentric
