/// What a frame draws, as tables that shaders read. web/src/engine/planner.ts is the other side of these
/// functions. Texels are on the graphics card alone.

#include <map>
#include <optional>

#include "engine/view/patch_tables.h"
#include "web/runtime/capture_part.h"
#include "web/runtime/module.h"

namespace acentric {
namespace {

struct Loaded {
  std::shared_ptr<const DisplayCapture> capture;
  std::uint32_t firstTexel = 0, firstOfReflections = 0;
};

struct Planner {
  ViewSettings settings;
  std::vector<WalkScene> storeys;
  std::map<int, Loaded> captures;  ///< by their numbers
  int nextCapture = 0;
  std::vector<std::int32_t> used;  ///< pairs of cameras and captures
  TaskRunner runner;               ///< this thread alone
} planner;

/// Addresses of arrays, as the page reads them.
template <class Value>
struct PageList {
  std::uint32_t count;
  const Value* first;

  explicit PageList(const std::vector<Value>& values)
      : count(std::uint32_t(values.size())), first(values.data()) {}
};

struct PageTables {
  PageList<PatchRecord> patches;
  PageList<PieceRecord> pieces;
  PageList<PatchTile> tiles;
  PageList<std::uint32_t> list;

  explicit PageTables(const PatchTables& t)
      : patches(t.patches), pieces(t.pieces), tiles(t.tiles.tiles), list(t.tiles.patches) {}
};
struct PageBackground {
  std::int32_t capture;  ///< its number
  std::uint32_t roles;
  PageList<glm::uvec2> columns;  ///< of each the first run and one behind the last
  std::uint32_t part;     ///< 0 = all of the view, 1 = between two directions, 2 = of more than half a turn
  float low[2], high[2];  ///< those
  float middle[2];        ///< direction of the capture's middle column
  float columnsPerRadian, rowsPerRadian, topElevation;
  float zenith[3], horizon[3], ground[3];
};
struct PageFrame {
  PageTables surfaces, behind, reflections;
  PageList<PageBackground> backgrounds;
  std::uint32_t showsMirrors;
};

/// Once for each index that was opened.
void openStoreys() {
  if (moduleBundle.storeys.empty()) return;
  planner.storeys.clear();
  planner.settings = moduleBundle.view;
  planner.settings.reconstruction = Reconstruction::patches;
  for (BundleStorey& storey : moduleBundle.storeys) {
    WalkScene& walk = planner.storeys.emplace_back();
    walk.layout = std::make_shared<const Layout>(std::move(storey.layout));
    walk.captures.resize(walk.layout->cameras.size());
  }
  moduleBundle.storeys.clear();
}

template <class From, std::size_t Count>
void copy(const From& from, float (&into)[Count]) {
  for (std::size_t i = 0; i < Count; ++i) into[i] = float(from[int(i)]);
}

PageBackground backgroundOf(const PieceDraw& piece, const DisplayCapture& capture, int number,
                            std::vector<glm::uvec2>& columns) {
  const ColumnCamera& camera = capture.camera;
  const CaptureBackground& runs = capture.background.runs;
  columns.assign(std::size_t(camera.columns), glm::uvec2(0));
  for (const ColumnRun& run : piece.runs)
    for (std::size_t k = std::size_t(run.first); k < std::size_t(run.last); ++k)
      columns[k] = {runs.columnStart[k], runs.columnStart[k + 1]};
  PageBackground page{number, piece.roles, PageList(columns)};
  if (piece.clipToPart) {
    const AzimuthRange& part = piece.part.azimuths;
    page.part = part.width > kPi ? 2 : 1;
    copy(directionOf(part.low), page.low), copy(directionOf(part.low + part.width), page.high);
  }
  copy(camera.directionAt(0.5 * camera.columns), page.middle);
  page.columnsPerRadian = float(1 / camera.columnPitch()), page.rowsPerRadian = float(1 / camera.rowPitch());
  page.topElevation = float(camera.topElevation);
  copy(runs.sky.zenith, page.zenith), copy(runs.sky.horizon, page.horizon),
      copy(runs.sky.ground, page.ground);
  return page;
}

}  // namespace
}  // namespace acentric

using namespace acentric;

/// The part of a capture that was taken, whose texels begin there; its number.
EXPORTED(addCapture) int addCapture(std::uint32_t firstTexel) {
  PartReader reader(moduleBytes);
  Loaded loaded{nullptr, firstTexel, 0};
  reader(loaded.firstOfReflections);
  loaded.firstOfReflections += firstTexel;
  loaded.capture = readPart(reader);
  moduleBytes = {};
  planner.captures[planner.nextCapture] = std::move(loaded);
  return planner.nextCapture++;
}
EXPORTED(dropCapture) void dropCapture(int number) { planner.captures.erase(number); }
/// Room for so many pairs: a camera, and the number of the capture that the next frame shows of it.
EXPORTED(useCaptures) std::int32_t* useCaptures(std::size_t count) {
  planner.used.resize(2 * count);
  return planner.used.data();
}

/// What `region` shows of the captures to an eye in it or close to it; null where it shows nothing.
EXPORTED(planFrame)
const PageFrame* planFrame(int storey, int region, double x, double y, double z, double yaw, double pitch,
                           double fov, int width, int height) {
  static PatchTables surfaces, behind, reflections;
  static std::vector<PageBackground> backgrounds;
  static std::vector<std::vector<glm::uvec2>> columns;
  static std::optional<PageFrame> page;
  openStoreys();
  WalkScene& walk = planner.storeys[std::size_t(storey)];
  const PerspectiveView view{{x, y, z}, yaw, pitch, fov, width, height};
  std::map<const DisplayCapture*, std::uint32_t> firstTexels;
  std::map<int, int> numbers;  // by camera
  for (std::size_t i = 0; i < planner.used.size(); i += 2) {
    const auto found = planner.captures.find(planner.used[i + 1]);
    if (found == planner.captures.end()) continue;
    const Loaded& loaded = found->second;
    walk.captures[std::size_t(planner.used[i])] = loaded.capture;
    numbers[planner.used[i]] = found->first;
    firstTexels[loaded.capture.get()] = loaded.firstTexel;
    if (loaded.capture->reflections)
      firstTexels[loaded.capture->reflections.get()] = loaded.firstOfReflections;
  }
  const auto plan = planRegion(walk, view, planner.settings, region);
  if (plan) {
    const PatchPlan patches = planPatches(walk, view, *plan, planner.runner);
    const auto tablesOf = [&](PatchTables& tables, std::span<const StripDraw> strips) {
      tables.set(
          strips, width, height, [&](const DisplayCapture& c) { return firstTexels.at(&c); }, true);
      return PageTables(tables);
    };
    std::vector<StripDraw> shown = patches.reflections;
    shown.insert(shown.end(), patches.mirrors.begin(), patches.mirrors.end());
    backgrounds.clear();
    columns.resize(plan->backgrounds.size());
    for (const PieceDraw& piece : plan->backgrounds)
      backgrounds.push_back(backgroundOf(piece, *walk.captures[std::size_t(piece.camera)],
                                         numbers.at(piece.camera), columns[backgrounds.size()]));
    page =
        PageFrame{tablesOf(surfaces, patches.surfaces), tablesOf(behind, patches.behind),
                  tablesOf(reflections, shown), PageList(backgrounds), plan->reflections.empty() ? 0u : 1u};
  }
  for (std::size_t i = 0; i < planner.used.size(); i += 2)
    walk.captures[std::size_t(planner.used[i])] = nullptr;
  return plan ? &*page : nullptr;
}
