#pragma once
/// How frames are made. Every field trades accuracy for time.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

enum class Renderer : std::uint8_t {
  list,     ///< list priority, no depth buffer (SIMD where the processor has it)
  scalar,   ///< list priority, one sample at a time in plain C++: the reference of the fast ones
  precise,  ///< the same in double precision: what floats cost
  zbuffer,  ///< the same splats with a depth buffer, for comparison
  gl,       ///< list priority on OpenGL; patches alone
};
inline constexpr Renderer kRenderers[] = {Renderer::list, Renderer::scalar, Renderer::precise,
                                          Renderer::zbuffer, Renderer::gl};
/// Is it drawn by view_gl instead of view?
constexpr bool onOpenGl(Renderer renderer) { return renderer == Renderer::gl; }
/// Does a depth test find what is nearest, and not the order of drawing?
constexpr bool depthTested(Renderer renderer) { return renderer == Renderer::zbuffer; }
/// Itself, or what comes nearest to it where there is no OpenGL to draw with.
Renderer withoutOpenGl(Renderer renderer);
const char* nameOf(Renderer renderer);
Result<Renderer> parseRenderer(std::string_view name);
/// The name itself, or of the way of drawing that took the place of one that files of earlier versions name.
std::string_view rendererNow(std::string_view name);
/// All their names, as options list them.
std::vector<std::string> rendererNames();

enum class Reconstruction : std::uint8_t {
  point,  ///< one pixel per sample
  splat,  ///< squares as large as the sample's footprint: the paper's warp (section 5)
  /// Patches of surfaces, each drawn to its edges: parts of pixels that they cover, colours interpolated
  /// within them. Of captures that know their silhouettes; others are drawn as splats.
  patches,
};
inline constexpr Reconstruction kReconstructions[] = {Reconstruction::point, Reconstruction::splat,
                                                      Reconstruction::patches};
const char* nameOf(Reconstruction reconstruction);
Result<Reconstruction> parseReconstruction(std::string_view name);
std::string_view reconstructionNow(std::string_view name);  ///< as rendererNow

struct ViewSettings {
  Renderer renderer = Renderer::list;
  Reconstruction reconstruction = Reconstruction::patches;
  int maxSplatPixels = 16;  ///< side of the largest splat, 1..64
  bool localGeometry = true;
  bool secondaryCover = true;  ///< in rings: the other hand is painted first, behind
  bool fillHoles = true;       ///< screen-space fill of what is still open, marked as invented

  Status check() const;
  bool operator==(const ViewSettings&) const = default;
};

}  // namespace acentric
