#pragma once
/// Colours of samples behind the first one of their pixel, as a range-coded stream (FORMAT.md, "Colours
/// behind the first"). They lie along the edges of what is before them, where the surface that they are on
/// mostly goes on beside it: each is predicted by its neighbours on the same plane, and what it is off by is
/// coded in even steps. As pictures they take three times the bytes.

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/image/capture.h"
#include "engine/store/colour_codes.h"

namespace acentric {

/// By how many codes the values that can be read are apart. About as true as pictures of that quality.
struct DeepColourSteps {
  explicit DeepColourSteps(int quality) : luma((2 * (100 - quality) + 1) / 3), chroma((3 * luma + 1) / 2) {}
  int luma, chroma;
};

/// How codes are kept, and which there are.
struct DeepColourShape {
  int rows = 0;     ///< of the capture
  int quality = 0;  ///< 0..99
  int mostCode = 0;
};

/// `codes` are of all samples: of first ones as they will be read, of the others as they are; these become
/// what will be read.
std::vector<std::byte> codeDeepColours(const CaptureSamples& samples, const DeepColourShape& shape,
                                       std::vector<ColourCodes>& codes);

/// Sets those of deeper samples. `malformed` without a place.
Status decodeDeepColours(std::span<const std::byte> bytes, const CaptureSamples& samples,
                         const DeepColourShape& shape, std::vector<ColourCodes>& codes);

}  // namespace acentric
