#pragma once
/// Project: all that the designer decides, as a plain value. File: `*.acentric.json`, schema:
/// schemas/project-1.schema.json.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/bake/bake_settings.h"
#include "engine/layout/layout_spec.h"
#include "engine/pipeline/camera_path.h"
#include "engine/scene/effect_plan.h"
#include "engine/scene/import.h"
#include "engine/view/view_settings.h"

namespace acentric {

/// Where the walk begins, and how it looks.
struct Spawn {
  glm::dvec2 position{0};  ///< plan, metres
  double yawRadians = 0;
  bool stored = true;  ///< false: the file keeps none; opening it finds one, and saving it keeps none
  bool operator==(const Spawn&) const = default;
};

/// A walk plane with its layout. Storeys share the scene, its captures' folder and all settings.
struct Storey {
  std::string name;  ///< of no other storey
  LayoutSpec layout;
  Spawn spawn;
  /// Ground that can be walked, of which the layout has a part; empty: the layout's outline is all of it.
  Outline walkable;
  bool operator==(const Storey&) const = default;
};
inline constexpr int kMaxStoreys = 200;

/// How many triangles a region's local geometry may have, and what is done where it has more.
struct TriangleBudget {
  int trianglesPerRegion = 0;     ///< 0 = no limit
  double maxErrorMetres = 0.005;  ///< that simplified surfaces may lie from the scene's
  bool simplify = false;          ///< simplify regions above the limit; else they are only reported

  Status check() const;
  bool simplifies() const { return simplify && trianglesPerRegion > 0; }
  bool operator==(const TriangleBudget&) const = default;
};

/// A view that is gone back to by its name.
struct Bookmark {
  std::string name;  ///< of no other bookmark
  int storey = 0;    ///< where one stands
  glm::dvec3 eye{0};
  double yawRadians = 0, pitchRadians = 0;
  double fovDegrees = 60;  ///< horizontal
  bool operator==(const Bookmark&) const = default;
};
inline constexpr std::size_t kMaxBookmarks = 1000;

/// A walk that was recorded or drawn.
struct WalkPath {
  std::string name;  ///< of no other path
  int storey = 0;    ///< on which it begins
  CameraPath path;   ///< with times, unless it is a single pose
  bool operator==(const WalkPath&) const = default;
};
inline constexpr std::size_t kMaxPaths = 200, kMaxPathPoses = 10000;

/// Relative, and without "..": what a project may state as its model. One that lies elsewhere is brought into
/// the project's folder (collect_model.h).
bool liesWithin(const std::filesystem::path& scene);

struct Project {
  std::filesystem::path scene;  ///< relative to the project file's folder, and within it
  ImportOptions import;
  EffectOverrides effects;
  std::vector<Storey> storeys{{"floor", {}, {}, {}}};  ///< at least one
  int storey = 0;  ///< the one that is worked on, and where the walk begins
  BakeSettings bake;
  TriangleBudget budget;
  ViewSettings view;
  double fovDegrees = 60;  ///< of the walk
  float exposure = 1;
  std::vector<Bookmark> bookmarks;
  std::vector<WalkPath> paths;

  const Storey& current() const { return storeys[std::size_t(storey)]; }
  Storey& current() { return storeys[std::size_t(storey)]; }
  const LayoutSpec& layout() const { return current().layout; }
  LayoutSpec& layout() { return current().layout; }
  const Spawn& spawn() const { return current().spawn; }
  Spawn& spawn() { return current().spawn; }

  Status check() const;
  bool operator==(const Project&) const = default;
};

/// Stable key order and formatting, so that projects diff well.
std::string formatProject(const Project& project);
/// `where` names the file in messages. Unknown keys, wrong types, bad values, a model outside the
/// project's folder: refused with a JSON pointer.
Result<Project> parseProject(const std::string& text, const std::string& where);

Result<Project> loadProject(const std::filesystem::path& path);
Status saveProject(const Project& project, const std::filesystem::path& path);

/// The published JSON Schema (draft 7) as text.
const char* projectSchema();

/// "gallery.acentric.json" -> "gallery.captures" beside it: where captures are kept.
std::filesystem::path captureFolderFor(const std::filesystem::path& projectPath);

}  // namespace acentric
