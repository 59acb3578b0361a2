#include "engine/scene/import_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/base/file.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

/// A folder that is nobody else's, for machines whose user has no cache: gone when the machine tidies up.
std::optional<fs::path> temporaryCacheFolder() {
  std::error_code error;
  const fs::path folder =
      fs::temp_directory_path(error) / fmt::format("acentric-{}", static_cast<unsigned>(::geteuid()));
  if (error) return std::nullopt;
  (void)::mkdir(folder.c_str(), 0700);
  struct stat status {};
  const bool own = ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
                   status.st_uid == ::geteuid() && (status.st_mode & 077) == 0;
  if (!own || ::access(folder.c_str(), W_OK | X_OK) != 0) return std::nullopt;
  return folder;
}

bool canBeWritten(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  return !error && ::access(folder.c_str(), W_OK | X_OK) == 0;
}

constexpr std::string_view kScenes = "scenes";

fs::path usualFolder() { return userCacheFolder() / kScenes; }

}  // namespace

fs::path keptFolder(std::string_view name) {
  const fs::path usual = userCacheFolder() / name;
  if (canBeWritten(usual)) return usual;
  const auto temporary = temporaryCacheFolder();
  return temporary ? *temporary / name : usual;
}

fs::path importCacheFolder(const ImportHost& host) {
  return host.cacheFolder.empty() ? keptFolder(kScenes) : host.cacheFolder;
}

std::optional<std::string> importCacheNotice(const ImportHost& host) {
  const fs::path folder = importCacheFolder(host);
  if (!host.cacheFolder.empty() || folder == usualFolder()) return std::nullopt;
  return fmt::format("{} cannot be written: imports are kept in {}", usualFolder().string(), folder.string());
}

}  // namespace acentric
