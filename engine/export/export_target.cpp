#include "engine/export/export_target.h"

#include <fmt/format.h>

#include <fstream>

namespace acentric {
namespace fs = std::filesystem;

Status checkExportTarget(const fs::path& folder, const std::string& index, const std::string& format,
                         const std::string& what) {
  constexpr std::size_t kBeginning = 200;
  std::error_code error;
  if (!fs::exists(folder, error)) return {};
  if (!fs::is_directory(folder, error))
    return fail(ErrorKind::invalidArgument, fmt::format("is no folder: name a new one for the {}", what),
                folder.string());
  if (fs::is_empty(folder, error)) return {};
  std::string text(kBeginning, '\0');
  std::ifstream file(folder / index, std::ios::binary);
  file.read(text.data(), std::streamsize(text.size()));
  text.resize(std::size_t(std::max<std::streamsize>(0, file.gcount())));
  std::string sought = fmt::format("\"format\":\"{}\"", format);
  std::erase(text, ' '), std::erase(sought, ' ');  // short objects are laid out without
  if (text.find(sought) != std::string::npos) return {};
  return fail(ErrorKind::invalidArgument,
              fmt::format("holds something that is no {}, and would be replaced: name a new folder", what),
              folder.string());
}

}  // namespace acentric
