#include "editor/session/project_files.h"

#include "engine/base/file.h"
#include "engine/base/link_file.h"
#include "engine/export/bundle.h"
#include "engine/export/walk_read.h"
#include "engine/pipeline/collect_model.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostProjectBytes = std::size_t(64) << 20;

fs::path folderOf(const fs::path& file) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(file, error).parent_path(), error);
}

}  // namespace

bool isProjectFile(const fs::path& file) { return file.filename().string().ends_with(kProjectEnding); }

fs::path shippedWalkOf(const fs::path& file) {
  if (file.filename() == kBundleIndex) return file.parent_path();
  std::error_code error;
  const bool walk = fs::is_directory(file, error) || file.extension() == kWalkEnding || isBundle(file);
  if (!walk) return {};
  return file.has_filename() ? file : file.parent_path();  // "folder/"
}

fs::path suggestedProjectFile(const fs::path& model) {
  std::error_code error;
  const fs::path absolute = fs::absolute(model, error);
  return absolute.parent_path() / (absolute.stem().string() + kProjectEnding);
}

fs::path autosaveFileFor(const fs::path& projectFile) {
  fs::path file = projectFile;
  file += ".autosave";
  return file;
}

Status writeAutosave(const Project& project, const fs::path& projectFile) {
  return writeTextAtomically(autosaveFileFor(projectFile), formatProject(project));
}

void removeAutosave(const fs::path& projectFile) {
  std::error_code error;  // one that is not there is as good as removed
  fs::remove(autosaveFileFor(projectFile), error);
}

Result<std::optional<Project>> recoverableAutosave(const fs::path& projectFile, const Project& saved) {
  const fs::path file = autosaveFileFor(projectFile);
  std::error_code error;
  if (!fs::exists(file, error)) return std::optional<Project>();
  const auto text = readText(file, kMostProjectBytes);
  if (!text) return tl::unexpected(text.error());
  auto project = parseProject(*text, file.string());
  if (!project) return tl::unexpected(project.error());
  return *project == saved ? std::nullopt : std::optional(std::move(*project));
}

fs::path putAside(const fs::path& file) {
  fs::path aside = file;
  aside += ".damaged";
  std::error_code error;
  fs::rename(file, aside, error);
  return error ? fs::path() : aside;
}

fs::path freeCopyName(const fs::path& projectFile) {
  std::string stem = projectFile.filename().string();
  if (isProjectFile(projectFile)) stem.resize(stem.size() - std::string_view(kProjectEnding).size());
  std::error_code error;
  for (int number = 1;; ++number) {
    const std::string name = stem + (number == 1 ? " copy" : " copy " + std::to_string(number));
    fs::path file = projectFile.parent_path() / (name + kProjectEnding);
    if (!fs::exists(file, error)) return file;
  }
}

Result<Project> movedProject(const Project& project, const fs::path& from, const fs::path& to,
                             const ImportHost& host) {
  const fs::path model = folderOf(from) / project.scene;
  std::error_code error;
  if (folderOf(from) == folderOf(to) || !fs::exists(model, error)) return project;
  const std::vector<fs::path> files = importedFiles(model, project.import, host);
  const auto collected = collectModel(model, to, files, files.empty() ? Collect::link : Collect::files);
  if (!collected) return tl::unexpected(collected.error());
  Project moved = project;
  moved.scene = collected->scene;
  return moved;
}

Result<int> shareCaptures(const fs::path& from, const fs::path& to) {
  const fs::path source = captureFolderFor(from);
  const fs::path target = captureFolderFor(to);
  std::error_code error;
  if (source == target || !fs::is_directory(source, error)) return 0;
  fs::create_directories(target, error);
  if (error)
    return fail(ErrorKind::unreadable, trf("the folder cannot be made: {}", error.message()),
                target.string());
  int added = 0;
  fs::directory_iterator it(source, error);
  for (; !error && it != fs::directory_iterator(); it.increment(error)) {
    const std::string name = it->path().filename().string();
    std::error_code ignored;
    if (!it->is_regular_file(ignored) || name.starts_with(kTemporaryPrefix) ||
        fs::exists(target / name, ignored))
      continue;
    if (Status there = linkOrCopyFile(it->path(), target / name); !there)
      return tl::unexpected(there.error());
    ++added;
  }
  if (error) return fail(ErrorKind::unreadable, error.message(), source.string());
  return added;
}

}  // namespace acentric::editor
