#pragma once
/// Local geometry over the background (apv.md section 4): a triangle rasteriser with its own depth buffer.
///
/// Edge functions are those of homogeneous rasterisation: for corners q0, q1, q2 in view axes, the pixel ray
/// d lies in the triangle where d.(q1 x q2), d.(q2 x q0), d.(q0 x q1) agree in sign with the determinant;
/// divided by their sum they are the perspective-correct weights, and the sum over the determinant is the
/// inverse depth. No triangle is ever clipped, not even one that reaches behind the eye. Triangles that share
/// an edge compute the same values for it up to the sign, so there are neither cracks nor pixels drawn twice.
///
/// Visibility comes first (triangle number and depth per pixel), then each visible pixel is shaded once.
/// Bands of rows run in parallel; pixels do not depend on the bands.

#include "engine/base/task_runner.h"
#include "engine/view/canvas.h"
#include "engine/view/column_culling.h"
#include "engine/view/frame.h"
#include "engine/view/local_shading.h"

namespace acentric {

class LocalRaster {
 public:
  /// Transforms and sets up all triangles. `local` and what `shading` refers to must outlive this.
  LocalRaster(const LocalGeometry& local, const LocalShading& shading, const PerspectiveView& view,
              TaskRunner& runner);

  /// Numbers the mirrors among the opaque triangles. They show the reflections that captures keep (warp.h),
  /// and where there is none their own baked light. Captures keep what lies beyond the near band: what stands
  /// so close before a mirror that its virtual place is within is missing in it, and what it would hide
  /// shows.
  void findMirrors(const FlatMirrors& mirrors);
  /// By number of the opaque triangles: the mirror that the eye sees of each, 0 = none; empty: none is one.
  const std::vector<std::uint8_t>& mirrors() const { return mirrors_; }

  /// Finds which of the opaque and alpha-tested triangles each pixel of the picture shows: its number, or
  /// kUncovered.
  void findOpaque(CoverRow coverRow, CoverImage& cover, TaskRunner& runner) const;
  /// Draws them where `cover` says: `frame` gets colours and kSourceLocal, `inverseZDepth` (1/m, row by row)
  /// their depth. Where one is a mirror and the frame has a source, the colour stays: it is what that shows.
  void drawOpaque(const CoverImage& cover, ShadeRun shadeRun, Frame& frame, FloatImage& inverseZDepth,
                  TaskRunner& runner) const;
  /// Blends the clear triangles over the frame, farthest first, where no opaque local geometry is nearer.
  /// Pixels keep their source, except that a pixel of an opaque one stays local; over a hole nothing is
  /// drawn.
  void drawClear(BlendRow blendRow, Frame& frame, const FloatImage& inverseZDepth, TaskRunner& runner) const;

  bool hasClear() const { return !clear_.empty(); }
  /// Triangles that reach into the picture.
  std::size_t triangleCount() const { return opaque_.size() + clear_.size(); }

 private:
  struct Triangle {
    glm::dvec3 edge[3];   ///< value at pixel centre (x, y): edge.x * x + edge.y * y + edge.z; >= 0 inside
    double perDepth = 0;  ///< 1 / |determinant|
    double farthest = 0;  ///< largest distance of a corner, metres: drawing order of clear ones
    PixelRect box;
    std::uint32_t index = 0;  ///< into LocalGeometry::triangles
    bool back = false;
    bool masked = false;
  };
  bool setUp(std::uint32_t index, Triangle& out) const;
  template <class Row, class Visit>
  void forEachRow(const Triangle& triangle, const PixelRect& rect, const Visit& visit) const;
  template <class Visit>
  void forEachPixel(const Triangle& triangle, const PixelRect& rect, const Visit& visit) const;
  template <class Body>
  void forBands(TaskRunner& runner, const Body& body) const;
  class BandShading;
  std::array<LocalPoint, 3> cornersOf(const Triangle& triangle) const;
  LocalPoint pointAt(const Triangle& triangle, const glm::dvec3& weights) const;

  const LocalGeometry& local_;
  const LocalShading& shading_;
  PerspectiveView view_;
  double focal_;                    ///< pixels
  std::vector<glm::dvec3> inView_;  ///< by local vertex
  std::vector<Triangle> opaque_;
  std::vector<std::uint8_t> mirrors_;                     ///< by opaque triangle, or empty
  std::vector<std::vector<std::uint32_t>> opaqueOfBand_;  ///< that reach into each band of rows, rising
  std::vector<Triangle> clear_;                           ///< farthest first
};

}  // namespace acentric
