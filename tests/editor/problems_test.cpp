#include "editor/session/problems.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "editor/actions/problem_actions.h"

namespace acentric::editor {
namespace {

/// A project of some cells in an empty scene, and all its captures baked.
ProblemFacts sound(Configuration configuration = Configuration::e) {
  OpenProject open;
  open.project.scene = "models/hall.glb";
  LayoutSpec& spec = open.project.layout();
  spec.configuration = configuration;
  spec.cellSize = 2;
  spec.outline.loops = {{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}};
  spec.freeApvs[3] = Apv{{0.3, 0.2}, {0.4, 0}, 60, Hand::counterClockwise};
  open.scene = std::make_shared<const Scene>();
  open.layout = std::make_shared<const Layout>(*buildLayout(spec));
  ProblemFacts facts;
  const std::size_t cameras = open.layout->cameras.size();
  facts.captures = std::make_shared<const CaptureStatus>(
      captureStatus(*open.layout, {std::vector<bool>(cameras, true), std::vector<bool>(cameras, false),
                                   std::vector<std::uint64_t>(cameras, 1)}));
  Inspection inspection;
  inspection.layout = open.layout;
  inspection.budgets.triangles.assign(open.layout->regions.size(), 10);
  facts.inspection = std::make_shared<const Inspection>(inspection);
  facts.built = std::make_shared<const OpenProject>(std::move(open));
  return facts;
}

template <class Change>
void change(std::shared_ptr<const OpenProject>& built, Change apply) {
  OpenProject changed = *built;
  apply(changed);
  built = std::make_shared<const OpenProject>(std::move(changed));
}
template <class Change>
void change(std::shared_ptr<const Inspection>& inspection, Change apply) {
  Inspection changed = *inspection;
  apply(changed);
  inspection = std::make_shared<const Inspection>(std::move(changed));
}
template <class Change>
void change(std::shared_ptr<const CaptureStatus>& captures, Change apply) {
  CaptureStatus changed = *captures;
  apply(changed);
  captures = std::make_shared<const CaptureStatus>(std::move(changed));
}

/// The only problem there is.
Problem only(const ProblemFacts& facts) {
  const auto problems = findProblems(facts);
  EXPECT_EQ(problems.size(), 1U);
  for (const Problem& problem : problems) SCOPED_TRACE(problem.text);
  return problems.empty() ? Problem{} : problems.front();
}
/// The action that the fix runs; empty if it is none.
std::string actionOf(const std::optional<ProblemFix>& fix) {
  const auto* run = fix ? std::get_if<RunAction>(&fix->way) : nullptr;
  return run != nullptr ? run->id : "";
}
bool says(const Problem& problem, const char* text) { return problem.text.find(text) != std::string::npos; }

TEST(Problems, ASoundProjectHasNone) {
  EXPECT_TRUE(findProblems(sound()).empty());
  EXPECT_TRUE(findProblems({}).empty()) << "nothing is open";
}

TEST(Problems, RegionsOverTheBudgetAreShownAndCanBeSplitOrFitted) {
  for (const auto& [configuration, action] :
       {std::pair(Configuration::e, "budget.split"), std::pair(Configuration::b, "budget.fit")}) {
    ProblemFacts facts = sound(configuration);
    change(facts.built, [](OpenProject& open) { open.project.budget.trianglesPerRegion = 15; });
    EXPECT_TRUE(findProblems(facts).empty());
    change(facts.inspection, [](Inspection& inspection) { inspection.budgets.triangles[1] = 16; });
    const Problem problem = only(facts);
    EXPECT_EQ(problem.severity, Severity::warning);
    EXPECT_TRUE(says(problem, "16")) << problem.text;
    EXPECT_EQ(problem.place.cells, std::set{facts.built->layout->regions[1].id});
    EXPECT_TRUE(problem.place.framed());
    EXPECT_EQ(problem.place.look, PlanLook::triangles);
    EXPECT_EQ(problem.place.section, "Triangle budget");
    ASSERT_TRUE(problem.fix.has_value());
    EXPECT_EQ(actionOf(problem.fix), action);
    change(facts.built, [](OpenProject& open) { open.project.budget.simplify = true; });
    EXPECT_EQ(only(facts).severity, Severity::note) << "it is seen to";
  }
}

TEST(Problems, AScaleInDoubtIsAskedAboutOnceAndChangedWithTheLayout) {
  ProblemFacts facts = sound();
  change(facts.inspection, [](Inspection& inspection) {
    inspection.scale = ScaleDoubt{0.15, 0.15, "As the model is scaled now, its storeys are 20 m high"};
  });
  const Problem problem = only(facts);
  EXPECT_EQ(problem.severity, Severity::warning);
  EXPECT_TRUE(says(problem, "its storeys are 20 m high. If it is right, enter 1 metres per unit"))
      << problem.text;
  EXPECT_EQ(problem.place.section, "Scene");
  ASSERT_TRUE(problem.fix.has_value());
  EXPECT_EQ(problem.fix->label, "Scale to 0.15");
  ProblemFacts more = facts;
  change(more.inspection, [](Inspection& inspection) {
    inspection.placement.findings = {
        {PlacementFlaw::insideSolid, Severity::error, {0}, -1, {1, 1}, "inside", {}}};
  });
  ASSERT_EQ(findProblems(more).size(), 2U);
  EXPECT_EQ(findProblems(more).front().fix, problem.fix) << "before what may come of it";
  const Project& project = facts.built->project;
  const Edit edit = editOf(*problem.fix, project, *facts.built->scene).value();
  EXPECT_EQ(edit.project.import.metresPerUnit, 0.15);
  EXPECT_NEAR(edit.project.layout().outline.area(), 0.15 * 0.15 * project.layout().outline.area(), 1e-9);
  change(facts.built, [](OpenProject& open) { open.project.import.metresPerUnit = 1; });
  EXPECT_TRUE(findProblems(facts).empty()) << "answered";
}

TEST(Problems, ManyOfAKindAreSummedUp) {
  ProblemFacts facts = sound();
  change(facts.built, [](OpenProject& open) {
    open.project.layout().outline.loops = {{{-20, -20}, {20, -20}, {20, 20}, {-20, 20}}};
    open.layout = std::make_shared<const Layout>(*buildLayout(open.project.layout()));
    open.project.budget.trianglesPerRegion = 5;
  });
  facts.captures = nullptr;
  change(facts.inspection, [&](Inspection& inspection) {
    inspection.layout = facts.built->layout;
    inspection.budgets.triangles.assign(facts.built->layout->regions.size(), 10);
  });
  const auto problems = findProblems(facts);
  ASSERT_EQ(problems.size(), kMostOfAKind + 1);
  EXPECT_TRUE(
      says(problems.back(), std::to_string(facts.built->layout->regions.size() - kMostOfAKind).c_str()));
}

TEST(Problems, ABadlyPlacedCameraIsHelpedByAPanoramaARoomlessCellRemovedAFreePanoramaMoved) {
  ProblemFacts facts = sound();
  const Layout& layout = *facts.built->layout;
  const auto regionUses = [](const Region& region, int camera) {
    for (const Cover& cover : region.covers)
      for (const Piece& piece : cover.pieces)
        if (piece.camera == camera) return true;
    return false;
  };
  const auto lattice =
      std::ranges::find_if(layout.regions, [](const Region& r) { return r.id.slot != kFreeSlot; });
  const int camera = lattice->covers.front().pieces.front().camera;
  PlacementFinding finding{PlacementFlaw::tooNear,     Severity::warning, {camera}, -1, {1, 1},
                           "stands 0.1 m from a wall", glm::dvec2(0.3, 0)};
  change(facts.inspection, [&](Inspection& inspection) { inspection.placement.findings = {finding}; });
  Problem problem = only(facts);
  EXPECT_TRUE(says(problem, "stands 0.1 m from a wall"));
  ASSERT_EQ(problem.place.cells.size(), 1U);
  const auto shown = layout.findRegion(*problem.place.cells.begin());
  ASSERT_TRUE(shown.has_value());
  EXPECT_TRUE(regionUses(layout.regions[std::size_t(*shown)], camera)) << "the cell shown uses the camera";
  const Project& project = facts.built->project;
  ASSERT_TRUE(problem.fix.has_value());
  EXPECT_EQ(problem.fix->label, "Fit cells") << "a push of the whole lattice would crowd other cameras";
  finding.panorama = {{1.5, 0.5}};
  change(facts.inspection, [&](Inspection& inspection) { inspection.placement.findings = {finding}; });
  problem = only(facts);
  ASSERT_TRUE(problem.fix.has_value());
  const Edit added = editOf(*problem.fix, project, *facts.built->scene).value();
  EXPECT_EQ(added.project.layout().freeApvs.size(), project.layout().freeApvs.size() + 1);
  EXPECT_EQ(added.project.layout().freeApvs.rbegin()->second.centre, glm::dvec2(1.5, 0.5));
  EXPECT_TRUE(added.project.layout().freeApvs.rbegin()->second.traditional());

  PlacementFinding none{PlacementFlaw::noStandingRoom, Severity::warning, {}, *shown, {1, 1}, "no room", {}};
  change(facts.inspection, [&](Inspection& inspection) { inspection.placement.findings = {none}; });
  problem = only(facts);
  ASSERT_TRUE(problem.fix.has_value());
  const Edit removed = editOf(*problem.fix, project, *facts.built->scene).value();
  EXPECT_FALSE(buildLayout(removed.project.layout())->findRegion(layout.regions[std::size_t(*shown)].id));

  const auto panorama =
      std::ranges::find_if(layout.regions, [](const Region& r) { return r.id.slot == kFreeSlot; });
  ASSERT_NE(panorama, layout.regions.end());
  finding.cameras = {panorama->covers.front().pieces.front().camera};
  change(facts.inspection, [&](Inspection& inspection) { inspection.placement.findings = {finding}; });
  problem = only(facts);
  ASSERT_TRUE(problem.fix.has_value());
  const Edit moved = editOf(*problem.fix, project, *facts.built->scene).value();
  EXPECT_EQ(moved.project.layout().freeApvs.at(3).centre, glm::dvec2(0.6, 0.2));
  EXPECT_EQ(moved.project.layout().latticeOrigin, facts.built->project.layout().latticeOrigin);
}

TEST(Problems, WhereManyCamerasStandBadlyOneStepForAllComesFirst) {
  ProblemFacts facts = sound();
  std::vector<PlacementFinding> findings;
  for (int n = 0; n < 4; ++n) {
    findings.push_back({PlacementFlaw::noFloor, Severity::warning, {n}, -1, {n, 1}, "nothing is below", {}});
    change(facts.inspection, [&](Inspection& inspection) { inspection.placement.findings = findings; });
    const auto problems = findProblems(facts);
    const bool many = n == 3;
    ASSERT_EQ(problems.size(), findings.size() + (many ? 1 : 0));
    EXPECT_EQ(says(problems.front(), "badly in 4 places"), many) << problems.front().text;
    EXPECT_EQ(actionOf(problems.front().fix), "layout.fit");
  }
}

TEST(Problems, OfOneCameraOnlyTheWorstIsTold) {
  ProblemFacts facts = sound();
  const PlacementFinding inside{PlacementFlaw::insideSolid, Severity::error, {0}, -1, {1, 1}, "inside", {}};
  const PlacementFinding low{PlacementFlaw::floorTooLow, Severity::warning, {0}, -1, {1, 1}, "too low", {}};
  change(facts.inspection, [&](Inspection& inspection) { inspection.placement.findings = {inside, low}; });
  const Problem problem = only(facts);
  EXPECT_TRUE(says(problem, "a camera: inside")) << problem.text;
  ASSERT_TRUE(problem.fix.has_value()) << "no push clears it, another lattice may";
  EXPECT_EQ(actionOf(problem.fix), "layout.fit");
}

TEST(Problems, CamerasThatNeedNoMendingAreNone) {
  ProblemFacts facts = sound();
  PlacementFinding suffices{
      PlacementFlaw::noFloor, Severity::note, {0}, -1, {1, 1}, "nothing is below it", {}};
  suffices.suffices = true;
  const PlacementFinding high{PlacementFlaw::floorTooHigh, Severity::note, {0}, -1, {1, 1}, "0.7 m", {}};
  change(facts.inspection, [&](Inspection& inspection) { inspection.placement.findings = {suffices, high}; });
  EXPECT_TRUE(findProblems(facts).empty());
}

TEST(Problems, AnInspectionOfAnotherLayoutSaysNothing) {
  ProblemFacts facts = sound();
  change(facts.inspection, [](Inspection& inspection) {
    inspection.placement.findings.assign(
        3, {PlacementFlaw::noFloor, Severity::error, {0}, -1, {0, 0}, "pit", {}});
    inspection.layout = std::make_shared<const Layout>(*inspection.layout);
  });
  EXPECT_TRUE(findProblems(facts).empty());
}

TEST(Problems, CapturesAreMissingStaleOrFailed) {
  ProblemFacts facts = sound();
  const int all = facts.captures->baked;
  change(facts.captures, [](CaptureStatus& captures) { captures.baked -= 3; });
  EXPECT_TRUE(says(only(facts), "3 captures are not baked yet"));
  EXPECT_EQ(actionOf(only(facts).fix), "bake.start");
  change(facts.captures,
         [](CaptureStatus& captures) { captures.stale[0] = captures.stale[1] = captures.stale[2] = true; });
  EXPECT_TRUE(says(only(facts), "3 captures are out of date"));
  change(facts.captures, [&](CaptureStatus& captures) {
    captures.baked = 0, captures.stale.assign(captures.stale.size(), false);
  });
  EXPECT_TRUE(says(only(facts), "Nothing is baked yet"));
  EXPECT_EQ(only(facts).severity, Severity::note);
  change(facts.captures, [&](CaptureStatus& captures) { captures.baked = all; });
  facts.failed = {{0, 12, "the disk is full"}};
  EXPECT_EQ(only(facts).severity, Severity::error);
  EXPECT_TRUE(says(only(facts), "Camera 12 could not be baked: the disk is full"));
  EXPECT_TRUE(only(facts).place.bakeCameras);
}

TEST(Problems, TheModelChangedOrMissingOrWithoutTextures) {
  ProblemFacts facts = sound();
  facts.scene = {SceneFiles::State::changed, {"/m/hall.glb"}};
  EXPECT_EQ(actionOf(only(facts).fix), "file.reimport");
  facts.scene = {SceneFiles::State::missing, {}, true};
  EXPECT_EQ(actionOf(only(facts).fix), "file.locate");
  EXPECT_EQ(only(facts).severity, Severity::error);
  EXPECT_TRUE(says(only(facts), "hall.glb"));
  facts.scene = {};
  change(facts.built, [](OpenProject& open) {
    Scene scene;
    scene.report.ignored = {"texture wood.png: no such file", "extension KHR_materials_specular"};
    open.scene = std::make_shared<const Scene>(scene);
  });
  EXPECT_TRUE(says(only(facts), "wood.png"));
  EXPECT_EQ(only(facts).place.section, "Scene");
}

TEST(Problems, AnOutlineWithoutCellsIsAnError) {
  ProblemFacts facts = sound();
  facts.captures = nullptr;
  change(facts.built, [](OpenProject& open) {
    LayoutSpec& spec = open.project.layout();
    for (const Region& region : open.layout->regions)
      if (region.id.slot != kFreeSlot) spec.removed.insert(region.id);
    open.layout = std::make_shared<const Layout>(*buildLayout(spec));
  });
  EXPECT_TRUE(says(only(facts), "no cell in the outline"));
  EXPECT_EQ(only(facts).severity, Severity::error);
}

TEST(Problems, WhatOthersDoToTheFilesIsListedAndTheWorstComesFirst) {
  ProblemFacts facts = sound();
  facts.lockedBy = LockOwner{"far.example", "ann", "2026-01-01 10:00", 7, "", "", ""};
  facts.projectFileChanged = true;
  facts.foretoldHoles = 2 * kToleratedHoles;
  facts.previews = 4;
  facts.diskShort = true;
  facts.freeBytes = 1'500'000'000;
  const auto problems = findProblems(facts);
  ASSERT_EQ(problems.size(), 5U);
  EXPECT_TRUE(says(problems.front(), "1.5 GB free"));
  EXPECT_EQ(problems.back().severity, Severity::note);
  EXPECT_TRUE(std::ranges::is_sorted(problems, std::greater(), &Problem::severity));
  EXPECT_EQ(countProblems(problems, Severity::warning), 3);
  facts.foretoldHoles = 0.5 * kToleratedHoles;
  EXPECT_EQ(findProblems(facts).size(), 4U);
}

TEST(Problems, ShowingOneGoesThere) {
  EditorState state;
  state.overlay = PlanOverlay::coverage;
  showProblem(state, {.cells = {{1, 2, 0}},
                      .low = {2, 2},
                      .high = {4, 4},
                      .look = PlanLook::triangles,
                      .section = "Layout"});
  EXPECT_EQ(state.selection, (std::set<CellId>{{1, 2, 0}}));
  ASSERT_TRUE(state.framePlan.has_value());
  EXPECT_LT(state.framePlan->low.x, 2);
  EXPECT_GT(state.framePlan->high.y, 4);
  EXPECT_EQ(state.overlay, PlanOverlay::triangles) << "coverage would cover the colours";
  EXPECT_EQ(state.openSection, "Layout");
  state.selection = {{9, 9, 0}};
  showProblem(state, {.look = PlanLook::checks});
  EXPECT_EQ(state.overlay, PlanOverlay::checks);
  EXPECT_EQ(state.selection.size(), 1U) << "a problem without cells leaves the selection";
}

}  // namespace
}  // namespace acentric::editor
