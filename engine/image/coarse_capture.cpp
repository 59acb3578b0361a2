#include "engine/image/coarse_capture.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/base/contract.h"
#include "engine/image/patches.h"
#include "engine/image/plane_numbers.h"

namespace acentric {
namespace {

/// Which of `all` columns or rows stands for each of `few`.
std::vector<std::size_t> middles(int all, int few) {
  std::vector<std::size_t> chosen;
  for (int k = 0; k < few; ++k) chosen.push_back(std::size_t((2LL * k + 1) * all / (2LL * few)));
  return chosen;
}

struct Raster {
  std::vector<std::size_t> columns, rows;  ///< of the capture, by those of the coarse one
};

CaptureSamples chosenSamples(const CaptureSamples& all, const Raster& raster) {
  CaptureSamples few;
  few.columnStart.push_back(0);
  for (const std::size_t column : raster.columns) {
    std::size_t i = all.columnStart[column];
    const std::size_t end = all.columnStart[column + 1];
    for (std::size_t row = 0; row < raster.rows.size(); ++row) {
      while (i < end && all.row[i] < raster.rows[row]) ++i;
      for (; i < end && all.row[i] == raster.rows[row]; ++i) {
        few.row.push_back(std::uint16_t(row));
        few.inverseDistance.push_back(all.inverseDistance[i]);
        few.colour.push_back(all.colour[i]);
        few.roles.push_back(all.roles[i]);
        if (!all.mirror.empty()) few.mirror.push_back(all.mirror[i]);
      }
    }
    few.columnStart.push_back(std::uint32_t(few.sampleCount()));
  }
  return few;
}

CaptureBackground chosenBackground(const CaptureBackground& all, const Raster& raster) {
  if (all.runCount() == 0) return {};
  BackgroundBuilder few;
  for (const std::size_t column : raster.columns) {
    std::size_t run = all.columnStart[column];
    const std::size_t end = all.columnStart[column + 1];
    for (std::size_t row = 0; row < raster.rows.size(); ++row) {
      while (run < end && all.endRow[run] <= raster.rows[row]) ++run;
      if (run < end && all.firstRow[run] <= raster.rows[row]) few.add(int(row), all.roles[run]);
    }
    few.closeColumn();
  }
  return std::move(few).finish(all.sky);
}

/// Of planes, times the factor: planes are most of what a coarse capture takes on disk, and nobody sees it
/// for long.
constexpr double kCoarseTolerance = 4;

/// Of one axis: which of `all` columns or rows each of `few` is made of, and which of them each of its
/// parts shows.
struct Blocks {
  std::vector<int> begin, end;
  std::vector<int> shown;  ///< by part, kCoverageParts of each

  Blocks(int all, int few) {
    for (int part = 0; part < kCoverageParts * few; ++part)
      shown.push_back(int((2LL * part + 1) * all / (2LL * kCoverageParts * few)));
    for (int k = 0; k < few; ++k) {
      begin.push_back(std::min(int(std::int64_t(k) * all / few), shown[std::size_t(kCoverageParts * k)]));
      end.push_back(std::max(int(std::int64_t(k + 1) * all / few),
                             shown[std::size_t(kCoverageParts * (k + 1) - 1)] + 1));
    }
  }
  /// One bit for each part of `coarse` that shows `fine`.
  std::uint32_t partsOf(int coarse, int fine) const {
    std::uint32_t parts = 0;
    for (int part = 0; part < kCoverageParts; ++part)
      if (shown[std::size_t(kCoverageParts * coarse + part)] == fine) parts |= 1u << part;
    return parts;
  }
};

/// One surface in one coarse pixel.
struct CoarseSurface {
  std::uint32_t plane = 0;
  std::uint8_t roles = 0, mirror = 0;
  bool blended = false;
  std::uint32_t parts = 0;
  int covered = 0, most = 0;  ///< parts of the samples' pixels, of all and of the one that gave its plane
  glm::vec4 colour{0};        ///< sums over these
  double inverse = 0;
  float stored = 0;  ///< of the capture's inverse distances
};

/// Surfaces of coarse pixels, one after the other.
class SurfaceGatherer {
 public:
  SurfaceGatherer(const ColumnCamera& fine, const CaptureSamples& all, const ColumnCamera& coarse,
                  double tolerance, double step, CaptureSamples& few)
      : all_(all),
        coarse_(coarse),
        tolerance_(tolerance),
        step_(step),
        pixels_(all, fine.rows, 0, fine.columns),
        across_(fine.columns, coarse.columns),
        down_(fine.rows, coarse.rows),
        few_(few) {}

  void gather() {
    few_.columnStart.push_back(0);
    for (int column = 0; column < coarse_.columns; ++column) {
      for (int row = 0; row < coarse_.rows; ++row) gatherPixel(column, row);
      std::swap(beside_, column_);
      column_.clear();
      few_.columnStart.push_back(std::uint32_t(few_.sampleCount()));
    }
    few_.planes = all_.planes;
  }

 private:
  /// A sample that covers so much of its pixel shows in the parts that the pixel gives its coarse one.
  static constexpr int kMostlyCovered = 8;

  void gatherPixel(int column, int row) {
    surfaces_.clear();
    for (int x = across_.begin[std::size_t(column)]; x < across_.end[std::size_t(column)]; ++x)
      for (int y = down_.begin[std::size_t(row)]; y < down_.end[std::size_t(row)]; ++y) {
        std::uint32_t parts = 0;
        const std::uint32_t columns = across_.partsOf(column, x), rows = down_.partsOf(row, y);
        for (int part = 0; part < kCoverageParts; ++part)
          if ((rows >> part & 1) != 0) parts |= columns << (kCoverageParts * part);
        addPixel(column, row, x, y, parts);
      }
    std::erase_if(surfaces_, [](const CoarseSurface& surface) { return surface.parts == 0; });
    column_.emplace_back();
    for (CoarseSurface& surface : surfaces_) {
      surface.plane = planeBeside(surface.plane, column, row);
      column_.back().push_back(surface.plane);
      surface.stored = storedInverseDistance(inverseOf(surface, column, row), step_);
    }
    std::ranges::sort(surfaces_, std::ranges::greater(), &CoarseSurface::stored);
    for (const CoarseSurface& surface : surfaces_) put(surface, row);
  }

  /// Where its plane is, or else the mean of what it is made of.
  double inverseOf(const CoarseSurface& surface, int column, int row) const {
    const double onPlane = all_.planes[surface.plane].inverseDistance(coarse_.directionAt(column + 0.5),
                                                                      coarse_.tangentAt(row + 0.5));
    return onPlane > 0 && surface.inverse > 0 ? onPlane : surface.inverse / surface.covered;
  }

  /// The plane with which a surface goes on in the pixel above or in the column before; else its own.
  std::uint32_t planeBeside(std::uint32_t own, int column, int row) const {
    const auto find = [&](const std::vector<std::uint32_t>& planes) {
      const auto found = std::ranges::find_if(planes, [&](std::uint32_t plane) {
        return areOne(all_.planes[plane], all_.planes[own], column, row);
      });
      return found == planes.end() ? own : *found;
    };
    if (row > 0)
      if (const std::uint32_t above = find(column_[std::size_t(row) - 1]); above != own) return above;
    return column > 0 ? find(beside_[std::size_t(row)]) : own;
  }

  /// `parts` of the coarse pixel show this one.
  void addPixel(int column, int row, int x, int y, std::uint32_t parts) {
    std::size_t most = 0;  // of those that cover little
    int mostCovered = 0;
    for (const std::uint32_t sample : pixels_.at(x, y)) {
      const int covered = std::popcount(all_.coverage[sample]);
      CoarseSurface& surface = surfaceOf(sample, column, row);
      surface.roles |= all_.roles[sample];
      surface.colour += float(covered) * unpackColour(all_.colour[sample]);
      surface.inverse += covered * double(all_.inverseDistance[sample]);
      surface.covered += covered;
      if (covered > surface.most) surface.most = covered, surface.plane = all_.plane[sample];
      if (covered >= kMostlyCovered) surface.parts |= parts, mostCovered = kMostlyCovered;
      if (covered > mostCovered) most = std::size_t(&surface - surfaces_.data()), mostCovered = covered;
    }
    if (mostCovered > 0 && mostCovered < kMostlyCovered) surfaces_[most].parts |= parts;
  }

  CoarseSurface& surfaceOf(std::uint32_t sample, int column, int row) {
    const std::uint8_t mirror = all_.mirror.empty() ? std::uint8_t(0) : all_.mirror[sample];
    const bool blended = floatFromHalf(all_.colour[sample].a) < 1;
    for (CoarseSurface& surface : surfaces_)
      if (surface.mirror == mirror && surface.blended == blended &&
          (surface.roles & all_.roles[sample]) != 0 &&
          areOne(all_.planes[surface.plane], all_.planes[all_.plane[sample]], column, row))
        return surface;
    return surfaces_.emplace_back(
        CoarseSurface{all_.plane[sample], all_.roles[sample], mirror, blended, 0, 0, 0, glm::vec4(0), 0, 0});
  }

  /// At the pixel's corners.
  bool areOne(const SurfacePlane& a, const SurfacePlane& b, int column, int row) const {
    if (a == b) return true;
    if (a.away != b.away) return false;
    for (const int right : {0, 1})
      for (const int below : {0, 1}) {
        const glm::dvec2 direction = coarse_.directionAt(column + right);
        const double tangent = coarse_.tangentAt(row + below);
        if (std::abs(a.inverseDistance(direction, tangent) - b.inverseDistance(direction, tangent)) >
            tolerance_)
          return false;
      }
    return true;
  }

  void put(const CoarseSurface& surface, int row) {
    glm::vec4 colour = surface.colour / float(surface.covered);
    if (!surface.blended) colour.a = 1;
    few_.row.push_back(std::uint16_t(row));
    few_.inverseDistance.push_back(surface.stored);
    few_.colour.push_back(packColour(colour));
    few_.roles.push_back(surface.roles);
    if (!all_.mirror.empty()) few_.mirror.push_back(surface.mirror);
    few_.coverage.push_back(std::uint16_t(surface.parts));
    few_.plane.push_back(surface.plane);
  }

  const CaptureSamples& all_;
  const ColumnCamera& coarse_;
  double tolerance_, step_;
  PixelSamples pixels_;
  Blocks across_, down_;
  CaptureSamples& few_;
  std::vector<CoarseSurface> surfaces_;                      ///< of the pixel
  std::vector<std::vector<std::uint32_t>> column_, beside_;  ///< planes of the column's pixels, of the last's
};

/// Only those that samples lie on, in the order of the first of them.
void keepUsedPlanes(CaptureSamples& samples) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> number(samples.planes.size(), kUnused);
  std::vector<SurfacePlane> used;
  for (std::uint32_t& plane : samples.plane) {
    if (number[plane] == kUnused) {
      number[plane] = std::uint32_t(used.size());
      used.push_back(samples.planes[plane]);
    }
    plane = number[plane];
  }
  samples.planes = std::move(used);
}

CaptureSamples coarseSamples(const Capture& capture, const CaptureSamples& all, const Capture& coarse,
                             const Raster& raster) {
  if (!all.hasSilhouettes()) return chosenSamples(all, raster);
  CaptureSamples few;
  SurfaceGatherer(capture.camera, all, coarse.camera, coarse.planeTolerance, coarse.distanceStep, few)
      .gather();
  keepUsedPlanes(few);
  roundPlanes(few, coarse.camera, coarse.distanceStep);
  return few;
}

}  // namespace

Capture coarsened(const Capture& capture, int factor) {
  require(factor >= 1, "a capture is made coarser, not finer");
  if (factor == 1) return capture;
  Capture coarse;
  coarse.camera = capture.camera;
  coarse.camera.columns = (capture.camera.columns + factor - 1) / factor;
  coarse.camera.rows = (capture.camera.rows + factor - 1) / factor;
  coarse.distanceStep = capture.distanceStep * std::bit_floor(unsigned(factor));
  coarse.planeTolerance = kCoarseTolerance * factor * capture.planeTolerance;
  coarse.shown = capture.shown;
  const Raster raster{middles(capture.camera.columns, coarse.camera.columns),
                      middles(capture.camera.rows, coarse.camera.rows)};
  static_cast<CaptureSamples&>(coarse) = coarseSamples(capture, capture, coarse, raster);
  coarse.background = chosenBackground(capture.background, raster);
  if (capture.hasReflections())
    coarse.reflections = coarseSamples(capture, capture.reflections, coarse, raster);
  if (!coarse.hasReflections()) {
    coarse.reflections = {};
    coarse.mirror.clear();
  }
  if (!coarse.hasSilhouettes() && !coarse.reflections.hasSilhouettes()) coarse.planeTolerance = 0;
  return coarse;
}

}  // namespace acentric
