#include "engine/measure/attribution.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/contract.h"
#include "engine/image/sharpen.h"
#include "engine/measure/compare.h"
#include "engine/measure/surface_steps.h"

namespace acentric {
namespace {

/// Says of each pixel which source it is laid to.
class Pixels {
 public:
  Pixels(const Frame& frame, const FloatImage& distance, const Image<std::uint8_t>& viewDependent)
      : frame_(frame), distance_(distance), viewDependent_(viewDependent) {}

  ErrorSource sourceOf(int x, int y) const {
    const PixelSource source = frame_.source.at(x, y);
    if (!isReal(source)) return ErrorSource::holes;
    if (anyNeighbour(x, y, [&](int nx, int ny, int step) { return !oneSurface(x, y, nx, ny, step); }))
      return ErrorSource::silhouettes;
    if (anyNeighbour(x, y, [&](int nx, int ny, int) {
          const PixelSource beside = frame_.source.at(nx, ny);
          return isReal(beside) && (source == kSourceLocal) != (beside == kSourceLocal);
        }))
      return ErrorSource::seams;
    if (viewDependent_.at(x, y) != 0) return ErrorSource::viewDependent;
    if (source == kSourceLocal) return ErrorSource::polygons;
    return std::isfinite(distance_.at(x, y)) ? ErrorSource::resampling : ErrorSource::background;
  }

 private:
  template <class Ask>
  bool anyNeighbour(int x, int y, const Ask& ask) const {
    return (x > 0 && ask(x - 1, y, 0)) || (y > 0 && ask(x, y - 1, 1)) ||
           (x + 1 < distance_.width && ask(x + 1, y, 0)) || (y + 1 < distance_.height && ask(x, y + 1, 1));
  }
  /// `step` 0: both lie in a row; 1: in a column.
  bool oneSurface(int x, int y, int nx, int ny, int step) const {
    const bool here = std::isfinite(distance_.at(x, y)), there = std::isfinite(distance_.at(nx, ny));
    if (!here || !there) return here == there;
    return step == 0 ? acentric::oneSurface(distance_, rowOf(distance_, y), std::size_t(std::min(x, nx)))
                     : acentric::oneSurface(distance_, columnOf(distance_, x), std::size_t(std::min(y, ny)));
  }

  const Frame& frame_;
  const FloatImage& distance_;
  const Image<std::uint8_t>& viewDependent_;
};

/// Of the places on one line, for a new place.
struct Weights {
  std::size_t first = 0;
  std::vector<float> weights;
};

/// Means of `count` equal stretches of a line of `length` pixels.
std::vector<Weights> meansOver(int length, int count) {
  std::vector<Weights> all(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double low = double(i) * length / count, high = double(i + 1) * length / count;
    Weights& w = all[std::size_t(i)];
    w.first = std::size_t(low);
    for (int p = int(low); p < std::min(length, int(std::ceil(high))); ++p)
      w.weights.push_back(float((std::min(high, p + 1.0) - std::max(low, double(p))) / (high - low)));
  }
  return all;
}

/// The pixels, linearly between the middles of such stretches.
std::vector<Weights> between(int length, int count) {
  std::vector<Weights> all(static_cast<std::size_t>(length));
  for (int p = 0; p < length; ++p) {
    const double at = std::clamp((p + 0.5) * count / length - 0.5, 0.0, double(count - 1));
    const int first = std::min(int(at), std::max(0, count - 2));
    Weights& w = all[std::size_t(p)];
    w.first = std::size_t(first);
    w.weights = {float(1 - (at - first)), float(at - first)};
    w.weights.resize(std::size_t(std::min(2, count - first)));
  }
  return all;
}

using Floats = Image<glm::vec3>;

Floats along(const Floats& picture, const std::vector<Weights>& columns, const std::vector<Weights>& rows) {
  Floats flat(int(columns.size()), picture.height), out(int(columns.size()), int(rows.size()));
  const auto sum = [](const Weights& w, const auto& at) {
    glm::vec3 total(0);
    for (std::size_t k = 0; k < w.weights.size(); ++k) total += w.weights[k] * at(int(w.first + k));
    return total;
  };
  for (int y = 0; y < flat.height; ++y)
    for (int x = 0; x < flat.width; ++x)
      flat.at(x, y) = sum(columns[std::size_t(x)], [&](int k) { return picture.at(k, y); });
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      out.at(x, y) = sum(rows[std::size_t(y)], [&](int k) { return flat.at(x, k); });
  return out;
}

/// By what each pixel differs from the four beside it.
Floats sharpened(const Floats& picture) {
  Floats out = picture;
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const glm::vec3 own = picture.at(x, y);
      for (const int step : {-1, 1})
        out.at(x, y) += kSharpening * (own - picture.at(std::clamp(x + step, 0, out.width - 1), y) + own -
                                       picture.at(x, std::clamp(y + step, 0, out.height - 1)));
      out.at(x, y) = glm::clamp(out.at(x, y), 0.0f, 255.0f);
    }
  return out;
}

}  // namespace

const char* nameOf(ErrorSource source) {
  constexpr std::array<const char*, kErrorSources> kNames{
      "holes", "silhouettes", "seams", "viewDependent", "polygons", "background", "resampling"};
  return kNames[std::size_t(source)];
}

const char* wordsFor(ErrorSource source) {
  constexpr std::array<const char*, kErrorSources> kWords{
      "holes, filled or not", "silhouettes",     "border of local polygons", "metals, mirrors, glass",
      "local polygons",       "sky, background", "captured surfaces"};
  return kWords[std::size_t(source)];
}

std::size_t Attribution::pixels() const {
  std::size_t sum = 0;
  for (const Part& part : parts) sum += part.pixels;
  return sum;
}

double Attribution::squares() const {
  double sum = 0;
  for (const Part& part : parts) sum += part.squares;
  return sum;
}

double Attribution::share(ErrorSource source) const {
  const double all = squares();
  return all > 0 ? of(source).squares / all : 0;
}

double Attribution::psnr() const { return psnrOfSquares(squares(), pixels()); }

double Attribution::psnrWithout(ErrorSource source) const {
  double rest = 0;
  for (std::size_t s = 0; s < kErrorSources; ++s)
    if (s != std::size_t(source)) rest += parts[s].squares;
  return psnrOfSquares(rest, pixels());
}

Attribution& Attribution::operator+=(const Attribution& other) {
  for (std::size_t s = 0; s < kErrorSources; ++s) {
    parts[s].pixels += other.parts[s].pixels;
    parts[s].squares += other.parts[s].squares;
  }
  return *this;
}

Attribution attribute(const Frame& frame, const ColourImage& truth, const FloatImage& truthDistance,
                      const Image<std::uint8_t>& viewDependent) {
  const auto fits = [&](const auto& image) {
    return image.width == truth.width && image.height == truth.height;
  };
  require(fits(frame.colour) && fits(frame.source) && fits(truthDistance) && fits(viewDependent),
          "pictures to compare are of one size");
  const Pixels pixels(frame, truthDistance, viewDependent);
  Attribution out;
  for (int y = 0; y < truth.height; ++y)
    for (int x = 0; x < truth.width; ++x) {
      const glm::dvec3 off = glm::dvec3(frame.colour.at(x, y)) - glm::dvec3(truth.at(x, y));
      Attribution::Part& part = out.parts[std::size_t(pixels.sourceOf(x, y))];
      ++part.pixels;
      part.squares += glm::dot(off, off);
    }
  return out;
}

ColourImage atSampleRate(const ColourImage& truth, double pixelsPerSample) {
  require(pixelsPerSample >= 1, "samples are at least a pixel apart");
  const int columns = std::max(1, int(std::lround(truth.width / pixelsPerSample)));
  const int rows = std::max(1, int(std::lround(truth.height / pixelsPerSample)));
  Floats picture(truth.width, truth.height);
  std::ranges::transform(truth.pixels, picture.pixels.begin(), [](const Rgba8& c) { return glm::vec3(c); });
  const Floats samples = along(picture, meansOver(truth.width, columns), meansOver(truth.height, rows));
  const Floats drawn = along(sharpened(samples), between(truth.width, columns), between(truth.height, rows));
  ColourImage out(truth.width, truth.height);
  std::ranges::transform(drawn.pixels, out.pixels.begin(),
                         [](const glm::vec3& c) { return Rgba8(glm::round(c), 255); });
  return out;
}

}  // namespace acentric
