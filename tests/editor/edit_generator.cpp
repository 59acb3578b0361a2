#include "tests/editor/edit_generator.h"

#include "editor/commands/density_edits.h"
#include "editor/commands/group_edits.h"
#include "editor/commands/layout_edits.h"
#include "editor/commands/outline_edits.h"
#include "editor/commands/setting_edits.h"
#include "editor/commands/storey_edits.h"
#include "editor/commands/walk_edits.h"

namespace acentric::editor {
namespace {

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
int whole(Random& random, int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }
bool coin(Random& random) { return whole(random, 0, 1) == 1; }
glm::dvec2 place(Random& random) { return {between(random, -9, 9), between(random, -9, 9)}; }

CellId cell(Random& random) {
  return {whole(random, -3, 3), whole(random, -3, 3), whole(random, 0, 2),
          coin(random) ? 0 : whole(random, 0, 2)};
}

LatticeStep step(Random& random) { return {whole(random, -3, 3), whole(random, -3, 3)}; }

/// Placed or not, free APVs too.
std::set<CellId> cells(const Project& project, Random& random) {
  std::set<CellId> some;
  for (int i = whole(random, 1, 4); i > 0; --i) some.insert(cell(random));
  for (const auto* known : {&project.layout().added, &project.layout().split})
    if (!known->empty() && coin(random)) some.insert(*known->begin());
  const LayoutSpec& spec = project.layout();
  if (canSplit(spec.configuration) && !spec.split.empty() && coin(random))
    some.insert(partsOf(spec, *spec.split.begin())[std::size_t(whole(random, 0, 3))]);
  for (const auto& [number, apv] : project.layout().freeApvs)
    if (whole(random, 0, 3) == 0) some.insert({number, 0, kFreeSlot});
  return some;
}

Apv apv(Random& random) {
  return {place(random), coin(random) ? glm::dvec2(0) : 0.2 * place(random), 360.0 / whole(random, 3, 12),
          coin(random) ? Hand::clockwise : Hand::counterClockwise};
}

Outline outline(Random& random) {
  Outline outline;
  for (int loop = whole(random, 0, 2); loop > 0; --loop) {
    const glm::dvec2 at = place(random);
    const double w = between(random, 1, 6), h = between(random, 1, 6);
    outline.loops.push_back({at, at + glm::dvec2(w / 2, 0.01), at + glm::dvec2(w, 0), at + glm::dvec2(w, h),
                             at + glm::dvec2(0, h)});
  }
  return outline;
}

BakeSettings bakeSettings(const Project& project, Random& random) {
  BakeSettings bake = project.bake;
  switch (whole(random, 0, 11)) {
    case 0:
      bake.samplesPerDegree = between(random, 0.4, 30);
      break;
    case 1:
      bake.ambientRays = whole(random, 0, 1100);
      break;
    case 2:
      bake.ambientRadius = between(random, 0.01, 50);
      break;
    case 3:
      bake.shadowRays = whole(random, 1, 64);
      break;
    case 4:
      bake.bounces = whole(random, 0, 8);
      break;
    case 5:
      bake.surfaceTexel = between(random, 0.002, 1);
      break;
    case 6:
      bake.maxLayers = whole(random, 1, 64);
      break;
    case 7:
      bake.pruning = !bake.pruning;
      break;
    case 8:
      bake.testEyes = whole(random, 1, 64);
      break;
    case 9:
      bake.distanceShift = between(random, 0, 4);
      bake.colourQuality = whole(random, 0, 100);
      break;
    case 10:
      bake.pruningLoss = between(random, -0.001, 0.01);
      break;
    default:
      bake.eyeRange = between(random, 0, 2);
  }
  return bake;
}

ViewSettings viewSettings(const Project& project, Random& random) {
  ViewSettings view = project.view;
  view.renderer = kRenderers[whole(random, 0, int(std::size(kRenderers)) - 1)];
  view.reconstruction = kReconstructions[whole(random, 0, int(std::size(kReconstructions)) - 1)];
  view.maxSplatPixels = int(between(random, 1, 64));
  view.localGeometry = coin(random);
  view.secondaryCover = coin(random);
  view.fillHoles = coin(random);
  return view;
}

TriangleBudget budget(Random& random) {
  return {whole(random, -1, 500'000), between(random, 1e-4, 1), coin(random)};
}

ImportOptions importOptions(Random& random) {
  return {coin(random) ? 0 : between(random, 1e-3, 100), UpAxis(whole(random, 0, 2)), coin(random)};
}

PathPose pose(Random& random) {
  return {{place(random), between(random, 0, 3)}, between(random, -7, 7), between(random, -1.6, 1.6), 0};
}

CameraPath path(Random& random) {
  CameraPath path{{pose(random)}};
  for (int i = whole(random, 0, 4); i > 0; --i) {
    PathPose next = pose(random);
    next.seconds = path.seconds() + between(random, -0.1, 9);
    path.poses.push_back(next);
  }
  return path;
}

/// An edit of one of them, or none if there are none.
template <class Place, class Make>
Edit ofOne(const Project& project, const std::vector<Place>& places, Random& random, Make make) {
  return places.empty() ? Edit{project, "none"} : make(std::size_t(whole(random, 0, int(places.size()) - 1)));
}

using P = const Project&;
using R = Random&;

}  // namespace

const std::vector<GeneratedCommand>& generatedCommands() {
  static const std::vector<GeneratedCommand> kCommands{
      {"addCell", [](P p, R r) { return addCell(p, cell(r)); }},
      {"removeCells", [](P p, R r) { return removeCells(p, cells(p, r)); }},
      {"moveCells", [](P p, R r) { return moveCells(p, cells(p, r), step(r)).edit; }},
      {"copyCells",
       [](P p, R r) {
         return copyCells(p, cells(p, r), {step(r), step(r)}).edit;
       }},
      {"splitCells", [](P p, R r) { return splitCells(p, cells(p, r)); }},
      {"setDensity", [](P p, R r) { return setDensity(p, cells(p, r), between(r, 0.2, 4.2)); }},
      {"stepDensity", [](P p, R r) { return stepDensity(p, cells(p, r), whole(r, -2, 2)); }},
      {"joinCells", [](P p, R r) { return joinCells(p, cells(p, r)); }},
      {"addFreeApv", [](P p, R r) { return addFreeApv(p, apv(r)); }},
      {"setFreeApv", [](P p, R r) { return setFreeApv(p, whole(r, 0, nextFreeNumber(p.layout())), apv(r)); }},
      {"setConfiguration", [](P p, R r) { return setConfiguration(p, Configuration(whole(r, 0, 6))); }},
      {"setCellSize", [](P p, R r) { return setCellSize(p, between(r, -0.1, 5)); }},
      {"setLatticeOrigin", [](P p, R r) { return setLatticeOrigin(p, place(r)); }},
      {"setRotation", [](P p, R r) { return setRotation(p, between(r, -4, 4)); }},
      {"setLattice",
       [](P p, R r) {
         return setLattice(p, {place(r), between(r, -4, 4), between(r, -0.1, 5)}, "Place the lattice");
       }},
      {"simplifyOutline", [](P p, R r) { return simplifyOutline(p, between(r, 0, 2)); }},
      {"setOutline", [](P p, R r) { return setOutline(p, outline(r)); }},
      {"setEyeHeight", [](P p, R r) { return setEyeHeight(p, between(r, -0.1, 3)); }},
      {"setFloorHeight", [](P p, R r) { return setFloorHeight(p, between(r, -5, 5)); }},
      {"setNearBand", [](P p, R r) { return setNearBand(p, between(r, -0.1, 3)); }},
      {"setBakeSettings", [](P p, R r) { return setBakeSettings(p, bakeSettings(p, r), "one"); }},
      {"setBakePreset", [](P p, R r) { return setBakePreset(p, kBakePresets[whole(r, 0, 2)]); }},
      {"setBudget", [](P p, R r) { return setBudget(p, budget(r), "all"); }},
      {"setViewSettings", [](P p, R r) { return setViewSettings(p, viewSettings(p, r), "all"); }},
      {"setFieldOfView", [](P p, R r) { return setFieldOfView(p, between(r, 0, 160)); }},
      {"setExposure", [](P p, R r) { return setExposure(p, float(between(r, -0.1, 9))); }},
      {"setSpawn",
       [](P p, R r) {
         return setSpawn(p, {place(r), between(r, -7, 7)});
       }},
      {"setEffect",
       [](P p, R r) {
         const int choice = whole(r, 0, 2);
         return setEffect(p, Effect(whole(r, 0, kEffectCount - 1)),
                          choice == 0 ? std::nullopt : std::optional(choice == 1));
       }},
      {"setScene",
       [](P p, R r) { return setScene(p, coin(r) ? "room.obj" : "models of mine/hall \u00e4.glb"); }},
      {"setImport", [](P p, R r) { return setImport(p, importOptions(r), "all"); }},
      {"showStorey", [](P p, R r) { return showStorey(p, whole(r, 0, int(p.storeys.size()) - 1)); }},
      {"renameStorey",
       [](P p, R r) { return renameStorey(p, coin(r) ? "up" : "level " + std::to_string(whole(r, 0, 9))); }},
      {"addBookmark", [](P p, R r) { return addBookmark(p, pose(r)); }},
      {"renameBookmark",
       [](P p, R r) {
         return ofOne(p, p.bookmarks, r,
                      [&](std::size_t i) { return renameBookmark(p, i, coin(r) ? "door" : "place 2"); });
       }},
      {"updateBookmark",
       [](P p, R r) {
         return ofOne(p, p.bookmarks, r, [&](std::size_t i) { return updateBookmark(p, i, pose(r)); });
       }},
      {"removeBookmark",
       [](P p, R r) {
         return ofOne(p, p.bookmarks, r, [&](std::size_t i) { return removeBookmark(p, i); });
       }},
      {"moveBookmark",
       [](P p, R r) {
         return ofOne(p, p.bookmarks, r, [&](std::size_t i) { return moveBookmark(p, i, coin(r) ? 1 : -1); });
       }},
      {"goToBookmark",
       [](P p, R r) { return ofOne(p, p.bookmarks, r, [&](std::size_t i) { return goToBookmark(p, i); }); }},
      {"addPath", [](P p, R r) { return addPath(p, path(r), whole(r, 0, int(p.storeys.size()) - 1)); }},
      {"renamePath",
       [](P p, R r) {
         return ofOne(p, p.paths, r,
                      [&](std::size_t i) { return renamePath(p, i, coin(r) ? "round" : "walk 1"); });
       }},
      {"removePath",
       [](P p, R r) { return ofOne(p, p.paths, r, [&](std::size_t i) { return removePath(p, i); }); }},
      {"movePath",
       [](P p, R r) {
         return ofOne(p, p.paths, r, [&](std::size_t i) { return movePath(p, i, coin(r) ? 1 : -1); });
       }},
      {"setPath",
       [](P p, R r) { return ofOne(p, p.paths, r, [&](std::size_t i) { return setPath(p, i, path(r)); }); }},
      {"removeStorey", [](P p, R) { return removeStorey(p); }},
  };
  return kCommands;
}

}  // namespace acentric::editor
