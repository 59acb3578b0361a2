#pragma once
/// Everything that is wrong with what is open now, or deserves a look, each with a sentence, a place to go to
/// and, where there is one, a way out. Pure: facts in, list out.

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "editor/session/capture_status.h"
#include "editor/session/engine_texts.h"
#include "editor/session/file_watch.h"
#include "editor/session/inspection.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/project_lock.h"

namespace acentric::editor {

struct FailedCamera {
  int storey = 0;
  int camera = 0;
  std::string error;
  bool operator==(const FailedCamera&) const = default;
};

/// What the list is made of. Null and empty: not known.
struct ProblemFacts {
  std::shared_ptr<const OpenProject> built;
  std::shared_ptr<const Inspection> inspection;  ///< of built->layout
  std::shared_ptr<const CaptureStatus> captures;
  int previews = 0;  ///< captures of which only a preview or a draft is there
  std::vector<FailedCamera> failed;
  std::optional<double> foretoldHoles;  ///< share of what is seen, of built->layout
  SceneFiles scene;
  bool projectFileChanged = false;
  std::optional<LockOwner> lockedBy;
  bool diskShort = false;                ///< for what the bake is expected to take
  std::uint64_t freeBytes = 0;           ///< of diskShort
  std::optional<std::string> lost = {};  ///< why work is not kept safe
  std::string language = "en";           ///< in which they are told
  bool operator==(const ProblemFacts&) const = default;
};

/// What to switch on in the plan to see it.
enum class PlanLook : std::uint8_t { unchanged, checks, triangles, coverage };

/// A part of the window, and what to do there.
struct ProblemPlace {
  std::set<CellId> cells = {};  ///< to be selected
  /// Plan, metres: to be framed; nothing to frame where `low` is not below `high`.
  glm::dvec2 low{0}, high{0};
  PlanLook look = PlanLook::unchanged;
  std::string section = {};  ///< of the settings; empty = none
  bool bakeCameras = false;  ///< the list of cameras in the bake panel
  bool framed() const { return low.x < high.x && low.y < high.y; }
  bool any() const {
    return !cells.empty() || framed() || look != PlanLook::unchanged || !section.empty() || bakeCameras;
  }
  bool operator==(const ProblemPlace&) const = default;
};

/// Ways out.
struct RunAction {
  std::string id;  ///< of the table
  bool operator==(const RunAction&) const = default;
};
struct MoveFreeApv {
  int number = 0;
  glm::dvec2 by{0};  ///< metres
  bool operator==(const MoveFreeApv&) const = default;
};
struct AddPanorama {
  glm::dvec2 place{0};  ///< metres
  bool operator==(const AddPanorama&) const = default;
};
struct RemoveCell {
  CellId cell;
  bool operator==(const RemoveCell&) const = default;
};
struct ScaleModel {
  double metresPerUnit = 1;  ///< the layout is scaled along
  bool operator==(const ScaleModel&) const = default;
};
struct ProblemFix {
  std::string label;
  std::variant<RunAction, MoveFreeApv, AddPanorama, RemoveCell, ScaleModel> way;
  bool operator==(const ProblemFix&) const = default;
};

struct Problem {
  Severity severity = Severity::warning;
  std::string text;  ///< one sentence
  ProblemPlace place = {};
  std::optional<ProblemFix> fix = {};
};

/// Of one kind at most so many are listed singly.
inline constexpr std::size_t kMostOfAKind = 50;
/// Share of what is seen that captures may miss without a word.
inline constexpr double kToleratedHoles = 0.01;

/// The worst first.
std::vector<Problem> findProblems(const ProblemFacts& facts);
int countProblems(const std::vector<Problem>& problems, Severity severity);

}  // namespace acentric::editor
