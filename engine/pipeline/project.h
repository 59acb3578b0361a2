#pragma once
/// Project: all that the designer decides, as a plain value. File: `*.acentric.json`, schema:
/// schemas/project-1.schema.json.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/bake/bake_settings.h"
#include "engine/layout/layout_spec.h"
#include "engine/scene/effect_plan.h"
#include "engine/scene/import.h"
#include "engine/view/view_settings.h"

namespace acentric {

/// Where the walk begins, and how it looks.
struct Spawn {
  glm::dvec2 position{0};  ///< plan, metres
  double yawRadians = 0;
  bool operator==(const Spawn&) const = default;
};

/// How many triangles a region's local geometry may have, and what is done where it has more.
struct TriangleBudget {
  int trianglesPerRegion = 0;     ///< 0 = no limit
  double maxErrorMetres = 0.005;  ///< that simplified surfaces may lie from the scene's
  bool simplify = false;          ///< simplify regions above the limit; else they are only reported

  Status check() const;
  bool simplifies() const { return simplify && trianglesPerRegion > 0; }
  bool operator==(const TriangleBudget&) const = default;
};

struct Project {
  std::filesystem::path scene;  ///< relative to the project file's folder
  ImportOptions import;
  EffectOverrides effects;
  LayoutSpec layout;
  BakeSettings bake;
  TriangleBudget budget;
  ViewSettings view;
  double fovDegrees = 60;  ///< of the walk
  float exposure = 1;
  Spawn spawn;

  Status check() const;
  bool operator==(const Project&) const = default;
};

/// Stable key order and formatting, so that projects diff well.
std::string formatProject(const Project& project);
/// `where` names the file in messages. Unknown keys, wrong types, bad values, absolute paths: refused with a
/// JSON pointer.
Result<Project> parseProject(const std::string& text, const std::string& where);

Result<Project> loadProject(const std::filesystem::path& path);
Status saveProject(const Project& project, const std::filesystem::path& path);

/// The published JSON Schema (draft 7) as text.
const char* projectSchema();

/// "gallery.acentric.json" -> "gallery.captures" beside it: where captures are kept.
std::filesystem::path captureFolderFor(const std::filesystem::path& projectPath);

}  // namespace acentric
