#include "engine/bake/part_rays.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace acentric {
namespace {

/// So much more may what a sample covers leave its plane: curved surfaces do, and surfaces that meet at an
/// edge must overlap a little, or other eyes would see in between them.
constexpr double kCurved = 3;
/// Surfaces right before one another that a ray is asked about.
constexpr int kMostBeforePlane = 4;

}  // namespace

std::uint16_t partsTowards(int acrossColumns, int acrossRows) {
  std::uint16_t parts = 0;
  for (int y = 0; y < kCoverageParts; ++y)
    for (int x = 0; x < kCoverageParts; ++x) {
      const auto isBeside = [](int step, int at) { return step == 0 || at == (step < 0 ? 0 : 3); };
      if (isBeside(acrossColumns, x) && isBeside(acrossRows, y)) parts |= partBit(x, y);
    }
  return parts;
}

int middlePart(std::uint16_t parts) {
  const auto placeOf = [](int part) { return glm::dvec2(part % kCoverageParts, part / kCoverageParts); };
  glm::dvec2 sum(0);
  for (int part = 0; part < kPixelPartCount; ++part)
    if ((parts >> part & 1) != 0) sum += placeOf(part);
  const glm::dvec2 middle = sum / double(std::popcount(parts));
  int best = -1;
  for (int part = 0; part < kPixelPartCount; ++part)
    if ((parts >> part & 1) != 0 &&
        (best < 0 || glm::distance(placeOf(part), middle) < glm::distance(placeOf(best), middle)))
      best = part;
  return best;
}

PartAngles::PartAngles(const ColumnCamera& camera) {
  const auto at = [](int part) { return (part + 0.5) / kCoverageParts; };
  const auto rowAt = [&](double y) {
    const double elevation = camera.elevationAt(y);
    return Row{std::cos(elevation), std::sin(elevation)};
  };
  for (int part = 0; part < kCoverageParts * camera.columns; ++part)
    columns_.push_back(camera.directionAt(at(part)));
  for (int part = 0; part < kCoverageParts * camera.rows; ++part) rows_.push_back(rowAt(at(part)));
  for (int k = 0; k < camera.columns; ++k) ownColumns_.push_back(camera.directionAt(k + 0.5));
  for (int k = 0; k < camera.rows; ++k) ownRows_.push_back(rowAt(k + 0.5));
}

PartAngles::Direction PartAngles::through(int column, int row, int part) const {
  return {columns_[std::size_t(kCoverageParts * column + part % kCoverageParts)],
          rows_[std::size_t(kCoverageParts * row + part / kCoverageParts)]};
}

PartAngles::Direction PartAngles::through(int column, int row) const {
  return {ownColumns_[std::size_t(column)], ownRows_[std::size_t(row)]};
}

PartRays::PartRays(const ColumnMarch::Setting& setting, const CaptureSamples& samples, bool reflections,
                   double tolerance, CaptureCounts& counts)
    : setting_(setting),
      samples_(samples),
      reflections_(reflections),
      tolerance_(tolerance),
      counts_(counts) {
  if (reflections)
    for (const FlatMirror& mirror : setting.mirrors->sides()) mirrors_[mirror.number] = mirror;
}

double PartRays::loose() const { return kCurved * tolerance_; }

bool PartRays::mayBe(bool opaque, const Hit& hit) const {
  const std::size_t material(setting_.shader.scene().scene().meshOf(hit.mesh).material);
  const MaterialRules& rule = setting_.shader.rules()[material];
  return opaque ? !rule.transmissive : rule.clear();
}

Hit PartRays::meet(std::uint32_t sample, const Direction& direction, std::span<const SurfacePlane> rivals) {
  const double flat = direction.row.cosine;
  const double w = planeOf(sample).inverseDistance(direction.plan, direction.row.sine / flat);
  if (!(w > 0)) return {};
  const double loose = this->loose();
  glm::dvec3 origin = setting_.columns.centreOfProjection, way = direction.unit();
  if (reflections_) {
    const FlatMirror& mirror = mirrors_[samples_.mirror[sample]];
    origin = mirror.imageOf(origin), way = mirror.reflected(way);
  }
  Ray ray{glm::vec3(origin), glm::vec3(way)};
  ray.nearest = float(1 / ((w + loose) * flat));
  if (w > loose) ray.farthest = float(1 / ((w - loose) * flat));
  const bool isOpaque = unpackColour(samples_.colour[sample]).a >= 1;
  for (int before = 0; before < kMostBeforePlane; ++before) {
    ++counts_.rays.primary;
    const Hit hit = setting_.shader.scene().trace(ray);
    if (!hit.found()) return {};
    const double met = 1 / (double(hit.distance) * flat), apart = std::abs(met - w);
    const auto isNearer = [&](const SurfacePlane& rival) {
      return std::abs(met - rival.inverseDistance(direction.plan, direction.row.sine / flat)) < apart;
    };
    if (apart <= loose && mayBe(isOpaque, hit) && std::ranges::none_of(rivals, isNearer)) return hit;
    ray.nearest = justBehind(hit.distance);
  }
  return {};
}

Shaded PartRays::shade(std::uint32_t sample, const Hit& hit, const Direction& direction, float width) {
  glm::vec3 way(direction.unit());
  SampleFootprint footprint = sampleFootprint(setting_, way);
  footprint.spread.across *= width, footprint.spread.along *= width;
  if (reflections_) {
    const FlatMirror& mirror = mirrors_[samples_.mirror[sample]];
    way = glm::vec3(mirror.reflected(glm::dvec3(way)));
    footprint = footprint.mirrored(glm::vec3(mirror.normal), 0);
  }
  const glm::dvec3 point = setting_.columns.centreOfProjection + double(hit.distance) * glm::dvec3(way);
  const MetSurface surface(hit, point, way);
  const Side side = planeOf(sample).away != 0 ? Side::other : Side::met;
  const auto seenFrom = [&](const glm::vec3& toViewer) {
    return setting_.shader.shade(hit, toViewer, counts_.rays, reflections_,
                                 footprint.on(setting_.shader.scene().scene(), hit, way));
  };
  const Shaded shaded = seenFrom(surface.toViewer(side));
  if (reflections_ || !shaded.dependsOnViewer) return shaded;
  return seenFrom(towardsEyes(setting_, samples_.roles[sample], surface, side));
}

}  // namespace acentric
