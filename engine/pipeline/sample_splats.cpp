#include "engine/pipeline/sample_splats.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/geometry/conventions.h"
#include "engine/view/slant.h"
#include "engine/view/warp.h"

namespace acentric {
namespace {

/// Samples so many times nearer to the camera, or farther, than a point are of other surfaces.
constexpr double kFarFromPoint = 1.4;
/// Of a picture that is much coarser than the captures, the samples next to the middle of a pixel are enough.
constexpr double kMostAround = 4;

}  // namespace

/// The samples of a piece's camera around one point, by pixel of the capture; each is traced when it is asked
/// for first.
class SampleSplats::Around {
 public:
  Around(const CaptureReach& reach, const Piece& piece, const glm::dvec3& point)
      : reach_(reach),
        piece_(piece),
        columns_(reach.columns(piece.camera)),
        distance_(glm::distance(point, columns_.centreOfProjection)) {
    const glm::dvec3 offset = point - columns_.centreOfProjection;
    const double middle = columns_.azimuthAt(0.5 * columns_.columns);
    const double turn = std::remainder(std::atan2(offset.y, offset.x) - middle, kTwoPi);
    const double elevation = std::atan2(offset.z, glm::length(glm::dvec2(offset)));
    own_ = {int(std::floor(0.5 * columns_.columns + turn / columns_.columnPitch())),
            int(std::floor((columns_.topElevation - elevation) / columns_.rowPitch()))};
  }

  /// The pixel in which the camera sees the point: column and row, which need not be one of its own.
  const glm::ivec2& own() const { return own_; }

  struct Sample {
    double distance = 0;    ///< metres from the camera
    double horizontal = 0;  ///< the same in the plan
    glm::dvec3 point{0};
    bool drawn = false;  ///< by the piece
  };
  /// Nearest first.
  const std::vector<Sample>& at(const glm::ivec2& pixel) {
    const auto [found, isNew] = traced_.try_emplace({pixel.x, pixel.y});
    if (isNew) found->second = trace(pixel);
    return found->second;
  }

  /// Of at(pixel)[index], as renderers find it from the samples beside it.
  Slant slantOf(const glm::ivec2& pixel, std::size_t index) {
    std::vector<std::uint32_t> columnStart{0};
    std::vector<std::uint16_t> row;
    std::vector<float> inverseDistance;
    std::size_t wanted = 0;
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        if (x == 0 && y == 0) wanted = row.size() + index;
        for (const Sample& sample : at(pixel + glm::ivec2(x, y))) {
          row.push_back(std::uint16_t(y + 1));
          inverseDistance.push_back(float(1 / sample.horizontal));
        }
      }
      columnStart.push_back(std::uint32_t(row.size()));
    }
    return slantsOf(columns_, columnStart, row, inverseDistance)[wanted];
  }

 private:
  std::vector<Sample> trace(const glm::ivec2& pixel) const {
    if (pixel.x < 0 || pixel.x >= columns_.columns || pixel.y < 0 || pixel.y >= columns_.rows) return {};
    const glm::dvec3 direction =
        glm::normalize(glm::dvec3(columns_.directionAt(pixel.x + 0.5), columns_.tangentAt(pixel.y + 0.5)));
    std::vector<Sample> samples;
    for (const OpaqueHit& hit : reach_.samplesAlong(piece_.camera, direction, distance_ / kFarFromPoint,
                                                    distance_ * kFarFromPoint, piece_.role)) {
      const glm::dvec3 point = columns_.centreOfProjection + hit.distance * direction;
      samples.push_back({hit.distance, hit.distance * glm::length(glm::dvec2(direction)), point,
                         piece_.holds(glm::dvec2(point))});
    }
    return samples;
  }

  const CaptureReach& reach_;
  const Piece& piece_;
  const ColumnCamera& columns_;
  double distance_;
  glm::ivec2 own_{0};
  std::map<std::pair<int, int>, std::vector<Sample>> traced_;
};

SampleSplats::SampleSplats(const CaptureReach& reach, const PerspectiveView& view,
                           const ViewSettings& settings)
    : reach_(reach),
      eye_(view.eye),
      viewFromWorld_(view.viewFromWorld()),
      focal_(view.focalPixels()),
      followsSlant_(acentric::followsSlant(settings.reconstruction)),
      factor_(settings.reconstruction == Reconstruction::point ? 0
              : followsSlant_                                  ? kOverlap
                                                               : kSlantAllowance),
      maxPixels_(settings.maxSplatPixels) {}

bool SampleSplats::Splat::covers(const glm::dvec2& place) const {
  return std::abs(place.x - centre.x) <= half.x && std::abs(place.y - centre.y) <= half.y;
}

/// As large as the sample's share of a surface that faces the camera.
SampleSplats::Splat SampleSplats::square(const ColumnCamera& camera, const glm::dvec3& point) const {
  const glm::dvec3 q = viewFromWorld_ * (point - eye_);
  if (!(q.z > 0)) return {};
  const double share =
      std::max(camera.columnPitch(), camera.rowPitch()) * glm::distance(point, camera.centreOfProjection);
  const double side = factor_ * share * focal_ * glm::length(q) / (q.z * q.z);
  return {focal_ / q.z * glm::dvec2(q), glm::dvec2(0.5 * std::ceil(std::clamp(side, 1.0, maxPixels_)))};
}

SampleSplats::Splat SampleSplats::rectangle(const ColumnCamera& camera, const glm::dvec3& point,
                                            const Slant& slant) const {
  const glm::dvec3 q = viewFromWorld_ * (point - eye_);
  if (!(q.z > 0)) return {};
  const glm::dvec3 offset = point - camera.centreOfProjection;
  const double horizontal = glm::length(glm::dvec2(offset));
  // From the sample to its neighbour in the next column or row.
  const auto onPicture = [&](const glm::dvec3& turn, double pitch, std::int8_t code) {
    const glm::dvec3 d = viewFromWorld_ * (pitch * (turn - slantTangent(code) * offset));
    return glm::abs(focal_ / q.z * glm::dvec2(d.x - q.x / q.z * d.z, d.y - q.y / q.z * d.z));
  };
  const glm::dvec3 across(-offset.y, offset.x, 0), down(0, 0, -glm::dot(offset, offset) / horizontal);
  const glm::dvec2 sides =
      onPicture(across, camera.columnPitch(), slant.across) + onPicture(down, camera.rowPitch(), slant.down);
  return {focal_ / q.z * glm::dvec2(q), glm::clamp(0.5 * factor_ * sides, 0.5, 0.5 * maxPixels_)};
}

/// So many samples away there may be one whose splat covers a point.
int SampleSplats::samplesAround(const ColumnCamera& camera, const glm::dvec3& point) const {
  const double pixel = glm::length(point - eye_) / focal_;
  const double spacing =
      std::min(camera.columnPitch(), camera.rowPitch()) * glm::distance(point, camera.centreOfProjection);
  return int(std::clamp(std::ceil(0.5 + 0.5 * pixel / spacing), 1.0, kMostAround));
}

bool SampleSplats::cover(const Piece& piece, const glm::dvec3& point, const glm::dvec2& place) const {
  const ColumnCamera& camera = reach_.columns(piece.camera);
  if (glm::dvec2(point) == glm::dvec2(camera.centreOfProjection)) return false;
  Around around(reach_, piece, point);
  const int most = samplesAround(camera, point);
  const auto any = [&](const auto& covers) {
    for (int x = -most; x <= most; ++x)
      for (int y = -most; y <= most; ++y) {
        const glm::ivec2 pixel = around.own() + glm::ivec2(x, y);
        const auto& samples = around.at(pixel);
        for (std::size_t i = 0; i < samples.size(); ++i)
          if (samples[i].drawn && covers(pixel, i, samples[i])) return true;
      }
    return false;
  };
  if (!followsSlant_)
    return any([&](const glm::ivec2&, std::size_t, const Around::Sample& sample) {
      return square(camera, sample.point).covers(place);
    });
  // Whatever its slant, a splat covers what is half a pixel away. Most pixels have such a sample, and slants
  // are dear.
  const auto smallest = [&](const Around::Sample& sample) {
    const glm::dvec3 q = viewFromWorld_ * (sample.point - eye_);
    return q.z > 0 && Splat{focal_ / q.z * glm::dvec2(q), glm::dvec2(0.5)}.covers(place);
  };
  for (const Around::Sample& sample : around.at(around.own()))
    if (sample.drawn && smallest(sample)) return true;
  return any([&](const glm::ivec2&, std::size_t, const Around::Sample& sample) {
           return smallest(sample);
         }) ||
         any([&](const glm::ivec2& pixel, std::size_t index, const Around::Sample& sample) {
           return rectangle(camera, sample.point, around.slantOf(pixel, index)).covers(place);
         });
}

}  // namespace acentric
