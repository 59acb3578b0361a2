#pragma once
/// A capture's samples as patches: neighbouring samples of one plane. Renderers draw a patch as one textured
/// polygon, so that what they do for a pixel does not depend on how many samples are near it.
///
/// The capture is cut into strips of columns, and these into tiles; a patch lies in one tile and has at most
/// one sample of each pixel. Strips are drawn in list order, as columns are. The patches of one strip are
/// ordered here, once for all eyes that the camera serves: a patch that may hide another comes before it.
/// That can be known beforehand because an eye lies on a known side of every plane that it sees
/// (SurfacePlane::away) and near the camera: patch_extent.h tells which may hide which, patch_order.h what
/// follows.

#include <ranges>

#include "engine/image/capture.h"

namespace acentric {

struct Patch {
  SurfacePlane plane;
  std::uint16_t column = 0, row = 0;    ///< its first
  std::uint16_t columns = 0, rows = 0;  ///< that its samples lie in
  std::uint8_t roles = 0;               ///< that need any of its samples
  std::uint8_t mirror = 0;              ///< of all its samples
  bool blended = false;                 ///< are they?
  std::uint32_t firstSample = 0;        ///< into Patches::samples
};

struct Patches {
  int stripColumns = 0;                   ///< of all strips, but for the last, which may have fewer
  std::vector<std::uint32_t> stripStart;  ///< strips + 1 offsets into `patches`
  std::vector<Patch> patches;             ///< of a strip: those that may hide others first
  std::vector<std::uint32_t> samples;     ///< of the capture, patch after patch
  std::size_t unordered = 0;              ///< pairs that may hide each other: their order is a guess

  std::size_t strips() const { return stripStart.empty() ? 0 : stripStart.size() - 1; }
  /// Of `samples`, one after the patch's last.
  std::uint32_t endOf(std::size_t patch) const {
    return patch + 1 < patches.size() ? patches[patch + 1].firstSample : std::uint32_t(samples.size());
  }
};

/// Of samples that have planes. Planes whose inverse distances differ by no more than `tolerance` (1/m) where
/// a sample lies are one there.
Patches makePatches(const ColumnCamera& camera, const CaptureSamples& samples, double tolerance);

/// Where the samples of each pixel of some columns lie in their list.
class PixelSamples {
 public:
  PixelSamples(const CaptureSamples& samples, int rows, int firstColumn, int endColumn);
  bool holds(int column, int row) const {
    return column >= firstColumn_ && column < endColumn_ && row >= 0 && row < rows_;
  }
  /// Nearest first.
  auto at(int column, int row) const {
    const std::size_t pixel = std::size_t(column - firstColumn_) * std::size_t(rows_) + std::size_t(row);
    return std::views::iota(first_[pixel], first_[pixel + 1]);
  }

 private:
  int rows_, firstColumn_, endColumn_;
  std::vector<std::uint32_t> first_;
};

}  // namespace acentric
