#pragma once
/// Rays through the 4x4 parts of a capture's pixels (coverage bits: image/capture.h) that ask for the surface
/// of one sample alone, right around its plane, whatever lies before it: what hides it may move aside.

#include <array>
#include <span>
#include <vector>

#include "engine/bake/column_march.h"

namespace acentric {

inline constexpr int kPixelPartCount = kCoverageParts * kCoverageParts;
constexpr std::uint16_t partBit(int x, int y) { return std::uint16_t(1u << (kCoverageParts * y + x)); }

/// The parts of a pixel beside its neighbour in that direction.
std::uint16_t partsTowards(int acrossColumns, int acrossRows);
/// The part nearest to the middle of those that a mask has, which is not 0.
int middlePart(std::uint16_t parts);

/// Where the pixel's own ray meets a plane that a ray through one of its parts meets at `met`; if that is
/// elsewhere altogether, `met`. 1/m.
inline double ownInverseDistance(double own, double met) {
  return own > 0.5 * met && own < 2 * met ? own : met;
}

/// Directions of the parts of all pixels, and of the pixels' own rays.
class PartAngles {
 public:
  explicit PartAngles(const ColumnCamera& camera);

  struct Row {
    double cosine = 0, sine = 0;
  };
  /// A ray's direction: unit, in plan and up.
  struct Direction {
    glm::dvec2 plan{0};
    Row row;
    glm::dvec3 unit() const { return {plan * row.cosine, row.sine}; }
  };
  Direction through(int column, int row, int part) const;
  /// The pixel's own ray.
  Direction through(int column, int row) const;

 private:
  std::vector<glm::dvec2> columns_, ownColumns_;
  std::vector<Row> rows_, ownRows_;
};

/// On one thread.
class PartRays {
 public:
  /// `samples`: of the capture, or what mirrors show in it (`reflections`). All must outlive it.
  PartRays(const ColumnMarch::Setting& setting, const CaptureSamples& samples, bool reflections,
           double tolerance, CaptureCounts& counts);

  using Direction = PartAngles::Direction;

  /// Where the ray meets the sample's surface. What it meets nearer to another plane than to that of the
  /// sample belongs there.
  Hit meet(std::uint32_t sample, const Direction& direction, std::span<const SurfacePlane> rivals);
  /// How far what a sample covers may be off its plane, 1/m.
  double loose() const;
  /// What is met there as the sample shows it, textures averaged over a square so many samples wide; of what
  /// mirrors show as it is without their tint.
  Shaded shade(std::uint32_t sample, const Hit& hit, const Direction& direction, float width);

 private:
  /// Panes and their bars may lie in one plane.
  bool mayBe(bool opaque, const Hit& hit) const;
  const SurfacePlane& planeOf(std::uint32_t sample) const { return samples_.planes[samples_.plane[sample]]; }

  const ColumnMarch::Setting& setting_;
  const CaptureSamples& samples_;
  bool reflections_;
  double tolerance_;  ///< 1/m
  CaptureCounts& counts_;
  std::array<FlatMirror, 256> mirrors_{};  ///< by number, of reflections
};

}  // namespace acentric
