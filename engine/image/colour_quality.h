#pragma once
/// How true stored colours are to what was baked.

namespace acentric {

/// 0 to 99: as pictures, of which 99 are the truest. 100: as they are, every bit.
inline constexpr int kLosslessColours = 100;

/// About 43 dB from what was baked (docs/captures.md): a picture that is itself 30 dB from the truth loses
/// 0.2 dB.
inline constexpr int kUsualColourQuality = 94;

}  // namespace acentric
