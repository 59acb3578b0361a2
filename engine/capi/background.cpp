#include <algorithm>
#include <limits>
#include <utility>

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

/// Cameras of a view, nearest first, then the others of its region: numbers within the place.
std::vector<int> camerasOf(const Wanted& wanted) {
  std::vector<int> cameras(wanted.needs.cameras.rbegin(), wanted.needs.cameras.rend());
  const Layout& layout = wanted.needs.place->here().layout;
  const auto& covers = layout.regions[std::size_t(wanted.needs.region)].covers;
  for (std::size_t c = 0; c < covers.size() && (c == 0 || wanted.settings.secondaryCover); ++c)
    for (const Piece& piece : covers[c].pieces)
      if (std::ranges::find(cameras, piece.camera) == cameras.end()) cameras.push_back(piece.camera);
  return cameras;
}

std::vector<Unneeded> unneededOf(const BundlePlayer& runtime, const Wanted& wanted) {
  const BundlePlace& place = *wanted.needs.place;
  std::set<std::size_t> needed;
  for (const int camera : camerasOf(wanted)) needed.insert(place.cameras[std::size_t(camera)]);
  const glm::dvec2 eye(wanted.view.eye);
  std::vector<Unneeded> out;
  for (std::size_t s = 0; s < runtime.bundle().storeys.size(); ++s) {
    const bool here = s == place.storey;
    const auto awayOf = [&](const glm::dvec2& at) {
      return here ? glm::distance(eye, at) : std::numeric_limits<double>::infinity();
    };
    for (const auto& [number, camera] : runtime.parts(s).cameras) {
      if (here && needed.contains(number)) continue;
      const double away = awayOf(glm::dvec2(camera.best()->camera.centreOfProjection));
      if (camera.full) out.push_back({away, s, number, false, Loaded::full});
      if (camera.coarse) out.push_back({away, s, number, false, Loaded::coarse});
    }
    for (const auto& [number, region] : runtime.parts(s).regions)
      if (!here || number != place.regions[std::size_t(wanted.needs.region)])
        out.push_back({awayOf(region.middle), s, number, true, Loaded::full});
  }
  std::ranges::stable_sort(out, std::ranges::greater(), &Unneeded::away);
  return out;
}

/// Where the eye is in a page's last regions, the pages beside it: whoever draws frames does not wait for
/// them.
void readAhead(acentric_bundle& bundle, const BundlePlayer::Needs& needs) {
  const BundlePlace& place = *needs.place;
  const std::pair now(place.storey, place.regions[std::size_t(needs.region)]);
  if (std::exchange(bundle.ahead, now) == now) return;
  std::vector<glm::dvec2> points;
  for (const int neighbour : place.here().neighbours[std::size_t(needs.region)])
    if (place.own[std::size_t(neighbour)] == 0)
      points.push_back(place.here().layout.regions[std::size_t(neighbour)].polygon.centroid());
  if (points.empty()) return;
  bundle.loader->doAside([&places = bundle.runtime.places(), storey = place.storey, points] {
    for (const glm::dvec2& point : points) places.readAhead(storey, point);
  });
}

}  // namespace

namespace acentric::capi {

acentric_status request(acentric_bundle& bundle, const Wanted& wanted, Loaded detail,
                        const std::function<bool(const LoadJob&)>& wants, const LoadJob& like) {
  const BundlePlace& place = *wanted.needs.place;
  std::vector<LoadJob> jobs;
  const auto add = [&](const LoadJob& job) {
    if (wants(job) && !bundle.failed.contains(job) && std::ranges::find(jobs, job) == jobs.end())
      jobs.push_back(job);
  };
  const std::vector<int> cameras = camerasOf(wanted);
  const auto addCaptures = [&](Loaded of) {
    for (const int camera : cameras) {
      LoadJob job = like;
      job.storey = place.storey, job.number = place.cameras[std::size_t(camera)];
      job.detail = renditionOf(place.here().cameras[std::size_t(camera)], of);
      if (job.detail != Loaded::absent) add(job);
    }
  };
  addCaptures(Loaded::coarse);
  if (wanted.settings.localGeometry || like.model) {
    LoadJob job = like;
    job.region = true, job.storey = place.storey;
    job.number = place.regions[std::size_t(wanted.needs.region)];
    add(job);
  }
  if (detail == Loaded::full) addCaptures(Loaded::full);
  if (!bundle.loader)
    bundle.loader =
        std::make_unique<BackgroundLoader>(bundle.runtime.bundle().textures.size(), bundle.runtime.threads());
  bundle.loader->ask(wanted.needs.place, std::move(jobs));
  readAhead(bundle, wanted.needs);
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
                   return request(*bundle, wanted, Loaded(detail), wants, {});
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
      else if (auto* capture = std::get_if<CapturePtr>(&*next->part))
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
    if (bundle->loader) bundle->loader->ask(nullptr, {}), bundle->loader->doAside(nullptr);
    bundle->ahead.reset();
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
