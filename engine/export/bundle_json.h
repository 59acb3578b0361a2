#pragma once
/// JSON of bundles: how it is laid out, and the words for values that both directions share.

#include <nlohmann/json.hpp>
#include <string>

namespace acentric {

using BundleJson = nlohmann::ordered_json;
struct BundleStorey;

/// Indented by two spaces; objects and arrays that are short take one line. The text depends on the value
/// alone.
std::string layOut(const BundleJson& json);

/// {"cameras": [...], "regions": [...]}, as a storey of the index has them.
BundleJson placesJson(const BundleStorey& storey);

namespace bundle_words {
inline constexpr const char* kKinds[] = {"ring", "gapTriangle", "gapSquare", "gapHexagon"};
inline constexpr const char* kHands[] = {"counterClockwise", "clockwise"};
inline constexpr const char* kWraps[] = {"repeat", "clamp", "mirror"};
inline constexpr const char* kAlphaModes[] = {"opaque", "mask", "blend"};
inline constexpr const char* kToneCurve = "acentric neutral 1";
}  // namespace bundle_words

}  // namespace acentric
