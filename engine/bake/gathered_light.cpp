#include "engine/bake/gathered_light.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <numbers>

#include "engine/bake/surface.h"
#include "engine/scene/surface_light.h"

namespace acentric {
namespace {

/// Cells that bounces are read from are this much larger than places: what a surface sends is seen from afar,
/// and averaged over many cells.
constexpr double kCellTexels = 4;
/// Rays gathered for a cell; the same reason.
constexpr int kCellRays = 32;

/// Places are told apart by their number, not by where they are: a scene in another unit or elsewhere on the
/// map is gathered by the same rays.
PositionSamples::Points pointsFor(std::uint32_t triangle, std::uint32_t place) {
  return PositionSamples::Points(mixBits(triangle ^ mixBits(place)));
}

std::uint32_t cellCount(std::uint32_t resolution) { return resolution * resolution; }

/// The cell, one of R x R equal triangles, that holds a place, and its middle.
struct Cell {
  std::uint32_t index;
  glm::vec2 middle;
};
Cell cellAt(std::uint32_t resolution, const glm::vec2& barycentric) {
  const float r = float(resolution);
  const float x = std::clamp(barycentric.x, 0.0f, 1.0f) * r, y = std::clamp(barycentric.y, 0.0f, 1.0f) * r;
  const std::uint32_t i = std::min(std::uint32_t(x), resolution - 1);
  const std::uint32_t j = std::min(std::uint32_t(y), resolution - 1 - i);
  // Row i has R - i upright cells and R - i - 1 inverted ones between them.
  const bool inverted = (x - float(i)) + (y - float(j)) > 1 && i + j + 1 < resolution;
  const float inset = inverted ? 2.0f / 3 : 1.0f / 3;
  return {i * (2 * resolution - i) + 2 * j + (inverted ? 1u : 0u),
          glm::vec2((float(i) + inset) / r, (float(j) + inset) / r)};
}

}  // namespace

GatherSettings GatherSettings::of(const BakeSettings& settings) {
  return {settings.ambientRays, settings.shadowRays, settings.bounces, settings.ambientRadius,
          settings.surfaceTexel};
}

bool gathersLight(const EffectPlan& plan, const BakeSettings& settings) {
  return settings.ambientRays > 0 &&
         (plan.on(Effect::ambientOcclusion) || plan.on(Effect::diffuseInterreflection));
}

std::uint32_t resolutionFor(const Mesh& mesh, std::uint32_t triangle, double texel, std::uint32_t most) {
  const glm::uvec3& t = mesh.triangles[triangle];
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
  const double wanted = std::min(longest / texel, 4 * std::sqrt(area) / texel);
  // A hair less, so that rounding does not decide where an edge is a whole number of texels.
  return std::uint32_t(std::clamp(std::ceil(wanted * (1 - 1e-5)), 1.0, double(most)));
}

void ValuesOnDemand::Free::operator()(std::uint64_t* values) const { std::free(values); }

ValuesOnDemand::ValuesOnDemand(std::size_t count)
    : values_(
          static_cast<std::uint64_t*>(std::calloc(std::max<std::size_t>(count, 1), sizeof(std::uint64_t)))) {
  if (!values_) throw std::bad_alloc();
}

GatheredLight::Grids GatheredLight::layOut(double texel, bool corners) const {
  const Scene& scene = scene_->scene();
  Grids grids;
  std::uint64_t next = 0;
  for (const Mesh& mesh : scene.meshes)
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::uint32_t r = resolutionFor(mesh, t, texel, kMaxResolution);
      grids.first.push_back(std::uint32_t(std::min<std::uint64_t>(next, kMaxPlaces)));
      grids.resolution.push_back(std::uint16_t(r));
      next += 2 * std::uint64_t(corners ? surfaceSampleCount(r) : cellCount(r));
    }
  grids.first.push_back(std::uint32_t(std::min<std::uint64_t>(next, kMaxPlaces + 1)));
  return grids;
}

GatheredLight::GatheredLight(const RayScene& scene, const BakeSettings& settings)
    : scene_(&scene),
      settings_(GatherSettings::of(settings)),
      lights_(scene, settings),
      ambient_(scene, lights_.set(), settings),
      bounced_(scene.plan().on(Effect::diffuseInterreflection)),
      emission_(scene.plan().on(Effect::emission)),
      rules_(materialRules(scene.scene(), scene.plan())),
      detail_(detailRules(scene.plan())),
      texel_(settings.surfaceTexel),
      firstTriangles_(scene.scene().firstTriangles()),
      values_(0) {
  detail_.normalMaps = false;  // too fine for what is sent into the distance
  constexpr double kGrowth = 1.2;
  const double coarsest = double(glm::length(scene.scene().bounds.size()));
  for (places_ = layOut(texel_, true); places_.first.back() > kMaxPlaces && texel_ < coarsest;)
    places_ = layOut(texel_ *= kGrowth, true);
  if (places_.first.back() > kMaxPlaces) throw std::bad_alloc();
  values_ = ValuesOnDemand(places_.first.back());
  if (!bounced_) return;
  cells_ = layOut(kCellTexels * texel_, false);
  for (int n = 0; n < settings_.bounces; ++n) cellValues_.emplace_back(cells_.first.back());
}

/// A place of the hit's triangle. Its normal is the corners': that of a hit may differ in its last bit from
/// ray to ray, and who comes first to a place decides what all others read there.
Hit GatheredLight::placeOn(const Hit& hit, const glm::vec2& barycentric) const {
  return {0, hit.mesh, hit.triangle, barycentric,
          triangleNormal(scene_->scene().meshes[hit.mesh], hit.triangle)};
}

GatheredLight::Gathered GatheredLight::at(const Hit& hit, bool back, RayCounts& rays) const {
  const std::uint32_t number = firstTriangles_[hit.mesh] + hit.triangle;
  const std::uint32_t r = places_.resolution[number];
  const std::uint32_t first = places_.first[number] + (back ? surfaceSampleCount(r) : 0);
  const SurfaceCell cell = surfaceCellAt(r, hit.barycentric);
  glm::vec4 sum(0);
  for (int c = 0; c < 3; ++c) {
    if (cell.weight[c] <= 0) continue;
    const glm::uvec2& at = cell.sample[c];
    const std::size_t index = first + surfaceSampleIndex(r, at.x, at.y);
    sum += cell.weight[c] * unpackColour(values_.at(index, rays, [&](RayCounts& own) {
             const Hit place = placeOn(hit, surfaceSamplePlace(r, at.x, at.y));
             const glm::vec3 side = back ? -place.geometricNormal() : place.geometricNormal();
             const Surface surface = surfaceAt<false>(scene_->scene(), place, side, {}, false);
             const Gathered g = gather(surface, number, std::uint32_t(index), own, rays);
             return packColour({g.radiance, 0.5f + 0.5f * g.open});
           }));
  }
  return {glm::vec3(sum), std::clamp(2 * sum.a - 1, 0.0f, 1.0f)};
}

GatheredLight::Gathered GatheredLight::gather(const Surface& surface, std::uint32_t triangle,
                                              std::uint32_t place, RayCounts& own, RayCounts& kept) const {
  if (bounced_)
    return gatherBounced(surface, settings_.bounces, settings_.ambientRays, pointsFor(triangle, place), own,
                         kept);
  const Ambient::Gathered ambient = ambient_.gather<true>(*scene_, surface, own);
  return {ambient.radiance, ambient.open};
}

/// `own` rays are of this place, `kept` those of cells met for the first time: they count even if another
/// thread was quicker with this place.
GatheredLight::Gathered GatheredLight::gatherBounced(const Surface& surface, int bounces, int count,
                                                     const PositionSamples::Points& points, RayCounts& own,
                                                     RayCounts& kept) const {
  const Across across(surface.normal);
  glm::vec3 light(0);
  int open = 0, drawn = 0;
  for (std::uint32_t k = 0; k < std::uint32_t(count); ++k) {
    // As many directions to a solid angle as its cosine says.
    const glm::vec2 u = points.at(k);
    const float aside = std::sqrt(u.x), angle = 2 * std::numbers::pi_v<float> * u.y;
    const glm::vec3 direction =
        across.at(aside * std::cos(angle), aside * std::sin(angle)) + surface.normal * std::sqrt(1 - u.x);
    // Below the real surface there is nothing to see, whatever the smoothed normal says.
    if (glm::dot(surface.geometricNormal, direction) <= 0) continue;
    ++drawn;
    ++own.bounce;
    const Hit hit = scene_->traceSolid({surface.rayOrigin, direction});
    if (hit.found()) {
      light += sentBy(hit, direction, bounces, kept);
    } else {
      light += ambient_.radianceFrom(direction);
      ++open;
    }
  }
  if (drawn == 0) return {};
  return {light / float(drawn), float(open) / float(drawn)};
}

/// Radiance of a surface towards where a ray met it.
glm::vec3 GatheredLight::sentBy(const Hit& hit, const glm::vec3& direction, int bounces,
                                RayCounts& rays) const {
  const Surface seen = surfaceAt<true>(scene_->scene(), hit, -direction, detail_, emission_);
  const glm::vec3 colour(seen.baseColour);
  if (rules_[std::size_t(scene_->scene().meshes[hit.mesh].material)].unlit) return colour;
  // What lights others by itself is among the lights.
  const glm::vec3 glow = scene_->areaLights().include(hit.mesh) ? glm::vec3(0) : seen.emission;
  return colour * cellLight(hit, glm::dot(hit.geometricNormal(), direction) > 0, bounces - 1, rays) + glow;
}

glm::vec3 GatheredLight::cellLight(const Hit& hit, bool back, int bounces, RayCounts& rays) const {
  const std::uint32_t number = firstTriangles_[hit.mesh] + hit.triangle;
  const std::uint32_t r = cells_.resolution[number];
  const Cell cell = cellAt(r, hit.barycentric);
  const std::size_t index = cells_.first[number] + (back ? cellCount(r) : 0) + cell.index;
  return glm::vec3(unpackColour(cellValues_[std::size_t(bounces)].at(index, rays, [&](RayCounts& own) {
    const Hit middle = placeOn(hit, cell.middle);
    const Surface surface = surfaceAt<false>(
        scene_->scene(), middle, back ? -middle.geometricNormal() : middle.geometricNormal(), {}, false);
    glm::vec3 light = lights_.at(surface, own) * std::numbers::inv_pi_v<float>;
    if (bounces > 0)
      light += gatherBounced(surface, bounces, kCellRays, pointsFor(number, std::uint32_t(index)), own, rays)
                   .radiance;
    return packColour({light, 1});
  })));
}

}  // namespace acentric
