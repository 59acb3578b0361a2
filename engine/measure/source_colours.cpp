#include "engine/measure/source_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "engine/geometry/conventions.h"
#include "engine/layout/drawing_order.h"

namespace acentric {
namespace {

/// Found by search: the least CIE 1976 difference between any two, and to the colours of what is no camera,
/// is 20 for normal, protanopic, deuteranopic and tritanopic eyes alike (tests/measure).
constexpr std::array<Rgba8, kCameraColours> kPalette{{{153, 240, 0, 255},
                                                      {51, 0, 240, 255},
                                                      {240, 102, 0, 255},
                                                      {0, 51, 102, 255},
                                                      {240, 204, 153, 255},
                                                      {102, 0, 153, 255},
                                                      {51, 102, 153, 255},
                                                      {102, 0, 0, 255},
                                                      {204, 51, 240, 255},
                                                      {153, 102, 51, 255}}};

/// How much worse it is for neighbours in the drawing order to look alike than for others of a region.
constexpr double kNextToEachOther = 8;

bool isCamera(PixelSource source) { return source > kSourceHole && source < kSourceBackground; }
int cameraOf(PixelSource source) { return int(source) - 1; }

double luma(const Rgba8& c) { return (0.299 * c.r + 0.587 * c.g + 0.114 * c.b) / 255; }

/// Lightness and hue, roughly as far apart as they look (no need to be exact: it only ranks).
double likeness(int a, int b) {
  if (a == b) return 1;
  const glm::dvec3 d = (glm::dvec3(kPalette[std::size_t(a)]) - glm::dvec3(kPalette[std::size_t(b)])) / 255.0;
  const double lighter = luma(kPalette[std::size_t(a)]) - luma(kPalette[std::size_t(b)]);
  return 0.01 / (glm::dot(d, d) / 3 + 3 * lighter * lighter);
}

/// Which covers each camera belongs to, as positions into a list by camera.
struct CoverPlaces {
  struct Place {
    const Cover* cover;
    std::size_t piece;
  };
  std::vector<std::size_t> start;
  std::vector<Place> places;

  explicit CoverPlaces(const Layout& layout) : start(layout.cameras.size() + 1, 0) {
    const auto forAll = [&](const auto& visit) {
      for (const Region& region : layout.regions)
        for (const Cover& cover : region.covers)
          for (std::size_t p = 0; p < cover.pieces.size(); ++p) visit(cover, p);
    };
    forAll([&](const Cover& cover, std::size_t p) { ++start[std::size_t(cover.pieces[p].camera) + 1]; });
    for (std::size_t c = 0; c + 1 < start.size(); ++c) start[c + 1] += start[c];
    places.resize(start.back());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    forAll([&](const Cover& cover, std::size_t p) {
      places[next[std::size_t(cover.pieces[p].camera)]++] = {&cover, p};
    });
  }
};

Rgba8 shaded(const Rgba8& colour, double factor) {
  const auto scaled = [&](std::uint8_t v) {
    return std::uint8_t(std::lround(std::clamp(v * factor, 0.0, 255.0)));
  };
  return {scaled(colour.r), scaled(colour.g), scaled(colour.b), 255};
}

/// The sign of its role at a pixel: cameras of the other hand are dotted, panoramas striped.
bool marked(SourceRole role, int x, int y) {
  if (role == SourceRole::otherHand) return x % 6 < 2 && y % 6 < 2;
  return role == SourceRole::panorama && (x + y) % 8 < 3;
}

Rgba8 withSign(const Rgba8& colour, SourceRole role, int x, int y) {
  if (!marked(role, x, y)) return colour;
  return luma(colour) > 0.45 ? shaded(colour, 0.45) : Rgba8((glm::ivec4(colour) + 2 * 255) / 3);
}

}  // namespace

Rgba8 cameraColour(int number) {
  return kPalette[std::size_t(((number % kCameraColours) + kCameraColours) % kCameraColours)];
}

const char* nameOf(SourceRole role) {
  switch (role) {
    case SourceRole::ownCover:
      return "cover";
    case SourceRole::otherHand:
      return "other hand";
    case SourceRole::panorama:
      return "panorama";
    case SourceRole::notACamera:
      break;
  }
  return "";
}

SourceColours::SourceColours(const Layout& layout) : number_(layout.cameras.size(), kCameraColours) {
  const CoverPlaces covers(layout);
  for (std::size_t camera = 0; camera < number_.size(); ++camera) {
    std::array<double, kCameraColours> cost{};
    const auto avoid = [&](const Piece& other, double weight) {
      const std::uint8_t taken = number_[std::size_t(other.camera)];
      if (taken == kCameraColours || std::size_t(other.camera) == camera) return;
      for (int n = 0; n < kCameraColours; ++n) cost[std::size_t(n)] += weight * likeness(n, taken);
    };
    for (std::size_t at = covers.start[camera]; at < covers.start[camera + 1]; ++at) {
      const auto& [cover, piece] = covers.places[at];
      const std::size_t count = cover->pieces.size();
      for (const Piece& other : cover->pieces) avoid(other, 1);
      avoid(cover->pieces[(piece + 1) % count], kNextToEachOther);
      avoid(cover->pieces[(piece + count - 1) % count], kNextToEachOther);
    }
    // Cameras that nothing decides for, such as those of panoramas, take turns.
    const auto least = std::ranges::min_element(cost);
    number_[camera] = *least == *std::ranges::max_element(cost) ? std::uint8_t(camera % kCameraColours)
                                                                : std::uint8_t(least - cost.begin());
  }
}

Rgba8 SourceColours::of(PixelSource source) const {
  if (source == kSourceHole) return kOpenHoleColour;
  if (source == kSourceInvented) return kInventedColour;
  if (source == kSourceLocal) return kLocalColour;
  if (source == kSourceBackground || std::size_t(cameraOf(source)) >= number_.size())
    return kBackgroundColour;
  return cameraColour(number_[std::size_t(cameraOf(source))]);
}

std::string sourceName(const Layout& layout, PixelSource source) {
  if (source == kSourceHole) return "hole";
  if (source == kSourceInvented) return "filled hole";
  if (source == kSourceLocal) return "local geometry";
  if (source == kSourceBackground || std::size_t(cameraOf(source)) >= layout.cameras.size())
    return "background";
  const int number = cameraOf(source);
  const LayoutCamera& camera = layout.cameras[std::size_t(number)];
  const double towards = std::fmod(degrees(camera.lowAzimuth + camera.fovRadians / 2) + 360, 360);
  if (camera.id.corner != kFreeCorner) return fmt::format("camera {}, looks to {:.0f}°", number, towards);
  const auto apv = layout.spec.freeApvs.find(camera.id.i);
  const bool traditional = apv != layout.spec.freeApvs.end() && apv->second.traditional();
  return fmt::format("{} {}, looks to {:.0f}°", traditional ? "panorama" : "free APV", camera.id.i, towards);
}

SourceRoles::SourceRoles(const Layout& layout, const PerspectiveView& view) {
  const auto region = layout.regionAt(glm::dvec2(view.eye));
  if (!region) return;
  known_ = true;
  const Region& home = layout.regions[std::size_t(*region)];
  const Cover& chosen = chooseCover(home, sectorOf(view));
  for (const Cover& cover : home.covers)
    for (const Piece& piece : cover.pieces) (&cover == &chosen ? own_ : other_).push_back(piece.camera);
  std::ranges::sort(own_), std::ranges::sort(other_);
}

SourceRole SourceRoles::of(PixelSource source) const {
  if (!isCamera(source)) return SourceRole::notACamera;
  if (!known_ || std::ranges::binary_search(own_, cameraOf(source))) return SourceRole::ownCover;
  return std::ranges::binary_search(other_, cameraOf(source)) ? SourceRole::otherHand : SourceRole::panorama;
}

std::vector<SourceShare> sourceShares(const Frame& frame, const SourceRoles& roles) {
  std::vector<std::uint32_t> counts(std::size_t(std::numeric_limits<PixelSource>::max()) + 1);
  for (const PixelSource source : frame.source.pixels) ++counts[source];
  std::vector<SourceShare> shares;
  for (std::size_t s = 0; s < counts.size(); ++s) {
    if (counts[s] == 0) continue;
    const auto source = PixelSource(s);
    shares.push_back({source, roles.of(source), double(counts[s]) / double(frame.source.pixels.size())});
  }
  std::ranges::stable_sort(shares, std::ranges::greater{}, &SourceShare::share);
  return shares;
}

ColourImage sourcePicture(const Frame& frame, const SourceColours& colours, const SourceRoles& roles) {
  struct Look {
    Rgba8 colour;
    SourceRole role;
    double least, gain;  // the factor by the picture's lightness
  };
  std::map<PixelSource, Look> looks;
  ColourImage out(frame.source.width, frame.source.height);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const PixelSource source = frame.source.at(x, y);
      auto found = looks.find(source);
      if (found == looks.end()) {
        const bool local = source == kSourceLocal, camera = isCamera(source);
        found = looks
                    .emplace(source, Look{colours.of(source), roles.of(source),
                                          local    ? 0.8
                                          : camera ? 0.86
                                                   : 1,
                                          local    ? 0.4
                                          : camera ? 0.28
                                                   : 0.0})
                    .first;
      }
      const auto& [colour, role, least, gain] = found->second;
      out.at(x, y) = withSign(shaded(colour, least + gain * luma(frame.colour.at(x, y))), role, x, y);
    }
  return out;
}

ColourImage sourceSwatch(PixelSource source, const SourceColours& colours, const SourceRoles& roles,
                         int side) {
  ColourImage out(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) out.at(x, y) = withSign(colours.of(source), roles.of(source), x, y);
  return out;
}

ColourImage holePicture(const Frame& frame) {
  ColourImage out(frame.source.width, frame.source.height);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    const PixelSource source = frame.source.pixels[i];
    const auto grey = std::uint8_t(std::lround(110 * luma(frame.colour.pixels[i])));
    out.pixels[i] = source == kSourceHole       ? Rgba8(255)
                    : source == kSourceInvented ? kInventedColour
                                                : Rgba8(grey, grey, grey, 255);
  }
  return out;
}

}  // namespace acentric
