#pragma once
/// The bundle that another one takes the place of: captures in it that are the same need not be made again.
/// Names of their files say what they are made of.

#include <filesystem>
#include <map>
#include <string>

#include "engine/export/bundle.h"

namespace acentric {

/// Of a camera's files: a hash of all that they are made of. Every bit of colours (quality 100) is kept of
/// all roles, and at no exposure.
std::string captureName(const ContentKey& key, std::uint8_t roles, int colourQuality, float exposure);

class FormerBundle {
 public:
  /// One that is not there, or cannot be read, has nothing.
  explicit FormerBundle(const std::filesystem::path& folder);

  const BundleFeatures& features() const { return features_; }
  /// Gives the bundle in `folder` the renditions of a camera, the best of which has this path, if they are
  /// here and whole. Any thread.
  bool give(const std::string& path, const std::filesystem::path& folder, BundleCamera& camera) const;

 private:
  bool give(const BundleFile& file, const std::filesystem::path& folder) const;

  std::filesystem::path folder_;
  BundleFeatures features_;
  std::map<std::string, BundleCamera> cameras_;  ///< by the path of their best rendition
};

}  // namespace acentric
