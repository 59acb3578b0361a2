/// What a project does with its storeys.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/layout/storey_choice.h"
#include "engine/pipeline/new_project.h"

namespace acentric {
namespace {

constexpr double kSameFloor = 0.5, kSamePlace = 0.05;  // metres

std::string freeName(const Project& project) {
  for (std::size_t n = 0;; ++n) {
    std::string name = fmt::format("storey {}", n);
    if (std::ranges::find(project.storeys, name, &Storey::name) == project.storeys.end()) return name;
  }
}

}  // namespace

Result<std::vector<OpenProject>> openStoreys(const OpenProject& open, const ImportHost& host,
                                             const Progress& progress, std::stop_token stop) {
  std::vector<OpenProject> storeys;
  for (std::size_t s = 0; s < open.project.storeys.size(); ++s) {
    if (int(s) == open.project.storey) {
      storeys.push_back(open);
      continue;
    }
    Project project = open.project;
    project.storey = int(s);
    auto other = reopenProject(open, project, host, progress, stop);
    if (!other) return tl::unexpected(other.error());
    storeys.push_back(std::move(*other));
  }
  return storeys;
}

std::size_t storeyAt(std::span<const OpenProject> storeys, const glm::dvec3& eye) {
  if (storeys.size() == 1) return 0;  // asked for each frame
  const auto misfit = [&](const OpenProject& open) { return misfitOf(*open.layout, eye); };
  return std::size_t(std::ranges::min_element(storeys, {}, misfit) - storeys.begin());
}

bool liesOn(const Storey& storey, const WalkPlane& plane) {
  if (std::abs(storey.layout.floorHeight - plane.height) > kSameFloor) return false;
  std::size_t corners = 0, held = 0;
  for (const auto& loop : plane.outline.loops)
    for (const glm::dvec2& corner : loop) {
      ++corners;
      if (glm::distance(storey.layout.outline.nearestPoint(corner), corner) <= kSamePlace) ++held;
    }
  return 2 * held > corners;
}

bool hasStoreyOn(const Project& project, const WalkPlane& plane) {
  return std::ranges::any_of(project.storeys, [&](const Storey& storey) { return liesOn(storey, plane); });
}

Result<int> addStoreys(Project& project, const OpenProject& open, std::span<const WalkPlane> planes,
                       bool ignoredSides, std::stop_token stop) {
  int added = 0;
  for (const WalkPlane& plane : planes) {
    if (hasStoreyOn(project, plane)) continue;
    auto storey = makeStorey(open, plane, freeName(project), ignoredSides, stop);
    if (!storey) return tl::unexpected(storey.error());
    project.storeys.push_back(std::move(*storey));
    ++added;
  }
  return added;
}

void removeStorey(Project& project, int storey) {
  if (project.storeys.size() < 2) return;
  project.storeys.erase(project.storeys.begin() + storey);
  if (project.storey > storey || (project.storey == storey && storey > 0)) --project.storey;
  const auto forget = [storey](auto& places) {
    std::erase_if(places, [storey](const auto& place) { return place.storey == storey; });
    for (auto& place : places)
      if (place.storey > storey) --place.storey;
  };
  forget(project.bookmarks);
  forget(project.paths);
}

}  // namespace acentric
