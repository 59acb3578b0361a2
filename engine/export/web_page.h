#pragma once
/// The page that walks through a bundle in a browser: its files, as web/ builds them, put beside a bundle, or
/// both as one HTML file.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/base/result.h"

namespace acentric {

/// Its files. The entry comes last: a page without the others must not open.
inline constexpr std::array kPageFiles = {"viewer.css", "viewer.js", "index.html"};

/// Where the built page is, seen from a program of ours: share/acentric/web beside an installed one's folder,
/// or web/dist of the sources that it was built from. Fails with how to make it.
Result<std::filesystem::path> findWebPage(const std::filesystem::path& program);

/// What those see who are sent the page's address.
struct PageTitle {
  std::string name;       ///< of the walk
  std::string poster;     ///< a picture beside the page; none: empty
  std::string walk = {};  ///< a walk's file beside the page, which it opens unless its address names another
};

/// Copies the page into the folder of a bundle, index.html last.
Status addWebPage(const std::filesystem::path& page, const std::filesystem::path& bundle,
                  const PageTitle& title);

/// Larger pages take long to open, and phones may not open them at all.
inline constexpr std::uint64_t kHandySingleFile = std::uint64_t(32) << 20;
/// Browsers hold no longer texts.
inline constexpr std::uint64_t kLargestSingleFile = std::uint64_t(256) << 20;

/// Writes the page with all files of the bundle in it; returns its size. Fails above kLargestSingleFile.
Result<std::uint64_t> writeSingleFile(const std::filesystem::path& page, const std::filesystem::path& bundle,
                                      const std::filesystem::path& output, const PageTitle& title);

}  // namespace acentric
