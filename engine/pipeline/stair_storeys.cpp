#include "engine/pipeline/stair_storeys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/geometry/round_to.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/project_walks.h"
#include "engine/pipeline/scene_probe.h"

namespace acentric {
namespace {

constexpr double kWidestRow = 2.0;   // metres: wider pieces have several rows of rings
constexpr double kWiderRing = 1.35;  // a single ring may be so many times wider than the piece
constexpr double kLevelRise = 0.01;  // metres per metre: a landing, which rises nowhere in particular

/// A piece's box along and across its slope.
struct AlignedBox {
  double azimuth = 0;
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-low};
  glm::dvec2 size() const { return high - low; }
  glm::dvec2 world(const glm::dvec2& place) const {
    const glm::dvec2 along = directionOf(azimuth);
    return place.x * along + place.y * glm::dvec2(-along.y, along.x);
  }
};

AlignedBox boxAlong(const Outline& outline, double azimuth) {
  AlignedBox box{azimuth};
  const glm::dvec2 along = directionOf(azimuth);
  for (const auto& loop : outline.loops)
    for (const glm::dvec2& corner : loop) {
      const glm::dvec2 place(glm::dot(corner, along), cross(along, corner));
      box.low = glm::min(box.low, place), box.high = glm::max(box.high, place);
    }
  return box;
}

/// A landing is as long as its box is in the direction where that is smallest.
AlignedBox boxOf(const StairPiece& piece) {
  if (glm::length(piece.slope.rise) >= kLevelRise)
    return boxAlong(piece.outline, std::atan2(piece.slope.rise.y, piece.slope.rise.x));
  AlignedBox best;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < 12; ++n) {
    const AlignedBox box = boxAlong(piece.outline, n * kPi / 12);
    const double area = box.size().x * box.size().y;
    if (area < least - 1e-9) least = area, best = box;
  }
  return best;
}

/// The storey of the project that lies on a plane; -1 = none.
int storeyOn(const Project& project, const WalkPlane& plane) {
  for (std::size_t s = 0; s < project.storeys.size(); ++s)
    if (!isStairs(project.storeys[s]) && liesOn(project.storeys[s], plane)) return int(s);
  return -1;
}

/// Has the project stairs over this piece already?
bool hasPiece(const Project& project, const StairPiece& piece) {
  return std::ranges::any_of(project.storeys, [&](const Storey& storey) {
    return isStairs(storey) && storey.layout.outline.contains(piece.slope.at) &&
           std::abs(storey.layout.groundAt(piece.slope.at) - piece.floorHeight) < 0.1;
  });
}

int freeStairNumber(const Project& project) {
  for (int number = 1;; ++number)
    if (std::ranges::none_of(project.storeys, [prefix = fmt::format("stairs {}.", number)](const Storey& s) {
          return s.name.starts_with(prefix);
        }))
      return number;
}

/// Up all pieces from the lowest, each time to the nearest that is higher, looking ahead, at walking speed.
std::optional<CameraPath> pathOver(std::span<const Storey> pieces) {
  constexpr double kMetresPerSecond = 1.0, kFarthest = 4;
  CameraPath path;
  std::vector<const LayoutSpec*> left;
  for (const Storey& piece : pieces) left.push_back(&piece.layout);
  const auto eyeOf = [](const LayoutSpec& spec) {
    return glm::dvec3(spec.slope->at, spec.floorHeight + spec.eyeHeight);
  };
  while (!left.empty()) {
    const auto away = [&](const LayoutSpec* spec) {
      return path.poses.empty() ? spec->floorHeight : glm::distance(eyeOf(*spec), path.poses.back().eye);
    };
    const auto next = std::ranges::min_element(left, {}, away);
    if (!path.poses.empty() && away(*next) > kFarthest) break;
    const glm::dvec3 eye = eyeOf(**next);
    PathPose pose{eye, 0, 0, 0};
    if (!path.poses.empty()) {
      PathPose& before = path.poses.back();
      const glm::dvec2 way = glm::dvec2(eye) - glm::dvec2(before.eye);
      before.yawRadians = pose.yawRadians = radians(tidyDegrees(std::atan2(way.y, way.x)));
      pose.seconds = before.seconds + std::max(0.01, glm::length(way) / kMetresPerSecond);
      pose.seconds = roundTo(pose.seconds, 0.01);
    }
    path.poses.push_back(pose);
    std::erase_if(left, [&](const LayoutSpec* spec) { return spec->floorHeight <= (*next)->floorHeight; });
  }
  if (path.poses.size() < 2 || !path.check()) return std::nullopt;
  return path;
}

class StairAdder {
 public:
  StairAdder(Project& project, const RayScene& rays, const Storeys& found, const WalkableOptions& walkable)
      : project_(project), rays_(rays), found_(found), like_(project.layout()) {
    options_.walkable = walkable;
    options_.walkable.eyeHeight = like_.eyeHeight;
    options_.pieceRise = std::clamp(2 * project.bake.eyeRange, 0.1, 1.0);
    for (const WalkPlane& plane : found.planes) storeyOf_.push_back(storeyOn(project, plane));
  }

  /// Does the way join storeys, those that are asked for?
  bool joins(const StoreyWay& way, const std::optional<StairEnds>& between) const {
    std::vector<int> ends;
    for (const int plane : way.planes)
      if (storeyOf_[std::size_t(plane)] >= 0) ends.push_back(storeyOf_[std::size_t(plane)]);
    const auto has = [&](int storey) { return std::ranges::find(ends, storey) != ends.end(); };
    return between ? has(between->lower) && has(between->upper) : ends.size() > 1;
  }

  Status add(const StoreyWay& way, AddedStairs& added) {
    const std::string name = fmt::format("from {:.2f} to {:.2f} m at ({:.1f}, {:.1f})",
                                         found_.planes[std::size_t(way.planes.front())].height,
                                         found_.planes[std::size_t(way.planes.back())].height,
                                         0.5 * (way.low.x + way.high.x), 0.5 * (way.low.y + way.high.y));
    const auto leaveOut = [&](const std::string& why) { added.leftOut.push_back(name + ": " + why); };
    auto pieces = findStairs(rays_.scene().bounds, found_, way, options_, probeFor(rays_));
    if (!pieces && pieces.error().kind != ErrorKind::tooLarge) return tl::unexpected(pieces.error());
    if (!pieces) return leaveOut(pieces.error().message), Status{};
    const std::size_t all = pieces->size();
    std::erase_if(*pieces, [&](const StairPiece& piece) { return hasPiece(project_, piece); });
    if (pieces->empty())
      return leaveOut(all == 0 ? "no way is found there at a closer look" : "has cells"), Status{};
    if (project_.storeys.size() + pieces->size() > std::size_t(kMaxStoreys))
      return leaveOut(fmt::format("its {} pieces are more than the {} storeys that a project may have let",
                                  pieces->size(), kMaxStoreys)),
             Status{};
    const int number = freeStairNumber(project_);
    std::vector<Storey> storeys;
    for (std::size_t p = 0; p < pieces->size(); ++p) {
      auto storey = storeyFor((*pieces)[p], fmt::format("stairs {}.{}", number, p + 1));
      if (!storey) return leaveOut(storey.error().message), Status{};
      storeys.push_back(std::move(*storey));
    }
    ++added.ways;
    added.pieces += int(storeys.size());
    const std::string pathName = fmt::format("stairs {}", number);
    if (auto path = pathOver(storeys);
        path && project_.paths.size() < kMaxPaths &&
        std::ranges::find(project_.paths, pathName, &WalkPath::name) == project_.paths.end())
      project_.paths.push_back({pathName, int(project_.storeys.size()), std::move(*path)});
    std::ranges::move(storeys, std::back_inserter(project_.storeys));
    return {};
  }

 private:
  Result<Storey> storeyFor(const StairPiece& piece, std::string name) const {
    Storey storey{std::move(name), layoutOf(piece, like_), {}, {}};
    if (Status sound = storey.layout.check(); !sound) return tl::unexpected(sound.error());
    const auto layout = buildLayout(storey.layout);
    if (!layout) return tl::unexpected(layout.error());
    storey.spawn.position = glm::round(storey.layout.outline.nearestPoint(piece.slope.at) * 1e3) / 1e3;
    storey.spawn.yawRadians =
        radians(std::round(degrees(std::atan2(piece.slope.rise.y, piece.slope.rise.x))));
    return storey;
  }

  Project& project_;
  const RayScene& rays_;
  const Storeys& found_;
  const LayoutSpec like_;
  StairOptions options_;
  std::vector<int> storeyOf_;  ///< by plane; -1 = none
};

}  // namespace

LayoutSpec layoutOf(const StairPiece& piece, const LayoutSpec& like) {
  LayoutSpec spec;
  spec.configuration = Configuration::b;
  spec.eyeHeight = like.eyeHeight;
  spec.nearBand = like.nearBand;
  spec.floorHeight = roundTo(piece.floorHeight, 1e-4) + 0.0;
  spec.outline = tidied(piece.outline);
  spec.slope = {glm::round(piece.slope.at * 1e4) / 1e4, glm::round(piece.slope.rise * 1e4) / 1e4 + 0.0};
  const AlignedBox box = boxOf(piece);
  const double length = box.size().x, width = box.size().y;
  // A ring reaches an edge's length forwards at its middle, half of that along its sides.
  const double rows = std::max(1.0, std::ceil(width / kWidestRow)), edge = width / (rows * std::sqrt(3.0));
  const double single = std::max(width / std::sqrt(3.0), 0.5 * length + width / (2 * std::sqrt(3.0)));
  const bool one = rows == 1 && single <= kWiderRing * edge;
  constexpr double kSlack = 1.002;  // so that no ring beside it touches the outline by rounding
  spec.cellSize =
      std::clamp(std::ceil(1e3 * kSlack * (one ? single : edge)) / 1e3, kLeastCellSize, kLargestCellSize);
  glm::dvec2 middle = 0.5 * (box.low + box.high);
  if (!one && std::fmod(rows, 2) == 0) middle.y -= 0.5 * std::sqrt(3.0) * spec.cellSize;
  spec.latticeOrigin = glm::round(box.world(middle) * 1e4) / 1e4;
  spec.rotationRadians = radians(tidyDegrees(box.azimuth));
  return spec;
}

Result<AddedStairs> addStairs(Project& project, const RayScene& rays, const Storeys& found,
                              const StairRequest& request, const Progress& progress, std::stop_token stop) {
  StairAdder adder(project, rays, found, request.walkable);
  AddedStairs added;
  bool any = false;
  for (std::size_t w = 0; w < found.ways.size(); ++w) {
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
    if (progress) progress({double(w), double(found.ways.size()), "laying cells on stairs"});
    if (!adder.joins(found.ways[w], request.between)) continue;
    any = true;
    if (Status done = adder.add(found.ways[w], added); !done) return tl::unexpected(done.error());
  }
  if (any || !request.between) return added;
  const auto nameOf = [&](int storey) { return project.storeys[std::size_t(storey)].name; };
  return fail(ErrorKind::notFound,
              fmt::format("no stairs or ramp that can be walked join '{}' and '{}'",
                          nameOf(request.between->lower), nameOf(request.between->upper)),
              "stairs");
}

int removeStairs(Project& project) {
  int removed = 0;
  for (std::size_t s = project.storeys.size(); s-- > 0;)
    if (isStairs(project.storeys[s]) && project.storeys.size() > 1) removeStorey(project, int(s)), ++removed;
  return removed;
}

}  // namespace acentric
