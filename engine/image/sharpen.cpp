#include "engine/image/sharpen.h"

#include <array>
#include <cmath>

namespace acentric {

std::vector<Rgba8> sharpenedColours(const ColumnCamera& camera, const CaptureSamples& samples,
                                    const PixelSamples& pixels, double tolerance,
                                    std::span<const Rgba8> colours) {
  std::vector<glm::dvec2> direction;
  std::vector<double> tangent;
  for (int k = 0; k < camera.columns; ++k) direction.push_back(camera.directionAt(k + 0.5));
  for (int r = 0; r < camera.rows; ++r) tangent.push_back(camera.tangentAt(r + 0.5));
  const auto mirrorOf = [&](std::uint32_t i) { return samples.mirror.empty() ? 0 : samples.mirror[i]; };
  const auto isSame = [&](std::uint32_t a, std::uint32_t b, int column, int row) {
    if (colours[a].a != colours[b].a || mirrorOf(a) != mirrorOf(b) ||
        (samples.roles[a] & samples.roles[b]) == 0)
      return false;
    if (samples.plane[a] == samples.plane[b]) return true;
    const SurfacePlane &planeA = samples.planes[samples.plane[a]], &planeB = samples.planes[samples.plane[b]];
    const auto& d = direction[std::size_t(column)];
    const double t = tangent[std::size_t(row)];
    return planeA.away == planeB.away &&
           std::abs(planeA.inverseDistance(d, t) - planeB.inverseDistance(d, t)) <= tolerance;
  };
  constexpr std::array<glm::ivec2, 4> kBeside{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  std::vector<Rgba8> sharpened(colours.begin(), colours.end());
  for (int column = 0; column < camera.columns; ++column)
    for (auto i = samples.columnStart[std::size_t(column)]; i < samples.columnStart[std::size_t(column) + 1];
         ++i) {
      glm::ivec3 difference(0);
      for (const glm::ivec2& step : kBeside) {
        const int x = column + step.x, y = samples.row[i] + step.y;
        if (!pixels.holds(x, y)) continue;
        for (const std::uint32_t other : pixels.at(x, y))
          if (isSame(i, other, x, y)) {
            difference += glm::ivec3(colours[i]) - glm::ivec3(colours[other]);
            break;
          }
      }
      if (difference == glm::ivec3(0)) continue;
      const glm::vec3 raised = glm::vec3(colours[i]) + kSharpening * glm::vec3(difference);
      sharpened[i] = Rgba8(glm::clamp(raised + 0.5f, 0.0f, 255.0f), colours[i].a);
    }
  return sharpened;
}

}  // namespace acentric
