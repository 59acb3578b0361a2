#include "engine/measure/seams.h"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.h"
#include "engine/measure/compare.h"
#include "engine/measure/surface_steps.h"

namespace acentric {
namespace {

template <class A, class B>
bool sameSize(const Image<A>& a, const Image<B>& b) {
  return a.width == b.width && a.height == b.height;
}

double rms(const glm::vec3& difference) { return std::sqrt(double(glm::dot(difference, difference)) / 3); }
double difference(const Rgba8& a, const Rgba8& b) { return rms(glm::vec3(a) - glm::vec3(b)); }

bool isCaptured(PixelSource source) { return isReal(source) && source != kSourceLocal; }

class Seams {
 public:
  Seams(const Frame& frame, const ColourImage& truth, const FloatImage& distance)
      : frame_(frame), truth_(truth), distance_(distance) {}

  SeamSums run() {
    for (int y = 0; y < truth_.height; ++y) walk(rowOf(distance_, y));
    for (int x = 0; x < truth_.width; ++x) walk(columnOf(distance_, x));
    return sums_;
  }

 private:
  void walk(const PixelLine& line) {
    for (std::size_t i = 0; i + 1 < line.length; ++i) {
      const std::size_t a = line.at(i), b = line.at(i + 1);
      const PixelSource from = frame_.source.pixels[a], to = frame_.source.pixels[b];
      if (!isReal(from) || !isReal(to) || !std::isfinite(distance_.pixels[a]) ||
          !std::isfinite(distance_.pixels[b]))
        continue;
      const bool border =
          (from == kSourceLocal && isCaptured(to)) || (isCaptured(from) && to == kSourceLocal);
      if (!border && from != to) continue;
      if (!oneSurface(distance_, line, i)) {
        sums_.silhouettes += border ? 1 : 0;
        continue;
      }
      const Rgba8 *const picture = frame_.colour.pixels.data(), *const truth = truth_.pixels.data();
      const double excess =
          std::max(0.0, difference(picture[a], picture[b]) - difference(truth[a], truth[b]));
      (border ? sums_.across : sums_.within).add(excess);
      if (!border) continue;
      const std::size_t local = from == kSourceLocal ? a : b, captured = from == kSourceLocal ? b : a;
      const double localError = difference(picture[local], truth[local]);
      const double capturedError = difference(picture[captured], truth[captured]);
      sums_.localSquares += localError * localError;
      sums_.capturedSquares += capturedError * capturedError;
    }
  }

  const Frame& frame_;
  const ColourImage& truth_;
  const FloatImage& distance_;
  SeamSums sums_;
};

}  // namespace

void StepSums::add(double pairExcess) {
  ++pairs;
  excess += pairExcess;
  visible += pairExcess >= kVisibleStep ? 1 : 0;
}

StepSums& StepSums::operator+=(const StepSums& other) {
  pairs += other.pairs, excess += other.excess, visible += other.visible;
  return *this;
}

double SeamSums::localError() const {
  return across.pairs == 0 ? 0 : std::sqrt(localSquares / double(across.pairs));
}
double SeamSums::capturedError() const {
  return across.pairs == 0 ? 0 : std::sqrt(capturedSquares / double(across.pairs));
}

SeamSums& SeamSums::operator+=(const SeamSums& other) {
  across += other.across, within += other.within;
  silhouettes += other.silhouettes;
  localSquares += other.localSquares, capturedSquares += other.capturedSquares;
  return *this;
}

SeamSums measureSeam(const Frame& frame, const ColourImage& truth, const FloatImage& truthDistance) {
  require(sameSize(frame.colour, truth) && sameSize(frame.source, truth) && sameSize(truthDistance, truth),
          "a frame and a truth of one size are compared");
  return Seams(frame, truth, truthDistance).run();
}

Change changeBetween(const ColourImage& before, const ColourImage& after) {
  require(sameSize(before, after), "pictures of one size are compared");
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.pixels.size(); ++i)
    changed += difference(before.pixels[i], after.pixels[i]) >= kVisibleStep ? 1 : 0;
  return {psnrOf(before, after), ssimOf(before, after),
          before.empty() ? 0 : double(changed) / double(before.pixels.size())};
}

}  // namespace acentric
