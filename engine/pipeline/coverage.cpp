#include "engine/pipeline/coverage.h"

#include <algorithm>
#include <cmath>

#include "engine/bake/flush_denormals.h"
#include "engine/bake/shading.h"
#include "engine/bake/surface.h"
#include "engine/measure/compare.h"
#include "engine/measure/correlation.h"
#include "engine/scene/surface_alpha.h"
#include "engine/view/warp.h"

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
    const auto material = std::size_t(rays_->scene().meshes[hit.mesh].material);
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
    const bool predicted = holes.openness.pixels[i] > 0.5f;
    sample.holes += hole ? 1 : 0;
    sample.predicted += predicted ? 1 : 0;
    sample.both += hole && predicted ? 1 : 0;
  }
}

Correlation correlationOf(const std::vector<HoleSample>& frames, double HoleSample::*predicted) {
  std::vector<double> x, y;
  for (const HoleSample& frame : frames) x.push_back(frame.*predicted), y.push_back(frame.measured);
  return {pearson(x, y), spearman(x, y)};
}

}  // namespace

std::unique_ptr<OpaqueTracer> opaqueTracerFor(RayScenePtr rays) {
  return std::make_unique<SceneTracer>(std::move(rays));
}

ProjectReach::ProjectReach(const OpenProject& open)
    : layout_(open.layout),
      tracer_(opaqueTracerFor(open.rays)),
      reach_(*layout_, columnsOf(open), open.project.bake.maxLayers, *tracer_) {}

ViewHoleOptions viewHoleOptionsFor(const ViewSettings& settings) {
  ViewHoleOptions options;
  options.everyCover = settings.secondaryCover;
  options.localGeometry = settings.localGeometry;
  options.splatFactor = settings.reconstruction == Reconstruction::point ? 0
                        : followsSlant(settings.reconstruction)          ? kOverlap
                                                                         : kSlantAllowance;
  options.maxSplatPixels = settings.maxSplatPixels;
  return options;
}

SurfaceCoverageOptions surfaceCoverageOptionsFor(const Project& project, int displayWidth) {
  SurfaceCoverageOptions options;
  options.everyCover = project.view.secondaryCover;
  options.focalPixels = 0.5 * displayWidth / std::tan(0.5 * radians(project.fovDegrees));
  return options;
}

Result<HoleCorrelation> correlateHoles(const ProjectReach& reach, const std::vector<PerspectiveView>& views,
                                       const ViewHoleOptions& options,
                                       const std::function<Result<Frame>(const PerspectiveView&)>& render,
                                       TaskRunner& runner, const Progress& progress, std::stop_token stop) {
  HoleCorrelation out;
  for (const PerspectiveView& view : views) {
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "the comparison was stopped");
    if (progress) progress({double(out.frames.size()), double(views.size()), "comparing holes"});
    const auto holes = predictHoles(*reach, view, options, runner);
    if (!holes) return tl::unexpected(holes.error());
    const auto frame = render(view);
    if (!frame) return tl::unexpected(frame.error());
    HoleSample sample{view,
                      holes->missed,
                      holes->open,
                      holes->expected,
                      holeShareOf(*frame, holes->rayDistance),
                      frame->stats.missingImages};
    countPixels(*frame, *holes, sample);
    out.frames.push_back(sample);
  }
  out.missed = correlationOf(out.frames, &HoleSample::missed);
  out.open = correlationOf(out.frames, &HoleSample::open);
  out.expected = correlationOf(out.frames, &HoleSample::expected);
  return out;
}

}  // namespace acentric
