#pragma once
/// A project made of a model file: what can be chosen, and what comes of it.

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

#include "engine/pipeline/bake_forecast.h"
#include "engine/pipeline/bake_limit.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/scene_storeys.h"

namespace acentric {

/// That a new project has at most, if nothing else is said, and that can be said.
inline constexpr std::size_t kUsualMostCameras = 2000;
inline constexpr int kMostFirstCameras = 10'000'000;
/// That its bake may take, likewise.
inline constexpr double kUsualBakeMinutes = 20, kMostBakeMinutes = 1e6;

struct NewProjectOptions {
  ImportOptions import;
  /// None: b, or e, whose cells are as large as suits each place, where only a part of the ground is laid
  /// out.
  std::optional<Configuration> configuration;
  double cellSize = 0;           ///< metres; 0 = from the walkable area (about 12 rings, 0.8..6 m)
  double eyeHeight = 1.6;        ///< metres
  std::string outline = "auto";  ///< "auto" or parseOutline text
  StoreyChoice storey;           ///< with "auto": nothing chosen = the one with most floor
  bool everyStorey = false;      ///< with "auto": a layout on each storey; the walk begins on the largest
  bool stairs = false;           ///< with everyStorey: cells on the stairs and ramps between the storeys too
  bool ignoreSides = false;      ///< see inspect/walkable_outline.h
  double samplesPerDegree = 0;   ///< 0 = BakeSettings' default
  // Of all storeys together, with "auto"; where there would be more, only a part of the ground is laid out
  // (first_cell.h), and the storeys' `walkable` has all of it. 0 = no limit.
  std::size_t mostCameras = kUsualMostCameras;
  double bakeMinutes = kUsualBakeMinutes;  ///< by a forecast with the runner's threads: see bake_limit.h
  std::optional<glm::dvec2> around;  ///< plan, metres: where such a part begins; none: where most is enclosed
};

struct NewProject {
  OpenProject open;
  LimitedBy limitedBy = LimitedBy::nothing;
  /// What baking it takes, at a glance; `cancelled` where that was not known in time, none where it was not
  /// asked.
  std::optional<Result<BakeForecast>> plan;
};

/// Imports the scene, finds floor and walkable area, lays the tessellation, estimates the exposure, chooses a
/// spawn, and opens that. The scene lies in the folder of `projectFile` (collect_model.h). Does not write the
/// project.
Result<NewProject> makeProject(const std::filesystem::path& sceneFile,
                               const std::filesystem::path& projectFile, const NewProjectOptions& options,
                               const ImportHost& host, TaskRunner& runner, const Progress& progress = {},
                               std::stop_token stop = {});

/// The cell size that a new project has if none is chosen, metres.
double firstCellSize(double walkableSquareMetres, Configuration configuration);

/// A storey for a walk plane found in the project's scene: configuration, cell size, eye height and near band
/// as in the project's current storey, the lattice shifted to where its cameras stand freest.
Result<Storey> makeStorey(const OpenProject& open, const WalkPlane& plane, std::string name,
                          bool ignoredSides, std::stop_token stop = {});

/// How long a new project waits for a forecast at a glance, seconds.
inline constexpr double kPlanningSeconds = 10;
/// What all storeys of a project take, at a glance: where there are many, as the largest of them do.
/// `cancelled` where that is not known in so many seconds.
Result<BakeForecast> glanceAtBake(std::span<const OpenProject> storeys, double seconds, TaskRunner& runner,
                                  const Progress& progress = {}, std::stop_token stop = {});

}  // namespace acentric
