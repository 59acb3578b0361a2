#pragma once
/// Which patches a frame draws, and where: set up once, then painted on every strip of the picture.
///
/// The order is front to back (apv.md section 2, read from its end): pieces of the plan from the nearest to
/// the farthest; of each capture strips of columns from the epipole outwards; of each strip patches in the
/// order that holds for every eye.

#include <array>
#include <climits>
#include <memory>
#include <vector>

#include "engine/base/task_runner.h"
#include "engine/view/patch_kernel.h"
#include "engine/view/view_plan.h"

namespace acentric {

struct RowRange {
  int first = 0, end = 0;
};

/// A convex polygon on the picture, as the rows that it touches in each column.
class PolygonRows {
 public:
  static constexpr std::size_t kMostCorners = 9;  ///< eight, and one more where the eye's plane cuts some off

  /// Corners in homogeneous pixels. False where it misses the picture.
  bool set(std::span<const glm::dvec3> corners, int width, int height);
  int x0() const { return x0_; }
  int x1() const { return x1_; }
  int y0() const { return y0_; }
  int y1() const { return y1_; }
  /// Rows that the polygon may touch in each of the columns [first, end), which lie in [x0, x1).
  void rows(int first, int end, std::vector<RowRange>& out) const;

 private:
  int x0_ = 0, x1_ = 0, y0_ = 0, y1_ = 0;
  int count_ = 0;
  std::array<glm::vec2, kMostCorners> places_;
};

struct PatchDraw {
  PatchColumn column;  ///< what is the same for all columns; places are those of column 0
  PolygonRows polygon;
  std::uint32_t firstTexel = 0;  ///< DisplayPatch::firstTexel
};

/// What the patches of one piece and strip have in common.
struct StripDraw {
  const PieceDraw* piece = nullptr;               ///< of the plan
  std::shared_ptr<const DisplayCapture> capture;  ///< its camera's, or what the mirrors there show
  std::vector<PatchDraw> patches;                 ///< front to back
  int x0 = INT_MAX, x1 = 0;                       ///< columns of the picture that they may touch
  bool limited = false;  ///< PatchColumn::limited: then the borders' values at column 0, and per column
  float lowStart = 0, lowAcross = 0, highStart = 0, highAcross = 0;
};

struct PatchPlan {
  std::vector<StripDraw> surfaces;     ///< of the first cover, front to back
  std::vector<StripDraw> behind;       ///< of the second
  std::uint32_t frontSlot = 0;         ///< the least of the first cover's pieces
  std::vector<StripDraw> reflections;  ///< what mirrors show
  std::vector<StripDraw> mirrors;      ///< the mirrors themselves, where nothing is known of what they show
};

/// Of captures that have patches. Valid as long as the plan is.
PatchPlan planPatches(const WalkScene& scene, const PerspectiveView& view, const ViewPlan& plan,
                      TaskRunner& runner);

}  // namespace acentric
