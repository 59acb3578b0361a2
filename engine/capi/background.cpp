#include <algorithm>
#include <limits>

#include "engine/capi/handle.h"

using namespace acentric;
using namespace acentric::capi;

namespace {

constexpr acentric_status kOk = ACENTRIC_OK;

/// Loaded, and not needed.
struct Unneeded {
  double away;  ///< from the eye, metres
  std::size_t storey, number;
  bool region;
  Loaded detail;  ///< of a capture
};

std::vector<Unneeded> unneededOf(const BundlePlayer& runtime, const Wanted& wanted) {
  const std::vector<int> cameras = camerasOf(runtime, wanted);
  const glm::dvec2 eye(wanted.view.eye);
  std::vector<Unneeded> out;
  for (std::size_t s = 0; s < runtime.bundle().storeys.size(); ++s) {
    const Layout& layout = runtime.bundle().storeys[s].layout;
    const bool here = s == wanted.needs.storey;
    const auto awayOf = [&](const glm::dvec2& place) {
      return here ? glm::distance(eye, place) : std::numeric_limits<double>::infinity();
    };
    for (std::size_t c = 0; c < layout.cameras.size(); ++c) {
      if (here && std::ranges::find(cameras, int(c)) != cameras.end()) continue;
      for (const Loaded detail : {Loaded::full, Loaded::coarse})
        if (runtime.capture(s, c, detail) != nullptr)
          out.push_back({awayOf(layout.cameras[c].position), s, c, false, detail});
    }
    for (std::size_t r = 0; r < layout.regions.size(); ++r)
      if (runtime.regionLoaded(s, r) && !(here && int(r) == wanted.needs.region))
        out.push_back({awayOf(layout.regions[r].polygon.centroid()), s, r, true, Loaded::full});
  }
  std::ranges::stable_sort(out, std::ranges::greater(), &Unneeded::away);
  return out;
}

}  // namespace

namespace acentric::capi {

std::vector<int> camerasOf(const BundlePlayer& runtime, const Wanted& wanted) {
  std::vector<int> cameras(wanted.needs.cameras.rbegin(), wanted.needs.cameras.rend());
  const Layout& layout = runtime.bundle().storeys[wanted.needs.storey].layout;
  const auto& covers = layout.regions[std::size_t(wanted.needs.region)].covers;
  for (std::size_t c = 0; c < covers.size() && (c == 0 || wanted.settings.secondaryCover); ++c)
    for (const Piece& piece : covers[c].pieces)
      if (std::ranges::find(cameras, piece.camera) == cameras.end()) cameras.push_back(piece.camera);
  return cameras;
}

std::vector<LoadJob> jobsOf(const BundlePlayer& runtime, const Wanted& wanted, Loaded detail,
                            const std::function<bool(const LoadJob&)>& wants, const LoadJob& like) {
  const std::size_t storey = wanted.needs.storey;
  std::vector<LoadJob> jobs;
  const auto add = [&](LoadJob job) {
    if (wants(job)) jobs.push_back(job);
  };
  const std::vector<int> cameras = camerasOf(runtime, wanted);
  const auto addCaptures = [&](Loaded of) {
    for (const int camera : cameras) {
      LoadJob job = like;
      job.storey = storey, job.number = std::size_t(camera);
      job.detail = renditionOf(runtime, storey, job.number, of);
      if (job.detail != Loaded::absent && std::ranges::find(jobs, job) == jobs.end()) add(job);
    }
  };
  addCaptures(Loaded::coarse);
  if (wanted.settings.localGeometry || like.model) {
    LoadJob job = like;
    job.region = true, job.storey = storey, job.number = std::size_t(wanted.needs.region);
    add(job);
  }
  if (detail == Loaded::full) addCaptures(Loaded::full);
  return jobs;
}

acentric_status request(acentric_bundle& bundle, std::vector<LoadJob> jobs) {
  if (!bundle.loader)
    bundle.loader = std::make_unique<BackgroundLoader>(bundle.runtime, bundle.runtime.threads());
  std::erase_if(jobs, [&](const LoadJob& job) { return bundle.failed.contains(job); });
  bundle.loader->ask(std::move(jobs));
  return kOk;
}

}  // namespace acentric::capi

acentric_status acentric_request_view(acentric_bundle* bundle, const acentric_view* view,
                                      const acentric_settings* settings, int32_t detail) {
  return forView(bundle, view, settings, wrongDetail(detail),
                 [&](BundlePlayer& runtime, const Wanted& wanted) {
                   const auto wants = [&](const LoadJob& job) {
                     if (job.region) return !runtime.regionLoaded(job.storey, job.number);
                     return runtime.loaded(job.storey, job.number) < job.detail;
                   };
                   return request(*bundle, jobsOf(runtime, wanted, Loaded(detail), wants, {}));
                 });
}

acentric_status acentric_poll(acentric_bundle* bundle, int32_t* arrived) {
  if (arrived != nullptr) *arrived = 0;
  return guarded(bundle, [&](BundlePlayer& runtime) {
    const auto isKept = [](const LoadJob& job) { return !job.model; };
    while (bundle->loader) {
      std::optional<Arrival> next = bundle->loader->take(isKept);
      if (!next) break;
      const LoadJob& job = next->job;
      Status kept;
      if (!next->part)
        kept = tl::unexpected(next->part.error());
      else if (auto* region = std::get_if<ReadRegion>(&*next->part))
        kept = runtime.keepRegion(job.storey, job.number, std::move(*region));
      else if (auto* capture = std::get_if<std::shared_ptr<const DisplayCapture>>(&*next->part))
        kept = runtime.keepCapture(job.storey, job.number, job.detail, std::move(*capture));
      if (!kept) {
        bundle->failed.insert(job);
        return failed(*bundle, kept.error());
      }
      if (arrived != nullptr) ++*arrived;
    }
    return kOk;
  });
}

acentric_status acentric_cancel(acentric_bundle* bundle) {
  return guarded(bundle, [&](BundlePlayer&) {
    if (bundle->loader) bundle->loader->ask({});
    bundle->failed.clear();
    return kOk;
  });
}

int32_t acentric_waiting(const acentric_bundle* bundle) {
  if (bundle == nullptr || !bundle->loader) return 0;
  return int32_t(bundle->loader->waiting());
}

acentric_status acentric_unload_beyond(acentric_bundle* bundle, const acentric_view* view,
                                       const acentric_settings* settings, uint64_t bytes) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (view == nullptr) return refused(bundle, "view is NULL");
    if (runtime.memory() <= bytes) return kOk;
    const auto wanted = wantedOf(runtime, *view, settings);
    if (!wanted) return failedView(*bundle, wanted.error());
    for (const Unneeded& each : unneededOf(runtime, *wanted)) {
      if (runtime.memory() <= bytes) break;
      if (each.region)
        runtime.unloadRegion(each.storey, each.number);
      else
        runtime.unloadCapture(each.storey, each.number, each.detail);
    }
    return kOk;
  });
}
