#pragma once
/// A capture's opaque samples as an adaptive mesh: rectangles of samples (patches) that lie on one plane.
///
/// A plane is linear in inverse distance: w = n.(c + t z) / d for column direction c and row tangent t
/// (apv.md section 2). So a patch is a plane quadrilateral, two triangles, and what it says of every pixel of
/// the capture is exact. It is as large as all its samples lie within a bound of that plane, whatever
/// surface they are of; where nothing else fits a patch is one sample, turned as its slant says.
///
/// The bound. Seen from an eye at b = P - E a sample lies in direction q = c + t z + w b, and covers
/// pitch / |q|. Wrong by dw, it is shifted by at most dw |b| / |q|, which is dw |b| / pitch samples, wherever
/// it is: one bound on the inverse distance, error * pitch / reach, holds the shift below `error` samples
/// for every eye within `reach` of the camera.
///
/// Neighbouring patches may disagree by twice the bound. So patches reach beyond their samples: by
/// kOpenFringe, and where the surface goes on by as much more as the sample beside is off their plane. Who
/// draws patches cuts them off at each sample's own fringe, and lets the samples that a fringe covers win
/// over it.

#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "engine/base/large_vector.h"
#include "engine/base/task_runner.h"
#include "engine/geometry/column_camera.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// Beyond a side where the surface ends; half of what splats reach beyond their samples.
inline constexpr double kOpenFringe = 0.05;

/// Where the two bits of a side's fringe lie, 0..kMostFringe.
enum MeshSide { kLowColumn = 0, kHighColumn = 2, kTopRow = 4, kBottomRow = 6 };
inline constexpr MeshSide kMeshSides[] = {kLowColumn, kHighColumn, kTopRow, kBottomRow};
inline constexpr int kMostFringe = 3;

struct MeshPatch {
  std::uint16_t column = 0, row = 0;     ///< the first of its samples
  std::uint8_t columns = 0, rows = 0;    ///< of samples, 1..kMostPatchSide
  std::uint8_t fringes = 0;              ///< the most of its samples on each side
  std::uint8_t roles = 0;                ///< that need any of its samples
  std::uint32_t firstSample = 0;         ///< into CaptureMesh::samples
  std::array<float, 4> inverseDistance;  ///< at its corners: low and high column of the top, then the bottom
};
static_assert(sizeof(MeshPatch) == 28);
inline constexpr int kMostPatchSide = 64;

inline constexpr double kLargestMeshError = 64;  ///< samples

struct MeshBound {
  double inverseDistance = 0;  ///< 1/m; by which the mesh may differ from a sample
  double error = 0;            ///< the same in samples
  double fringeStep = 0;       ///< samples; fringes are kOpenFringe and so many of these
};
/// Of a camera for eyes within `reach` metres; `error` in samples.
MeshBound meshBound(const ColumnCamera& camera, double error, double reach);
/// How far from a camera the eye may stand in the regions that it has roles for, in plan, metres.
double eyeReach(const Layout& layout, int camera);

struct CaptureMesh {
  std::vector<MeshPatch> patches;      ///< their first columns do not fall
  LargeVector<std::uint32_t> samples;  ///< of the capture: each opaque one once; patch by patch, column by
                                       ///< column, downwards

  LargeVector<std::uint8_t> fringes;  ///< of each of these; nothing but at the sides of patches

  std::size_t triangleCount() const { return 2 * patches.size(); }
};

/// How far the surface reaches beyond a patch's samples there, samples.
inline double fringeOf(std::uint8_t fringes, MeshSide side, const MeshBound& bound) {
  return kOpenFringe + bound.fringeStep * ((fringes >> side) & kMostFringe);
}
/// Column direction and row tangent (c, t) of the patch's corners, in the order of their inverse distances.
/// Fringes follow the tangents of the circle of directions and of the column: exact to their square.
std::array<glm::dvec3, 4> cornersOf(const ColumnCamera& camera, const MeshPatch& patch,
                                    const MeshBound& bound);

/// Does not depend on the number of threads. Stopped, it returns soon, with a mesh that is not whole.
CaptureMesh buildCaptureMesh(const DisplayCapture& capture, const MeshBound& bound, TaskRunner& runner,
                             const std::stop_token& stop = {});

}  // namespace acentric
