#pragma once
/// Where the colours of a list of samples lie in a picture (FORMAT.md, "Colours as pictures"). The samples of
/// each layer (the first ones of all pixels, the second ones, ...) are an image of columns x rows, cut into
/// square tiles; tiles that hold a sample are laid side by side, in rows as wide as that image. Of surfaces'
/// first layer all tiles are kept, so that it stays a picture as the camera saw it. Both directions work it
/// out from the samples' pixels alone.

#include <cstdint>
#include <vector>

#include "engine/image/capture.h"
#include "engine/store/colour_codes.h"
#include "engine/store/still_picture.h"

namespace acentric {

inline constexpr int kColourTile = 8;

struct ColourTiles {
  int width = 0, height = 0;
  std::vector<std::uint32_t> place;  ///< of each sample: y * width + x
};

/// `whole`: of the first layer all tiles are kept.
ColourTiles layOutColours(const CaptureSamples& samples, int rows, bool whole);

/// What no sample lies on continues what is beside it.
StillPicture pictureOf(const CaptureSamples& samples, const ColourTiles& tiles, const ColourCoder& coder);

}  // namespace acentric
