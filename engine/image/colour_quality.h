#pragma once
/// How true stored colours are to what was baked.

namespace acentric {

/// 0 to 99: as pictures, of which 99 are the truest. 100: as they are, every bit.
inline constexpr int kLosslessColours = 100;

/// About 45 dB from what was baked (docs/captures.md).
inline constexpr int kUsualColourQuality = 96;

/// Of what is shipped, unless the project asks for less: about 44 dB, 0.6 dB of a frame (docs/runtimes.md).
inline constexpr int kShippedColourQuality = 92;

}  // namespace acentric
