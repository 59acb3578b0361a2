#pragma once
/// From what a reader took out of a file to a Scene that keeps its promises: metres, Z up, project origin,
/// sound triangles only, normals and tangents filled, light in it, key computed. Private to this folder.

#include "engine/scene/source_scene.h"

namespace acentric {

Result<Scene> finishScene(SourceScene source, const std::string& name, const ImportOptions& options,
                          const Progress& progress);

}  // namespace acentric
