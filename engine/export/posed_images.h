#pragma once
/// Pictures with the cameras that took them, in the formats of programs that make scenes of such: COLMAP's
/// text files, nerfstudio's transforms.json, Seurat's manifest; and a list of panoramas. Places are ours:
/// metres, Z up, relative to the project's origin.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/geometry/perspective_view.h"
#include "engine/image/image.h"

namespace acentric {

struct PosedImage {
  PerspectiveView view;
  std::string colour;  ///< file, relative to the folder of the description
  std::string depth;   ///< the same; along the view's axis
  int place = 0;       ///< pictures from one place share its number
};

struct ColouredPoint {
  glm::dvec3 place{0};
  Rgba8 colour{0};
};

/// transforms.json: one pinhole camera for all, poses as camera to world with OpenGL's axes; depth in units
/// of `depthUnit` metres. All pictures have one size and field of view.
std::string nerfstudioTransforms(std::span<const PosedImage> images, double depthUnit,
                                 const std::string& points);
/// cameras.txt, images.txt and points3D.txt in `folder`, which is there.
Status writeColmap(std::span<const PosedImage> images, std::span<const ColouredPoint> points,
                   const std::filesystem::path& folder);
/// A view group for each place, about the head box's centre; depth is EYE_Z in channel Z.
std::string seuratManifest(std::span<const PosedImage> images, const glm::dvec3& headBoxCentre);
/// Points as PLY, ASCII.
Status writePointsPly(std::span<const ColouredPoint> points, const std::filesystem::path& file);

struct PosedPanorama {
  std::string file;  ///< relative to the folder of the list
  int region = 0;
  glm::dvec3 eye{0};
};

/// panoramas.json: what they are, and where each was taken. `exposure`: what radiance is multiplied with
/// before it is shown.
std::string panoramaList(std::span<const PosedPanorama> panoramas, double exposure);

/// One channel of 16 bits, in units of `unit` metres; what is farther than that holds, and infinity, is 0.
Status writeDepthPng(const FloatImage& metres, double unit, const std::filesystem::path& file);

}  // namespace acentric
