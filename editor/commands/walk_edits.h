#pragma once
/// Edits of bookmarks and of paths. Pure: project in, edit out. Those with a number are of one that is there.

#include "editor/commands/edit.h"

namespace acentric::editor {

/// Last in the list, with a free name; with the project's field of view, on its current storey.
Edit addBookmark(const Project& project, const PathPose& here);
Edit renameBookmark(const Project& project, std::size_t bookmark, std::string name);
/// The same name, another view.
Edit updateBookmark(const Project& project, std::size_t bookmark, const PathPose& here);
Edit removeBookmark(const Project& project, std::size_t bookmark);
/// `steps` < 0: towards the beginning of the list. At its ends nothing changes.
Edit moveBookmark(const Project& project, std::size_t bookmark, int steps);
/// The storey and the field of view that it was taken with.
Edit goToBookmark(const Project& project, std::size_t bookmark);

/// Last in the list, with a free name.
Edit addPath(const Project& project, const CameraPath& path, int storey);
Edit renamePath(const Project& project, std::size_t path, std::string name);
Edit removePath(const Project& project, std::size_t path);
Edit movePath(const Project& project, std::size_t path, int steps);
Edit setPath(const Project& project, std::size_t path, CameraPath changed);

/// Times of neighbouring key poses differ by at least this much.
inline constexpr double kLeastKeySeconds = 0.001;

/// Its time stays between those of its neighbours; the first one's is 0.
CameraPath withPose(CameraPath path, std::size_t pose, PathPose changed);
/// A key pose at that time, where the eye would be then; its number is returned too.
std::pair<CameraPath, std::size_t> withPoseAt(CameraPath path, double seconds);
/// A key pose at the end, as high as the last one, looking the way that one goes there at that speed. A path
/// that would take too long stays as it is.
CameraPath withPoseAfter(CameraPath path, const glm::dvec2& place, double metresPerSecond);
/// One pose is left at least. What follows the first then begins at 0.
CameraPath withoutPose(CameraPath path, std::size_t pose);

}  // namespace acentric::editor
