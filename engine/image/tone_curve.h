#pragma once
/// Constants of the way from radiance to display codes (colour.h), for the inner loops that take it too. Free
/// of the standard library.

namespace acentric::tone_curve {

/// Below this peak the tone curve is the identity.
inline constexpr float kShoulderStart = 0.76f;
/// How fast highlights lose colour once their peak is compressed.
inline constexpr float kHighlightDesaturation = 0.15f;
/// Brighter than anything a half float holds after a large exposure; keeps the arithmetic finite.
inline constexpr float kBrightest = 1e9f;
/// Buckets in [0, 1] of the table of codes: each is narrower than the narrowest step between codes (1/3295),
/// so at most one threshold lies in it.
inline constexpr int kCodeBuckets = 4096;

}  // namespace acentric::tone_curve
