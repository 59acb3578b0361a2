#pragma once
/// Plans remembered in the user's cache, one a project, for as long as nothing changes that they depend on:
/// the project file's bytes, the sizes, times and places of all files of its scene, and this program.

#include <optional>

#include "engine/pipeline/bake_plan.h"

namespace acentric {

class PlanMemory {
 public:
  /// `text`: of the project file.
  PlanMemory(const std::filesystem::path& file, std::optional<int> storey, const std::string& text,
             const ImportHost& host);

  std::optional<BakePlan> recall() const;
  /// Nothing is kept of a scene whose files may have changed since `opened`. Nor if it cannot be written:
  /// then the next asking takes longer.
  void keep(const BakePlan& plan, const std::filesystem::path& scene, const ImportOptions& import,
            std::filesystem::file_time_type opened) const;

 private:
  std::filesystem::path file_, entry_;
  ContentKey asked_;
  ImportHost host_;
};

}  // namespace acentric
