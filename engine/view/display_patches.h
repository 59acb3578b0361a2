#pragma once
/// The patches of a capture (image/patches.h) made ready to be drawn: each is a small picture of its samples
/// on one plane.
///
/// The texels of a patch are its samples and a border one sample wide, column by column. A texel that is no
/// sample of the patch covers nothing; its colour is that of the nearest sample, or of the same surface where
/// that goes on in another patch, so that colours may be interpolated up to the patch's edge.

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/base/large_vector.h"
#include "engine/image/capture.h"
#include "engine/image/image.h"
#include "engine/view/patch_kernel.h"

namespace acentric {

struct DisplayPatch {
  glm::vec3 normal{0};                  ///< SurfacePlane::normal
  std::uint32_t firstTexel = 0;         ///< of (column - 1, row - 1)
  std::uint16_t column = 0, row = 0;    ///< its first
  std::uint16_t columns = 0, rows = 0;  ///< without the border
  /// What is cut off the corners of that rectangle, samples along either side: low column and low row, low
  /// column and high row, high column and low row, both high.
  std::array<std::uint8_t, 4> cut{};
  std::uint8_t roles = 0;   ///< that need any of its samples
  std::uint8_t mirror = 0;  ///< that it belongs to, or that shows it
  bool blended = false;
  bool away = false;  ///< SurfacePlane::away
};

struct DisplayPatches {
  int stripColumns = 0;                   ///< Patches::stripColumns
  std::vector<std::uint32_t> stripStart;  ///< strips + 1 offsets
  std::vector<DisplayPatch> patches;      ///< of a strip: those that may hide others first
  LargeVector<Rgba8> colour;              ///< of texels; sRGB, straight alpha
  LargeVector<std::uint32_t> cover;       ///< of texels (kTexelParts ...)
  std::vector<glm::vec2> columnBorder;    ///< columns + 1 unit directions
  std::vector<float> rowBorder;           ///< rows + 1 tangents, falling

  std::size_t bytes() const;
};

/// Of samples that have planes; `colours` are theirs, sRGB with straight alpha.
DisplayPatches displayPatches(const ColumnCamera& camera, const CaptureSamples& samples, double tolerance,
                              std::span<const Rgba8> colours);

/// Sets kBlockWhole and kBlockInner in the words of a patch of so many texels and their border
/// (patch_kernel.h).
void markWholeBlocks(std::uint32_t* cover, int columns, int rows);

}  // namespace acentric
