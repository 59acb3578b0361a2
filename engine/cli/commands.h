#pragma once
/// The commands: options in, report out.

#include <optional>
#include <string>
#include <vector>

#include "engine/bench/bake.h"
#include "engine/bench/representations.h"
#include "engine/cli/command.h"
#include "engine/cli/layout_edits.h"
#include "engine/pipeline/collect_model.h"
#include "engine/pipeline/new_project.h"

namespace acentric::cli {

struct NewOptions {
  std::filesystem::path scene, output;
  std::string configuration = "auto", outline = "auto", up = "guess", light = "guess";
  double cellSize = 0, eyeHeight = 1.6, samplesPerDegree = 0, metresPerUnit = 0;
  std::size_t mostCameras = kUsualMostCameras;  ///< 0 = no limit
  double bakeMinutes = kUsualBakeMinutes;       ///< 0 = no limit
  std::string around;                           ///< "x,y"; empty = where most floor is enclosed
  std::string storey;   ///< empty = the one with most floor; number, height such as 3.2m, or "list"
  bool stairs = false;  ///< with "all"
  bool ignoreSides = false, force = false;
  bool estimate = true;  ///< what the bake will take
  bool link = false;     ///< to a model outside the project's folder, instead of bringing it there
};
Result<Report> runNew(const NewOptions& options, const Common& common);
/// What was brought into a project's folder.
Report collectReport(const CollectedModel& collected);

struct StoreysOptions {
  std::filesystem::path file;  ///< project or model
  std::string up = "guess", light = "guess";
  double metresPerUnit = 0, eyeHeight = 1.6, stepHeight = 0.25, gridStep = 0, leastShare = 0.05,
         leastArea = 2;
  bool ignoreSides = false;
  /// Of a project: what is found there becomes storeys of its own, by number, height or "all".
  std::vector<std::string> add, remove;
  std::vector<std::string> rename;     ///< "storey 1=attic"
  std::string begin;                   ///< where the walk begins
  std::vector<std::string> addStairs;  ///< "all", or two storeys as LOWER:UPPER
  bool removeStairs = false;
  bool edits() const {
    return !add.empty() || !remove.empty() || !rename.empty() || !begin.empty() || !addStairs.empty() ||
           removeStairs;
  }
};
Result<Report> runStoreys(const StoreysOptions& options, const Common& common);

struct CheckOptions {
  std::filesystem::path project, output;
  double cameraRoom = 0.4, mostPush = 1;
  bool all = false;
};
Result<Report> runCheck(const CheckOptions& options, const Common& common);

struct LayoutOptions {
  std::filesystem::path project, output;
  LayoutEdits edits;
  std::string outline;  ///< empty = as it is, "auto", or parseOutline text
  bool fit = false;     ///< the lattice to the floor, after all else
  bool apply = false;
};
Result<Report> runLayout(const LayoutOptions& options, const Common& common);

struct InfoOptions {
  std::filesystem::path project;
  bool regions = false;
};
Result<Report> runInfo(const InfoOptions& options, const Common& common);

struct BudgetOptions {
  std::filesystem::path project, output;
  std::size_t most = 0;  ///< triangles per region; 0 = the project's limit, if any
};
Result<Report> runBudget(const BudgetOptions& options, const Common& common);

struct FitCommandOptions {
  std::filesystem::path project, output;
  std::size_t most = 0;  ///< triangles per region
  double leastCell = 0.3;
  double maxError = 0.005;  ///< metres, of simplified regions
  bool rotate = false, shift = false, simplify = false, apply = false;
  bool split = false;  ///< keep the project's cells and split those above the number
  bool merge = false;  ///< with `split`: undo splits that the number does not call for
};
Result<Report> runFit(const FitCommandOptions& options, const Common& common);
Result<Report> runFitBySplitting(const FitCommandOptions& options, const Common& common);

struct BakeOptions {
  std::filesystem::path project;
  std::vector<int> only;
  std::filesystem::path along;  ///< only the cameras that frames along this path are painted from
  int frames = 0;               ///< of the path, evenly chosen; 0 = all
  std::string shard;            ///< "2/8"; empty = all
  std::string light = "with";   ///< surface light: with, without or only
  bool dryRun = false;
  bool prune = false;
  std::string quality = "final";
  bool coarseFirst = false;  ///< a preview of everything before the first camera is final
  bool verify = false;       ///< read what is there to its end first
  bool takeOver = false;     ///< from another bake of the project
  bool list = false;         ///< tell of each camera
  double memoryMegabytes = double(MemoryBudget::kUsual) / 1e6;
};
Result<Report> runBake(const BakeOptions& options, const Common& common);

struct FarmSlurmOptions {
  std::filesystem::path project;
  std::filesystem::path output;   ///< folder of the scripts and logs; empty = beside the project
  std::filesystem::path program;  ///< acentric on the nodes; empty = where this one is
  std::string partition;
  int nodes = 1;
  double taskSeconds = 30;
  bool submit = false, print = false;
};
Result<Report> runFarmSlurm(const FarmSlurmOptions& options, const Common& common);

/// Frames of the tour that commands make where no path is given.
inline constexpr int kTourFrames = 60;

/// "960x540".
struct PictureSize {
  int width = 960, height = 540;
};
Result<PictureSize> parseSize(const std::string& text);
/// "x,y" or "x,y,z"; without z at `eyeZ`.
Result<glm::dvec3> parseEye(const std::string& text, double eyeZ);

/// By which differences from the truth are amplified.
inline constexpr int kDifferenceGain = 4;

struct BenchPackOptions {
  std::filesystem::path project, path, output;  ///< no path: once round in the region where the walk begins
  std::string size = "1920x1080";
  int frames = 120;           ///< of the way round
  double mostMegabytes = 52;  ///< of the folder
};
Result<Report> runBenchPack(const BenchPackOptions& options, const Common& common);

struct ExportOptions {
  std::filesystem::path project, output;
  std::string to = "bundle";  ///< "web": with the page that walks through it; "gltf" ...; or pictures
  bool allowMissing = false;
  std::optional<int> colourQuality;  ///< of "bundle", "web", "walk" and WebP; none: the project's
  int regionsPerPage = 64;           ///< of "walk"
  bool singleFile = false;           ///< of "web": `output` is one HTML file with everything in it
  int texturePixels = 4096;          ///< of "gltf" and "3dtiles"
  /// Of "gltf" ("none" and "png" unless given) and "3dtiles" ("meshopt" and "webp").
  std::optional<std::string> meshCompression, textureFormat;
  int region = -1;       ///< of "gltf", "3dtiles" and pictures: this one alone
  int facePixels = 512;  ///< of pictures
};
Result<Report> runExport(const ExportOptions& options, const Common& common);
Result<Report> runExportImages(const ExportOptions& options, const Common& common);
Result<Report> runExportGltf(const ExportOptions& options, const Common& common);
Result<Report> runExportExr(const ExportOptions& options, const Common& common);

/// Serves a published folder, a bundle or a walk to browsers on this machine, until it is stopped.
struct ServeCommandOptions {
  std::filesystem::path subject;
  std::optional<int> port;  ///< none: the usual one, or another that is free
  bool open = false;        ///< in the browser
};
Result<Report> runServe(const ServeCommandOptions& options, const Common& common);

/// Where the eye is and where it looks.
struct ViewChoice {
  std::string bookmark;  ///< of the project; empty = eye and angles below
  std::string eye;
  std::optional<double> yawDegrees;  ///< none = as the walk begins; with an eye of its own, 0
  double pitchDegrees = 0, fovDegrees = 60;
  std::string size = "960x540";
};
Result<PerspectiveView> chosenView(const ViewChoice& choice, const OpenProject& open);
/// The storey that was opened; all of them where an eye was given and no storey.
Result<std::vector<OpenProject>> storeysFor(const ViewChoice& choice, const OpenProject& current,
                                            const Common& common);

struct RenderOptions : ViewChoice {
  std::filesystem::path project, output, holes;
  std::string renderer;  ///< empty = the project's
  Look look;
  std::string mode = "picture";  ///< frame_pictures.h
  int truthSamples = 4;
  int gain = kDifferenceGain;
  bool stats = false;
};
Result<Report> runRender(const RenderOptions& options, const Common& common);

struct AskOptions : ViewChoice {
  std::filesystem::path project;
  std::string pixel;  ///< empty = the middle
  bool improvements = true;
};
Result<Report> runAsk(const AskOptions& options, const Common& common);

struct WalkOptions {
  std::filesystem::path project, path, output;
  std::string size = "960x540", renderer;  ///< no renderer: the project's
  Look look;
  double fovDegrees = 0;                      ///< 0 = the project's
  std::vector<std::string> modes{"picture"};  ///< frame_pictures.h
  int truthSamples = 4;
  int gain = kDifferenceGain;
};
Result<Report> runWalk(const WalkOptions& options, const Common& common);

struct TourOptions {
  std::filesystem::path project, output;
  int frames = kTourFrames;
};
Result<Report> runTour(const TourOptions& options, const Common& common);

struct MeasureOptions {
  std::filesystem::path project, path, images;
  std::string size = "640x360", renderer;  ///< no renderer: the project's
  Look look;
  double fovDegrees = 0;
  int frames = 0;  ///< 0 = all; else so many, evenly chosen
  int truthSamples = 1;
  bool seams = false;        ///< also where local geometry and captures meet, and changes of region
  int crossings = 20;        ///< 0 = all along the path; else so many, evenly chosen
  bool attribution = false;  ///< also what the error comes from
};
Result<Report> runMeasure(const MeasureOptions& options, const Common& common);

struct SweepOptions {
  std::filesystem::path project, path;
  std::filesystem::path output;    ///< folder; empty = beside the project
  std::vector<std::string> knobs;  ///< "layers" or "layers=1/2"; empty = all
  std::string size = "640x360";
  int frames = 8, repeats = 3, truthSamples = 4, crossings = 8;
  double budgetMinutes = 10;
  bool search = true;    ///< also combinations
  bool numerics = true;  ///< also careful arithmetic against less
  bool again = false;    ///< forget what was measured before
  bool list = false;
};
Result<Report> runSweep(const SweepOptions& options, const Common& common);

struct ProposeOptions {
  std::filesystem::path project, path;
  std::filesystem::path output;    ///< folder; empty = beside the project
  std::vector<std::string> knobs;  ///< as a sweep's; empty = those of layouts and captures
  double mostMegabytes = 0, mostMilliseconds = 0, leastPsnr = 0;  ///< 0: no goal
  std::string size = "1280x720";
  int frames = 4, repeats = 3, truthSamples = 4;
  double budgetMinutes = 10;
  bool again = false;  ///< forget what was measured before
  bool apply = false;
};
Result<Report> runPropose(const ProposeOptions& options, const Common& common);

struct PresetOptions {
  std::filesystem::path project, from;  ///< from: a sweep's folder or file; empty = beside the project
  std::string name;
  bool apply = false;
};
Result<Report> runPreset(const PresetOptions& options, const Common& common);

/// Brings the model of a project into the project's folder.
struct CollectOptions {
  std::filesystem::path project;
  bool link = false;
};
Result<Report> runCollect(const CollectOptions& options, const Common& common);

/// How a project's model is read: the twin of the editor's choice of light and its answer to a scale in
/// doubt.
struct ModelOptions {
  std::filesystem::path project;
  std::optional<double> metresPerUnit;  ///< nothing = as it is
  std::string light;                    ///< empty = as it is
};
Result<Report> runModel(const ModelOptions& options, const Common& common);

/// Where the walk begins: the twin of the editor's "Start here".
struct StartOptions {
  std::filesystem::path project;
  std::string at;                    ///< "x,y" in metres; empty = as it is
  std::optional<double> yawDegrees;  ///< nothing = as it is
  bool find = false;                 ///< as for a new project
};
Result<Report> runStart(const StartOptions& options, const Common& common);

struct ValidateOptions {
  std::filesystem::path project;
};
Result<Report> runValidate(const ValidateOptions& options, const Common& common);

struct BenchOptions {
  std::filesystem::path project, path;  ///< path empty = a tour
  std::string size = "960x540";
  Look look;
  std::vector<std::string> renderers = rendererNames();
  int frames = 30, repeats = 3;
  bool stream = false;  ///< walk in real time, while captures come and go
  double metresPerSecond = 1.4;
  bool waitForCaptures = false;  ///< of a stream
  bool leaveOut = false;         ///< renderers that cannot hold the scene; else they are a failure
};
/// As it is being walked: frames with captures missing or coarse, the longest frame, memory, loads.
Result<Report> runBenchStream(const BenchOptions& options, const Common& common);
Result<Report> runBench(const BenchOptions& options, const Common& common);

/// Several projects after each other: how times grow with a scene.
struct BenchGrowthOptions {
  std::vector<std::filesystem::path> projects;
  BenchOptions view{{}, {}, "1280x720", {}, {"list", "polygons", "gl-polygons", "truth"}, 8, 1};
  std::filesystem::path chart;
  bool processorTime = false;  ///< in place of what passes on the clock
};
Result<Report> runBenchGrowth(const BenchGrowthOptions& options, const Common& common);

/// Walks through layouts of ever more regions, whose captures are made as they are read.
struct BenchWalkGrowthOptions {
  std::vector<std::uint64_t> regions{100, 1000, 10'000, 100'000, 1'000'000};
  std::string configuration = "b", size = "640x360", renderer = "list";
  double cellSize = 2, samplesPerDegree = 4, metresPerSecond = 1.4;
  int regionsPerPage = 64, frames = 1800;
  std::filesystem::path chart;
};
Result<Report> runBenchWalkGrowth(const BenchWalkGrowthOptions& options, const Common& common);

struct BenchBakeOptions {
  std::filesystem::path project;
  BakeBenchOptions bench;
};
Result<Report> runBenchBake(const BenchBakeOptions& options, const Common& common);

/// From a model to its first view, with a project of its own for each; nothing of them stays.
struct BenchFirstViewOptions {
  std::vector<std::filesystem::path> scenes;
  double metresPerUnit = 0, cellSize = 0, samplesPerDegree = 0;  ///< as for `new`
};
Result<Report> runBenchFirstView(const BenchFirstViewOptions& options, const Common& common);

struct BenchHolesOptions {
  std::filesystem::path project, output;  ///< output: a folder; empty = nothing is written
  std::string size = "640x360";
  std::string place;  ///< "x,y"; empty = where the walk begins
  double fovDegrees = 0;
  std::optional<double> yawDegrees;
  int frames = 5, truthSamples = 1;
};
Result<Report> runBenchHoles(const BenchHolesOptions& options, const Common& common);

struct BenchRepresentationsOptions {
  std::filesystem::path project, output;     ///< output: the folder that it works in
  std::vector<std::filesystem::path> paths;  ///< measured besides the random poses
  std::string size = "640x360";
  RepresentationBenchOptions bench;
};
Result<Report> runBenchRepresentations(const BenchRepresentationsOptions& options, const Common& common);

struct BenchNumericsOptions {
  std::filesystem::path project, path, output;  ///< output: a folder; empty = nothing is written
  std::string size = "640x360";
  int frames = 8, repeats = 3;
};
Result<Report> runBenchNumerics(const BenchNumericsOptions& options, const Common& common);

/// Of tests/bench_functions.
struct BenchFunctionsOptions {
  std::vector<std::string> names;  ///< empty = all that have what they need
  std::filesystem::path model, project;
  std::string at;  ///< "x,y"; empty = the model's middle
  std::size_t triangles = 0, regions = 1000;
  std::filesystem::path beside;  ///< another build's programs; empty = none
  int rounds = 3;
};
Result<Report> runBenchFunctions(const BenchFunctionsOptions& options, const Common& common);

struct EstimateCommandOptions {
  std::filesystem::path project, output;
  double effort = 1;  ///< EstimateOptions, of all storeys together
};
Result<Report> runEstimate(const EstimateCommandOptions& options, const Common& common);

struct CoverageOptions {
  std::filesystem::path project, path, output, csv;
  bool plan = false, surfaces = false, pruning = false, correlate = false;
  int points = 20000, eyesPerRegion = 7, grid = 512, frames = 20;
  double reach = 0;                     ///< metres; 0 = any distance
  std::string size, renderer = "list";  ///< size empty: 960x540, or 640x360 to correlate
};
Result<Report> runCoverage(const CoverageOptions& options, const Common& common);

}  // namespace acentric::cli
