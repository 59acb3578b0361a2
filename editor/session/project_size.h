#pragma once
/// How much memory a project value takes, for the history's limit.

#include <cstddef>

#include "engine/pipeline/project.h"

namespace acentric::editor {

/// Bytes: the value, its strings, outlines and sets of cells, with what a node of a set costs beside its
/// content.
std::size_t approximateBytes(const Project& project);

}  // namespace acentric::editor
