#pragma once
/// Which bookmark or path is selected, and which of a path's key poses. Numbers may have become stale by an
/// undo: ask, and get only what is there.

#include <optional>

#include "engine/pipeline/project.h"

namespace acentric::editor {

struct WalkSelection {
  enum class Kind { none, bookmark, path };
  Kind kind = Kind::none;
  std::size_t number = 0;
  std::optional<std::size_t> pose;

  const Bookmark* bookmark(const Project& project) const {
    return kind == Kind::bookmark && number < project.bookmarks.size() ? &project.bookmarks[number] : nullptr;
  }
  const WalkPath* path(const Project& project) const {
    return kind == Kind::path && number < project.paths.size() ? &project.paths[number] : nullptr;
  }
  /// Of the selected path.
  std::optional<std::size_t> poseIn(const Project& project) const {
    const WalkPath* walk = path(project);
    return walk != nullptr && pose && *pose < walk->path.poses.size() ? pose : std::nullopt;
  }
  bool operator==(const WalkSelection&) const = default;
};

}  // namespace acentric::editor
