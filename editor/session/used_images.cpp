#include "editor/session/used_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "editor/session/engine_texts.h"
#include "engine/geometry/conventions.h"
#include "engine/view/view_cameras.h"
#include "ui/translate.h"

namespace acentric::editor {

std::vector<UsedImage> usedImages(const LoadedWalk& loaded, const PerspectiveView& view,
                                  const ViewSettings& settings, const Frame* frame) {
  const Layout& layout = *loaded.walk.layout;
  const SourceRoles roles(layout, view);
  const std::vector<SourceShare> shares =
      frame != nullptr ? sourceShares(*frame, roles) : std::vector<SourceShare>();
  std::vector<UsedImage> images;
  for (const int camera : paintingOrder(layout, view, settings)) {
    const auto index = std::size_t(camera);
    const PixelSource source = sourceOfCamera(camera);
    UsedImage image;
    image.camera = camera;
    image.role = roles.of(source);
    if (index >= loaded.walk.captures.size() || !loaded.walk.captures[index])
      image.state = ImageState::missing;
    else if (index < loaded.standsIn.size() && loaded.standsIn[index])
      image.state = ImageState::coarse;
    const LayoutCamera& placed = layout.cameras[index];
    image.lowDegrees = std::fmod(std::fmod(degrees(placed.lowAzimuth), 360) + 360, 360);
    image.widthDegrees = degrees(placed.fovRadians);
    if (frame != nullptr) {
      const auto found = std::ranges::find(shares, source, &SourceShare::source);
      image.share = found == shares.end() ? 0 : found->share;
    }
    images.push_back(image);
  }
  return images;
}

std::string describe(const UsedImage& image) {
  std::string text = trf("camera {}   {:.0f}–{:.0f}°   {}", image.camera, image.lowDegrees,
                         image.lowDegrees + image.widthDegrees, engineText(nameOf(image.role)));
  if (image.state == ImageState::missing) return trf("{}   not there", text);
  if (image.state == ImageState::coarse) text += tr(", coarse");
  return image.share ? text + fmt::format("   {:.1f} %", 100 * *image.share) : text;
}

ColourImage spotlight(const Frame& frame, int camera) {
  constexpr Rgba8 kVeil{8, 10, 14, 190}, kClear{255, 255, 255, 0};
  ColourImage out(frame.source.width, frame.source.height);
  const PixelSource source = sourceOfCamera(camera);
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] = frame.source.pixels[i] == source ? kClear : kVeil;
  return out;
}

}  // namespace acentric::editor
