#include <algorithm>
#include <array>
#include <cmath>

#include "engine/picture/plan_picture.h"

namespace acentric {

Rgba8 scaleColour(double share) {
  // Viridis at nine even places.
  static constexpr std::array<glm::u8vec3, 9> kStops{{{68, 1, 84},
                                                      {71, 44, 122},
                                                      {59, 81, 139},
                                                      {44, 113, 142},
                                                      {33, 144, 141},
                                                      {39, 173, 129},
                                                      {92, 200, 99},
                                                      {170, 220, 50},
                                                      {253, 231, 37}}};
  if (std::isnan(share)) return {173, 181, 189, 255};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t below = std::min(std::size_t(at), kStops.size() - 2);
  const glm::dvec3 colour =
      glm::mix(glm::dvec3(kStops[below]), glm::dvec3(kStops[below + 1]), at - double(below));
  return {glm::u8vec3(glm::round(colour)), 255};
}

Rgba8 categoryColour(int category) {
  // Okabe and Ito's set with a grey for black.
  static constexpr std::array<Rgba8, 8> kColours{{{86, 180, 233, 255},
                                                  {230, 159, 0, 255},
                                                  {0, 158, 115, 255},
                                                  {204, 121, 167, 255},
                                                  {0, 114, 178, 255},
                                                  {213, 94, 0, 255},
                                                  {240, 228, 66, 255},
                                                  {134, 142, 150, 255}}};
  return kColours[std::size_t(((category % 8) + 8) % 8)];
}

double PlanScale::shareOf(double value) const {
  if (!(high > low)) return 0.5;
  const double share = logarithmic && low > 0 ? std::log(std::max(value, low) / low) / std::log(high / low)
                                              : (value - low) / (high - low);
  return std::clamp(share, 0.0, 1.0);
}

}  // namespace acentric
