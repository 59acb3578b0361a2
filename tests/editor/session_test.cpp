/// The session without a window, on a real model: opened through the import process, edited, baked, saved,
/// reopened.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "editor/commands/layout_edits.h"
#include "editor/commands/setting_edits.h"
#include "editor/commands/storey_edits.h"
#include "editor/session/project_files.h"
#include "engine/inspect/refine.h"
#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

TEST_F(SessionTest, FromAModelToABakedSavedAndReopenedProject) {
  const fs::path file = folder_ / "room.acentric.json";
  {
    Session session(options());
    openAndSettle(session, folder_ / "room.obj");
    EXPECT_TRUE(session.untitled());
    EXPECT_GT(session.built()->layout->regions.size(), 1U);
    ASSERT_TRUE(session.backdrop() != nullptr);
    EXPECT_FALSE(session.backdrop()->picture.empty());
    makeCoarse(session);
    waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
    ASSERT_TRUE(session.saveAs(file));
    EXPECT_FALSE(session.dirty());
    session.startBake();
    waitFor(session, [&] { return !session.working() && session.captures()->complete(); });
    EXPECT_EQ(session.walk()->missing, 0);
    EXPECT_FALSE(session.streaming());
    for (std::size_t c = 0; c < session.walk()->keys.size(); ++c) {
      EXPECT_NE(session.walk()->walk.captures[c], nullptr) << "all of them fit";
      EXPECT_FALSE(session.walk()->standsIn[c]);
    }
    EXPECT_EQ(session.lastBake()->captures.baked, int(session.built()->layout->cameras.size()));
    EXPECT_EQ(session.bakeQueue().count(CameraStage::done), session.lastBake()->captures.baked);
    EXPECT_EQ(session.bakeQueue().share(), 1);
    EXPECT_GT(session.neededBytes().value_or(0), 0);
    EXPECT_GT(session.freeBytes().value_or(0), 0u);
    for (const BakeState state : session.captures()->regions) EXPECT_EQ(state, BakeState::baked);
  }
  Session again(options());
  EXPECT_EQ(again.preferences().recent.front(), file);
  openAndSettle(again, file);
  EXPECT_TRUE(again.captures()->complete());
  again.startBake();
  waitFor(again, [&] { return again.lastBake().has_value() && !again.working(); });
  EXPECT_EQ(again.lastBake()->captures.baked, 0);
}

TEST_F(SessionTest, CapturesThatTurnOutToBeDamagedAreToldOfAndNoLongerCountAsBaked) {
  const fs::path file = folder_ / "room.acentric.json";
  {
    Session session(options());
    openAndSettle(session, folder_ / "room.obj");
    makeCoarse(session);
    waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
    ASSERT_TRUE(session.saveAs(file));
    session.startBake();
    waitFor(session, [&] { return !session.working() && session.captures()->complete(); });
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(captureFolderFor(file))) {
    if (entry.path().extension() != ".pack") continue;
    const auto before = fs::last_write_time(entry.path());
    std::fstream bytes(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(std::streamoff(entry.file_size() / 2));
    bytes.write("damaged", 7);
    bytes.close();
    fs::last_write_time(entry.path(), before);  // as the disk's failure leaves it
  }
  Session again(options());
  again.open(file);
  waitFor(again, [&] { return again.walk() && !again.working() && again.captures()->baked == 0; });
  EXPECT_TRUE(told(again, "set aside as *.damaged; bake again"));
  EXPECT_TRUE(told(again, "more like these"));
  again.startBake();
  waitFor(again, [&] { return !again.working() && again.captures()->complete(); });
  EXPECT_EQ(again.walk()->missing, 0);
}

TEST_F(SessionTest, ABakeIsPausedGoneOnWithAndCancelled) {
  Session session(options());
  openAndSettle(session, folder_ / "room.obj");
  makeCoarse(session);
  BakeSettings finer = session.project().bake;
  finer.samplesPerDegree = 6;
  session.apply(setBakeSettings(session.project(), finer, "finer"));
  ASSERT_TRUE(session.saveAs(folder_ / "room.acentric.json"));
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  const auto traced = [&] {
    double sum = session.bakeQueue().previewed();
    for (const QueuedCamera& camera : session.bakeQueue().cameras()) sum += camera.traced;
    return sum;
  };
  session.startBake();
  waitFor(session, [&] { return traced() > 0.5; });
  session.pauseBake(true);
  EXPECT_TRUE(session.bakePaused());
  // What was under way comes to its end; then nothing moves any more.
  double before = -1;
  int still = 0;
  waitFor(session, [&] {
    still = traced() == before ? still + 1 : 0;
    before = traced();
    return still > 60;
  });
  EXPECT_TRUE(session.baking().running());
  EXPECT_LT(session.bakeQueue().finished(), int(session.bakeQueue().cameras().size()));
  session.pauseBake(false);
  waitFor(session, [&] { return traced() > before + 0.5; });
  session.pauseBake(true);
  session.cancelBake();
  waitFor(session, [&] { return !session.baking().running(); });
  EXPECT_EQ(session.bakeQueue().count(CameraStage::tracing), 0);
  EXPECT_FALSE(session.lastBake().has_value());
  waitFor(session, [&] { return !session.working(); });
}

TEST_F(SessionTest, RemovingACellAndUndoingItLeavesEverythingBaked) {
  Session session(options());
  saveCoarseRoom(session);
  session.startBake();
  waitFor(session, [&] { return !session.working() && session.captures()->complete(); });
  const std::size_t before = session.built()->layout->regions.size();
  session.apply(removeCells(session.project(), {session.built()->layout->regions.front().id}));
  waitFor(session,
          [&] { return !session.working() && session.built()->layout->regions.size() == before - 1; });
  EXPECT_TRUE(session.captures()->complete());
  session.undo();
  waitFor(session, [&] { return !session.working() && session.built()->layout->regions.size() == before; });
  EXPECT_TRUE(session.captures()->complete());
  EXPECT_FALSE(session.dirty());
}

TEST_F(SessionTest, AnEstimateIsOfWhatIsMissingAndForgottenWithAnEdit) {
  Session session(options());
  saveCoarseRoom(session);
  EXPECT_EQ(session.estimate(), nullptr);
  session.estimateBake();
  waitFor(session, [&] { return session.estimate() != nullptr; });
  EXPECT_EQ(session.estimate()->cameras, int(session.built()->layout->cameras.size()));
  EXPECT_GT(session.estimate()->seconds.value, 0);
  EXPECT_GT(session.estimate()->bytes.value, 0);
  session.apply(setEyeHeight(session.project(), 1.3));
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  EXPECT_EQ(session.estimate(), nullptr);
  session.startBake();
  waitFor(session, [&] { return !session.working() && session.captures()->complete(); });
  session.estimateBake();
  waitFor(session, [&] { return session.estimate() != nullptr; });
  EXPECT_EQ(session.estimate()->cameras, 0);
  EXPECT_EQ(session.estimate()->seconds.value, 0);
}

TEST_F(SessionTest, ABakeTellsWhichOfItsCapturesAnEditHasMadeUseless) {
  Session session(options());
  saveCoarseRoom(session);
  session.startBake();
  session.pauseBake(true);
  waitFor(session, [&] { return !session.bakeQueue().cameras().empty(); });
  EXPECT_EQ(session.outdatedInBake(), 0);
  const auto settle = [&] {
    waitFor(session, [&] { return session.built()->project == session.project(); });
  };
  std::set<CellId> allButOne;
  for (const Region& region : session.built()->layout->regions) allButOne.insert(region.id);
  allButOne.erase(allButOne.begin());
  session.apply(removeCells(session.project(), allButOne));
  settle();
  EXPECT_GT(session.outdatedInBake(), 0);
  EXPECT_LT(session.outdatedInBake(), session.bakeQueue().toBake()) << "cells that stay are still baked";
  session.apply(setEyeHeight(session.project(), 1.3));
  settle();
  EXPECT_EQ(session.outdatedInBake(), session.bakeQueue().toBake());
  session.undo();
  session.undo();
  settle();
  EXPECT_EQ(session.outdatedInBake(), 0);
  session.cancelBake();
  waitFor(session, [&] { return !session.working(); });
}

TEST_F(SessionTest, ABakeSaysWhatItWillTakeBeforeItsFirstCamera) {
  Session session(options());
  saveCoarseRoom(session);
  EXPECT_FALSE(session.bakeForecast());
  const int cameras = int(session.built()->layout->cameras.size());
  session.startBake();
  EXPECT_EQ(session.bakeSecondsLeft(), std::nullopt);
  waitFor(session, [&] { return session.bakeForecast().has_value(); });
  EXPECT_EQ(session.bakeForecast()->cameras, cameras);
  EXPECT_EQ(session.bakeForecast()->lights, 1);
  EXPECT_EQ(session.bakeForecast()->threads, session.bakeThreads());
  EXPECT_GT(session.bakeForecast()->seconds(), 0);
  EXPECT_GT(session.bakeForecast()->bytes(), 0);
  waitFor(session, [&] { return !session.working() && session.captures()->complete(); });
  EXPECT_EQ(session.bakeForecast()->cameras, cameras) << "it stays";
  session.startBake();
  EXPECT_FALSE(session.bakeForecast()) << "of another bake";
  waitFor(session, [&] { return session.bakeForecast().has_value(); });
  EXPECT_TRUE(session.bakeForecast()->nothing());
  waitFor(session, [&] { return !session.working(); });
}

TEST_F(SessionTest, ABakeIsForetoldByTheEstimateThatWasAskedForBefore) {
  Session session(options());
  saveCoarseRoom(session);
  session.estimateBake();
  waitFor(session, [&] { return session.estimate() != nullptr; });
  const double seconds = session.estimate()->seconds.value;
  session.startBake();
  waitFor(session, [&] { return session.bakeForecast().has_value(); });
  EXPECT_EQ(session.bakeForecast()->seconds(), seconds);
  EXPECT_EQ(session.bakeForecast()->cameras, int(session.built()->layout->cameras.size()));
  waitFor(session, [&] { return !session.working(); });
}

TEST_F(SessionTest, CellsAreFittedToTheBudgetAsAnEditThatCanBeUndone) {
  Session session(options());
  openAndSettle(session, folder_ / "room.obj");
  session.apply(setConfiguration(session.project(), Configuration::e));
  session.apply(setCellSize(session.project(), 3));
  TriangleBudget budget;
  budget.trianglesPerRegion = 1;  // the room has no part with fewer
  session.apply(setBudget(session.project(), budget, "one"));
  waitFor(session, [&] { return !session.working(); });
  const LayoutSpec before = session.project().layout();
  session.fitCells();
  waitFor(session, [&] { return !session.searching().running() && !session.messages().all().empty(); });
  EXPECT_EQ(session.messages().all().back().level, MessageLevel::warning);
  EXPECT_EQ(session.project().layout(), before);

  budget.trianglesPerRegion = 12;
  session.apply(setBudget(session.project(), budget, "all"));
  waitFor(session, [&] { return !session.working(); });
  session.fitCells();
  waitFor(session, [&] { return !session.searching().running() && session.project().layout() != before; });
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  const auto counts = countLocalTriangles(*session.built()->scene, *session.built()->layout);
  ASSERT_FALSE(counts.empty());
  EXPECT_LE(*std::ranges::max_element(counts), 12U);
  session.undo();
  EXPECT_EQ(session.project().layout(), before);
}

TEST_F(SessionTest, CellsAboveTheBudgetAreSplitAsTheSearchSays) {
  {  // a rug of many triangles in a corner of the room
    writeRoom(folder_ / "rug.obj");
    std::ofstream rug(folder_ / "rug.obj", std::ios::app);
    constexpr int kSide = 14;
    for (int i = 0; i <= kSide; ++i)
      for (int j = 0; j <= kSide; ++j) rug << "v " << -2.9 + 0.2 * i << " 0.01 " << -2.4 + 0.2 * j << '\n';
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const int a = 9 + i * (kSide + 1) + j, b = a + kSide + 1;
        rug << "f " << a << ' ' << a + 1 << ' ' << b + 1 << ' ' << b << '\n';
      }
  }
  Session session(options());
  openAndSettle(session, folder_ / "rug.obj");
  session.apply(setConfiguration(session.project(), Configuration::e));
  session.apply(setCellSize(session.project(), 3));
  session.apply(setNearBand(session.project(), 0.05));
  TriangleBudget budget;
  budget.trianglesPerRegion = 150;
  session.apply(setBudget(session.project(), budget, "150"));
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  RefineOptions refining;
  refining.mostTriangles = 150;
  TaskRunner runner(0);
  const auto expected =
      refineToBudget(session.project().layout(), TriangleTree(session.built()->scene), refining, runner);
  ASSERT_TRUE(expected) << expected.error().describe();
  ASSERT_GT(expected->split, 0U);
  session.splitOverBudget();
  waitFor(session,
          [&] { return !session.searching().running() && !session.project().layout().split.empty(); });
  EXPECT_EQ(session.project().layout(), expected->spec);
  session.undo();
  EXPECT_TRUE(session.project().layout().split.empty());
}

TEST_F(SessionTest, StoreysFoundInTheSceneAreAddedBakedAndWalked) {
  // A slab over a part of a hall's floor, with head room above and below.
  std::ofstream(folder_ / "loft.obj")
      << "v -6 0 -3\nv 6 0 -3\nv 6 0 3\nv -6 0 3\nv -6 6 -3\nv 6 6 -3\nv 6 6 3\nv -6 6 3\n"
         "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
         "v 1 2.9 -3\nv 6 2.9 -3\nv 6 2.9 3\nv 1 2.9 3\nv 1 2.6 -3\nv 6 2.6 -3\nv 6 2.6 3\nv 1 2.6 3\n"
         "f 12 11 10 9\nf 13 14 15 16\nf 12 9 13 16\n";
  Session session(options());
  openAndSettle(session, folder_ / "loft.obj");
  makeCoarse(session);
  ASSERT_TRUE(session.saveAs(folder_ / "loft.acentric.json"));
  waitFor(session, [&] { return !session.working(); });
  ASSERT_EQ(session.project().storeys.size(), 1U);
  session.findStoreys();
  waitFor(session, [&] { return !session.working() && session.project().storeys.size() > 1; });
  ASSERT_EQ(session.project().storeys.size(), 3U)
      << "the floor, the loft, and the roof of a file without sides";
  EXPECT_NEAR(session.project().storeys[1].layout.floorHeight, 2.9, 0.02);
  session.findStoreys();
  waitFor(session, [&] { return !session.working(); });
  EXPECT_EQ(session.project().storeys.size(), 3U) << "nothing is added twice";

  session.startBake();
  waitFor(session, [&] { return !session.working() && session.captures()->complete(); });
  session.apply(showStorey(session.project(), 1));
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  EXPECT_NEAR(session.built()->layout->eyeZ(), 2.9 + session.project().layout().eyeHeight, 0.02);
  waitFor(session, [&] { return !session.working() && session.captures()->complete(); });
  EXPECT_EQ(session.walk()->missing, 0) << "a bake is of all storeys";

  session.apply(setEyeHeight(session.project(), 1.3));
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  session.startBake();
  waitFor(session, [&] { return session.bakeQueue().count(CameraStage::tracing) > 0; });
  EXPECT_EQ(session.bakeQueue().cameras().front().storey, 1) << "the one that is shown comes first";
  EXPECT_FALSE(bakeMarks(session.bakeQueue(), session.built()->keys).baking.empty());
  session.cancelBake();
  waitFor(session, [&] { return !session.working(); });
}

TEST_F(SessionTest, ACrashedRunIsOfferedForRecoveryAndTheFileIsAsItWasSaved) {
  const fs::path file = folder_ / "room.acentric.json";
  double edited = 0;
  {
    Session session(options());
    openAndSettle(session, folder_ / "room.obj");
    ASSERT_TRUE(session.saveAs(file));
    session.apply(setEyeHeight(session.project(), 1.23));
    edited = session.project().layout().eyeHeight;
    waitFor(session, [&] { return !session.working(); });
    session.poll(now_ + 100);
    EXPECT_TRUE(fs::exists(autosaveFileFor(file)));
  }  // gone without saving or closing, as by a crash
  Session session(options());
  openAndSettle(session, file);
  ASSERT_TRUE(session.recoveryOffered());
  EXPECT_NE(session.project().layout().eyeHeight, edited);
  session.answerRecovery(true);
  EXPECT_EQ(session.project().layout().eyeHeight, edited);
  EXPECT_TRUE(session.dirty());
  ASSERT_TRUE(session.save());
  EXPECT_FALSE(fs::exists(autosaveFileFor(file)));
  waitFor(session, [&] { return !session.working(); });
}

TEST_F(SessionTest, NothingIsOfferedOfWhatWasUndone) {
  const fs::path file = folder_ / "room.acentric.json";
  Session session(options());
  openAndSettle(session, folder_ / "room.obj");
  ASSERT_TRUE(session.saveAs(file));
  session.apply(setEyeHeight(session.project(), 1.23));
  session.poll(now_ + 100);
  ASSERT_TRUE(fs::exists(autosaveFileFor(file)));
  session.undo();
  ASSERT_FALSE(session.dirty());
  session.poll(now_ + 101);
  EXPECT_FALSE(fs::exists(autosaveFileFor(file)));
  session.redo();
  session.poll(now_ + 200);
  EXPECT_TRUE(fs::exists(autosaveFileFor(file))) << "done again, it is kept again";
  waitFor(session, [&] { return !session.working(); });
}

TEST_F(SessionTest, TheInspectionFollowsEditsAndCostsNothingUnasked) {
  Session session(options());
  openAndSettle(session, folder_ / "room.obj");
  EXPECT_EQ(session.inspection(), nullptr);
  EXPECT_FALSE(session.inspecting().running());

  session.askForInspection(true);
  waitFor(session, [&] { return session.inspection() != nullptr; });
  const auto before = session.inspection();
  const Layout& layout = *session.built()->layout;
  ASSERT_EQ(before->budgets.triangles.size(), layout.regions.size());
  EXPECT_EQ(before->budgets.triangles, countLocalTriangles(*session.built()->scene, layout));

  ASSERT_TRUE(session.apply(removeCells(session.project(), {layout.regions.front().id})));
  waitFor(session, [&] {
    session.askForInspection(true);
    return session.built()->layout != before->layout && session.inspection() != nullptr;
  });
  EXPECT_EQ(session.inspection()->layout, session.built()->layout);
  EXPECT_EQ(session.inspection()->budgets.triangles.size(), before->budgets.triangles.size() - 1);
  EXPECT_EQ(session.inspection()->budgets.counted, 0u)
      << "a region that an edit leaves alone was counted again";

  session.askForInspection(false);
  EXPECT_EQ(session.inspection(), nullptr);
}

TEST_F(SessionTest, AnUnsoundEditIsRefusedWithAReason) {
  Session session(options());
  openAndSettle(session, folder_ / "room.obj");
  const Project before = session.project();
  session.messages().takeNew();
  EXPECT_FALSE(session.apply(setCellSize(before, -1)));
  EXPECT_EQ(session.project(), before);
  const auto news = session.messages().takeNew();
  ASSERT_EQ(news.size(), 1U);
  EXPECT_TRUE(news.front().modal);
}

TEST_F(SessionTest, AFileThatIsNotThereIsAFailureThatNamesIt) {
  Session session(options());
  session.open(folder_ / "missing.glb");
  for (int i = 0; i < 2000 && session.opening().running(); ++i) {
    session.poll(now_);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_FALSE(session.hasProject());
  const auto news = session.messages().takeNew();
  ASSERT_EQ(news.size(), 1U);
  EXPECT_EQ(news.front().level, MessageLevel::error);
  EXPECT_NE(news.front().text.find("missing.glb"), std::string::npos);
}

TEST(OnlyViewDiffers, KnowsWhatNeedsNothingLaidOrLoaded) {
  Project a;
  a.scene = "room.obj";
  Project b = a;
  b.view.fillHoles = !b.view.fillHoles;
  b.fovDegrees = 75;
  b.spawn().yawRadians = 2;
  EXPECT_TRUE(onlyViewDiffers(a, b));
  b.exposure = 2;
  EXPECT_FALSE(onlyViewDiffers(a, b));
}

}  // namespace
}  // namespace acentric::editor
