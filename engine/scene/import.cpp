#include "engine/scene/import.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>

#include "engine/base/file.h"
#include "engine/scene/import_cache.h"
#include "engine/scene/import_process.h"
#include "engine/scene/references.h"
#include "engine/scene/scene_file.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

constexpr const char* kEntryExtension = ".acscene";
/// Raised whenever the same file would import to another scene than before.
constexpr std::uint32_t kImportVersion = 3;

/// Entries are found by the model file's content; the files that it names are then compared one by one.
/// What may be read depends on where the model lies.
fs::path entryFor(const fs::path& folder, const fs::path& path, const ContentKey& model,
                  const ImportOptions& options) {
  Hasher hasher;
  hasher.text("acentric import")
      .value(kImportVersion)
      .value(kSceneFileVersion)
      .value(model.high)
      .value(model.low)
      .text(path.parent_path().lexically_relative(readableFolderOf(path)).generic_string());
  options.addTo(hasher);
  return folder / (hasher.finish().toHex() + kEntryExtension);
}

/// Names the entry that a path was last imported to.
fs::path pointerFor(const fs::path& folder, const fs::path& model, const ImportOptions& options) {
  Hasher hasher;
  hasher.text("acentric last import").text(model.string());
  options.addTo(hasher);
  return folder / (hasher.finish().toHex() + ".last");
}

/// A convenience: that it cannot be written is no reason to fail.
void noteLastImport(const fs::path& pointer, const fs::path& entry) {
  const std::string name = entry.filename().string();
  if (const auto known = readText(pointer, 4096); !known || *known != name)
    (void)writeTextAtomically(pointer, name);
}

Status checkModel(const fs::path& path) {
  std::error_code error;
  const auto type = fs::status(path, error).type();
  if (type == fs::file_type::not_found) return fail(ErrorKind::notFound, "does not exist", path.string());
  if (type == fs::file_type::directory)
    return fail(ErrorKind::invalidArgument, "is a folder; name the model file in it", path.string());
  if (type != fs::file_type::regular)
    return fail(ErrorKind::unreadable, "is not a regular file", path.string());
  return {};
}

/// Nothing where there is no entry, or a damaged or outdated one: the caller imports afresh.
ScenePtr fromCache(const fs::path& entry, const fs::path& model) {
  std::error_code error;
  if (!fs::exists(entry, error)) return nullptr;
  bool current = false;
  auto file = readSceneFile(entry, [&](const std::vector<Dependency>& dependencies) {
    for (const Dependency& dependency : dependencies)
      if (!unchanged(dependency, model.parent_path())) return false;
    return current = true;
  });
  if (!file || !current) return nullptr;
  file->scene.name = model.stem().string();  // the same bytes may lie under another name
  return std::make_shared<const Scene>(std::move(file->scene));
}

/// The temporary that the importer writes, gone when this goes unless it was put in place.
class Temporary {
 public:
  explicit Temporary(const fs::path& folder) {
    static std::atomic<unsigned> counter{0};
    path_ = folder / fmt::format("{}import-{}{}", temporaryNameStart(), counter++, kEntryExtension);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    std::error_code error;
    fs::remove(path_, error);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

ImportOptions permitted(ImportOptions options, const ImportHost& host) {
  options.outsideFiles = host.outsideFiles;
  return options;
}

Result<ScenePtr> importUnguarded(const fs::path& asked, const ImportOptions& options, const ImportHost& host,
                                 const Progress& progress, std::stop_token stop) {
  if (auto status = options.check(); !status) return tl::unexpected(status.error());
  if (auto status = checkModel(asked); !status) return tl::unexpected(status.error());
  std::error_code error;
  const fs::path path = fs::weakly_canonical(asked, error);
  const fs::path folder = importCacheFolder(host);
  fs::create_directories(folder, error);
  if (error)
    return fail(ErrorKind::unreadable,
                "imports cannot be kept here: " + error.message() +
                    "; set XDG_CACHE_HOME to a folder that can be written",
                folder.string());
  removeStaleTemporaries(folder);
  if (progress) progress({0, 0, "looking in the cache"});
  const auto content = hashFile(path);
  if (!content) return tl::unexpected(content.error());
  const fs::path entry = entryFor(folder, path, *content, options);
  if (host.useCache)
    if (ScenePtr scene = fromCache(entry, path)) {
      noteLastImport(pointerFor(folder, path, options), entry);
      return scene;
    }

  const auto program = importerProgram(host);
  if (!program) return tl::unexpected(program.error());
  const Temporary temporary(folder);
  if (auto status = runImporter(*program, path, options, temporary.path(), host, progress, stop); !status) {
    if (status.error().where == path.string()) status.error().where = asked.string();
    return tl::unexpected(status.error());
  }
  if (progress) progress({0, 0, "taking the scene over"});
  auto file = readSceneFile(temporary.path(), nullptr);
  if (!file)
    return fail(ErrorKind::internal, "the importer handed over a broken scene: " + file.error().message,
                asked.string());
  // A model that changed while it was read must not be found under the old content's key.
  const auto after = hashFile(path);
  if (host.useCache && after && *after == *content) {
    fs::rename(temporary.path(), entry, error);
    if (!error) noteLastImport(pointerFor(folder, path, options), entry);
  }
  return std::make_shared<const Scene>(std::move(file->scene));
}

}  // namespace

Result<ScenePtr> importScene(const fs::path& path, const ImportOptions& options, const ImportHost& host,
                             const Progress& progress, std::stop_token stop) {
  try {
    return importUnguarded(path, permitted(options, host), host, progress, std::move(stop));
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "the scene does not fit in memory", path.string());
  } catch (const std::exception& error) {
    return fail(ErrorKind::internal, error.what(), path.string());
  }
}

ScenePtr lastImported(const fs::path& asked, const ImportOptions& given, const ImportHost& host) {
  const ImportOptions options = permitted(given, host);
  std::error_code error;
  const fs::path model = fs::weakly_canonical(asked, error);
  const fs::path folder = importCacheFolder(host);
  const auto name = readText(pointerFor(folder, model, options), 4096);
  if (error || !name || fs::path(*name).has_parent_path()) return nullptr;
  auto file = readSceneFile(folder / *name, nullptr);
  if (!file) return nullptr;
  file->scene.name = model.stem().string();
  return std::make_shared<const Scene>(std::move(file->scene));
}

std::vector<fs::path> importedFiles(const fs::path& asked, const ImportOptions& given,
                                    const ImportHost& host) {
  const ImportOptions options = permitted(given, host);
  std::error_code error;
  const fs::path model = fs::weakly_canonical(asked, error);
  const auto content = hashFile(model);
  if (error || !content || !host.useCache) return {};
  std::vector<fs::path> files;
  (void)readSceneFile(entryFor(importCacheFolder(host), model, *content, options),
                      [&](const std::vector<Dependency>& dependencies) {
                        files.push_back(model);
                        for (const Dependency& dependency : dependencies)
                          files.push_back(model.parent_path() / dependency.path);
                        return false;
                      });
  return files;
}

Status shareImported(const fs::path& asked, const ImportOptions& given, const ImportHost& host,
                     const fs::path& folder) {
  const ImportOptions options = permitted(given, host);
  std::error_code error;
  const fs::path model = fs::weakly_canonical(asked, error);
  const auto content = hashFile(model);
  if (!content) return tl::unexpected(content.error());
  const fs::path own = importCacheFolder(host);
  const fs::path entry = entryFor(own, model, *content, options);
  const fs::path shared = entryFor(folder, model, *content, options);
  if (own == folder) return {};
  return replaceFileAtomically(shared, [&](const fs::path& temporary) -> Status {
    fs::copy_file(entry, temporary, error);
    if (!error) return {};
    return fail(error == std::errc::no_space_on_device ? ErrorKind::outOfSpace : ErrorKind::unreadable,
                "the imported scene cannot be copied: " + error.message(), shared.string());
  });
}

}  // namespace acentric
