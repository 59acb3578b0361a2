#include "engine/export/surface_charts.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <unordered_map>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

using Corners = std::array<glm::dvec2, 3>;

struct CellHash {
  std::size_t operator()(const glm::i64vec3& c) const {
    std::uint64_t hash = 0;
    for (int i = 0; i < 3; ++i)
      hash = (hash ^ std::uint64_t(c[i])) * 0x9e3779b97f4a7c15ULL, hash ^= hash >> 29;
    return hash;
  }
};

class Grower {
 public:
  explicit Grower(std::span<const SurfaceTriangle> triangles)
      : triangles_(triangles),
        normals_(triangles.size()),
        areas_(triangles.size()),
        corners_(triangles.size()) {
    std::unordered_map<glm::i64vec3, std::uint32_t, CellHash> known;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& at = triangles[t].corners;
      const glm::dvec3 normal =
          glm::cross(glm::dvec3(at[1]) - glm::dvec3(at[0]), glm::dvec3(at[2]) - glm::dvec3(at[0]));
      const double length = glm::length(normal);
      areas_[t] = 0.5 * length;
      normals_[t] = length > 0 ? normal / length : glm::dvec3(0);
      for (int i = 0; i < 3; ++i)
        corners_[t][i] =
            known.try_emplace(glm::i64vec3(glm::round(glm::dvec3(at[std::size_t(i)]) / kWeld)), known.size())
                .first->second;
      for (int i = 0; i < 3; ++i)
        if (corners_[t][i] != corners_[t][(i + 1) % 3]) edges_.emplace_back(edge(t, i), std::uint32_t(t));
    }
    std::ranges::sort(edges_);
  }

  std::vector<SurfaceChart> grow() {
    std::vector<std::uint32_t> order(triangles_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return areas_[a] > areas_[b]; });
    taken_.assign(triangles_.size(), 0);
    std::vector<SurfaceChart> charts;
    for (const std::uint32_t seed : order)
      if (taken_[seed] == 0) std::ranges::move(cut(from(seed)), std::back_inserter(charts));
    return charts;
  }

 private:
  /// From corner i to the next.
  std::uint64_t edge(std::size_t t, int i) const {
    return std::uint64_t(corners_[t][i]) << 32 | corners_[t][(i + 1) % 3];
  }

  SurfaceChart from(std::uint32_t seed) {
    SurfaceChart chart;
    taken_[seed] = 1;
    chart.triangles.push_back(seed);
    const glm::dvec3 normal = normals_[seed];
    if (normal == glm::dvec3(0)) {
      chart.origin = triangles_[seed].corners[0];
      layOut(chart);
      return chart;
    }
    chart.origin = triangles_[seed].corners[0];
    const glm::dvec3 other = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    chart.across = glm::normalize(glm::cross(other, normal));
    chart.down = glm::cross(normal, chart.across);
    std::vector<Corners> placed{placesOf(chart, seed)};
    std::deque<std::uint32_t> next{seed};
    while (!next.empty() && chart.triangles.size() < kMostChartTriangles) {
      const std::uint32_t t = next.front();
      next.pop_front();
      for (int i = 0; i < 3; ++i) {
        const std::uint64_t along = edge(t, i), back = along << 32 | along >> 32;
        for (auto e = std::ranges::lower_bound(edges_, std::pair(back, 0U));
             e != edges_.end() && e->first == back; ++e) {
          const std::uint32_t n = e->second;
          if (taken_[n] != 0 || triangles_[n].kind != triangles_[seed].kind ||
              glm::dot(normals_[n], normal) < kLeastCosine)
            continue;
          const Corners places = placesOf(chart, n);
          if (std::ranges::any_of(placed, [&](const Corners& each) { return overlap(each, places); }))
            continue;
          taken_[n] = 1;
          chart.triangles.push_back(n), placed.push_back(places), next.push_back(n);
          if (chart.triangles.size() >= kMostChartTriangles) break;
        }
      }
    }
    layOut(chart);
    return chart;
  }

  /// With the border that a picture has around it, about.
  static double roomOf(const glm::dvec2& size) {
    constexpr double kBorder = 0.01;  // metres
    return (size.x + kBorder) * (size.y + kBorder);
  }

  /// The chart, or what it is cut into where that takes less room. A frame's first cuts save nothing, so all
  /// are tried before it is told.
  std::vector<SurfaceChart> cut(SurfaceChart chart) const {
    constexpr double kWorthwhile = 0.75, kFull = 0.8;
    const std::size_t count = chart.triangles.size();
    const double room = roomOf(chart.size);
    double covered = 0;
    std::vector<Corners> places;
    for (const std::uint32_t t : chart.triangles) covered += areas_[t], places.push_back(placesOf(chart, t));
    std::vector<SurfaceChart> whole{std::move(chart)};
    if (count < 2 || covered > kFull * room) return whole;
    struct Box {
      glm::dvec2 low{HUGE_VAL}, high{-HUGE_VAL};
      void add(const Corners& corners) {
        for (const glm::dvec2& p : corners) low = glm::min(low, p), high = glm::max(high, p);
      }
    };
    std::vector<std::size_t> best;
    std::size_t bestCount = 0;
    double least = HUGE_VAL;
    for (int axis = 0; axis < 2; ++axis) {
      std::vector<std::size_t> order(count);
      std::iota(order.begin(), order.end(), std::size_t(0));
      std::ranges::stable_sort(order, {}, [&](std::size_t i) {
        return places[i][0][axis] + places[i][1][axis] + places[i][2][axis];
      });
      std::vector<double> behind(count);  // of the i-th and all after it
      Box box;
      for (std::size_t i = count; i-- > 1;) box.add(places[order[i]]), behind[i] = roomOf(box.high - box.low);
      box = {};
      for (std::size_t i = 1; i < count; ++i) {
        box.add(places[order[i - 1]]);
        const double both = roomOf(box.high - box.low) + behind[i];
        if (both < least) least = both, best = order, bestCount = i;
      }
    }
    std::vector<SurfaceChart> parts;
    double taken = 0;
    for (const bool first : {true, false}) {
      SurfaceChart part = whole[0];
      part.triangles.clear();
      for (std::size_t i = first ? 0 : bestCount; i < (first ? bestCount : count); ++i)
        part.triangles.push_back(whole[0].triangles[best[i]]);
      layOut(part);
      for (SurfaceChart& each : cut(std::move(part))) {
        taken += roomOf(each.size);
        parts.push_back(std::move(each));
      }
    }
    return taken < kWorthwhile * room ? parts : whole;
  }

  Corners placesOf(const SurfaceChart& chart, std::uint32_t t) const {
    Corners out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = chart.place(triangles_[t].corners[i]);
    return out;
  }

  /// Turns the axes along the edge that gives the smallest rectangle.
  void layOut(SurfaceChart& chart) const {
    constexpr std::size_t kMostTried = 64;
    std::vector<glm::dvec2> all, ways;
    for (const std::uint32_t t : chart.triangles) {
      const Corners places = placesOf(chart, t);
      for (std::size_t i = 0; i < 3; ++i) {
        all.push_back(places[i]);
        ways.push_back(places[(i + 1) % 3] - places[i]);
      }
    }
    std::ranges::stable_sort(ways, std::greater<>(),
                             [](const glm::dvec2& way) { return glm::dot(way, way); });
    ways.resize(std::min(ways.size(), kMostTried));
    glm::dvec2 best(1, 0), low(0), high(0);
    double smallest = HUGE_VAL;
    for (glm::dvec2 way : ways) {
      const double length = glm::length(way);
      if (!(length > 0)) continue;
      way /= length;
      glm::dvec2 from(HUGE_VAL), to(-HUGE_VAL);
      for (const glm::dvec2& p : all) {
        const glm::dvec2 at(glm::dot(way, p), cross(way, p));
        from = glm::min(from, at), to = glm::max(to, at);
      }
      const double area = (to.x - from.x) * (to.y - from.y);
      if (area >= smallest) continue;
      smallest = area, best = way, low = from, high = to;
    }
    if (smallest == HUGE_VAL) return;
    const glm::dvec3 along = best.x * chart.across + best.y * chart.down;
    const glm::dvec3 aside = -best.y * chart.across + best.x * chart.down;
    chart.origin += low.x * along + low.y * aside;
    chart.across = along, chart.down = aside;
    chart.size = high - low;
    if (chart.size.x >= chart.size.y) return;
    std::swap(chart.across, chart.down);
    std::swap(chart.size.x, chart.size.y);
  }

  static inline const double kLeastCosine = std::cos(kMostBend);
  const std::span<const SurfaceTriangle> triangles_;
  std::vector<glm::dvec3> normals_;
  std::vector<double> areas_;
  std::vector<glm::uvec3> corners_;  ///< equal where they are one
  std::vector<std::pair<std::uint64_t, std::uint32_t>> edges_;
  std::vector<char> taken_;
};

}  // namespace

bool overlap(const std::array<glm::dvec2, 3>& a, const std::array<glm::dvec2, 3>& b) {
  // A separating axis is the normal of a side of one of them; borders may overlap by rounding.
  constexpr double kSlack = 2 * kWeld;
  for (const auto& [of, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    double turn = cross((*of)[1] - (*of)[0], (*of)[2] - (*of)[0]);
    if (turn == 0) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 from = (*of)[i], side = (*of)[(i + 1) % 3] - from;
      const double length = glm::length(side);
      if (length == 0) return false;
      double deepest = -HUGE_VAL;
      for (const glm::dvec2& p : *other)
        deepest = std::max(deepest, (turn > 0 ? 1 : -1) * cross(side, p - from) / length);
      if (deepest <= kSlack) return false;
    }
  }
  return true;
}

std::vector<SurfaceChart> chartsOf(std::span<const SurfaceTriangle> triangles) {
  return Grower(triangles).grow();
}

}  // namespace acentric
