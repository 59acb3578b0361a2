#include "engine/bake/effect_costs.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "engine/bake/bake.h"
#include "engine/bake/column_rays.h"
#include "engine/bake/flush_denormals.h"
#include "engine/bake/shading.h"
#include "engine/base/stopwatch.h"
#include "engine/geometry/conventions.h"
#include "engine/scene/surface_light.h"

namespace acentric {
namespace {

constexpr int kPixels = 1536;
constexpr int kRepeats = 3;             ///< of which the quickest counts: the machine does other things too
constexpr std::size_t kWitnesses = 24;  ///< cameras asked whether they see a place

struct Pixel {
  std::size_t camera;
  Hit hit;
  Ray ray;
};

class CostProbe {
 public:
  CostProbe(const RayScene& scene, const Layout& layout, const BakeSettings& settings, std::stop_token stop)
      : scene_(scene), layout_(layout), settings_(settings), stop_(std::move(stop)) {
    if (gathersLight(scene.plan(), settings))
      gathered_ = std::make_shared<const GatheredLight>(scene, settings);
    for (const LayoutCamera& camera : layout.cameras)
      columns_.push_back(columnCameraFor(camera, layout, scene.scene().bounds, settings));
    for (int n = 0; n < kPixels && !columns_.empty(); ++n) addPixel(n);
  }
  const std::vector<Pixel>& pixels() const { return pixels_; }

  double secondsToTrace() const {
    return quickest([&] {
      for (const Pixel& pixel : pixels_) found_ += scene_.trace(pixel.ray).found() ? 1 : 0;
    });
  }
  double secondsToShade(const EffectPlan& plan) const {
    const Shader shader(scene_, plan, settings_, gathered_, stop_);
    return quickest([&] { shadeAll(shader); });
  }
  double secondsToShadeFirst() const {
    const Shader shader(scene_, scene_.plan(), settings_, gathered_, stop_);
    const Stopwatch watch;
    shadeAll(shader);
    return watch.seconds();
  }

  /// Of the places around a pixel that are gathered when nobody has read them, the share that falls to it in
  /// a whole bake: places per square metre over the pixels of all cameras there.
  double shareOfPlaces() const {
    const double texel = gathered_->texel();
    double sum = 0;
    for (const Pixel& pixel : pixels_) {
      const auto corners = PlacedMesh(scene_.scene(), pixel.hit.mesh).corners(pixel.hit.triangle);
      const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
      const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
      const double places = surfaceSampleCount(resolutionFor(corners, texel, GatheredLight::kMaxResolution));
      const double density = pixelsPerSquareMetre(pixel);
      sum += area > 0 && density > 0 ? std::min(1.0, places / (3 * area * density)) : 1;
    }
    return sum / double(pixels_.size());
  }

 private:
  template <class Work>
  static double quickest(const Work& work) {
    double best = std::numeric_limits<double>::infinity();
    for (int n = 0; n < kRepeats; ++n) {
      const Stopwatch watch;
      work();
      best = std::min(best, watch.seconds());
    }
    return best;
  }
  void shadeAll(const Shader& shader) const {
    RayCounts rays;
    for (const Pixel& pixel : pixels_)
      found_ += shader.shade(pixel.hit, -pixel.ray.direction, rays).alpha > 0;
  }

  /// A pixel of the n-th of kPixels shares of all cameras, spread evenly; beyond the first region it serves.
  void addPixel(int n) {
    const std::size_t index = std::size_t(n) * columns_.size() / kPixels;
    const ColumnCamera& columns = columns_[index];
    const double u = std::fmod((n + 0.5) * 0.7548776662466927, 1.0),
                 v = std::fmod((n + 0.5) * 0.5698402909980532, 1.0);
    const glm::dvec2 direction = columns.directionAt(u * columns.columns);
    const double elevation = columns.elevationAt(v * columns.rows), flat = std::cos(elevation);
    const LayoutCamera& camera = layout_.cameras[index];
    const double exit = firstExit(camera, direction);
    const Ray ray{glm::vec3(columns.centreOfProjection),
                  glm::vec3(direction.x * flat, direction.y * flat, std::sin(elevation)), float(exit / flat)};
    const Hit hit = scene_.trace(ray);
    if (hit.found()) pixels_.push_back({index, hit, ray});
  }

  /// Pixels of all cameras that see it: its own, and as many as some of the others tell.
  double pixelsPerSquareMetre(const Pixel& pixel) const {
    const glm::dvec3 at =
        glm::dvec3(pixel.ray.origin) + glm::dvec3(pixel.ray.direction) * double(pixel.hit.distance);
    const glm::dvec3 normal(pixel.hit.geometricNormal());
    const std::size_t step = std::max<std::size_t>(1, columns_.size() / kWitnesses);
    double others = 0;
    for (std::size_t c = 0; c < columns_.size(); c += step)
      if (c != pixel.camera && sees(columns_[c], at)) others += density(columns_[c], at, normal);
    return density(columns_[pixel.camera], at, normal) + others * double(step);
  }

  bool sees(const ColumnCamera& camera, const glm::dvec3& at) const {
    const glm::dvec3 way = at - camera.centreOfProjection;
    const double distance = glm::length(way), elevation = std::atan2(way.z, std::hypot(way.x, way.y));
    double turn = std::fmod(std::atan2(way.y, way.x) - camera.lowAzimuth, kTwoPi);
    if (turn < 0) turn += kTwoPi;
    if (turn >= camera.fovRadians || elevation > camera.topElevation || elevation < camera.bottomElevation)
      return false;
    return scene_.transmittance({glm::vec3(camera.centreOfProjection), glm::vec3(way / distance), 0,
                                 float(distance * 0.999)}) != glm::vec3(0);
  }

  static double density(const ColumnCamera& camera, const glm::dvec3& at, const glm::dvec3& normal) {
    const glm::dvec3 way = at - camera.centreOfProjection;
    const double square = glm::dot(way, way), distance = std::sqrt(square);
    const double pixelAngle = camera.columnPitch() * camera.rowPitch() * std::hypot(way.x, way.y) / distance;
    const double facing = std::abs(glm::dot(way, normal)) / distance;
    return pixelAngle > 0 ? facing / (pixelAngle * square) : 0;
  }

  const RayScene& scene_;
  const Layout& layout_;
  const BakeSettings& settings_;
  std::stop_token stop_;
  std::vector<ColumnCamera> columns_;
  std::vector<Pixel> pixels_;
  std::shared_ptr<const GatheredLight> gathered_;
  mutable std::uint64_t found_ = 0;  ///< so that no work is left out as useless
};

}  // namespace

EffectCosts measureEffectCosts(const RayScene& scene, const Layout& layout, const BakeSettings& settings,
                               std::stop_token stop) {
  const FlushDenormals flush;
  EffectCosts costs;
  const CostProbe probe(scene, layout, settings, stop);
  const EffectPlan& plan = scene.plan();
  if (probe.pixels().empty()) return costs;
  const bool gathers = gathersLight(plan, settings);
  const double first = probe.secondsToShadeFirst(), shading = probe.secondsToShade(plan);
  const double gathering = gathers ? std::max(0.0, first - shading) * probe.shareOfPlaces() : 0;
  const double whole = probe.secondsToTrace() + shading + gathering;
  for (int e = 0; e < kEffectCount; ++e) {
    if (stop.stop_requested()) return {};
    if (!plan.on(Effect(e))) continue;
    EffectPlan without = plan;
    without[Effect(e)].on = false;
    // Measured side by side: the processor's pace changes.
    const double with = probe.secondsToShade(plan);
    double seconds = std::max(0.0, with - probe.secondsToShade(without)) * shading / with;
    const Effect gatherer =
        plan.on(Effect::diffuseInterreflection) ? Effect::diffuseInterreflection : Effect::ambientOcclusion;
    if (Effect(e) == gatherer) seconds += gathering;
    costs.share[std::size_t(e)] = std::min(1.0, seconds / whole);
  }
  costs.pixels = int(probe.pixels().size());
  return costs;
}

}  // namespace acentric
