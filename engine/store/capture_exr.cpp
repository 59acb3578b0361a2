#include "engine/store/capture_exr.h"

#include <utility>

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

CaptureSamples withBackground(const Capture& capture, std::vector<HalfColour> premultipliedColours) {
  CaptureSamples all = capture;
  all.colour = std::move(premultipliedColours);
  const CaptureBackground& back = capture.background;
  if (back.runCount() == 0) return all;
  const std::size_t total = capture.sampleCount() + back.pixelCount();
  const CaptureSamples samples = std::move(all);
  all = {};
  all.row.reserve(total);
  all.inverseDistance.reserve(total);
  all.colour.reserve(total);
  all.roles.reserve(total);
  all.mirror.reserve(capture.hasReflections() ? total : 0);
  all.columnStart.push_back(0);
  const ColumnCamera& camera = capture.camera;
  for (std::size_t column = 0; column + 1 < samples.columnStart.size(); ++column) {
    std::size_t next = samples.columnStart[column];
    const auto copyUpTo = [&](int row) {  // and with it
      for (; next < samples.columnStart[column + 1] && int(samples.row[next]) <= row; ++next) {
        all.row.push_back(samples.row[next]);
        all.inverseDistance.push_back(samples.inverseDistance[next]);
        all.colour.push_back(samples.colour[next]);
        all.roles.push_back(samples.roles[next]);
        if (capture.hasReflections()) all.mirror.push_back(samples.mirror[next]);
      }
    };
    const glm::dvec2 along = camera.directionAt(double(column) + 0.5);
    for (std::size_t run = back.columnStart[column]; run < back.columnStart[column + 1]; ++run)
      for (int row = back.firstRow[run]; row < back.endRow[run]; ++row) {
        copyUpTo(row);
        const glm::vec3 direction(glm::normalize(glm::dvec3(along, camera.tangentAt(row + 0.5))));
        all.row.push_back(std::uint16_t(row));
        all.inverseDistance.push_back(0);
        all.colour.push_back(packColour({back.sky.radiance(direction), 1}));
        all.roles.push_back(back.roles[run]);
        if (capture.hasReflections()) all.mirror.push_back(0);
      }
    copyUpTo(camera.rows);
    all.columnStart.push_back(std::uint32_t(all.row.size()));
  }
  return all;
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
  if (const CaptureBackground& back = capture.background; back.runCount() > 0) {
    for (const glm::vec3& radiance : {back.sky.zenith, back.sky.horizon, back.sky.ground})
      hasher.value(radiance.x).value(radiance.y).value(radiance.z);
    hasher.array(std::span(back.columnStart)).array(std::span(back.firstRow));
    hasher.array(std::span(back.endRow)).array(std::span(back.roles));
  }
  if (capture.hasReflections()) add(capture.reflections, capture.reflections.colour);
  return hasher.finish();
}

}  // namespace acentric
