#include "engine/cli/frame_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/contract.h"
#include "engine/measure/compare.h"
#include "engine/picture/captioned_pictures.h"

namespace acentric::cli {
namespace {

constexpr int kSwatchSide = 14;
constexpr double kLeastInLegend = 5e-4;  ///< share of the picture

std::string hex(const Rgba8& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
}

}  // namespace

const char* nameOf(PictureMode mode) {
  switch (mode) {
    case PictureMode::picture:
      return "picture";
    case PictureMode::truth:
      return "truth";
    case PictureMode::difference:
      return "difference";
    case PictureMode::beside:
      return "beside";
    case PictureMode::sources:
      return "sources";
    case PictureMode::holes:
      return "holes";
  }
  return "picture";
}

std::vector<std::string> pictureModeNames() {
  std::vector<std::string> names;
  for (const PictureMode mode : kPictureModes) names.emplace_back(nameOf(mode));
  return names;
}

std::vector<PictureMode> pictureModes(std::span<const std::string> names) {
  std::vector<PictureMode> modes;
  for (const std::string& name : names)
    for (const PictureMode mode : kPictureModes)
      if (name == nameOf(mode) && !std::ranges::count(modes, mode)) modes.push_back(mode);
  return modes;
}

bool needsTruth(PictureMode mode) {
  return mode == PictureMode::truth || mode == PictureMode::difference || mode == PictureMode::beside;
}

FramePictures::FramePictures(std::span<const OpenProject> storeys, int gain)
    : storeys_(storeys), gain_(gain), colours_(storeys.size()) {}

const Layout& FramePictures::layoutAt(const PerspectiveView& view) const {
  return *storeys_[storeyAt(storeys_, view.eye)].layout;
}

const SourceColours& FramePictures::coloursAt(const PerspectiveView& view) const {
  auto& colours = colours_[storeyAt(storeys_, view.eye)];
  if (!colours) colours = std::make_unique<const SourceColours>(layoutAt(view));
  return *colours;
}

ColourImage FramePictures::make(PictureMode mode, const Frame& frame, const PerspectiveView& view,
                                const TruthFrame* truth) const {
  require(truth != nullptr || !needsTruth(mode), "the truth is there where it is needed");
  switch (mode) {
    case PictureMode::picture:
      break;
    case PictureMode::truth:
      return truth->colour;
    case PictureMode::difference:
      return differenceImage(frame.colour, truth->colour, gain_);
    case PictureMode::beside:
      return contactSheet({frame.colour, truth->colour}, 2);
    case PictureMode::sources:
      return sourcePicture(frame, coloursAt(view), SourceRoles(layoutAt(view), view));
    case PictureMode::holes:
      return holePicture(frame);
  }
  return frame.colour;
}

Result<ColourImage> FramePictures::makeWithLegend(PictureMode mode, const Frame& frame,
                                                  const PerspectiveView& view,
                                                  const TruthFrame* truth) const {
  std::vector<LegendLine> lines;
  const SourceRoles roles(layoutAt(view), view);
  if (mode == PictureMode::sources) {
    for (const SourceShare& s : sourceShares(frame, roles)) {
      if (s.share < kLeastInLegend) continue;
      std::string text = sourceName(layoutAt(view), s.source);
      if (s.role == SourceRole::otherHand) text += " (other hand)";
      lines.push_back({sourceSwatch(s.source, coloursAt(view), roles, kSwatchSide),
                       fmt::format("{}: {:.1f} %", text, 100 * s.share)});
    }
  } else if (mode == PictureMode::holes) {
    double open = 0, invented = 0;
    for (const SourceShare& s : sourceShares(frame, roles))
      (s.source == kSourceHole ? open : invented) +=
          s.source == kSourceHole || s.source == kSourceInvented ? s.share : 0;
    lines.push_back({ColourImage(kSwatchSide, kSwatchSide, kInventedColour),
                     fmt::format("filled in by guesswork: {:.3f} %", 100 * invented)});
    lines.push_back(
        {ColourImage(kSwatchSide, kSwatchSide, Rgba8(255)), fmt::format("left open: {:.3f} %", 100 * open)});
  }
  return withLegend(make(mode, frame, view, truth), lines);
}

Json FramePictures::sourcesJson(const Frame& frame, const PerspectiveView& view) const {
  const Layout& layout = layoutAt(view);
  Json list = Json::array();
  for (const SourceShare& s : sourceShares(frame, SourceRoles(layout, view))) {
    Json entry = {{"source", sourceName(layout, s.source)}};
    if (s.role != SourceRole::notACamera) {
      entry["camera"] = int(s.source) - 1;
      entry["role"] = nameOf(s.role);
    }
    entry["share"] = s.share;
    entry["colour"] = hex(coloursAt(view).of(s.source));
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace acentric::cli
