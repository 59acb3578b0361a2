#pragma once
/// Bookmarks and paths of a project file. For project_file.cpp.

#include <nlohmann/json_fwd.hpp>

#include "engine/pipeline/project.h"

namespace acentric {

/// Adds "bookmarks" and "paths" where there are any.
void addWalks(const Project& project, nlohmann::ordered_json& json);
/// From JSON that the schema allows; the storeys have been read. Throws std::runtime_error where a storey's
/// name is none.
void readWalks(const nlohmann::ordered_json& json, Project& project);
/// Names that tell them apart, storeys that are there, numbers in range; with a JSON pointer.
Status checkWalks(const Project& project);

/// Degrees to nine decimals: angles then survive saving and reading unchanged.
double tidyDegrees(double angleRadians);

}  // namespace acentric
