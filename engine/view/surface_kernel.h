#pragma once
/// The inner loops of local geometry: which pixels of a row a triangle covers, and the colours of those of
/// one whose every point looks like base colour times baked light, plus emission.
///
/// One template (surface_kernel_body.h) over the lane types, which all give the same bits. Free of the
/// standard library and of glm, as patch_kernel.h is.

#include <cstdint>

namespace acentric {

/// How coordinates beyond the texture are brought back: in the order of Wrap.
enum class TextureWrap : std::uint8_t { repeat, clamp, mirror };

struct SurfaceShade {
  const std::uint32_t* texels = nullptr;  ///< Rgba8 words, row by row; null: white
  std::int32_t width = 0, height = 0;
  TextureWrap wrapU{}, wrapV{};
  bool nearest = false;
  float uv[3][2]{};                      ///< of the corners, transformed
  const std::uint32_t* light = nullptr;  ///< HalfColour, two words each; null: 1 everywhere
  std::int32_t resolution = 0;           ///< of the light (surface_light.h), kMaxResolution at most; 0: black
  float barycentric[3][2]{};             ///< of the corners, in the triangle that the light is of
  float colour[3]{1, 1, 1}, emission[3]{};
  float exposure = 1;
  const float* linearFromSrgb = nullptr;  ///< linearFromSrgbTable()
  const float* threshold = nullptr;       ///< of DisplayCodes
  const std::uint8_t* firstCode = nullptr;

  static constexpr std::int32_t kMaxResolution = 30000;
};

/// Pixels [x0, x0 + count) of a row, all of the triangle.
struct SurfaceRun {
  double slope[3], start[3];  ///< the edge functions at pixel x: start + x * slope (local_raster.h)
  double perDepth = 0;        ///< inverse depth by their sum
  std::int32_t x0 = 0, count = 0;
  std::uint32_t* colour = nullptr;  ///< Rgba8 words, of pixel x0 on
  float* inverseZDepth = nullptr;   ///< 1/m
};

using ShadeRun = void (*)(const SurfaceShade& shade, const SurfaceRun& run);

/// Pixels [x0, x0 + count) of a row, some of them of a triangle.
struct EdgeRow {
  double slope[3], start[3];  ///< as SurfaceRun
  bool ownsBorder[3];         ///< are pixels exactly on that edge its own?
  double perDepth = 0;
  double mostInverse = 0;  ///< nearer points are not drawn, 1/m
  std::int32_t x0 = 0, count = 0;
};

struct TriangleRow : EdgeRow {
  std::uint32_t triangle = 0;
  std::uint32_t* visible = nullptr;  ///< the triangle seen at each pixel, of pixel x0 on
  float* nearest = nullptr;          ///< its inverse depth, 1/m
};

/// Makes the triangle the one seen where it covers a pixel and is nearer than what was seen there.
using CoverRow = void (*)(const TriangleRow& row);

void coverRowScalar(const TriangleRow& row);
void coverRowAvx2(const TriangleRow& row);
void coverRowAvx512(const TriangleRow& row);

/// A triangle that what lies behind it shines through.
struct ClearShade {
  SurfaceShade surface;
  float opacity = 1;   ///< alpha of every point; of glass a factor
  bool glass = false;  ///< alpha by glassAlpha
  float transmission = 0;
  float normal[3][3]{};  ///< of the corners, of any length
  float toEye[3][3]{};   ///< of the corners, metres
};

struct ClearRow : EdgeRow {
  std::uint32_t* colour = nullptr;        ///< Rgba8 words, of pixel x0 on
  const std::uint16_t* source = nullptr;  ///< PixelSource; over holes nothing is drawn
  const float* nearest = nullptr;         ///< inverse depth of what hides it where the source is `local`, 1/m
  std::uint16_t hole = 0;                 ///< below all other sources
  std::uint16_t local = 0xffff;           ///< above them
};

/// Blends the triangle over the pixels that it covers where it is not hidden.
using BlendRow = void (*)(const ClearShade& shade, const ClearRow& row);

void blendRowScalar(const ClearShade& shade, const ClearRow& row);
void blendRowAvx2(const ClearShade& shade, const ClearRow& row);
void blendRowAvx512(const ClearShade& shade, const ClearRow& row);

void shadeRunScalar(const SurfaceShade& shade, const SurfaceRun& run);
void shadeRunAvx2(const SurfaceShade& shade, const SurfaceRun& run);
void shadeRunAvx512(const SurfaceShade& shade, const SurfaceRun& run);

}  // namespace acentric
