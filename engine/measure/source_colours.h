#pragma once
/// Which camera painted a pixel, as colours and names. Colours differ for colour-blind eyes too, a camera
/// keeps its own wherever the eye goes, and cameras that one view shows beside each other get colours far
/// apart. What no camera painted has colours that no camera has.

#include <string>
#include <vector>

#include "engine/geometry/perspective_view.h"
#include "engine/layout/layout.h"
#include "engine/view/frame.h"

namespace acentric {

inline constexpr int kCameraColours = 10;
/// sRGB, opaque.
Rgba8 cameraColour(int number);
inline constexpr Rgba8 kLocalColour{128, 128, 128, 255};
inline constexpr Rgba8 kBackgroundColour{255, 255, 255, 255};
inline constexpr Rgba8 kInventedColour{255, 0, 200, 255};
inline constexpr Rgba8 kOpenHoleColour{0, 0, 0, 255};

/// What a camera is for an eye in a region.
enum class SourceRole : std::uint8_t {
  ownCover,   ///< of the cover that the view has chosen
  otherHand,  ///< of another cover of the region, behind it
  panorama,   ///< a traditional panorama that helps out behind both
  notACamera,
};

/// "cover", "other hand", "panorama"; nothing for what is no camera.
const char* nameOf(SourceRole role);

class SourceColours {
 public:
  explicit SourceColours(const Layout& layout);
  Rgba8 of(PixelSource source) const;

 private:
  std::vector<std::uint8_t> number_;  ///< of cameraColour, by camera
};

/// "camera 12, looks to 75°", "panorama 1, looks to 90°", "local geometry", "filled hole".
std::string sourceName(const Layout& layout, PixelSource source);

/// By camera what it is for a view; nothing is asked of sources that are not cameras.
class SourceRoles {
 public:
  /// An eye outside all regions: every camera is one of its own cover.
  SourceRoles(const Layout& layout, const PerspectiveView& view);
  SourceRole of(PixelSource source) const;

 private:
  std::vector<int> own_, other_;  ///< sorted
  bool known_ = false;
};

struct SourceShare {
  PixelSource source = kSourceHole;
  SourceRole role = SourceRole::notACamera;
  double share = 0;  ///< of the frame's pixels
};
/// What a frame's pixels came from, the most first.
std::vector<SourceShare> sourceShares(const Frame& frame, const SourceRoles& roles);

/// The colour of each pixel's source, with as much of the picture's lightness as leaves them apart: what
/// local geometry painted keeps its shading. Cameras of the other hand are dotted, panoramas striped.
ColourImage sourcePicture(const Frame& frame, const SourceColours& colours, const SourceRoles& roles);
/// The same signs on a small square, for legends.
ColourImage sourceSwatch(PixelSource source, const SourceColours& colours, const SourceRoles& roles,
                         int side);

/// The picture in dim grey; holes in white, those that were filled in kInventedColour.
ColourImage holePicture(const Frame& frame);

}  // namespace acentric
