#include "engine/view/captured_background.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/view/background.h"
#include "engine/view/warp.h"

namespace acentric {
namespace {

/// A value that grows evenly down a column of the picture: at the centre of pixel y it is start + y * rise.
struct Ramp {
  double start = 0;
  double rise = 0;
  double at(int y) const { return start + y * rise; }
};

/// Pixels [first, end) of a column of the picture.
struct Pixels {
  int first = 0;
  int end = 0;
  bool empty() const { return first >= end; }

  /// Those where the ramp is >= 0. Together with `keepNegative` of the same ramp all of them, each once.
  void keepNotNegative(const Ramp& ramp) { keep(ramp, false); }
  void keepNegative(const Ramp& ramp) { keep(ramp, true); }

 private:
  void keep(const Ramp& ramp, bool negative) {
    if (ramp.rise == 0) {
      if ((ramp.start < 0) != negative) end = first;
      return;
    }
    const double zero = -ramp.start / ramp.rise;
    // The first pixel behind the change of sign; 0 itself counts as not negative.
    const double changed = std::clamp(ramp.rise > 0 ? std::ceil(zero) : std::floor(zero) + 1,
                                      static_cast<double>(first), static_cast<double>(end));
    ((ramp.rise > 0) == negative ? end : first) = static_cast<int>(changed);
  }
};

/// One column of the picture: directions along it run on a straight line.
class PictureColumn {
 public:
  PictureColumn(const PerspectiveView& view, int x, CanvasPixel* pixels)
      : first_(directionThrough(view, x + 0.5, 0.5)),
        step_(directionThrough(view, x + 0.5, 1.5) - first_),
        height_(view.height),
        pixels_(pixels) {}

  void paint(const PieceDraw& piece, const DisplayCapture& capture, const SkyTable& sky,
             std::uint32_t slot) const {
    for (const ColumnRun& run : piece.runs) {
      if (!piece.clipToPart) {
        paintRun(piece, capture, run, sky, slot, {0, height_});
        continue;
      }
      const AzimuthRange& part = piece.part.azimuths;
      const Ramp fromLow = leftOf(directionOf(part.low)),
                 fromHigh = leftOf(directionOf(part.low + part.width));
      Pixels within{0, height_};
      within.keepNotNegative(fromLow);
      if (part.width <= kPi) {
        within.keepNegative(fromHigh);
        paintRun(piece, capture, run, sky, slot, within);
      } else {  // left of the low border, and besides right of the high one
        Pixels others{0, height_};
        others.keepNegative(fromLow);
        others.keepNegative(fromHigh);
        paintRun(piece, capture, run, sky, slot, within);
        paintRun(piece, capture, run, sky, slot, others);
      }
    }
  }

 private:
  Ramp leftOf(const glm::dvec2& border) const {
    return {cross(border, glm::dvec2(first_)), cross(border, glm::dvec2(step_))};
  }

  /// Through the capture's columns in the order in which they lie along this column of the picture.
  void paintRun(const PieceDraw& piece, const DisplayCapture& capture, const ColumnRun& run,
                const SkyTable& sky, std::uint32_t slot, Pixels pixels) const {
    const auto& border = capture.background.columnBorder;
    const auto leftOfBorder = [&](int k) { return leftOf(border[static_cast<std::size_t>(k)]); };
    pixels.keepNotNegative(leftOfBorder(run.first));
    pixels.keepNegative(leftOfBorder(run.last));
    if (pixels.empty()) return;
    const auto isRight = [&](const glm::dvec2& b) {
      return cross(b, glm::dvec2(first_) + double(pixels.first) * glm::dvec2(step_)) >= 0;
    };
    const auto begin = border.begin() + run.first;
    const auto next = std::partition_point(begin, border.begin() + run.last, isRight) - border.begin();
    int k = std::clamp(int(next) - 1, run.first, run.last - 1);
    const double turn = cross(glm::dvec2(first_), glm::dvec2(step_));  // > 0: counter-clockwise
    for (; !pixels.empty() && k >= run.first && k<run.last; k += turn> 0 ? 1 : -1) {
      Pixels own = pixels;
      if (turn > 0) own.keepNegative(leftOfBorder(k + 1));
      if (turn < 0) own.keepNotNegative(leftOfBorder(k));
      if (own.empty()) continue;
      paintColumn(piece, capture, static_cast<std::size_t>(k), sky, slot, own);
      pixels.first = own.end;
    }
  }

  void paintColumn(const PieceDraw& piece, const DisplayCapture& capture, std::size_t k, const SkyTable& sky,
                   std::uint32_t slot, const Pixels& pixels) const {
    const DisplayBackground& background = capture.background;
    const CaptureBackground& runs = background.runs;
    const glm::dvec2 along(capture.columnDirection[k]);
    const Ramp flat{glm::dot(along, glm::dvec2(first_)), glm::dot(along, glm::dvec2(step_))};
    const auto above = [&](std::size_t row) {
      const double tangent = background.rowBorder[row];
      return Ramp{first_.z - tangent * flat.start, step_.z - tangent * flat.rise};
    };
    for (std::size_t run = runs.columnStart[k]; run < runs.columnStart[k + 1]; ++run) {
      if ((runs.roles[run] & piece.roles) == 0) continue;
      Pixels seen = pixels;
      seen.keepNegative(above(runs.firstRow[run]));
      seen.keepNotNegative(above(runs.endRow[run]));
      fill(seen, sky, slot);
    }
  }

  void fill(const Pixels& pixels, const SkyTable& sky, std::uint32_t slot) const {
    const glm::vec3 first(first_), step(step_);
    for (int y = pixels.first; y < pixels.end; ++y) {
      const glm::vec3 d = first + static_cast<float>(y) * step;
      pixels_[y] = canvasPixel(sky.towards(d) | slot << 24, 0);
    }
  }

  glm::dvec3 first_, step_;
  int height_;
  CanvasPixel* pixels_;
};

}  // namespace

CapturedBackground::CapturedBackground(const WalkScene& scene, const ViewPlan& plan)
    : scene_(scene), plan_(plan) {
  for (const PieceDraw& piece : plan.backgrounds) {
    const Sky& sky = captureOf(piece).background.runs.sky;
    const auto found = std::ranges::find(skies_, sky, &SkyTable::sky);
    skyOf_.push_back(static_cast<std::size_t>(found - skies_.begin()));
    if (found == skies_.end()) skies_.emplace_back(sky, scene.exposure);
  }
}

const DisplayCapture& CapturedBackground::captureOf(const PieceDraw& piece) const {
  return *scene_.captures[static_cast<std::size_t>(piece.camera)];
}

void CapturedBackground::paint(const PerspectiveView& view, Canvas& canvas) const {
  if (plan_.backgrounds.empty()) return;
  for (int x = canvas.x0; x < canvas.x0 + canvas.width; ++x) {
    const PictureColumn column(view, x, canvas.column(x));
    for (std::size_t i = 0; i < plan_.backgrounds.size(); ++i)
      column.paint(plan_.backgrounds[i], captureOf(plan_.backgrounds[i]), skies_[skyOf_[i]],
                   capturedBackgroundSlot(i));
  }
}

}  // namespace acentric
