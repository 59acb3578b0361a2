#include "editor/session/screenshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "editor/session/project_files.h"
#include "engine/base/contract.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPictureEnding = ".png";

std::string nameStart(const fs::path& projectFile) {
  std::string name = projectFile.filename().string();
  for (const char* ending : {kProjectEnding, kWalkEnding})
    if (name.ends_with(ending)) name.resize(name.size() - std::strlen(ending));
  return name + "-view-";
}

/// Of "START123.png"; 0 for other names.
int numberOf(const std::string& name, const std::string& start) {
  if (!name.starts_with(start) || !name.ends_with(kPictureEnding)) return 0;
  const std::string digits =
      name.substr(start.size(), name.size() - std::min(name.size(), start.size() + kPictureEnding.size()));
  const bool number =
      !digits.empty() && digits.size() <= 8 && digits.find_first_not_of("0123456789") == std::string::npos;
  return number ? std::stoi(digits) : 0;
}

}  // namespace

ColourImage splitPicture(const ColourImage& left, const ColourImage& right, double share) {
  require(left.width == right.width && left.height == right.height, "pictures of one size are split");
  ColourImage out = left;
  for (int y = 0; y < out.height; ++y)
    for (int x = std::clamp(int(share * out.width), 0, out.width); x < out.width; ++x)
      out.at(x, y) = right.at(x, y);
  return out;
}

fs::path nextScreenshot(const fs::path& projectFile) {
  const std::string start = nameStart(projectFile);
  int highest = 0;
  std::error_code error;
  for (fs::directory_iterator entry(projectFile.parent_path(), error), end; !error && entry != end;
       entry.increment(error))
    highest = std::max(highest, numberOf(entry->path().filename().string(), start));
  return projectFile.parent_path() / fmt::format("{}{:03}{}", start, highest + 1, kPictureEnding);
}

Result<fs::path> writeScreenshot(const ColourImage& picture, const fs::path& projectFile) {
  for (;;) {
    fs::path file = nextScreenshot(projectFile);
    // An empty file takes the name; the picture then replaces it as a whole.
    std::FILE* claim = std::fopen(file.c_str(), "wx");
    if (claim == nullptr) {
      if (errno == EEXIST) continue;  // another program was quicker
      return fail(ErrorKind::unreadable,
                  fmt::format("the picture cannot be written: {}", std::strerror(errno)), file.string());
    }
    std::fclose(claim);
    if (const Status written = writeColourImage(picture, file); !written) {
      std::error_code ignored;
      fs::remove(file, ignored);
      return tl::unexpected(written.error());
    }
    return file;
  }
}

}  // namespace acentric::editor
