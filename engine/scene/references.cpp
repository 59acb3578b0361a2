#include "engine/scene/references.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "engine/base/file.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

std::string trimmed(std::string_view text) {
  const auto isTrim = [](char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '"' || c == '\0';
  };
  while (!text.empty() && isTrim(text.front())) text.remove_prefix(1);
  while (!text.empty() && isTrim(text.back())) text.remove_suffix(1);
  return std::string(text);
}

/// base / relative, where each part may differ in letter case.
std::optional<fs::path> findIgnoringCase(const fs::path& base, const fs::path& relative) {
  fs::path at = base;
  std::error_code error;
  for (const fs::path& part : relative) {
    if (part.empty() || part == ".") continue;
    if (part == ".." || fs::exists(at / part, error)) {
      at /= part;
      continue;
    }
    const std::string wanted = lowerCase(part.string());
    std::optional<fs::path> found;
    for (const auto& entry : fs::directory_iterator(at, error))
      if (lowerCase(entry.path().filename().string()) == wanted) found = entry.path();
    if (!found) return std::nullopt;
    at = *found;
  }
  return at;
}

bool isBelow(const fs::path& path, const fs::path& folder) {
  const auto [mismatch, unused] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return mismatch == folder.end() || (std::next(mismatch) == folder.end() && mismatch->empty());
}

bool isRegular(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool holdsProject(const fs::path& folder) {
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error))
    if (entry->path().native().ends_with(".acentric.json") && isRegular(entry->path())) return true;
  return false;
}

}  // namespace

fs::path readableFolderOf(const fs::path& model) {
  for (fs::path at = model.parent_path(); at.has_relative_path(); at = at.parent_path())
    if (at.parent_path().filename() == "models" && holdsProject(at.parent_path().parent_path())) return at;
  return model.parent_path();
}

References::References(const fs::path& model, bool allowOutside) : allowOutside_(allowOutside) {
  std::error_code error;
  model_ = fs::weakly_canonical(fs::absolute(model, error), error);
  folder_ = model_.parent_path();
  within_ = readableFolderOf(model_);
}

std::string References::keyFor(const fs::path& path) const {
  const fs::path relative = path.lexically_relative(folder_);
  const bool near = !relative.empty() && (isBelow(path, folder_) || isBelow(path, folder_.parent_path()));
  return (near ? relative : path).string();
}

bool References::mayRead(const fs::path& path) const {
  if (allowOutside_) return true;
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  return !error && isBelow(canonical, within_);
}

Error References::outside(const fs::path& path, std::string named) {
  std::error_code error;
  const fs::path leads = fs::weakly_canonical(path, error);
  return {
      ErrorKind::unsupported,
      fmt::format("lies outside the model's folder ({}) and is not read; bring it there, or allow it with "
                  "--outside-files",
                  (error ? path : leads).string()),
      std::move(named)};
}

Result<fs::path> References::find(std::string_view named) {
  std::string text = trimmed(named);
  std::replace(text.begin(), text.end(), '\\', '/');
  if (text.starts_with("file://")) text.erase(0, 7);
  if (text.empty() || text.find('\0') != std::string::npos || text.size() > 4096)
    return fail(ErrorKind::notFound, "is not a file name", text.substr(0, 80));
  fs::path path(text);
  std::error_code error;
  std::optional<fs::path> outside;
  if (path.is_absolute() && isRegular(path)) {
    if (mayRead(path)) {
      const fs::path canonical = fs::weakly_canonical(path, error);
      files_[keyFor(canonical)] = true;
      return canonical;
    }
    outside = path;
  }
  const bool foreign = path.is_absolute() || (text.size() > 1 && text[1] == ':');  // another machine's disk
  std::vector<fs::path> candidates;
  if (!foreign) candidates.push_back(path);
  candidates.push_back(path.filename());
  candidates.push_back(fs::path("textures") / path.filename());
  candidates.push_back(fs::path("../textures") / path.filename());
  for (const fs::path& candidate : candidates) {
    const auto found = findIgnoringCase(folder_, candidate);
    if (!found || !isRegular(*found)) continue;
    if (!mayRead(*found)) {
      if (!outside) outside = *found;
      continue;
    }
    const fs::path canonical = fs::weakly_canonical(*found, error);
    files_[keyFor(canonical)] = true;
    return canonical;
  }
  if (outside) return tl::unexpected(References::outside(*outside, text));
  if (!foreign) files_.try_emplace(path.lexically_normal().string(), false);
  return fail(ErrorKind::notFound, "does not exist", text);
}

Result<std::vector<std::byte>> References::read(std::string_view named, std::size_t maxBytes) {
  const auto path = find(named);
  if (!path) return tl::unexpected(path.error());
  return readFile(*path, maxBytes);
}

void References::noteRead(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  if (!error && canonical != model_) files_[keyFor(canonical)] = isRegular(canonical);
}

Result<std::vector<Dependency>> References::dependencies() const {
  std::vector<Dependency> all;
  for (const auto& [key, existed] : files_) {
    Dependency dependency;
    dependency.path = key;
    const fs::path path = folder_ / key;  // an absolute key replaces the folder
    struct stat status {};
    dependency.exists = existed;
    if (existed) {
      if (::stat(path.c_str(), &status) != 0)
        return fail(ErrorKind::unreadable, "vanished during the import", path.string());
      const auto content = hashFile(path);
      if (!content) return tl::unexpected(content.error());
      dependency.size = std::uint64_t(status.st_size);
      dependency.modifiedNanoseconds =
          std::int64_t(status.st_mtim.tv_sec) * 1'000'000'000 + status.st_mtim.tv_nsec;
      dependency.inode = status.st_ino;
      dependency.content = *content;
    }
    all.push_back(std::move(dependency));
  }
  return all;
}

bool unchanged(const Dependency& dependency, const fs::path& modelFolder) {
  const fs::path path = modelFolder / dependency.path;
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
  if (exists != dependency.exists) return false;
  if (!exists) return true;
  if (std::uint64_t(status.st_size) != dependency.size) return false;
  const std::int64_t modified = std::int64_t(status.st_mtim.tv_sec) * 1'000'000'000 + status.st_mtim.tv_nsec;
  if (modified == dependency.modifiedNanoseconds && status.st_ino == dependency.inode) return true;
  const auto content = hashFile(path);
  return content && *content == dependency.content;
}

}  // namespace acentric
