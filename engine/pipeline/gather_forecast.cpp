#include "engine/pipeline/gather_forecast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/bake/flush_denormals.h"
#include "engine/bake/gathered_light.h"
#include "engine/bake/position_samples.h"
#include "engine/bake/test_eyes.h"
#include "engine/base/work_clock.h"
#include "engine/pipeline/coverage.h"
#include "engine/scene/instances.h"

namespace acentric {
namespace {

using Spot = GatheredLight::Spot;

constexpr std::size_t kPlaces = 4096, kCells = 512;  ///< asked, at most
constexpr std::size_t kScatteredPlaces = 4096;       ///< triangles of instances that are asked
constexpr int kWaysFromCell = 8;
/// Samples on a spot from which on it is as good as certain that one reads it.
constexpr double kPlenty = 4;
/// Neighbouring places gathered one after the other, as surfaces ask for them; rays to measure the rate by.
constexpr std::size_t kRun = 16;
constexpr double kRateRays = 2e6;
constexpr std::size_t kBriefly = 10;  ///< so many times fewer of all these
constexpr std::size_t kBriefRun = 2;  ///< with bounces, a few places read a great many cells

double chanceOf(double expected) { return 1 - std::exp(-expected); }

/// `count` numbers below `all`, spread evenly whatever the order of what they number.
std::vector<std::size_t> spread(std::size_t count, std::size_t all) {
  constexpr double kGolden = 0.6180339887498949;
  std::vector<std::size_t> numbers;
  for (std::size_t n = 0; n < std::min(count, all); ++n)
    numbers.push_back(all <= count ? n
                                   : std::size_t(std::fmod((double(n) + 0.5) * kGolden, 1.0) * double(all)));
  return numbers;
}

/// Who reads a spot: samples of the cameras' captures, and of the surfaces' own light.
class Readers {
 public:
  Readers(const OpenProject& open, const std::vector<int>& cameras, const SurfaceLight* light)
      : open_(open), reach_(open, ProjectReach::Eyes::placed), light_(light) {
    for (const int number : cameras) {
      const LayoutCamera& camera = open.layout->cameras[std::size_t(number)];
      Served& served = cameras_.emplace_back(Served{number, &camera, {}});
      for (const Role& role : camera.roles) served.eyes.push_back(eyesOf(role));
    }
  }

  /// That captures read it.
  double chance(const Spot& spot) const {
    std::vector<std::int8_t> seen(eyes_.size(), kNotAsked);
    double samples = 0;
    for (const Served& served : cameras_) {
      const double more = samplesOn(spot, served);
      if (more > 0 && needs(served, spot.position, seen) && (*reach_).holds(served.number, spot.position))
        samples += more;
      if (samples > kPlenty) break;
    }
    return chanceOf(samples);
  }
  bool lightReads(const Spot& spot) const {
    if (light_ == nullptr) return false;
    const auto drawn = open_.drawn->numberOf(spot.mesh, spot.triangle);
    return drawn && light_->resolution[*drawn] > 0 && (!spot.back || light_->hasBack[*drawn] != 0);
  }

 private:
  static constexpr std::int8_t kNotAsked = -1;
  struct Served {
    int number = 0;
    const LayoutCamera* camera = nullptr;
    std::vector<std::vector<std::size_t>> eyes;  ///< by role, into eyes_
  };

  std::vector<std::size_t> eyesOf(const Role& role) {
    std::vector<std::size_t> numbers;
    if (!open_.project.bake.pruning) return numbers;
    for (const glm::dvec3& eye : placedEyes(role.polygon, open_.layout->eyeZ(), open_.project.bake)) {
      const auto [known, added] = numbers_.try_emplace(std::array{eye.x, eye.y, eye.z}, eyes_.size());
      if (added) eyes_.push_back(eye);
      numbers.push_back(known->second);
    }
    return numbers;
  }

  /// Pixels of the camera that a spot in full view covers.
  double samplesOn(const Spot& spot, const Served& served) const {
    const ColumnCamera& columns = (*reach_).columns(served.number);
    const glm::dvec3 way = spot.position - columns.centreOfProjection;
    const double azimuth = std::remainder(
        std::atan2(way.y, way.x) - columns.lowAzimuth - columns.fovRadians / 2, 2 * std::numbers::pi);
    if (std::abs(azimuth) > columns.fovRadians / 2) return 0;
    const double distance = glm::length(way), flat = glm::length(glm::dvec2(way));
    if (!(flat > 0)) return 0;
    const double facing = -glm::dot(glm::dvec3(spot.normal), way) / distance;
    const double pixel = columns.columnPitch() * columns.rowPitch() * flat / distance;
    return facing <= 0 ? 0 : spot.squareMetres * facing / (distance * distance * pixel);
  }

  /// As the bake asks, without its maps.
  bool sees(const glm::dvec3& eye, const glm::dvec3& point, double tolerance) const {
    const glm::dvec3 way = point - eye;
    const double distance = glm::length(way);
    const float farthest = float(distance - tolerance);
    return !(farthest > 0) || !(open_.rays->occluderDistance(
                                    {glm::vec3(eye), glm::vec3(way / distance), 0, farthest}) < farthest);
  }

  /// Does a role of the camera need the point? `seen`: of each eye, as far as it was asked.
  bool needs(const Served& served, const glm::dvec3& point, std::vector<std::int8_t>& seen) const {
    const glm::dvec2 way = glm::dvec2(point) - served.camera->position;
    const double flat = glm::length(way);
    // Half a sample of the first camera that asks: what the bake takes for the same surface.
    const ColumnCamera& columns = (*reach_).columns(served.number);
    const double tolerance = 0.5 * columns.rowPitch() * glm::distance(point, columns.centreOfProjection);
    for (std::size_t r = 0; r < served.eyes.size(); ++r) {
      const Role& role = served.camera->roles[r];
      if (exitDistance(*served.camera, role, way / flat) > flat) continue;
      if (role.clip && !role.clip->holds(glm::dvec2(point))) continue;
      if (!open_.project.bake.pruning) return true;
      for (const std::size_t eye : served.eyes[r]) {
        if (seen[eye] == kNotAsked) seen[eye] = sees(eyes_[eye], point, tolerance) ? 1 : 0;
        if (seen[eye] == 1) return true;
      }
    }
    return false;
  }

  const OpenProject& open_;
  ProjectReach reach_;
  const SurfaceLight* light_;
  std::vector<Served> cameras_;
  std::vector<glm::dvec3> eyes_;
  std::map<std::array<double, 3>, std::size_t> numbers_;
};

/// Of a spot, that it is read: by captures, and by them or the surfaces' own light.
struct Chances {
  double captures = 0, any = 0;
};

class Forecaster {
 public:
  Forecaster(const OpenProject& open, const std::vector<int>& cameras, const SurfaceLight* light,
             TaskRunner& runner, const std::stop_token& stop, bool brief)
      : open_(open),
        fewer_(brief ? kBriefly : 1),
        run_(brief ? kBriefRun : kRun),
        settings_(open.project.bake),
        gathered_(*open.rays, open.project.bake),
        readers_(open, cameras, light),
        firstTriangles_(open.scene->firstTriangles()),
        runner_(runner),
        stop_(stop) {}

  GatherForecast run() {
    const std::vector<std::size_t> numbers = spread(kPlaces / fewer_, gathered_.placeCount());
    std::vector<Chances> places(numbers.size());
    runner_.parallelFor(numbers.size(), [&](std::size_t n) {
      const FlushDenormals flush;
      if (!stop_.stop_requested()) places[n] = ofPlace(gathered_.place(numbers[n]));
    });
    std::vector<std::size_t> read;
    for (std::size_t n = 0; n < numbers.size(); ++n)
      if (places[n].any > 0.5) read.push_back(numbers[n]);
    std::ranges::sort(read);
    GatherForecast forecast;
    const double raysPerPlace = measureRate(read, forecast);
    const double share = double(gathered_.placeCount()) / double(std::max<std::size_t>(1, numbers.size()));
    double captures = 0, any = 0, squares = 0;
    for (const Chances& c : places) captures += c.captures, any += c.any, squares += c.any * c.any;
    const Chances cells = raysForCells(), instances = raysForScattered(raysPerPlace);
    forecast.captureRays = share * captures * raysPerPlace + cells.captures + instances.captures;
    forecast.lightRays = share * any * raysPerPlace + cells.any + instances.any - forecast.captureRays;
    if (any > 0 && numbers.size() < gathered_.placeCount())
      forecast.relativeError = std::sqrt(std::max(0.0, squares - any * any / double(places.size()))) / any;
    return forecast;
  }

 private:
  Chances ofPlace(const Spot& spot) const {
    if (!gathered_.lights(open_.scene->meshOf(spot.mesh).material)) return {};
    const double captures = readers_.chance(spot);
    return {captures, readers_.lightReads(spot) ? 1 : captures};
  }

  /// Gathers runs of places that begin with those given; rays for a place itself.
  double measureRate(const std::vector<std::size_t>& read, GatherForecast& forecast) {
    std::vector<std::size_t> starts;
    for (const std::size_t n : read)
      if (starts.empty() || n >= starts.back() + run_) starts.push_back(n);
    std::ranges::sort(starts, {}, [](std::size_t n) { return mixBits(std::uint32_t(n)); });
    const std::size_t batch = std::size_t(fewer_ > 1 ? 1 : 4) * std::size_t(runner_.threads());
    RayCounts rays;
    std::size_t places = 0;
    const WorkClock watch;
    for (std::size_t first = 0; first < starts.size() && double(rays.gathered) * double(fewer_) < kRateRays;
         first += batch) {
      const std::size_t count = std::min(batch, starts.size() - first);
      std::vector<RayCounts> counts(count);
      runner_.parallelFor(count, [&](std::size_t run) {
        const FlushDenormals flush;
        const std::size_t begin = starts[first + run];
        for (std::size_t n = begin; n < std::min(begin + run_, gathered_.placeCount()); ++n)
          if (!stop_.stop_requested()) gathered_.gatherPlace(n, counts[run], stop_);
      });
      for (const RayCounts& count1 : counts) rays += count1;
      for (std::size_t run = 0; run < count; ++run)
        places += std::min(run_, gathered_.placeCount() - starts[first + run]);
      if (stop_.stop_requested()) return 0;
    }
    if (rays.gathered > 0) forecast.secondsPerRay = watch.seconds() / double(rays.gathered);
    return gathered_.cellCount() > 0 || places == 0 ? settings_.ambientRays
                                                    : double(rays.gathered) / double(places);
  }

  /// Rays that come to a cell, gathered for places that are read and for other cells: as many as light that
  /// leaves the cell comes to such places, each with its share of rays.
  struct Arriving {
    Chances fromPlaces;
    double fromCells = 0;
  };
  Arriving arrivingAt(const Spot& cell, std::uint32_t number) const {
    const Across across(cell.normal);
    const PositionSamples::Points points(mixBits(number));
    const float lift = 1e-3f * float(std::sqrt(cell.squareMetres));
    Arriving sum;
    for (int k = 0; k < kWaysFromCell; ++k) {
      const glm::vec2 u = points.at(std::uint32_t(k));
      const float aside = std::sqrt(u.x), angle = 2 * std::numbers::pi_v<float> * u.y;
      const glm::vec3 way =
          across.at(aside * std::cos(angle), aside * std::sin(angle)) + cell.normal * std::sqrt(1 - u.x);
      const Hit hit = open_.rays->traceSolid({glm::vec3(cell.position), way, lift});
      if (!hit.found()) continue;
      Spot met{hit.mesh, hit.triangle};
      if (!open_.scene->isInstance(hit.mesh)) met.sceneTriangle = firstTriangles_[hit.mesh] + hit.triangle;
      const double places = gathered_.placesPerSquareMetre(met.mesh, met.triangle);
      met.back = glm::dot(hit.across, way) > 0;
      met.position = cell.position + double(hit.distance) * glm::dvec3(way);
      met.normal = met.back ? -hit.geometricNormal() : hit.geometricNormal();
      met.squareMetres = 3 / places;  // each point reads three
      const Chances read = ofPlace(met);
      const double each = cell.squareMetres / kWaysFromCell;
      sum.fromPlaces.captures += each * places * settings_.ambientRays * read.captures;
      sum.fromPlaces.any += each * places * settings_.ambientRays * read.any;
      sum.fromCells +=
          each * gathered_.cellsPerSquareMetre(met.mesh, met.triangle) * GatheredLight::kCellRays;
    }
    return sum;
  }

  /// For places and cells that have no numbers: by some of their triangles, each for its like.
  Chances raysForScattered(double raysPerPlace) const {
    struct Part {
      std::uint32_t placed, triangle;
      double stands;
    };
    std::vector<Part> parts;
    if (!open_.scene->instances.empty())
      eachTriangle(*open_.scene, kScatteredPlaces / fewer_,
                   [&](std::uint32_t placed, const PlacedMesh&, std::uint32_t triangle, double stands) {
                     if (open_.scene->isInstance(placed)) parts.push_back({placed, triangle, stands});
                   });
    if (!open_.scene->meshes.empty() && !gathered_.isLaidOut(0)) {
      const std::uint32_t all = firstTriangles_.back(), step = all / (kScatteredPlaces / fewer_) + 1;
      std::uint32_t mesh = 0;
      for (std::uint64_t n = 0; n < all; n += step) {
        while (firstTriangles_[mesh + 1] <= n) ++mesh;
        parts.push_back({mesh, std::uint32_t(n - firstTriangles_[mesh]), double(step)});
      }
    }
    std::vector<Chances> rays(parts.size());
    runner_.parallelFor(parts.size(), [&](std::size_t n) {
      const FlushDenormals flush;
      const Part& part = parts[n];
      for (const bool back : {false, true}) {
        if (stop_.stop_requested()) return;
        Spot spot = gathered_.middleOf(part.placed, part.triangle, back);
        const double area = spot.squareMetres;
        if (!(area > 0)) continue;
        const double places = area * gathered_.placesPerSquareMetre(part.placed, part.triangle);
        spot.squareMetres = area * std::min(1.0, 6 / places);  // six cells read each
        const Chances read = ofPlace(spot);
        rays[n].captures += part.stands * places * read.captures * raysPerPlace;
        rays[n].any += part.stands * places * read.any * raysPerPlace;
        if (gathered_.cellCount() == 0 || !gathered_.lights(open_.scene->meshOf(part.placed).material))
          continue;
        const double cells = area * gathered_.cellsPerSquareMetre(part.placed, part.triangle);
        spot.squareMetres = area / cells;
        const Chances arriving = raysWith(arrivingAt(spot, std::uint32_t(n)), 1);
        rays[n].captures += part.stands * cells * arriving.captures;
        rays[n].any += part.stands * cells * arriving.any;
      }
    });
    Chances sum;
    for (const Chances& one : rays) sum.captures += one.captures, sum.any += one.any;
    return sum;
  }

  /// Rays of a cell, of every bounce, by what comes to it; `direct`: those towards lights.
  Chances raysWith(const Arriving& arriving, double direct) const {
    const auto with = [&](double fromPlaces) {
      double sum = 0;
      for (int bounce = settings_.bounces - 1; bounce >= 0 && fromPlaces > 0; --bounce)
        sum += chanceOf(bounce + 1 == settings_.bounces ? fromPlaces : arriving.fromCells) *
               (direct + (bounce > 0 ? GatheredLight::kCellRays : 0));
      return sum;
    };
    return {with(arriving.fromPlaces.captures), with(arriving.fromPlaces.any)};
  }

  /// Rays gathered for all cells that are read, of every bounce: the last from places, others from cells.
  Chances raysForCells() const {
    const std::vector<std::size_t> numbers = spread(kCells / fewer_, gathered_.cellCount());
    if (numbers.empty()) return {};
    std::vector<Chances> rays(numbers.size());
    runner_.parallelFor(numbers.size(), [&](std::size_t n) {
      const FlushDenormals flush;
      const Spot cell = gathered_.cell(numbers[n]);
      if (stop_.stop_requested() || !gathered_.lights(open_.scene->meshes[cell.mesh].material)) return;
      const Arriving arriving = arrivingAt(cell, std::uint32_t(n));
      RayCounts direct;
      gathered_.gatherCell(numbers[n], 0, direct, stop_);
      rays[n] = raysWith(arriving, double(direct.total()));
    });
    Chances sum;
    for (const Chances& r : rays) sum.captures += r.captures, sum.any += r.any;
    const double share = double(gathered_.cellCount()) / double(numbers.size());
    return {share * sum.captures, share * sum.any};
  }

  const OpenProject& open_;
  std::size_t fewer_;
  std::size_t run_;
  const BakeSettings& settings_;
  GatheredLight gathered_;
  Readers readers_;
  std::vector<std::uint32_t> firstTriangles_;
  TaskRunner& runner_;
  std::stop_token stop_;
};

}  // namespace

Result<GatherForecast> forecastGathering(const OpenProject& open, const std::vector<int>& cameras,
                                         const SurfaceLight* light, TaskRunner& runner,
                                         const std::stop_token& stop, bool brief) {
  if (!gathersLight(open.plan, open.project.bake)) return GatherForecast{};
  const GatherForecast forecast = Forecaster(open, cameras, light, runner, stop, brief).run();
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "the estimate was stopped");
  return forecast;
}

}  // namespace acentric
