#pragma once
/// From a model file to a Scene. Parsing runs in a child process (the `acentric-importer` program) with
/// limits on time and memory, because parsers crash and hang on bad files; the child hands the Scene over as
/// a scene file in the cache. That cache is keyed by the content of every file read and by the options, so a
/// second open is fast. Vertices and triangles stay in that file, which is mapped.

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/base/physical_memory.h"
#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/scene/scene.h"

namespace acentric {

enum class UpAxis : std::uint8_t { guess, y, z };

/// Where the light on surfaces comes from.
enum class Lighting : std::uint8_t {
  guess,
  inTextures,  ///< colours are shown as they are, as of a photographed or scanned place: no lamp, no shadow
  computed     ///< also for materials that the file declares unlit
};

struct ImportOptions {
  double metresPerUnit = 0;   ///< 0 = guess (glTF: 1; others: by the file's unit, else by size)
  UpAxis up = UpAxis::guess;  ///< glTF: Y; others: by the file, else by level surfaces (up_axis_guess.h)
  bool defaultLight = true;   ///< add a sun and sky when the file has no light
  /// Guess: by the file's unlit materials, else by what textures and meshes look like (texture_light.h).
  Lighting lighting = Lighting::guess;
  /// What stands in several places is placed mesh by mesh as long as that gives no more triangles in all; of
  /// more, what has most stays instances. The host's to say.
  std::uint64_t flatTriangles = 2'000'000;
  /// Read files outside the model's own folder too. The host's to say (ImportHost), never a project file's.
  bool outsideFiles = false;

  Status check() const;
  void addTo(Hasher& hasher) const;
  bool operator==(const ImportOptions&) const = default;
};

/// How the child is run.
struct ImportHost {
  std::filesystem::path importer;     ///< empty = the one that came with this program
  std::filesystem::path cacheFolder;  ///< empty = userCacheFolder()/"scenes"
  double timeLimitSeconds = 600;
  /// That a scene may take: while it is read, and by what its file says of it, opened.
  std::size_t memoryLimitBytes = physicalMemory() / 4 * 3;
  bool useCache = true;
  bool outsideFiles = false;  ///< models may name files outside their own folder
};

Result<ScenePtr> importScene(const std::filesystem::path& path, const ImportOptions& options,
                             const ImportHost& host = {}, const Progress& progress = {},
                             std::stop_token stop = {});

/// The scene as this machine last imported it from `path`, which may be gone; null if it is not in the cache.
ScenePtr lastImported(const std::filesystem::path& path, const ImportOptions& options,
                      const ImportHost& host = {});

/// The model file and all that it names, as the cache knows them; none if it does not hold this scene. Who
/// keeps results of a scene can tell by them whether it may have changed.
std::vector<std::filesystem::path> importedFiles(const std::filesystem::path& path,
                                                 const ImportOptions& options, const ImportHost& host = {});

/// Puts what the cache holds of this scene, which was imported, into another folder as well: machines that
/// see that one take the scene from it, with `cacheFolder`, and need not be able to write there.
Status shareImported(const std::filesystem::path& path, const ImportOptions& options, const ImportHost& host,
                     const std::filesystem::path& folder);

/// What the child does, in this process: parse, check, convert. Only for the child and for tests of sound
/// files.
Result<Scene> parseScene(const std::filesystem::path& path, const ImportOptions& options);

/// The scene file (cache, hand-over): versioned, checksummed; the geometry of what is read is mapped.
Status writeSceneFile(const Scene& scene, const std::filesystem::path& path);
Result<Scene> readSceneFile(const std::filesystem::path& path);

}  // namespace acentric
