#pragma once
/// A bundle: a baked project as a folder of files that any web server or program can serve, with nothing but
/// what a runtime needs (FORMAT.md). This is its index as a value; the files that it names are read and
/// written elsewhere.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/hash.h"
#include "engine/layout/layout.h"
#include "engine/scene/flat_mirrors.h"
#include "engine/scene/scene.h"
#include "engine/view/view_settings.h"

namespace acentric {

inline constexpr const char* kBundleFormat = "acentric bundle";
inline constexpr int kBundleVersion = 4;
inline constexpr const char* kBundleIndex = "bundle.json";

/// A file of the bundle.
struct BundleFile {
  std::string path;  ///< within the folder, with '/'
  std::uint64_t bytes = 0;
  ContentKey hash;  ///< XXH3-128 of its bytes
  bool operator==(const BundleFile&) const = default;
};

struct BundleCapture {
  BundleFile file;
  int columns = 0, rows = 0;
  std::uint64_t samples = 0, reflections = 0;
  bool operator==(const BundleCapture&) const = default;
};

/// The renditions of one camera; none where it was not baked.
struct BundleCamera {
  double topElevation = 0, bottomElevation = 0;  ///< radians
  std::optional<BundleCapture> full, coarse;
  bool operator==(const BundleCamera&) const = default;
};

struct BundleLocal {
  BundleFile file;
  std::uint64_t triangles = 0;
  bool operator==(const BundleLocal&) const = default;
};

struct BundleTexture {
  BundleFile file;  ///< PNG, 8-bit RGBA, straight alpha, sRGB
  int width = 0, height = 0;
  Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
  bool nearest = false;
  bool operator==(const BundleTexture&) const = default;
};

struct BundlePose {
  glm::dvec3 eye{0};
  double yaw = 0, pitch = 0;  ///< radians
  double seconds = 0;         ///< since a path began
  bool operator==(const BundlePose&) const = default;
};

struct BundleBookmark {
  std::string name;
  int storey = 0;
  BundlePose pose;
  double fov = 0;  ///< radians, horizontal
  bool operator==(const BundleBookmark&) const = default;
};

struct BundlePath {
  std::string name;
  int storey = 0;
  std::vector<BundlePose> poses;
  bool operator==(const BundlePath&) const = default;
};

struct BundleStorey {
  std::string name;
  /// Regions and cameras as a renderer needs them, without a lattice: of a camera's eight roles only the
  /// number counts, the bit of its samples; the spec has only heights, near band and outline.
  Layout layout;
  glm::dvec2 start{0};
  double startYaw = 0;                            ///< radians
  std::vector<BundleCamera> cameras;              ///< by Layout::cameras
  std::vector<std::optional<BundleLocal>> local;  ///< by region; none where nothing is near
  std::vector<std::vector<int>> neighbours;       ///< by region: those that touch it
};

/// What the project uses: a runtime can leave away what nothing calls for.
struct BundleFeatures {
  bool layered = false;     ///< captures with several samples in a pixel
  bool blended = false;     ///< samples or near surfaces with alpha < 1
  bool mirrors = false;     ///< captures with reflections
  bool background = false;  ///< captures with runs of the background
  bool light = false;       ///< baked to near surfaces
  bool operator==(const BundleFeatures&) const = default;
};

struct Bundle {
  std::string generator, name;
  glm::dvec3 origin{0};  ///< of positions in the model, metres
  float exposure = 1;
  double fov = 0;  ///< radians, horizontal, that the walk begins with
  ViewSettings view;
  Sky sky;
  Bounds bounds;
  BundleFeatures features;
  std::vector<BundleTexture> textures;
  std::vector<Material> materials;  ///< textures by number in `textures`
  std::vector<MirrorPlane> mirrors;
  std::vector<BundleStorey> storeys;
  int storey = 0;  ///< where the walk begins
  std::vector<BundleBookmark> bookmarks;
  std::vector<BundlePath> paths;
};

/// bundle.json: the same value gives the same text.
std::string formatBundle(const Bundle& bundle);

}  // namespace acentric
