#include "engine/store/capture_exr.h"

#include <algorithm>

namespace acentric {
namespace {

constexpr std::uint16_t kHalfOne = 0x3c00;

}  // namespace

HalfColour premultiplied(const HalfColour& straight) {
  if (straight.a == kHalfOne) return straight;
  const glm::vec4 colour = unpackColour(straight);
  HalfColour result = packColour(glm::vec4(glm::vec3(colour) * colour.a, 1));
  result.a = straight.a;
  return result;
}

HalfColour straightened(const HalfColour& premultiplied) {
  if (premultiplied.a == kHalfOne) return premultiplied;
  if (premultiplied.a == 0) return HalfColour(0);
  const glm::vec4 colour = unpackColour(premultiplied);
  HalfColour result = packColour(glm::vec4(glm::vec3(colour) / colour.a, 1));
  result.a = premultiplied.a;
  return result;
}

ContentKey checksumOf(const ContentKey& key, const Capture& capture,
                      const std::vector<HalfColour>& premultipliedColours) {
  Hasher hasher;
  hasher.value(key.high).value(key.low);
  capture.camera.addTo(hasher);
  hasher.value(capture.distanceStep);
  const auto add = [&](const CaptureSamples& samples, const std::vector<HalfColour>& colours) {
    hasher.array(std::span(samples.columnStart)).array(std::span(samples.row));
    hasher.array(std::span(samples.inverseDistance)).array(std::span(colours));
    hasher.array(std::span(samples.roles));
    if (capture.hasReflections()) hasher.array(std::span(samples.mirror));
  };
  add(capture, premultipliedColours);
  if (capture.hasReflections()) add(capture.reflections, capture.reflections.colour);
  return hasher.finish();
}

}  // namespace acentric
