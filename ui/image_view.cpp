#include "ui/image_view.h"

#include <algorithm>

namespace acentric::ui {

FittedImage fitImage(const glm::dvec2& areaMin, const glm::dvec2& areaSize, double aspect) {
  const glm::dvec2 area = glm::max(areaSize, glm::dvec2(0));
  glm::dvec2 size(area.x, area.x / aspect);
  if (size.y > area.y) size = {area.y * aspect, area.y};
  return {areaMin + 0.5 * (area - size), size};
}

void drawImage(ImTextureID texture, const FittedImage& place, bool bottomUp) {
  const ImVec2 low(float(place.min.x), float(place.min.y));
  const ImVec2 high(float(place.min.x + place.size.x), float(place.min.y + place.size.y));
  ImGui::GetWindowDrawList()->AddImage(texture, low, high, {0, bottomUp ? 1.0F : 0.0F},
                                       {1, bottomUp ? 0.0F : 1.0F});
}

}  // namespace acentric::ui
