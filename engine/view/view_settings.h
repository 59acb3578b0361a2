#pragma once
/// How frames are made. Every field trades accuracy for time.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

enum class Renderer : std::uint8_t {
  list,       ///< list priority, no depth buffer (SIMD where the processor has it)
  scalar,     ///< list priority, one sample at a time in plain C++: the reference of the fast ones
  precise,    ///< the same in double precision: what floats cost
  zbuffer,    ///< the same splats with a depth buffer, for comparison
  gl,         ///< list priority on OpenGL
  glZbuffer,  ///< the same splats on OpenGL with a depth test, for comparison
  glMesh,     ///< captures as adaptive meshes on OpenGL, with a depth test (capture_mesh.h)
};
inline constexpr Renderer kRenderers[] = {Renderer::list,    Renderer::scalar, Renderer::precise,
                                          Renderer::zbuffer, Renderer::gl,     Renderer::glZbuffer,
                                          Renderer::glMesh};
/// Is it drawn by view_gl instead of view?
constexpr bool onOpenGl(Renderer renderer) {
  return renderer == Renderer::gl || renderer == Renderer::glZbuffer || renderer == Renderer::glMesh;
}
/// Does a depth test find what is nearest, and not the order of drawing?
constexpr bool depthTested(Renderer renderer) {
  return renderer == Renderer::zbuffer || renderer == Renderer::glZbuffer || renderer == Renderer::glMesh;
}
/// Itself, or what comes nearest to it where there is no OpenGL to draw with.
Renderer withoutOpenGl(Renderer renderer);
const char* nameOf(Renderer renderer);
Result<Renderer> parseRenderer(std::string_view name);
/// All their names, as options list them.
std::vector<std::string> rendererNames();

enum class Reconstruction : std::uint8_t {
  point,  ///< one pixel per sample
  splat,  ///< squares as large as the sample's footprint
  /// Rectangles as large as the footprint of the surface there: neighbouring samples of one surface are
  /// joined, however it is turned, and edges do not grow. Two more bytes read per sample.
  surface,
  /// The same rectangles, and each pixel the mean, in linear light, of the samples in it and around it, by
  /// where in their pixels they lie: smooth edges. One more pass over the picture.
  filtered,
  /// Patches of surfaces, each drawn to its edges: parts of pixels that they cover, colours interpolated
  /// within them. Of captures that know their silhouettes; others are drawn filtered.
  patches,
};
inline constexpr Reconstruction kReconstructions[] = {Reconstruction::point, Reconstruction::splat,
                                                      Reconstruction::surface, Reconstruction::filtered,
                                                      Reconstruction::patches};
/// Are splats rectangles after the slant of their surface?
constexpr bool followsSlant(Reconstruction reconstruction) {
  return reconstruction != Reconstruction::point && reconstruction != Reconstruction::splat;
}
/// Is each pixel the mean of the samples around it? Also of captures without patches.
constexpr bool isFiltered(Reconstruction reconstruction) {
  return reconstruction == Reconstruction::filtered || reconstruction == Reconstruction::patches;
}
const char* nameOf(Reconstruction reconstruction);
Result<Reconstruction> parseReconstruction(std::string_view name);

inline constexpr double kLargestMeshError = 64;

struct ViewSettings {
  Renderer renderer = Renderer::list;
  Reconstruction reconstruction = Reconstruction::patches;
  int maxSplatPixels = 16;  ///< side of the largest splat, 1..64
  /// Meshes: how far a surface may shift in a picture against where its samples lie, in samples,
  /// 0.01..kLargestMeshError.
  double meshError = 0.25;
  /// Of a capture's mesh; where it takes more, its error is raised, at most to kLargestMeshError. 0 = any
  /// number.
  int maxMeshTriangles = 0;
  bool localGeometry = true;
  bool secondaryCover = true;  ///< in rings: the other hand is painted first, behind
  bool fillHoles = true;       ///< screen-space fill of what is still open, marked as invented

  Status check() const;
  bool operator==(const ViewSettings&) const = default;
};

}  // namespace acentric
