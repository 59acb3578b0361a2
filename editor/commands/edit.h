#pragma once
/// An edit: the project as it should be, and what to call that in the history.

#include <string>

#include "engine/pipeline/project.h"

namespace acentric::editor {

struct Edit {
  Project project;
  std::string label;
};

}  // namespace acentric::editor
