#include "engine/view/local_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/image/colour.h"

namespace acentric {
namespace {

/// Nearer surfaces are not drawn, metres along the view axis: below what any project, in whatever unit it is
/// drawn, has before an eye.
constexpr double kNearest = 1e-7;
constexpr std::size_t kTrianglesPerTask = 4096;
constexpr int kBandRows = 32;

/// Pixels whose centres the triangle can cover: the box of its part in front of the near plane.
PixelRect boundsOf(const std::array<glm::dvec3, 3>& corners, const PerspectiveView& view, double focal) {
  glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  const auto add = [&](const glm::dvec3& q) {
    const glm::dvec2 at(0.5 * view.width + focal * q.x / q.z, 0.5 * view.height + focal * q.y / q.z);
    low = glm::min(low, at), high = glm::max(high, at);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &p = corners[i], &q = corners[(i + 1) % 3];
    if (p.z >= kNearest) add(p);
    if ((p.z < kNearest) != (q.z < kNearest)) {
      const glm::dvec3 crossing = p + (kNearest - p.z) / (q.z - p.z) * (q - p);
      add({crossing.x, crossing.y, kNearest});
    }
  }
  const auto clampTo = [](double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
  };
  if (!(low.x <= high.x)) return {};
  return {clampTo(std::floor(low.x - 0.5), view.width), clampTo(std::floor(low.y - 0.5), view.height),
          clampTo(std::ceil(high.x + 0.5), view.width), clampTo(std::ceil(high.y + 0.5), view.height)};
}

/// A pixel centre exactly on an edge belongs to one of the two triangles that share it: their edge functions
/// are each other's negative.
bool ownsBorder(const glm::dvec3& edge) {
  if (edge.x != 0) return edge.x > 0;
  if (edge.y != 0) return edge.y > 0;
  return edge.z > 0;
}

bool covers(double value, const glm::dvec3& edge) { return value > 0 || (value == 0 && ownsBorder(edge)); }

}  // namespace

LocalRaster::LocalRaster(const LocalGeometry& local, const LocalShading& shading, const PerspectiveView& view,
                         TaskRunner& runner)
    : local_(local),
      shading_(shading),
      view_(view),
      focal_(view.focalPixels()),
      inView_(local.vertices.size()) {
  const auto tasks = [](std::size_t count) { return (count + kTrianglesPerTask - 1) / kTrianglesPerTask; };
  const glm::dmat3 viewFromWorld = view.viewFromWorld();
  runner.parallelFor(tasks(inView_.size()), [&](std::size_t task) {
    const std::size_t end = std::min(inView_.size(), (task + 1) * kTrianglesPerTask);
    for (std::size_t v = task * kTrianglesPerTask; v < end; ++v)
      inView_[v] = viewFromWorld * (glm::dvec3(local_.vertices[v].position) - view_.eye);
  });
  std::vector<std::vector<Triangle>> parts(tasks(local_.triangles.size()));
  runner.parallelFor(parts.size(), [&](std::size_t task) {
    const std::size_t end = std::min(local_.triangles.size(), (task + 1) * kTrianglesPerTask);
    Triangle triangle;
    for (std::size_t t = task * kTrianglesPerTask; t < end; ++t)
      if (setUp(static_cast<std::uint32_t>(t), triangle)) parts[task].push_back(triangle);
  });
  for (const auto& part : parts)
    for (const Triangle& triangle : part)
      (shading_.materialOf(local_.triangles[triangle.index].mesh).clear() ? clear_ : opaque_)
          .push_back(triangle);
  opaqueOfBand_.resize(static_cast<std::size_t>((view.height + kBandRows - 1) / kBandRows));
  for (std::size_t t = 0; t < opaque_.size(); ++t)
    for (int band = opaque_[t].box.y0 / kBandRows; band <= (opaque_[t].box.y1 - 1) / kBandRows; ++band)
      opaqueOfBand_[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(t));
  std::stable_sort(clear_.begin(), clear_.end(),
                   [](const Triangle& a, const Triangle& b) { return a.farthest > b.farthest; });
}

bool LocalRaster::setUp(std::uint32_t index, Triangle& out) const {
  const LocalTriangle& source = local_.triangles[index];
  const std::array<glm::dvec3, 3> q{inView_[source.vertices.x], inView_[source.vertices.y],
                                    inView_[source.vertices.z]};
  out.box = boundsOf(q, view_, focal_);
  if (out.box.width() <= 0 || out.box.height() <= 0) return false;
  const glm::dvec3 normals[3]{glm::cross(q[1], q[2]), glm::cross(q[2], q[0]), glm::cross(q[0], q[1])};
  const double determinant = glm::dot(q[0], normals[0]);
  if (determinant == 0 || !std::isfinite(determinant)) return false;  // seen edge on
  const double sign = determinant < 0 ? -1 : 1;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 n = sign * normals[i];
    // At pixel centre (x + 0.5, y + 0.5), in terms of the whole numbers x and y.
    out.edge[i] = {
        n.x / focal_, n.y / focal_,
        n.z + n.x * ((0.5 - 0.5 * view_.width) / focal_) + n.y * ((0.5 - 0.5 * view_.height) / focal_)};
  }
  out.perDepth = 1 / std::abs(determinant);
  out.farthest = std::sqrt(std::max({glm::dot(q[0], q[0]), glm::dot(q[1], q[1]), glm::dot(q[2], q[2])}));
  out.index = index;
  out.back = determinant > 0;  // the eye is behind the plane of q0, q1, q2
  out.masked = shading_.materialOf(source.mesh).masked;
  return true;
}

/// visit(y, row): rows of all pixels of the rectangle that are covered, and few others; `Row` is an EdgeRow
/// with whatever `visit` fills in.
template <class Row, class Visit>
void LocalRaster::forEachRow(const Triangle& triangle, const PixelRect& rect, const Visit& visit) const {
  Row row;
  for (int i = 0; i < 3; ++i) {
    row.slope[i] = triangle.edge[i].x;
    row.ownsBorder[i] = ownsBorder(triangle.edge[i]);
  }
  row.perDepth = triangle.perDepth;
  row.mostInverse = 1 / kNearest;
  const int y0 = std::max(triangle.box.y0, rect.y0), y1 = std::min(triangle.box.y1, rect.y1);
  for (int y = y0; y < y1; ++y) {
    double low = std::max(triangle.box.x0, rect.x0), high = std::min(triangle.box.x1, rect.x1) - 1;
    for (int i = 0; i < 3; ++i) {
      row.start[i] = triangle.edge[i].y * y + triangle.edge[i].z;
      // Where this edge can be crossed, a pixel of slack left and right; the test of each pixel is exact.
      if (row.slope[i] > 0) low = std::max(low, -row.start[i] / row.slope[i] - 1);
      if (row.slope[i] < 0) high = std::min(high, -row.start[i] / row.slope[i] + 1);
    }
    if (!(low <= high)) continue;
    row.x0 = static_cast<int>(low), row.count = static_cast<int>(high) + 1 - row.x0;
    visit(y, row);
  }
}

/// visit(x, y, edge values, inverse depth) for each covered pixel of the rectangle.
template <class Visit>
void LocalRaster::forEachPixel(const Triangle& triangle, const PixelRect& rect, const Visit& visit) const {
  const auto& edge = triangle.edge;
  forEachRow<EdgeRow>(triangle, rect, [&](int y, const EdgeRow& row) {
    for (int x = row.x0; x < row.x0 + row.count; ++x) {
      const glm::dvec3 values(row.slope[0] * x + row.start[0], row.slope[1] * x + row.start[1],
                              row.slope[2] * x + row.start[2]);
      if (!covers(values.x, edge[0]) || !covers(values.y, edge[1]) || !covers(values.z, edge[2])) continue;
      const double inverseZDepth = (values.x + values.y + values.z) * triangle.perDepth;
      if (inverseZDepth > row.mostInverse || !(inverseZDepth > 0)) continue;
      visit(x, y, values, static_cast<float>(inverseZDepth));
    }
  });
}

std::array<LocalPoint, 3> LocalRaster::cornersOf(const Triangle& triangle) const {
  const LocalTriangle& source = local_.triangles[triangle.index];
  std::array<LocalPoint, 3> corners;
  for (int i = 0; i < 3; ++i)
    corners[static_cast<std::size_t>(i)] = {source.mesh, source.triangle,
                                            glm::vec2(local_.vertices[source.vertices[i]].barycentric),
                                            triangle.back};
  return corners;
}

LocalPoint LocalRaster::pointAt(const Triangle& triangle, const glm::dvec3& weights) const {
  const std::array<LocalPoint, 3> corners = cornersOf(triangle);
  const glm::dvec3 b = weights / (weights.x + weights.y + weights.z);
  LocalPoint point = corners[0];
  point.barycentric =
      glm::vec2(b.x * glm::dvec2(corners[0].barycentric) + b.y * glm::dvec2(corners[1].barycentric) +
                b.z * glm::dvec2(corners[2].barycentric));
  return point;
}

void LocalRaster::findMirrors(const FlatMirrors& mirrors) {
  for (std::size_t t = 0; t < opaque_.size(); ++t) {
    const std::uint8_t plane = mirrors.planeOf(local_, local_.triangles[opaque_[t].index]);
    if (plane == FlatMirrors::kNoPlane) continue;
    mirrors_.resize(opaque_.size(), 0);
    mirrors_[t] = mirrors.seenFrom(plane, view_.eye);
  }
}

/// body(band, first row, end row).
template <class Body>
void LocalRaster::forBands(TaskRunner& runner, const Body& body) const {
  runner.parallelFor(opaqueOfBand_.size(), [&](std::size_t band) {
    const int y0 = static_cast<int>(band) * kBandRows;
    body(band, y0, std::min(y0 + kBandRows, view_.height));
  });
}

void LocalRaster::findOpaque(CoverRow coverRow, CoverImage& cover, TaskRunner& runner) const {
  const std::size_t width = static_cast<std::size_t>(view_.width);
  cover.width = view_.width, cover.height = view_.height;
  cover.pixels.resize(width * static_cast<std::size_t>(view_.height));
  forBands(runner, [&](std::size_t band, int y0, int y1) {
    std::uint32_t* const visible = &cover.at(0, y0);
    std::vector<float> nearest(width * static_cast<std::size_t>(y1 - y0), 0.0f);
    std::fill_n(visible, nearest.size(), kUncovered);
    const PixelRect rect{0, y0, view_.width, y1};
    for (const std::uint32_t t : opaqueOfBand_[band]) {
      const Triangle& triangle = opaque_[t];
      const auto pixelAt = [&](int x, int y) {
        return static_cast<std::size_t>(y - y0) * width + static_cast<std::size_t>(x);
      };
      if (!triangle.masked) {
        forEachRow<TriangleRow>(triangle, rect, [&](int y, TriangleRow& row) {
          row.triangle = t;
          row.visible = visible + pixelAt(row.x0, y), row.nearest = nearest.data() + pixelAt(row.x0, y);
          coverRow(row);
        });
        continue;
      }
      forEachPixel(triangle, rect, [&](int x, int y, const glm::dvec3& values, float depth) {
        const std::size_t pixel = pixelAt(x, y);
        if (depth <= nearest[pixel] || !shading_.survivesMask(pointAt(triangle, values))) return;
        nearest[pixel] = depth;
        visible[pixel] = t;
      });
    }
  });
}

/// What the triangles of a band look like, kept from one row to the next.
class LocalRaster::BandShading {
 public:
  explicit BandShading(const LocalRaster& raster) : raster_(raster) {}

  const std::optional<SurfaceShade>& of(std::uint32_t triangle) {
    Entry& entry = entries_[triangle % entries_.size()];
    if (entry.triangle != triangle) {
      entry.triangle = triangle;
      entry.shade = raster_.shading_.triangle(raster_.cornersOf(raster_.opaque_[triangle]));
    }
    return entry.shade;
  }

 private:
  struct Entry {
    std::uint32_t triangle = kUncovered;
    std::optional<SurfaceShade> shade;
  };
  const LocalRaster& raster_;
  std::array<Entry, 128> entries_;
};

void LocalRaster::drawOpaque(const CoverImage& cover, ShadeRun shadeRun, Frame& frame,
                             FloatImage& inverseZDepth, TaskRunner& runner) const {
  const glm::vec3 eye(view_.eye);
  forBands(runner, [&](std::size_t, int y0, int y1) {
    BandShading shading(*this);
    for (int y = y0; y < y1; ++y)
      for (int x = 0, end = 0; x < view_.width; x = end) {
        const std::uint32_t t = cover.at(x, y);
        for (end = x + 1; end < view_.width && cover.at(end, y) == t;) ++end;
        if (t == kUncovered) continue;
        bool reflecting = false;
        if (!mirrors_.empty() && mirrors_[t] != 0) {
          const auto reflects = [&](int i) { return frame.source.at(i, y) != kSourceHole; };
          reflecting = reflects(x);
          for (int i = x + 1; i < end; ++i)
            if (reflects(i) != reflecting) end = i;
        }
        std::fill_n(&frame.source.at(x, y), end - x, kSourceLocal);
        const Triangle& triangle = opaque_[t];
        const auto& edge = triangle.edge;
        SurfaceRun run;
        for (int i = 0; i < 3; ++i) run.slope[i] = edge[i].x, run.start[i] = edge[i].y * y + edge[i].z;
        run.perDepth = triangle.perDepth;
        run.x0 = x, run.count = end - x;
        run.colour = reinterpret_cast<std::uint32_t*>(&frame.colour.at(x, y));
        run.inverseZDepth = &inverseZDepth.at(x, y);
        const auto* const shade = reflecting ? nullptr : &shading.of(t);
        if (shade != nullptr && *shade) {
          shadeRun(**shade, run);
          continue;
        }
        for (int i = x; i < end; ++i) {
          const glm::dvec3 values(run.slope[0] * i + run.start[0], run.slope[1] * i + run.start[1],
                                  run.slope[2] * i + run.start[2]);
          if (!reflecting) frame.colour.at(i, y) = shading_.colourAt(pointAt(triangle, values), eye);
          inverseZDepth.at(i, y) = static_cast<float>((values.x + values.y + values.z) * triangle.perDepth);
        }
      }
  });
}

void LocalRaster::drawClear(BlendRow blendRow, Frame& frame, const FloatImage& inverseZDepth,
                            TaskRunner& runner) const {
  const glm::vec3 eye(view_.eye);
  forBands(runner, [&](std::size_t, int y0, int y1) {
    const PixelRect band{0, y0, view_.width, y1};
    for (const Triangle& triangle : clear_) {
      if (triangle.box.y0 >= y1 || triangle.box.y1 <= y0) continue;
      if (const auto shade = shading_.clearTriangle(cornersOf(triangle), eye)) {
        forEachRow<ClearRow>(triangle, band, [&](int y, ClearRow& row) {
          row.colour = reinterpret_cast<std::uint32_t*>(&frame.colour.at(row.x0, y));
          row.source = &frame.source.at(row.x0, y), row.nearest = &inverseZDepth.at(row.x0, y);
          row.hole = kSourceHole, row.local = kSourceLocal;
          blendRow(*shade, row);
        });
        continue;
      }
      forEachPixel(triangle, band, [&](int x, int y, const glm::dvec3& values, float depth) {
        const PixelSource source = frame.source.at(x, y);
        if (source == kSourceHole || (source == kSourceLocal && depth <= inverseZDepth.at(x, y))) return;
        const LocalPoint point = pointAt(triangle, values);
        if (triangle.masked && !shading_.survivesMask(point)) return;
        Rgba8& pixel = frame.colour.at(x, y);
        pixel = blendOver(shading_.colourAt(point, eye), pixel);
      });
    }
  });
}

}  // namespace acentric
