#include "engine/export/bundle_places.h"

#include <limits>
#include <numeric>

#include "engine/layout/storey_choice.h"

namespace acentric {
namespace {

/// One place a storey.
class WholeBundle final : public BundlePlaces {
 public:
  WholeBundle(const std::shared_ptr<const BundleFiles>& files, Bundle bundle)
      : bundle_(std::make_shared<const Bundle>(std::move(bundle))) {
    for (std::size_t s = 0; s < bundle_->storeys.size(); ++s) {
      auto place = std::make_shared<BundlePlace>();
      place->page = place->storey = s;
      place->bundle = bundle_;
      place->cameras.resize(bundle_->storeys[s].cameras.size());
      place->regions.resize(bundle_->storeys[s].local.size());
      for (auto* numbers : {&place->cameras, &place->regions})
        std::iota(numbers->begin(), numbers->end(), 0U);
      place->own.assign(place->regions.size(), 1);
      place->files = files;
      places_.push_back(std::move(place));
    }
  }

  const Bundle& root() const override { return *bundle_; }
  Counts counts(std::size_t storey) const override {
    return {places_[storey]->cameras.size(), places_[storey]->regions.size()};
  }
  Result<std::size_t> storeyAt(const glm::dvec3& eye) override {
    std::size_t best = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; places_.size() > 1 && s < places_.size(); ++s) {
      const double misfit = misfitOf(bundle_->storeys[s].layout, eye);
      if (misfit < nearest) nearest = misfit, best = s;
    }
    return best;
  }
  Result<BundlePlacePtr> placeAt(std::size_t storey, const glm::dvec2&) override { return places_[storey]; }
  void readAhead(std::size_t, const glm::dvec2&) override {}
  Result<BundlePlacePtr> placeOfCamera(std::size_t storey, std::size_t) override { return places_[storey]; }
  Result<BundlePlacePtr> placeOfRegion(std::size_t storey, std::size_t) override { return places_[storey]; }
  Result<CameraFacts> camera(std::size_t storey, std::size_t camera) override {
    const BundleStorey& of = bundle_->storeys[storey];
    return factsOf(of.layout.cameras[camera], of.cameras[camera]);
  }
  Result<RegionFacts> region(std::size_t storey, std::size_t region) override {
    const BundleStorey& of = bundle_->storeys[storey];
    const Region& its = of.layout.regions[region];
    const auto& local = of.local[region];
    return RegionFacts{its.kind,
                       its.polygon.corners,
                       its.grown.corners,
                       of.neighbours[region],
                       local ? local->triangles : 0,
                       local ? local->file.bytes : 0};
  }

 private:
  std::shared_ptr<const Bundle> bundle_;
  std::vector<BundlePlacePtr> places_;  ///< by storey
};

}  // namespace

CameraFacts factsOf(const LayoutCamera& camera, const BundleCamera& renditions) {
  const auto rendition = [](const std::optional<BundleCapture>& capture) {
    if (!capture) return CameraFacts::Rendition();
    return CameraFacts::Rendition{capture->columns, capture->rows, capture->samples, capture->reflections,
                                  capture->file.bytes};
  };
  return {camera.position,
          camera.lowAzimuth,
          camera.fovRadians,
          renditions.topElevation,
          renditions.bottomElevation,
          rendition(renditions.full),
          rendition(renditions.coarse)};
}

Result<std::unique_ptr<BundlePlaces>> wholeBundle(std::unique_ptr<BundleFiles> files) {
  auto bundle = readBundle(*files);
  if (!bundle) return tl::unexpected(bundle.error());
  return std::make_unique<WholeBundle>(std::move(files), std::move(*bundle));
}

}  // namespace acentric
