#include "engine/bake/preview.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/bake/column_rays.h"
#include "engine/bake/flush_denormals.h"
#include "engine/bake/shading.h"
#include "engine/bake/surface.h"
#include "engine/base/contract.h"
#include "engine/image/colour.h"
#include "engine/scene/surface_alpha.h"

namespace acentric {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kMostLayers = 16;
constexpr glm::vec3 kCapColour{0.018F, 0.020F, 0.024F};

/// Sky above, its bounce below, and a lamp beside the eye.
float lightOn(const glm::vec3& normal, const glm::vec3& toViewer) {
  const float sky = 0.46F + 0.18F * normal.z;
  return sky + 0.42F * std::max(0.0F, glm::dot(normal, toViewer));
}

Rgba8 encoded(const PreviewSeen& seen) {
  if (!(seen.alpha > 0)) return Rgba8(0);
  return encodeForDisplay(seen.colour / seen.alpha, 1, seen.alpha);
}

}  // namespace

/// Where a ray begins and ends under a cut.
struct PreviewTracer::Start {
  bool open = true;  ///< else it sees nothing
  bool cut = false;  ///< there is a cut at all
  bool atCut = false;
  float nearest = 0, farthest = kInfinity;
};

PreviewTracer::PreviewTracer(RayScenePtr rays)
    : rays_(std::move(rays)),
      rules_(materialRules(rays_->scene(), rays_->plan())),
      detail_(detailRules(rays_->plan())) {}

PreviewTracer::Start PreviewTracer::startOf(const Ray& ray, double cutHeight) const {
  Start start{.nearest = ray.nearest, .farthest = ray.farthest};
  start.cut = cutHeight < kNoCut;
  if (!start.cut) return start;
  const double above = double(ray.origin.z) - cutHeight;
  if (above > 0) {
    start.atCut = true;
    start.open = ray.direction.z < 0;
    if (start.open) start.nearest = std::max(ray.nearest, float(above / -double(ray.direction.z)));
  } else if (ray.direction.z > 0) {
    start.farthest = std::min(ray.farthest, float(-above / double(ray.direction.z)));
  }
  return start;
}

bool PreviewTracer::seenFromBehind(const Hit& hit, const glm::vec3& direction) const {
  const Scene& scene = rays_->scene();
  return !scene.materials[std::size_t(scene.meshOf(hit.mesh).material)].doubleSided &&
         glm::dot(hit.across, direction) > 0;
}

bool PreviewTracer::inSolid(const glm::vec3& place) const {
  const Ray down{place, {0, 0, -1}};
  const Hit below = rays_->trace(down);
  return below.found() && seenFromBehind(below, down.direction);
}

PreviewSeen PreviewTracer::follow(const Ray& ray, const Start& start, Hit hit) const {
  PreviewSeen seen;
  const Scene& scene = rays_->scene();
  const glm::vec3 toViewer = -ray.direction;
  float passing = 1;
  const auto add = [&](const glm::vec3& colour, float alpha) {
    seen.colour += passing * alpha * colour;
    seen.alpha += passing * alpha;
    passing *= 1 - alpha;
  };
  const auto colourOf = [&](const Hit& at, float& alpha) {
    const auto material = std::size_t(scene.meshOf(at.mesh).material);
    const MaterialRules& rules = rules_[material];
    const Surface surface = detail_.any() ? surfaceAt<true>(scene, at, toViewer, detail_, true)
                                          : surfaceAt<false>(scene, at, toViewer, detail_, true);
    alpha = rules.blended ? std::clamp(surface.baseColour.a, 0.0F, 1.0F) : 1.0F;
    if (rules.transmissive)
      alpha *= glassAlpha(scene.materials[material].transmission, glm::vec3(surface.baseColour),
                          glm::dot(surface.normal, toViewer))
                   .alpha();
    const float light = rules.unlit ? 1.0F : lightOn(surface.normal, toViewer);
    return glm::vec3(surface.baseColour) * light + glm::min(surface.emission, glm::vec3(1));
  };
  const auto endAt = [&](const Hit& at, const glm::vec3& colour) {
    add(colour, 1);
    const glm::vec3 normal = at.geometricNormal();
    seen.distance = at.distance;
    seen.normal = glm::dot(normal, toViewer) >= 0 ? normal : -normal;
    seen.mesh = at.mesh, seen.triangle = at.triangle;
  };
  Ray rest{ray.origin, ray.direction, start.nearest, start.farthest};
  std::optional<Hit> behind;  // the first surface that was seen from behind
  for (int layer = 0; layer < kMostLayers; ++layer) {
    if (layer > 0) hit = rays_->trace(rest);
    if (!hit.found() || hit.distance > start.farthest) break;
    rest.nearest = justBehind(hit.distance);
    if (start.cut && seenFromBehind(hit, ray.direction) &&
        !rules_[std::size_t(scene.meshOf(hit.mesh).material)].clear()) {
      if (start.atCut && !behind && inSolid(ray.origin + start.nearest * ray.direction)) {
        add(kCapColour, 1);
        seen.distance = start.nearest;
        seen.normal = {0, 0, 1};
        seen.mesh = hit.mesh, seen.triangle = hit.triangle;
        seen.cap = true;
        return seen;
      }
      if (!behind) behind = hit;
      continue;
    }
    float alpha = 1;
    const glm::vec3 colour = colourOf(hit, alpha);
    if (alpha >= kOpaqueAlpha) {
      endAt(hit, colour);
      return seen;
    }
    if (alpha >= kInvisibleAlpha) add(colour, alpha);
  }
  if (behind) {
    float alpha = 1;
    endAt(*behind, colourOf(*behind, alpha));
  }
  return seen;
}

PreviewSeen PreviewTracer::along(const Ray& ray, double cutHeight) const {
  const FlushDenormals flush;
  const Start start = startOf(ray, cutHeight);
  if (!start.open) return {};
  return follow(ray, start, rays_->trace({ray.origin, ray.direction, start.nearest, start.farthest}));
}

void PreviewTracer::along(const RayPacket& packet, double cutHeight,
                          std::array<PreviewSeen, RayPacket::kSize>& seen) const {
  RayPacket traced = packet;
  std::array<Start, RayPacket::kSize> starts;
  bool any = false;
  for (std::size_t i = 0; i < std::size_t(packet.count); ++i) {
    starts[i] = startOf({packet.origin, packet.direction[i], packet.nearest[i]}, cutHeight);
    traced.nearest[i] = starts[i].nearest;
    any = any || starts[i].open;
    seen[i] = {};
  }
  if (!any) return;
  std::array<Hit, RayPacket::kSize> hits;
  rays_->trace(traced, hits);
  for (std::size_t i = 0; i < std::size_t(packet.count); ++i)
    if (starts[i].open)
      seen[i] = follow({packet.origin, packet.direction[i], packet.nearest[i]}, starts[i], hits[i]);
}

PreviewPicture previewView(const PreviewTracer& tracer, const PerspectiveView& view, double cutHeight,
                           TaskRunner& runner, std::stop_token stop) {
  require(view.check().has_value(), "a view to preview is sound");
  PreviewPicture picture{ColourImage(view.width, view.height), FloatImage(view.width, view.height)};
  const glm::dmat3 worldFromView = glm::transpose(view.viewFromWorld());
  const double focal = view.focalPixels();
  runner.parallelFor(std::size_t(view.height), [&](std::size_t row) {
    if (stop.stop_requested()) return;
    const FlushDenormals flush;
    const int y = int(row);
    std::array<PreviewSeen, RayPacket::kSize> seen;
    for (int first = 0; first < view.width; first += RayPacket::kSize) {
      RayPacket packet;
      packet.origin = glm::vec3(view.eye);
      packet.count = std::min(RayPacket::kSize, view.width - first);
      for (int i = 0; i < packet.count; ++i) {
        const glm::dvec3 inView{(first + i + 0.5 - 0.5 * view.width) / focal,
                                (y + 0.5 - 0.5 * view.height) / focal, 1};
        packet.direction[std::size_t(i)] = glm::vec3(glm::normalize(worldFromView * inView));
      }
      tracer.along(packet, cutHeight, seen);
      for (int i = 0; i < packet.count; ++i) {
        picture.colour.at(first + i, y) = encoded(seen[std::size_t(i)]);
        picture.rayDistance.at(first + i, y) = seen[std::size_t(i)].distance;
      }
    }
  });
  return stop.stop_requested() ? PreviewPicture{} : picture;
}

PreviewPicture previewCapture(const PreviewTracer& tracer, const LayoutCamera& camera,
                              const ColumnCamera& columns, TaskRunner& runner, std::stop_token stop) {
  require(columns.check().has_value(), "a camera to preview is sound");
  PreviewPicture picture{ColourImage(columns.columns, columns.rows),
                         FloatImage(columns.columns, columns.rows)};
  const RowAngles rows(columns);
  runner.parallelFor(std::size_t(columns.columns), [&](std::size_t column) {
    if (stop.stop_requested()) return;
    const FlushDenormals flush;
    const glm::dvec2 direction = columns.directionAt(double(column) + 0.5);
    const double exit = firstExit(camera, direction);
    const int x = columns.columns - 1 - int(column);
    std::array<PreviewSeen, RayPacket::kSize> seen;
    for (int first = 0; first < columns.rows; first += RayPacket::kSize) {
      const int last = std::min(first + RayPacket::kSize, columns.rows);
      tracer.along(firstRays(columns, rows, direction, first, last, exit), kNoCut, seen);
      for (int y = first; y < last; ++y) {
        picture.colour.at(x, y) = encoded(seen[std::size_t(y - first)]);
        picture.rayDistance.at(x, y) = seen[std::size_t(y - first)].distance;
      }
    }
  });
  return stop.stop_requested() ? PreviewPicture{} : picture;
}

}  // namespace acentric
