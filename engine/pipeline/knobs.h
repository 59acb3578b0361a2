#pragma once
/// What of a project trades accuracy for time: names that a sweep and a user give values to. A choice of
/// values makes of one project another, and nothing else.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/measure/sweep.h"
#include "engine/pipeline/project.h"

namespace acentric {

struct Knob {
  std::string name;
  std::string what;    ///< that it changes, with the unit
  bool bakes = false;  ///< captures or the light of surfaces are others; else only how frames are made
  std::function<std::string(const Project&)> value;
  /// Refuses what it does not know. The project's own check comes later.
  std::function<Status(Project&, const std::string&)> set;
  /// What a sweep tries beside the project's own.
  std::function<std::vector<std::string>(const Project&)> tried;
};

/// Those of the view first; a setting is applied in this order.
std::span<const Knob> knobs();
Result<const Knob*> knobOf(const std::string& name);

/// Sorted as the table is; without choices that the project has already. Fails where a knob is unknown or
/// given twice.
Result<SweepSetting> inOrder(SweepSetting setting, const Project& project);

/// The project so set, checked.
Result<Project> applySetting(Project project, const SweepSetting& setting);

/// "layers" or "layers=1/2/4".
struct KnobRange {
  const Knob* knob = nullptr;
  std::vector<std::string> values;  ///< that differ from the project's
};
Result<KnobRange> parseKnobRange(const std::string& text, const Project& project);

/// A preset of `acentric sweep` by its name, from the file that a sweep wrote.
Result<SweepSetting> presetOf(const std::filesystem::path& sweepFile, const std::string& name);
/// "gallery.acentric.json" -> "gallery.sweep" beside it.
std::filesystem::path sweepFolderFor(const std::filesystem::path& projectPath);
/// The same for a search that has goals: "gallery.goals".
std::filesystem::path goalsFolderFor(const std::filesystem::path& projectPath);
/// `from`: a sweep's folder or its file; empty = as above.
std::filesystem::path sweepFileOf(const std::filesystem::path& projectPath,
                                  const std::filesystem::path& from);
inline constexpr const char* kSweepFile = "sweep.json";

}  // namespace acentric
