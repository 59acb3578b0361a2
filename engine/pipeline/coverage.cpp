#include "engine/pipeline/coverage.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "engine/bake/flush_denormals.h"
#include "engine/bake/region_sight.h"
#include "engine/bake/shading.h"
#include "engine/bake/surface.h"
#include "engine/inspect/random_poses.h"
#include "engine/measure/compare.h"
#include "engine/measure/correlation.h"
#include "engine/scene/surface_alpha.h"

namespace acentric {
namespace {

class SceneTracer final : public OpaqueTracer {
 public:
  explicit SceneTracer(RayScenePtr rays)
      : rays_(std::move(rays)),
        rules_(materialRules(rays_->scene(), rays_->plan())),
        detail_(detailRules(rays_->plan())) {}

  OpaqueHit trace(const glm::dvec3& origin, const glm::dvec3& direction, double nearest,
                  double farthest) const override {
    constexpr int kMostClearSurfaces = 256;
    const FlushDenormals flush;
    Ray ray{glm::vec3(origin), glm::vec3(direction), float(nearest), float(farthest)};
    for (int n = 0; n < kMostClearSurfaces; ++n) {
      const Hit hit = rays_->trace(ray);
      if (!hit.found()) return {};
      if (opaque(hit, -ray.direction)) return {double(hit.distance), glm::dvec3(hit.geometricNormal())};
      ray.nearest = justBehind(hit.distance);
    }
    return {};
  }

 private:
  /// As Shader finds the alpha of a hit.
  bool opaque(const Hit& hit, const glm::vec3& toViewer) const {
    const auto material = std::size_t(rays_->scene().meshOf(hit.mesh).material);
    const MaterialRules& rules = rules_[material];
    if (!rules.clear()) return true;
    const Surface surface = detail_.any() ? surfaceAt<true>(rays_->scene(), hit, toViewer, detail_, false)
                                          : surfaceAt<false>(rays_->scene(), hit, toViewer, detail_, false);
    float alpha = rules.blended ? std::clamp(surface.baseColour.a, 0.0f, 1.0f) : 1.0f;
    if (rules.transmissive)
      alpha *= glassAlpha(rays_->scene().materials[material].transmission, glm::vec3(surface.baseColour),
                          glm::dot(surface.normal, toViewer))
                   .alpha();
    return alpha >= kOpaqueAlpha;
  }

  RayScenePtr rays_;
  std::vector<MaterialRules> rules_;
  DetailRules detail_;
};

/// Asks RegionSight, by which the bake prunes. The eyes of a camera are placed when it is asked first.
class BakeSight final : public CaptureSight {
 public:
  BakeSight(const OpenProject& open, const BakeSettings& settings)
      : rays_(open.rays),
        layout_(open.layout),
        settings_(settings),
        testEyes_(*rays_, settings_),
        skyEyes_(*rays_, forSky(settings_)),
        sights_(std::make_unique<Lazy[]>(layout_->cameras.size())) {}

  bool keeps(int camera, std::size_t role, const glm::dvec3& point, const OpaqueHit& hit,
             const glm::dvec3& direction) const override {
    const FlushDenormals flush;
    const RegionSight& sight = sightOf(camera).toKeep;
    RegionSight::Hints hints = sight.hints();
    RayCounts rays;
    const MetSurface surface(glm::vec3(hit.normal), point, glm::vec3(direction));
    return sight.sees(role, surface, kSameDepth * rowPitch(camera) * hit.distance, hints, rays) != Side::none;
  }
  bool keepsSky(int camera, std::size_t role, const glm::dvec3& direction) const override {
    const FlushDenormals flush;
    const RegionSight& sight = sightOf(camera).ofSky;
    RegionSight::Hints hints = sight.hints();
    return sight.any(role, hints, [&](const EyeView& view, std::size_t) {
      return !std::isfinite(rays_->occluderDistance({glm::vec3(view.eye()), glm::vec3(direction)}));
    });
  }
  double rightBehind(int camera) const override {
    return std::max(kSameDepth * rowPitch(camera), kSameSurface);
  }

 private:
  double rowPitch(int camera) const {
    return radians(1.0) / samplesPerDegreeOf(layout_->cameras[std::size_t(camera)], settings_);
  }

  struct Sights {
    RegionSight toKeep, ofSky;
  };
  struct Lazy {
    std::once_flag once;
    std::unique_ptr<const Sights> sights;
  };
  const Sights& sightOf(int camera) const {
    Lazy& lazy = sights_[std::size_t(camera)];
    std::call_once(lazy.once, [&] {
      const LayoutCamera& served = layout_->cameras[std::size_t(camera)];
      lazy.sights = std::make_unique<const Sights>(
          Sights{RegionSight::untraced(*rays_, served, layout_->eyeZ(), testEyes_),
                 RegionSight::untraced(*rays_, served, layout_->eyeZ(), skyEyes_)});
    });
    return *lazy.sights;
  }

  static BakeSettings forSky(BakeSettings settings) {
    settings.testEyes = kSkyEyes;
    settings.pruningLoss = 0;
    return settings;
  }

  RayScenePtr rays_;
  std::shared_ptr<const Layout> layout_;
  BakeSettings settings_;
  mutable TestEyes testEyes_, skyEyes_;
  std::unique_ptr<Lazy[]> sights_;
};

std::unique_ptr<CaptureSight> sightFor(const OpenProject& open, ProjectReach::Eyes eyes) {
  BakeSettings settings = open.project.bake;
  if (!settings.pruning) return nullptr;
  if (eyes == ProjectReach::Eyes::placed) settings.pruningLoss = 0;
  return std::make_unique<BakeSight>(open, settings);
}

std::vector<ColumnCamera> columnsOf(const OpenProject& open) {
  std::vector<ColumnCamera> columns;
  for (const LayoutCamera& camera : open.layout->cameras)
    columns.push_back(columnCameraFor(camera, *open.layout, open.scene->bounds, open.project.bake));
  return columns;
}

void countPixels(const Frame& frame, const ViewHoles& holes, HoleSample& sample) {
  for (std::size_t i = 0; i < frame.source.pixels.size(); ++i) {
    const PixelSource source = frame.source.pixels[i];
    const bool hole =
        (source == kSourceHole || source == kSourceInvented) && std::isfinite(holes.rayDistance.pixels[i]);
    const bool predicted = holes.openPixels.pixels[i] != 0;
    sample.holes += hole ? 1 : 0;
    sample.predicted += predicted ? 1 : 0;
    sample.both += hole && predicted ? 1 : 0;
  }
}

/// Means over the frames of each eye.
std::vector<HoleSample> byEye(const std::vector<HoleSample>& frames) {
  std::vector<HoleSample> eyes;
  for (std::size_t first = 0, last = 0; first < frames.size(); first = last) {
    HoleSample sum = frames[first];
    for (last = first + 1; last < frames.size() && frames[last].view.eye == sum.view.eye; ++last) {
      const HoleSample& frame = frames[last];
      sum.missed += frame.missed, sum.open += frame.open, sum.measured += frame.measured;
    }
    const double n = double(last - first);
    sum.missed /= n, sum.open /= n, sum.measured /= n;
    eyes.push_back(sum);
  }
  return eyes;
}

Correlation correlationOf(const std::vector<HoleSample>& eyes, double HoleSample::*predicted) {
  std::vector<double> x, y;
  for (const HoleSample& eye : eyes) x.push_back(eye.*predicted), y.push_back(eye.measured);
  return {pearson(x, y), spearman(x, y)};
}

}  // namespace

std::unique_ptr<OpaqueTracer> opaqueTracerFor(RayScenePtr rays) {
  return std::make_unique<SceneTracer>(std::move(rays));
}

ProjectReach::ProjectReach(const OpenProject& open, Eyes eyes)
    : layout_(open.layout),
      tracer_(opaqueTracerFor(open.rays)),
      sight_(sightFor(open, eyes)),
      reach_(*layout_, columnsOf(open), open.project.bake.maxLayers, *tracer_, sight_.get()) {}

SurfaceCoverageOptions surfaceCoverageOptionsFor(const Project& project, int displayWidth) {
  SurfaceCoverageOptions options;
  options.everyCover = project.view.secondaryCover;
  options.eyes.lower = options.eyes.higher = project.bake.eyeRange;
  options.focalPixels = 0.5 * displayWidth / std::tan(0.5 * radians(project.fovDegrees));
  return options;
}

Result<std::vector<PerspectiveView>> randomLooks(const OpenProject& open, int count, int width, int height) {
  constexpr int kLooks = 6;
  RandomPoseOptions options;
  options.count = count;
  const auto poses = randomPoses(standingAreaOf(*open.layout), options);
  if (!poses) return tl::unexpected(poses.error());
  std::vector<PerspectiveView> views;
  for (const RandomPose& pose : *poses) {
    PerspectiveView view;
    // Pitches are as good as drawn for heights.
    const double above = open.project.bake.eyeRange * pose.pitchRadians / options.mostPitch;
    view.eye = {pose.place, open.layout->eyeZ() + above};
    view.fovRadians = kTwoPi / kLooks;
    view.width = width, view.height = height;
    for (int k = 0; k < kLooks; ++k) {
      view.yawRadians = pose.yawRadians + k * kTwoPi / kLooks;
      views.push_back(view);
    }
  }
  return views;
}

Result<HoleCorrelation> correlateHoles(const ProjectReach& reach, const std::vector<PerspectiveView>& views,
                                       const ViewSettings& settings,
                                       const std::function<Result<Frame>(const PerspectiveView&)>& render,
                                       TaskRunner& runner, const Progress& progress, std::stop_token stop) {
  HoleCorrelation out;
  for (const PerspectiveView& view : views) {
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "the comparison was stopped");
    if (progress) progress({double(out.frames.size()), double(views.size()), "comparing holes"});
    const auto holes = predictHoles(*reach, view, settings, runner);
    if (!holes) return tl::unexpected(holes.error());
    const auto frame = render(view);
    if (!frame) return tl::unexpected(frame.error());
    HoleSample sample{view, holes->missed, holes->open, holeShareOf(*frame, holes->rayDistance),
                      frame->stats.missingImages};
    countPixels(*frame, *holes, sample);
    out.frames.push_back(sample);
  }
  const std::vector<HoleSample> eyes = byEye(out.frames);
  out.eyes = int(eyes.size());
  out.missed = correlationOf(eyes, &HoleSample::missed);
  out.open = correlationOf(eyes, &HoleSample::open);
  return out;
}

}  // namespace acentric
