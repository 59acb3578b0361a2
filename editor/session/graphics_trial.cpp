#include "editor/session/graphics_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/measure/compare.h"
#include "ui/translate.h"

namespace acentric::editor {

bool isSoftwareRasteriser(std::string_view description) {
  static constexpr std::array<std::string_view, 7> kNames = {
      "llvmpipe", "softpipe", "swrast", "lavapipe", "SwiftShader", "Software Rasterizer", "GDI Generic"};
  return std::ranges::any_of(
      kNames, [&](std::string_view name) { return description.find(name) != std::string_view::npos; });
}

bool GraphicsTrial::wanted(Graphics graphics, std::string_view description) const {
  const bool due = state_ == State::untried || (state_ == State::refused && graphics != triedFor_);
  if (!due || graphics == Graphics::processor) return false;
  return graphics == Graphics::card || !isSoftwareRasteriser(description);
}

void GraphicsTrial::refuse(Graphics graphics) {
  state_ = State::refused;
  triedFor_ = graphics;
}

std::string GraphicsTrial::judge(const Frame& processor, const Frame& card, Graphics graphics) {
  const bool sameSize = processor.colour.width == card.colour.width &&
                        processor.colour.height == card.colour.height && !card.colour.empty();
  const double likeness = sameSize ? psnrOf(processor.colour, card.colour) : 0;
  const bool faster = graphics == Graphics::card || card.stats.totalSeconds < processor.stats.totalSeconds;
  refuse(graphics);
  if (likeness >= kLeastLikeness && faster) state_ = State::passed;
  if (likeness >= kLeastLikeness) return {};
  return trf(
      "The graphics card draws this walk differently than the processor ({:.1f} dB; {:.0f} are expected), "
      "which goes on drawing it. A newer graphics driver may help.",
      likeness, kLeastLikeness);
}

}  // namespace acentric::editor
