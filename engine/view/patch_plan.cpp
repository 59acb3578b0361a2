#include "engine/view/patch_plan.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/view/display_patches.h"
#include "engine/view/picture_axes.h"
#include "engine/view/second_look.h"
#include "engine/view/warp.h"

namespace acentric {
namespace {

/// Borders of rows are curves on the picture, sides of polygons are not: so many pixels more on all sides.
constexpr float kMargin = 0.75f;
/// Polygons of so few rows or columns are drawn as rectangles.
constexpr int kSmall = 4;
/// Corners nearer than this to the eye's plane are cut off, metres along the view axis.
constexpr double kNear = 1e-4;

/// Rays through pixels: of pixel (x, y) `first + x * across + y * down`, one metre along the view axis.
struct PixelRays {
  glm::dvec3 first, across, down;
  glm::dvec3 axis;  ///< of the view

  explicit PixelRays(const PerspectiveView& view) {
    const glm::dmat3 axes = glm::transpose(view.viewFromWorld());
    const double focal = view.focalPixels();
    axis = axes[2];
    across = axes[0] / focal, down = axes[1] / focal;
    first = axes[2] + (0.5 - 0.5 * view.width) * across + (0.5 - 0.5 * view.height) * down;
  }
};

/// One strip of the columns of a piece's capture.
class StripPlanner {
 public:
  StripPlanner(const PerspectiveView& view, const PixelRays& rays, const PieceDraw& piece,
               const DisplayCapture& capture, std::size_t strip, std::uint32_t slot, const SecondLook* look)
      : view_(view),
        rays_(rays),
        axes_(view),
        piece_(piece),
        capture_(capture),
        strip_(strip),
        look_(look),
        eye_(-glm::dvec3(piece.baseline)),
        baseline_(axes_.project(glm::dvec3(piece.baseline))) {
    const DisplayPatches& patches = *capture.patches;
    first_ = int(strip) * patches.stripColumns;
    end_ = std::min(first_ + patches.stripColumns, capture.camera.columns);
    middle_ = 0.5 * (first_ + end_);
    ahead_ = capture.camera.directionAt(middle_);
    common_.columnsPerRadian = float(1 / capture.camera.columnPitch());
    common_.rowsPerRadian = float(1 / capture.camera.rowPitch());
    common_.wantedRoles = std::uint32_t(piece.roles) << kTexelRoles;
    common_.slot = slot;
  }

  StripDraw plan(bool reflects, bool mirrorsOnly) {
    StripDraw draw;
    common_.reflects = reflects;
    limit(draw);
    const DisplayPatches& patches = *capture_.patches;
    const glm::ivec2 rows = rowsInSight();
    for (std::uint32_t i = patches.stripStart[strip_]; i < patches.stripStart[strip_ + 1]; ++i) {
      const DisplayPatch& patch = patches.patches[i];
      if ((patch.roles & piece_.roles) == 0 || (mirrorsOnly && patch.mirror == 0)) continue;
      if (patch.row >= rows.y || patch.row + patch.rows <= rows.x) continue;
      add(patch, draw);
    }
    return draw;
  }

 private:
  /// Rows [x, y) of the strip that the picture may show something of.
  glm::ivec2 rowsInSight() const {
    const ColumnCamera& camera = capture_.camera;
    if (piece_.sight.empty()) return {0, camera.rows};
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = first_; k < end_; ++k) {
      const ColumnSight& sight = piece_.sight[std::size_t(k)];
      if (sight.x0 < sight.x1)
        low = std::min(low, sight.tangents.low), high = std::max(high, sight.tangents.high);
    }
    if (low > high) return {0, 0};
    const auto rowAt = [&](double tangent) {
      return (camera.topElevation - std::atan(tangent)) / camera.rowPitch();
    };
    constexpr int kBeside = 2;
    return {std::max(int(rowAt(high)) - kBeside, 0), std::min(int(rowAt(low)) + 1 + kBeside, camera.rows)};
  }

  void limit(StripDraw& draw) {
    if (!piece_.clipToPart) return;
    const AzimuthRange part = piece_.part.azimuths;
    const glm::dvec2 low = directionOf(part.low), high = directionOf(part.low + part.width);
    const auto leftOf = [](const glm::dvec2& border, const glm::dvec3& d) {
      return float(cross(border, glm::dvec2(d)));
    };
    draw.limited = common_.limited = true;
    common_.eitherSide = part.width > kPi;
    draw.lowStart = leftOf(low, rays_.first), draw.lowAcross = leftOf(low, rays_.across);
    draw.highStart = -leftOf(high, rays_.first), draw.highAcross = -leftOf(high, rays_.across);
    common_.lowStep = leftOf(low, rays_.down), common_.highStep = -leftOf(high, rays_.down);
  }

  glm::dvec3 inStrip(const glm::dvec3& v) const {
    return {ahead_.x * v.x + ahead_.y * v.y, ahead_.x * v.y - ahead_.y * v.x, v.z};
  }

  void add(const DisplayPatch& patch, StripDraw& draw) {
    const glm::dvec3 normal(patch.normal);
    const double side = 1 - glm::dot(normal, eye_);  // of the eye; the camera's is 1
    if (patch.away ? side >= 0 : side <= 0) return;
    PolygonRows polygon;
    if (!polygon.set(cornersOf(patch), view_.width, view_.height)) return;

    PatchColumn column = common_;
    const glm::dvec3 perDepth = normal / side;
    const auto set = [&](const glm::dvec3& ray, float* place, float& depth) {
      const double inverse = glm::dot(perDepth, ray);
      const glm::dvec3 d = inStrip(ray + inverse * eye_);
      for (int i = 0; i < 3; ++i) place[i] = float(d[i]);
      depth = float(inverse);
    };
    set(rays_.first, column.start, column.depthStart);
    set(rays_.down, column.step, column.depthStep);
    set(rays_.across, column.across, column.depthAcross);
    const int middleRow = patch.row + patch.rows / 2;
    column.columnOffset = float(middle_ - patch.column);
    column.middleTangent = capture_.patches->rowBorder[std::size_t(middleRow)];
    column.rowOffset = float(middleRow - patch.row);
    column.columns = patch.columns, column.rows = patch.rows;
    if (!capture_.patches->cover.empty()) {  // else they are on a graphics card alone
      column.colour =
          reinterpret_cast<const std::uint32_t*>(capture_.patches->colour.data() + patch.firstTexel);
      column.cover = capture_.patches->cover.data() + patch.firstTexel;
    }
    column.mirror = patch.mirror;
    column.blended = patch.blended;
    column.settled = look_ != nullptr && !isWorthALook(patch);
    draw.x0 = std::min(draw.x0, polygon.x0()), draw.x1 = std::max(draw.x1, polygon.x1());
    draw.patches.push_back({column, polygon, patch.firstTexel});
  }

  /// Is any of it sampled thinly, and may be more densely by the second cover? Told by its middle, and of
  /// larger patches by four places around it.
  bool isWorthALook(const DisplayPatch& patch) const {
    constexpr int kFew = 8;
    constexpr double kNotThin = 1.25 * kThinDensity / kMostDensity;  // there and all around
    constexpr std::array<glm::ivec2, 5> kEighths{{{4, 4}, {1, 1}, {1, 7}, {7, 1}, {7, 7}}};
    const std::size_t places = patch.columns <= kFew && patch.rows <= kFew ? 1 : kEighths.size();
    const glm::dvec3 normal(patch.normal);
    return std::any_of(kEighths.begin(), kEighths.begin() + places, [&](const glm::ivec2& share) {
      const auto x = std::size_t(patch.column + share.x * patch.columns / 8);
      const auto y = std::size_t(patch.row + share.y * patch.rows / 8);
      const glm::dvec3 direction(glm::dvec2(capture_.patches->columnBorder[x]),
                                 capture_.patches->rowBorder[y]);
      const double inverse = glm::dot(normal, direction);
      if (!(inverse > 0)) return true;
      const glm::dvec3 place = direction / inverse - eye_;
      const double zDepth = glm::dot(rays_.axis, place);
      if (!(zDepth >= kNear)) return true;
      const auto pixel = SurfacePixel::onPlane(normal, zDepth, place / zDepth, rays_.across, rays_.down);
      const double density =
          densityAt(pixel, -eye_, double(common_.columnsPerRadian), double(common_.rowsPerRadian));
      return density < kNotThin && look_->isWorth(pixel, density);
    });
  }

  std::span<const glm::dvec3> cornersOf(const DisplayPatch& patch) {
    const int left = patch.column, right = left + patch.columns, top = patch.row, bottom = top + patch.rows;
    const auto& cut = patch.cut;
    const std::array<glm::ivec2, 8> corners{{{left + cut[0], top},
                                             {left, top + cut[0]},
                                             {left, bottom - cut[1]},
                                             {left + cut[1], bottom},
                                             {right - cut[3], bottom},
                                             {right, bottom - cut[3]},
                                             {right, top + cut[2]},
                                             {right - cut[2], top}}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const glm::vec2& c = capture_.patches->columnBorder[std::size_t(corners[i].x)];
      const glm::dvec3 direction(c.x, c.y, capture_.patches->rowBorder[std::size_t(corners[i].y)]);
      const double inverse = std::max(glm::dot(glm::dvec3(patch.normal), direction), 0.0);
      corners_[i] = axes_.project(direction) + inverse * baseline_;
    }
    return corners_;
  }

  const PerspectiveView& view_;
  const PixelRays& rays_;
  PictureAxes axes_;
  const PieceDraw& piece_;
  const DisplayCapture& capture_;
  std::size_t strip_;
  const SecondLook* look_;  ///< null: of what is painted there is no second cover
  glm::dvec3 eye_;          ///< e = E - P, metres
  glm::dvec3 baseline_;     ///< P - E on the picture
  int first_ = 0, end_ = 0;
  double middle_ = 0;    ///< column
  glm::dvec2 ahead_{0};  ///< its direction
  PatchColumn common_{};
  std::array<glm::dvec3, 8> corners_{};
};

/// Strips that hold columns of the piece, from the epipole outwards.
std::vector<std::size_t> stripsOf(const PieceDraw& piece, const DisplayCapture& capture) {
  const DisplayPatches& patches = *capture.patches;
  std::vector<char> wanted(patches.stripStart.size() - 1, 0);
  for (const ColumnRun& run : piece.runs)
    for (int strip = run.first / patches.stripColumns; strip <= (run.last - 1) / patches.stripColumns;
         ++strip)
      wanted[std::size_t(strip)] = 1;
  const double epipole = std::atan2(-double(piece.baseline.y), -double(piece.baseline.x));
  std::vector<std::pair<double, std::size_t>> away;
  for (std::size_t strip = 0; strip < wanted.size(); ++strip) {
    if (!wanted[strip]) continue;
    const int first = int(strip) * patches.stripColumns;
    const int end = std::min(first + patches.stripColumns, capture.camera.columns);
    const double half = 0.5 * (end - first) * capture.camera.columnPitch();
    double angle = std::abs(std::remainder(capture.camera.azimuthAt(0.5 * (first + end)) - epipole, kTwoPi));
    if (angle < half) angle = 0;             // holds the epipole
    if (kPi - angle < half) angle = kTwoPi;  // or the antipode
    away.emplace_back(angle, strip);
  }
  std::ranges::sort(away);
  std::vector<std::size_t> order;
  for (const auto& [angle, strip] : away) order.push_back(strip);
  return order;
}

}  // namespace

bool PolygonRows::set(std::span<const glm::dvec3> corners, int width, int height) {
  count_ = 0;
  const auto add = [&](const glm::dvec3& q) {
    if (std::size_t(count_) < kMostCorners) places_[std::size_t(count_++)] = glm::vec2(q) / float(q.z);
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if (a.z >= kNear) add(a);
    if ((a.z >= kNear) != (b.z >= kNear)) add(a + (kNear - a.z) / (b.z - a.z) * (b - a));
  }
  if (count_ < 3) return false;
  glm::vec2 low(HUGE_VALF), high(-HUGE_VALF);
  for (int i = 0; i < count_; ++i)
    low = glm::min(low, places_[std::size_t(i)]), high = glm::max(high, places_[std::size_t(i)]);
  const glm::vec2 size(width, height);
  low = glm::clamp(glm::floor(low - kMargin), glm::vec2(0), size);
  high = glm::clamp(glm::ceil(high + kMargin), glm::vec2(0), size);
  x0_ = int(low.x), y0_ = int(low.y), x1_ = int(high.x), y1_ = int(high.y);
  return x0_ < x1_ && y0_ < y1_;
}

void PolygonRows::rows(int first, int end, std::vector<RowRange>& out) const {
  out.assign(std::size_t(end - first), {y0_, y1_});
  if (x1_ - x0_ <= kSmall || y1_ - y0_ <= kSmall) return;
  std::ranges::fill(out, RowRange{y1_, y0_});
  for (int i = 0; i < count_; ++i) {
    glm::vec2 a = places_[std::size_t(i)], b = places_[std::size_t(i + 1 == count_ ? 0 : i + 1)];
    if (a.x > b.x) std::swap(a, b);
    const float rate = b.x > a.x ? (b.y - a.y) / (b.x - a.x) : 0;
    // Columns that it reaches with the margin.
    const float low = std::ceil(a.x - 1 - kMargin), high = std::floor(b.x + kMargin) + 1;
    const int from = low > float(first) ? int(std::min(low, float(end))) : first;
    const int to = high < float(end) ? int(std::max(high, float(first))) : end;
    for (int x = from; x < to; ++x) {
      const float left = float(x) - kMargin, right = float(x + 1) + kMargin;
      const float atLeft = a.x < left ? a.y + (left - a.x) * rate : a.y;
      const float atRight = b.x > right ? a.y + (right - a.x) * rate : b.y;
      RowRange& rows = out[std::size_t(x - first)];
      const float top = std::min(atLeft, atRight) - kMargin, bottom = std::max(atLeft, atRight) + kMargin;
      // Rounded as numbers that are not negative.
      const float begins = std::clamp(top, float(y0_), float(y1_)),
                  ends = std::clamp(bottom, float(y0_), float(y1_));
      const int whole = int(ends);
      rows.first = std::min(rows.first, int(begins));
      rows.end = std::max(rows.end, whole + (float(whole) < ends));
    }
  }
}

PatchPlan planPatches(const WalkScene& scene, const PerspectiveView& view, const ViewPlan& plan,
                      TaskRunner& runner) {
  struct Task {
    const PieceDraw* piece;
    std::shared_ptr<const DisplayCapture> capture;
    std::size_t strip;
    std::uint32_t slot;
    bool reflects, mirrorsOnly;
    StripDraw* out;
  };
  PatchPlan patches;
  std::vector<Task> tasks;
  const auto addAll = [&](const std::vector<PieceDraw>& pieces, std::size_t first, std::size_t end,
                          std::uint32_t firstSlot, bool shown, bool mirrorsOnly,
                          std::vector<StripDraw>& out) {
    const std::size_t from = tasks.size();
    for (std::size_t i = end; i-- > first;) {
      std::shared_ptr<const DisplayCapture> capture = scene.captures[std::size_t(pieces[i].camera)];
      if (shown) capture = capture->reflections;
      if (capture == nullptr || capture->patches == nullptr) continue;
      for (const std::size_t strip : stripsOf(pieces[i], *capture))
        tasks.push_back({&pieces[i], capture, strip, firstSlot + std::uint32_t(i), shown || mirrorsOnly,
                         mirrorsOnly, nullptr});
    }
    out.resize(tasks.size() - from);
    for (std::size_t i = from; i < tasks.size(); ++i) tasks[i].out = &out[i - from];
  };
  const auto& pieces = plan.pieces;
  const auto front = std::size_t(std::ranges::find(pieces, false, &PieceDraw::secondary) - pieces.begin());
  patches.frontSlot = pieceSlot(plan, front);
  addAll(pieces, front, pieces.size(), pieceSlot(plan, 0), false, false, patches.surfaces);
  addAll(pieces, 0, front, pieceSlot(plan, 0), false, false, patches.behind);
  if (!plan.reflections.empty()) {
    addAll(plan.reflections, 0, plan.reflections.size(), reflectionSlot(plan, 0), true, false,
           patches.reflections);
    addAll(pieces, 0, pieces.size(), pieceSlot(plan, 0), false, true, patches.mirrors);
  }
  const PixelRays rays(view);
  const SecondLook look(scene, std::span(pieces).first(front));
  runner.parallelFor(tasks.size(), [&](std::size_t i) {
    const Task& task = tasks[i];
    const bool isFirst = !task.piece->secondary && !task.reflects && front > 0;
    *task.out =
        StripPlanner(view, rays, *task.piece, *task.capture, task.strip, task.slot, isFirst ? &look : nullptr)
            .plan(task.reflects, task.mirrorsOnly);
    task.out->piece = task.piece, task.out->capture = task.capture;
  });
  return patches;
}

}  // namespace acentric
