#include "editor/commands/storey_edits.h"

#include <algorithm>
#include <vector>

#include "engine/pipeline/pipeline.h"
#include "ui/translate.h"

namespace acentric::editor {

Edit showStorey(const Project& project, int storey) {
  Edit edit{project, trf("Go to {}", project.storeys[std::size_t(storey)].name)};
  edit.project.storey = storey;
  return edit;
}

std::optional<int> storeyBeside(const Project& project, int steps) {
  std::vector<int> byHeight;
  for (int s = 0; s < int(project.storeys.size()); ++s)
    if (s == project.storey || !project.storeys[std::size_t(s)].layout.slope) byHeight.push_back(s);
  std::ranges::stable_sort(byHeight, {},
                           [&](int s) { return project.storeys[std::size_t(s)].layout.floorHeight; });
  const auto at = std::ranges::find(byHeight, project.storey) - byHeight.begin() + steps;
  if (at < 0 || at >= std::ssize(byHeight)) return std::nullopt;
  return byHeight[std::size_t(at)];
}

Edit renameStorey(const Project& project, std::string name) {
  Edit edit{project, trf("Rename {} to {}", project.current().name, name)};
  edit.project.current().name = std::move(name);
  return edit;
}

Edit removeStorey(const Project& project) {
  Edit edit{project, trf("Remove {}", project.current().name)};
  acentric::removeStorey(edit.project, project.storey);
  return edit;
}

}  // namespace acentric::editor
