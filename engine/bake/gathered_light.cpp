#include "engine/bake/gathered_light.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <new>
#include <numbers>
#include <span>

#include "engine/bake/surface.h"
#include "engine/base/contract.h"
#include "engine/base/stopwatch.h"
#include "engine/scene/placed_mesh.h"
#include "engine/scene/surface_light.h"

namespace acentric {
namespace {

/// Places are told apart by their number, not by where they are: a scene in another unit or elsewhere on the
/// map is gathered by the same rays.
PositionSamples::Points pointsFor(std::uint32_t triangle, std::uint32_t place) {
  return PositionSamples::Points(mixBits(triangle ^ mixBits(place)));
}

std::uint32_t cellsOf(std::uint32_t resolution) { return resolution * resolution; }

/// Row i has R - i upright cells and R - i - 1 inverted ones between them.
std::uint32_t cellsBefore(std::uint32_t resolution, std::uint32_t row) {
  return row * (2 * resolution - row);
}

/// The last row that begins at `index` or before.
template <class Before>
std::uint32_t rowOf(std::uint32_t rows, std::uint32_t index, const Before& before) {
  std::uint32_t first = 0;
  for (std::uint32_t last = rows; last - first > 1;) {
    const std::uint32_t middle = (first + last) / 2;
    (before(middle) <= index ? first : last) = middle;
  }
  return first;
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
  return resolutionFor(PlacedMesh(mesh, nullptr).corners(triangle), texel, most);
}

std::uint32_t resolutionFor(const std::array<glm::vec3, 3>& corners, double texel, std::uint32_t most) {
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
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

/// A set-associative cache: a value lies in one of the few places that its key's hash allows, and takes that
/// of another when these are full.
struct ScatteredValuesOnDemand::Shard {
  struct Entry {
    Key key;
    HalfColour value;  ///< zero: empty
  };
  struct Free {
    void operator()(Entry* entries) const { std::free(entries); }
  };
  static constexpr std::size_t kCount = 64, kSets = 32768, kWays = 4;  // 168 MB in all
  static constexpr unsigned kCountBits = 6;

  std::mutex mutex;
  std::unique_ptr<Entry[], Free> entries;  ///< zero memory that nobody touched costs nothing
  std::size_t nextWay = 0;

  static std::uint32_t hashOf(const Key& key) {
    return mixBits(key.place ^ mixBits(key.triangle ^ mixBits(key.placed)));
  }
  std::span<Entry> placesFor(std::uint32_t hash) { return {entries.get() + kWays * (hash % kSets), kWays}; }
};

ScatteredValuesOnDemand::ScatteredValuesOnDemand() : shards_(std::make_unique<Shard[]>(Shard::kCount)) {}
ScatteredValuesOnDemand::~ScatteredValuesOnDemand() = default;
ScatteredValuesOnDemand::ScatteredValuesOnDemand(ScatteredValuesOnDemand&&) noexcept = default;

std::optional<HalfColour> ScatteredValuesOnDemand::find(const Key& key) const {
  const std::uint32_t hash = Shard::hashOf(key);
  Shard& shard = shards_[hash >> (32 - Shard::kCountBits)];
  const std::lock_guard lock(shard.mutex);
  if (!shard.entries) return {};
  for (const Shard::Entry& entry : shard.placesFor(hash))
    if (entry.key == key && entry.value != HalfColour(0)) return entry.value;
  return {};
}

bool ScatteredValuesOnDemand::keep(const Key& key, const HalfColour& value) const {
  const std::uint32_t hash = Shard::hashOf(key);
  Shard& shard = shards_[hash >> (32 - Shard::kCountBits)];
  const std::lock_guard lock(shard.mutex);
  if (!shard.entries) {
    shard.entries.reset(
        static_cast<Shard::Entry*>(std::calloc(Shard::kSets * Shard::kWays, sizeof(Shard::Entry))));
    if (!shard.entries) throw std::bad_alloc();
  }
  const std::span<Shard::Entry> places = shard.placesFor(hash);
  Shard::Entry* place = nullptr;
  for (Shard::Entry& entry : places) {
    if (entry.value == HalfColour(0))
      place = place == nullptr ? &entry : place;
    else if (entry.key == key)
      return false;
  }
  if (place == nullptr) place = &places[shard.nextWay++ % Shard::kWays];
  *place = {key, value};
  return true;
}

GatheredLight::Grids GatheredLight::layOut(double texel, bool corners) const {
  const Scene& scene = scene_->scene();
  Grids grids;
  grids.first.clear();
  std::uint64_t next = 0;
  for (const Mesh& mesh : scene.meshes)
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::uint32_t r = resolutionFor(mesh, t, texel, kMaxResolution);
      grids.first.push_back(std::uint32_t(std::min<std::uint64_t>(next, kMaxPlaces)));
      grids.resolution.push_back(std::uint16_t(r));
      next += 2 * std::uint64_t(corners ? surfaceSampleCount(r) : cellsOf(r));
    }
  grids.first.push_back(std::uint32_t(std::min<std::uint64_t>(next, kMaxPlaces + 1)));
  return grids;
}

GatheredLight::GatheredLight(const RayScene& scene, const BakeSettings& settings, std::uint64_t mostPlaces)
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
  if (bounced_) scatteredCells_.resize(std::size_t(settings_.bounces));
  laidOut_ = firstTriangles_.back() <= mostPlaces / (2 * surfaceSampleCount(1));
  if (!laidOut_) return;
  constexpr double kGrowth = 1.2;
  for (places_ = layOut(texel_, true); places_.first.back() > mostPlaces;)
    places_ = layOut(texel_ *= kGrowth, true);
  values_ = ValuesOnDemand(places_.first.back());
  if (!bounced_) return;
  cells_ = layOut(kCellTexels * texel_, false);
  for (int n = 0; n < settings_.bounces; ++n) cellValues_.emplace_back(cells_.first.back());
}

/// One of R x R equal triangles, and its middle.
struct GatheredLight::Cell {
  std::uint32_t index;
  glm::vec2 middle;

  Cell(std::uint32_t resolution, std::uint32_t i, std::uint32_t j, bool inverted)
      : index(cellsBefore(resolution, i) + 2 * j + (inverted ? 1u : 0u)) {
    const float inset = inverted ? 2.0f / 3 : 1.0f / 3;
    middle = glm::vec2(float(i) + inset, float(j) + inset) / float(resolution);
  }
  static Cell at(std::uint32_t resolution, const glm::vec2& barycentric) {
    const glm::vec2 place = glm::clamp(barycentric, 0.0f, 1.0f) * float(resolution);
    const std::uint32_t i = std::min(std::uint32_t(place.x), resolution - 1);
    const std::uint32_t j = std::min(std::uint32_t(place.y), resolution - 1 - i);
    return {resolution, i, j, (place.x - float(i)) + (place.y - float(j)) > 1 && i + j + 1 < resolution};
  }
  static Cell numbered(std::uint32_t resolution, std::uint32_t index) {
    const std::uint32_t i =
        rowOf(resolution, index, [&](std::uint32_t row) { return cellsBefore(resolution, row); });
    const std::uint32_t along = index - cellsBefore(resolution, i);
    return {resolution, i, along / 2, along % 2 == 1};
  }
};

GatheredLight::Side GatheredLight::sideOf(const Hit& hit, bool back) const {
  if (hit.mesh + 1 < firstTriangles_.size())
    return {hit.mesh, hit.triangle, firstTriangles_[hit.mesh] + hit.triangle, back};
  return {hit.mesh, hit.triangle, mixBits(hit.mesh) + hit.triangle, back};
}

/// The side that has the number-th value of the grids; `within`: its number there.
GatheredLight::Side GatheredLight::sideAt(const Grids& grids, std::size_t number,
                                          std::uint32_t& within) const {
  require(number < grids.first.back(), "light is gathered for places and cells of the scene");
  Side side;
  const auto next = std::ranges::upper_bound(grids.first, std::uint32_t(number));
  side.sceneTriangle = std::uint32_t(next - grids.first.begin()) - 1;
  const auto mesh = std::ranges::upper_bound(firstTriangles_, side.sceneTriangle);
  side.mesh = std::uint32_t(mesh - firstTriangles_.begin()) - 1;
  side.triangle = side.sceneTriangle - firstTriangles_[side.mesh];
  within = std::uint32_t(number) - grids.first[side.sceneTriangle];
  const std::uint32_t ofOneSide = (*next - grids.first[side.sceneTriangle]) / 2;
  side.back = within >= ofOneSide;
  within -= side.back ? ofOneSide : 0;
  return side;
}

GatheredLight::Spot GatheredLight::spotOn(const Side& side, const glm::vec2& barycentric,
                                          double share) const {
  const PlacedMesh placed(scene_->scene(), side.mesh);
  const auto corners = placed.corners(side.triangle);
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
  const glm::vec3 normal = triangleNormal(placed, side.triangle);
  return {side.mesh,
          side.triangle,
          side.sceneTriangle,
          side.back,
          a + double(barycentric.x) * (b - a) + double(barycentric.y) * (c - a),
          side.back ? -normal : normal,
          share * 0.5 * glm::length(glm::cross(b - a, c - a))};
}

/// The normal is the corners': that of a hit may differ in its last bit from ray to ray, and who comes first
/// to a place decides what all others read there.
Surface GatheredLight::surfaceOf(const Side& side, const glm::vec2& barycentric) const {
  const glm::vec3 normal = triangleNormal(PlacedMesh(scene_->scene(), side.mesh), side.triangle);
  const Hit hit{0, side.mesh, side.triangle, barycentric, normal};
  const glm::vec3 facing = side.back ? -hit.geometricNormal() : hit.geometricNormal();
  return surfaceAt<false>(scene_->scene(), hit, facing, {}, false);
}

GatheredLight::Gathered GatheredLight::at(const Hit& hit, bool back, RayCounts& rays,
                                          const std::stop_token& stop) const {
  const Side side = sideOf(hit, back);
  const SurfaceCell cell = surfaceCellAt(resolutionOf(places_, side, texel_), hit.barycentric);
  glm::vec4 sum(0);
  for (int c = 0; c < 3; ++c)
    if (cell.weight[c] > 0)
      sum += cell.weight[c] * unpackColour(placeLight(side, cell.sample[c].x, cell.sample[c].y, rays, stop));
  return {glm::vec3(sum), std::clamp(2 * sum.a - 1, 0.0f, 1.0f)};
}

HalfColour GatheredLight::placeLight(const Side& side, std::uint32_t i, std::uint32_t j, RayCounts& rays,
                                     const std::stop_token& stop) const {
  const std::uint32_t r = resolutionOf(places_, side, texel_);
  const std::uint32_t within = (side.back ? surfaceSampleCount(r) : 0) + surfaceSampleIndex(r, i, j);
  const auto gathered = [&](std::uint32_t index, RayCounts& own) {
    const Stopwatch watch;
    const Surface surface = surfaceOf(side, surfaceSamplePlace(r, i, j));
    const Gathered g = gather(surface, side.sceneTriangle, index, own, rays, stop);
    own.gatherSeconds = watch.seconds();
    return stop.stop_requested() ? HalfColour(0) : packColour({g.radiance, 0.5f + 0.5f * g.open});
  };
  if (!isLaidOut(side.mesh))
    return scatteredValues_.at({side.mesh, side.triangle, within}, rays,
                               [&](RayCounts& own) { return gathered(within, own); });
  const std::uint32_t index = places_.first[side.sceneTriangle] + within;
  return values_.at(index, rays, [&](RayCounts& own) { return gathered(index, own); });
}

std::uint32_t GatheredLight::resolutionOf(const Grids& grids, const Side& side, double texel) const {
  if (isLaidOut(side.mesh)) return grids.resolution[side.sceneTriangle];
  return resolutionFor(PlacedMesh(scene_->scene(), side.mesh).corners(side.triangle), texel, kMaxResolution);
}

/// A place by its number.
struct GatheredLight::Place {
  Side side;
  std::uint32_t resolution = 0, i = 0, j = 0;
};
GatheredLight::Place GatheredLight::placeNumbered(std::size_t number) const {
  Place place;
  std::uint32_t within = 0;
  place.side = sideAt(places_, number, within);
  const std::uint32_t r = place.resolution = places_.resolution[place.side.sceneTriangle];
  place.i = rowOf(r + 1, within, [&](std::uint32_t row) { return surfaceSampleIndex(r, row, 0); });
  place.j = within - surfaceSampleIndex(r, place.i, 0);
  return place;
}

GatheredLight::Spot GatheredLight::place(std::size_t number) const {
  const auto [side, r, i, j] = placeNumbered(number);
  // It is read from the cells around it: one at a corner of the triangle, three along an edge, or six.
  const int edges = (i == 0 ? 1 : 0) + (j == 0 ? 1 : 0) + (i + j == r ? 1 : 0);
  const double cells = edges == 0 ? 6 : edges == 1 ? 3 : 1;
  const glm::vec2 corner = glm::vec2(float(i), float(j)) / float(r);
  const glm::vec2 inside = corner + (glm::vec2(1.0f / 3) - corner) / float(r);
  return spotOn(side, inside, cells / cellsOf(r));
}

void GatheredLight::gatherPlace(std::size_t number, RayCounts& rays, const std::stop_token& stop) const {
  const Place place = placeNumbered(number);
  placeLight(place.side, place.i, place.j, rays, stop);
}

GatheredLight::Spot GatheredLight::cell(std::size_t number) const {
  std::uint32_t within = 0;
  const Side side = sideAt(cells_, number, within);
  const std::uint32_t r = cells_.resolution[side.sceneTriangle];
  return spotOn(side, Cell::numbered(r, within).middle, 1.0 / cellsOf(r));
}

GatheredLight::Spot GatheredLight::middleOf(std::uint32_t placed, std::uint32_t triangle, bool back) const {
  return spotOn(sideOf({0, placed, triangle}, back), glm::vec2(1.0f / 3), 1);
}

double GatheredLight::areaOf(std::uint32_t placed, std::uint32_t triangle) const {
  return spotOn({placed, triangle, 0, false}, {}, 1).squareMetres;
}

double GatheredLight::placesPerSquareMetre(std::uint32_t placed, std::uint32_t triangle) const {
  const Side side = sideOf({0, placed, triangle}, false);
  return surfaceSampleCount(resolutionOf(places_, side, texel_)) / areaOf(placed, triangle);
}

double GatheredLight::cellsPerSquareMetre(std::uint32_t placed, std::uint32_t triangle) const {
  const Side side = sideOf({0, placed, triangle}, false);
  return cellsOf(resolutionOf(cells_, side, kCellTexels * texel_)) / areaOf(placed, triangle);
}

void GatheredLight::gatherCell(std::size_t number, int bounces, RayCounts& rays,
                               const std::stop_token& stop) const {
  std::uint32_t within = 0;
  const Side side = sideAt(cells_, number, within);
  cellLight(side, Cell::numbered(cells_.resolution[side.sceneTriangle], within), bounces, rays, stop);
}

GatheredLight::Gathered GatheredLight::gather(const Surface& surface, std::uint32_t triangle,
                                              std::uint32_t place, RayCounts& own, RayCounts& kept,
                                              const std::stop_token& stop) const {
  if (bounced_)
    return gatherBounced(surface, settings_.bounces, settings_.ambientRays, pointsFor(triangle, place), own,
                         kept, stop);
  const Ambient::Gathered ambient = ambient_.gather<true>(*scene_, surface, own);
  return {ambient.radiance, ambient.open};
}

/// `own` rays are of this place, `kept` those of cells met for the first time: they count even if another
/// thread was quicker with this place. A cell's rays may each lead to a cell nobody has read before, so that
/// one place alone can take minutes: all of them look for a stop.
GatheredLight::Gathered GatheredLight::gatherBounced(const Surface& surface, int bounces, int count,
                                                     const PositionSamples::Points& points, RayCounts& own,
                                                     RayCounts& kept, const std::stop_token& stop) const {
  const Across across(surface.normal);
  glm::vec3 light(0);
  int open = 0, drawn = 0;
  for (std::uint32_t k = 0; k < std::uint32_t(count); ++k) {
    if (stop.stop_requested()) return {};
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
      light += sentBy(hit, direction, bounces, kept, stop);
    } else {
      light += ambient_.radianceFrom(direction);
      ++open;
    }
  }
  if (drawn == 0) return {};
  return {light / float(drawn), float(open) / float(drawn)};
}

/// Radiance of a surface towards where a ray met it.
glm::vec3 GatheredLight::sentBy(const Hit& hit, const glm::vec3& direction, int bounces, RayCounts& rays,
                                const std::stop_token& stop) const {
  const Surface seen = surfaceAt<true>(scene_->scene(), hit, -direction, detail_, emission_);
  const glm::vec3 colour(seen.baseColour);
  if (!lights(scene_->scene().meshOf(hit.mesh).material)) return colour;
  // What lights others by itself is among the lights.
  const glm::vec3 glow = scene_->areaLights().include(hit.mesh) ? glm::vec3(0) : seen.emission;
  const Side side = sideOf(hit, glm::dot(hit.geometricNormal(), direction) > 0);
  const Cell cell = Cell::at(resolutionOf(cells_, side, kCellTexels * texel_), hit.barycentric);
  return colour * cellLight(side, cell, bounces - 1, rays, stop) + glow;
}

glm::vec3 GatheredLight::cellLight(const Side& side, const Cell& cell, int bounces, RayCounts& rays,
                                   const std::stop_token& stop) const {
  const std::uint32_t r = resolutionOf(cells_, side, kCellTexels * texel_);
  const std::uint32_t within = (side.back ? cellsOf(r) : 0) + cell.index;
  const auto gathered = [&](std::uint32_t index, RayCounts& own) {
    const Surface surface = surfaceOf(side, cell.middle);
    glm::vec3 light = lights_.at(surface, own) * std::numbers::inv_pi_v<float>;
    if (bounces > 0)
      light +=
          gatherBounced(surface, bounces, kCellRays, pointsFor(side.sceneTriangle, index), own, rays, stop)
              .radiance;
    return stop.stop_requested() ? HalfColour(0) : packColour({light, 1});
  };
  const auto before = std::size_t(bounces);
  if (!isLaidOut(side.mesh))
    return glm::vec3(unpackColour(scatteredCells_[before].at(
        {side.mesh, side.triangle, within}, rays, [&](RayCounts& own) { return gathered(within, own); })));
  const std::uint32_t index = cells_.first[side.sceneTriangle] + within;
  return glm::vec3(unpackColour(
      cellValues_[before].at(index, rays, [&](RayCounts& own) { return gathered(index, own); })));
}

}  // namespace acentric
