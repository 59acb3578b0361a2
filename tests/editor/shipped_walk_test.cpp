/// Shipped walks in a session: shown frame by frame as other readers show them, and never edited.

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "editor/actions/action_table.h"
#include "editor/commands/storey_edits.h"
#include "editor/commands/walk_edits.h"
#include "editor/session/project_files.h"
#include "engine/base/file.h"
#include "engine/export/bundle_player.h"
#include "engine/export/walk_read.h"
#include "engine/export/walk_write.h"
#include "tests/editor/session_fixture.h"
#include "tests/export/small_walk.h"

namespace acentric::editor {
namespace {

/// Exported once; each test has a session of its own.
class ShippedWalkTest : public SessionTest {
 protected:
  static void SetUpTestSuite() {
    room = fs::temp_directory_path() / ("acentric-shipped-walk-test-" + std::to_string(::getpid()));
    fs::create_directories(room);
    TaskRunner runner(1);
    const OpenProject open = test::bakedProject(room / "small.acentric.json", runner);
    const auto written = exportBundle({&open, 1}, room / "bundle", {false, "a test", 90}, runner);
    ASSERT_TRUE(written) << written.error().describe();
    ASSERT_TRUE(writeWalk(room / "bundle", room / "small.acentric"));
  }
  static void TearDownTestSuite() { fs::remove_all(room); }

  /// With all of it in memory.
  void openWhole(Session& session, const fs::path& file) {
    session.open(file);
    waitFor(session, [&] { return session.walk() && !session.working(); });
  }
  static void expectFramesOfPlayer(const Session& session, const fs::path& file) {
    auto whole = wholeBundle(std::move(*bundleAt(file)));
    ASSERT_TRUE(whole);
    BundlePlayer player;
    player.open(std::move(*whole));
    const BundleStorey& storey = player.bundle().storeys.front();
    for (std::size_t c = 0; c < storey.cameras.size(); ++c)
      ASSERT_TRUE(player.loadCapture(0, c, Loaded::full));
    for (std::size_t r = 0; r < storey.local.size(); ++r) ASSERT_TRUE(player.loadRegion(0, r));
    TaskRunner runner(1);
    const ViewSettings& settings = session.project().view;
    for (const PerspectiveView& view : test::everyView(*session.built()->layout)) {
      const auto expected = player.render(view, settings);
      const auto actual = renderFrame(session.walk()->walk, view, settings, runner);
      ASSERT_TRUE(expected && actual);
      EXPECT_GT(actual->stats.samplesDrawn, 100u);
      EXPECT_EQ(actual->colour.pixels, expected->colour.pixels);
      EXPECT_EQ(actual->source.pixels, expected->source.pixels);
    }
  }
  /// A copy of the bundle in which a byte in the middle of each file of one folder is another.
  fs::path damaged(const char* folder) const {
    const fs::path copy = folder_ / "damaged";
    fs::copy(room / "bundle", copy, fs::copy_options::recursive);
    for (const auto& entry : fs::directory_iterator(copy / folder)) {
      std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(std::streamoff(fs::file_size(entry.path()) / 2));
      file.put('\x5a').put('\x33');
    }
    return copy;
  }

  static inline fs::path room;
};

TEST_F(ShippedWalkTest, ShowsTheFramesOfItsOtherReadersBitForBit) {
  for (const char* name : {"small.acentric", "bundle"}) {
    Session session(options());
    openWhole(session, room / name);
    ASSERT_TRUE(session.shippedWalk()) << name;
    EXPECT_EQ(session.walk()->missing + session.walk()->coarse, 0);
    expectFramesOfPlayer(session, room / name);
  }
}

TEST_F(ShippedWalkTest, HasWhatItsProjectSaysOfTheWalk) {
  Session session(options());
  openWhole(session, room / "bundle" / "");
  EXPECT_EQ(session.file(), room / "bundle");
  openWhole(session, room / "bundle" / kBundleIndex);  // the folder, by its index
  EXPECT_EQ(session.file(), room / "bundle");
  const Project project = session.project(), from = test::everythingProject();
  EXPECT_EQ(project.view, from.view);
  EXPECT_NEAR(project.fovDegrees, from.fovDegrees, 1e-9);
  EXPECT_EQ(project.storeys.size(), from.storeys.size());
  EXPECT_EQ(project.spawn().position, from.spawn().position);
  ASSERT_EQ(project.bookmarks.size(), 1u);
  EXPECT_EQ(project.bookmarks[0].name, "the lamp");
  EXPECT_NEAR(project.bookmarks[0].fovDegrees, 50, 1e-9);
  ASSERT_EQ(project.paths.size(), 1u);
  EXPECT_EQ(project.paths[0].path.seconds(), 2.5);
  EXPECT_EQ(project.bake.eyeRange, 0) << "all of them stand at eye height";
  EXPECT_TRUE(session.captures()->complete());
  EXPECT_GT(session.captures()->bytes.front(), 0u);
  EXPECT_EQ(session.shippedWalk()->bundle.generator, "a test");
  EXPECT_EQ(session.title(), "bundle (walk) – Acentric");
  EXPECT_TRUE(session.problems().empty());
  EXPECT_EQ(session.preferences().recent.front(), room / "bundle");
}

TEST_F(ShippedWalkTest, IsNotEdited) {
  Session session(options());
  openWhole(session, room / "small.acentric");
  const Project before = session.project();
  const auto refused = [&](const char* what) { return told(session, std::string(what) + ": " + kIsWalk); };
  EXPECT_FALSE(session.apply(setCellSize(before, 0.5)));
  EXPECT_TRUE(refused(setCellSize(before, 0.5).label.c_str()));
  EXPECT_FALSE(session.apply(renameBookmark(before, 0, "another")));
  session.applyLive(setExposure(before, 2), true);
  session.startBake();
  EXPECT_TRUE(refused("Baking"));
  session.estimateBake();
  session.findStoreys();
  session.outlineFromScene();
  session.fitCells();
  session.splitOverBudget();
  session.reimport();
  session.exportPath(0, folder_ / "path.json");
  EXPECT_FALSE(session.working());
  EXPECT_FALSE(session.save());
  const Status saved = session.saveAs(folder_ / "copy.acentric.json");
  ASSERT_FALSE(saved);
  EXPECT_NE(saved.error().describe().find(kIsWalk), std::string::npos);
  EXPECT_EQ(session.project(), before);
  EXPECT_FALSE(session.history().canUndo());
  session.close();
  EXPECT_FALSE(session.shippedWalk());
  EXPECT_EQ(std::distance(fs::directory_iterator(room), {}), 3)
      << "captures, bundle and walk: nothing is left beside them";
}

TEST_F(ShippedWalkTest, IsShownOtherwiseWithoutBeingUnsaved) {
  Session session(options());
  openWhole(session, room / "small.acentric");
  ViewSettings view = session.project().view;
  view.renderer = Renderer::scalar;
  EXPECT_TRUE(session.apply(setViewSettings(session.project(), view, "renderer")));
  EXPECT_TRUE(session.apply(setFieldOfView(session.project(), 90)));
  EXPECT_EQ(session.built()->project.fovDegrees, 90);
  EXPECT_FALSE(session.dirty());
  EXPECT_FALSE(session.worthAsking());
  session.undo();
  EXPECT_EQ(session.project().view.renderer, Renderer::scalar);
  EXPECT_NE(session.project().fovDegrees, 90);
}

TEST_F(ShippedWalkTest, ShowsAnotherStorey) {
  const fs::path copy = folder_ / "storeys";
  fs::copy(room / "bundle", copy, fs::copy_options::recursive);
  auto index = nlohmann::ordered_json::parse(*readText(copy / kBundleIndex));
  auto above = index["storeys"][0];
  above["name"] = "above";
  index["storeys"].push_back(above);
  ASSERT_TRUE(writeTextAtomically(copy / kBundleIndex, index.dump()));
  Session session(options());
  openWhole(session, copy);
  const auto below = session.walk();
  ASSERT_EQ(session.project().storeys.size(), 2u);
  EXPECT_TRUE(session.apply(showStorey(session.project(), 1)));
  EXPECT_EQ(session.built()->layout, session.shippedWalk()->layouts[1]);
  waitFor(session, [&] { return session.walk() != below && !session.working(); });
  EXPECT_EQ(session.walk()->walk.layout, session.built()->layout);
  expectFramesOfPlayer(session, copy);
  session.undo();
  EXPECT_EQ(session.built()->layout, session.shippedWalk()->layouts[0]);
}

TEST_F(ShippedWalkTest, KeepsToTheMemoryOfWalks) {
  Session session(options());
  openWhole(session, room / "small.acentric");
  const auto full = [&] {
    const auto& standsIn = session.walk()->standsIn;
    return std::ranges::count(standsIn, false);
  };
  const auto all = full();
  EXPECT_EQ(all, std::ptrdiff_t(session.walk()->walk.captures.size()));
  session.preferences().walkMegabytes = 1;
  session.walkMemoryChanged();
  waitFor(session, [&] { return !session.working() && full() < all; });
  for (const auto& capture : session.walk()->walk.captures) EXPECT_TRUE(capture) << "coarse ones stand in";
}

TEST_F(ShippedWalkTest, CoarseCapturesStandInForDamagedOnes) {
  const fs::path copy = damaged("captures");
  Session session(options());
  openWhole(session, copy);
  EXPECT_TRUE(told(session, copy.string() + ", captures/"));
  EXPECT_TRUE(told(session, "its hash differs. The coarse capture stands in; copy the walk again"));
  for (std::size_t c = 0; c < session.walk()->standsIn.size(); ++c) {
    EXPECT_TRUE(session.walk()->standsIn[c]);
    EXPECT_TRUE(session.walk()->walk.captures[c]);
  }
}

TEST_F(ShippedWalkTest, DamagedRangesOfAFileAreNamed) {
  std::string bytes = *readText(room / "small.acentric");
  for (std::size_t at = bytes.size() / 2; at < bytes.size(); at += bytes.size() / 20) bytes[at] ^= 0x55;
  const fs::path file = folder_ / "damaged.acentric";
  ASSERT_TRUE(writeTextAtomically(file, bytes));
  Session session(options());
  openWhole(session, file);
  EXPECT_TRUE(told(session, file.string() + ", captures/"));
  EXPECT_TRUE(told(session, "its hash differs. The coarse capture stands in; copy the walk again"));
  const auto& standsIn = session.walk()->standsIn;
  EXPECT_TRUE(std::ranges::count(standsIn, true) > 0 && std::ranges::count(standsIn, false) > 0);
}

TEST_F(ShippedWalkTest, DamagedSurroundingsAreNamedAndLeftOut) {
  const fs::path copy = damaged("regions");
  fs::remove_all(copy / "textures");
  Session session(options());
  openWhole(session, copy);
  EXPECT_TRUE(told(session, "It is white; copy the walk again"));
  EXPECT_TRUE(told(session, ". Near geometry is missing there; copy the walk again"));
  for (const auto& local : session.walk()->walk.local) EXPECT_TRUE(local && local->triangles.empty());
}

TEST_F(ShippedWalkTest, WhatCannotBeOpenedSaysWhyAndLeavesWhatIsOpen) {
  Session session(options());
  openWhole(session, room / "small.acentric");
  const std::string whole = *readText(room / "small.acentric");
  const fs::path cut = folder_ / "cut.acentric", foreign = folder_ / "foreign.acentric";
  ASSERT_TRUE(writeTextAtomically(cut, whole.substr(0, whole.size() / 2)));
  ASSERT_TRUE(writeTextAtomically(foreign, "a story of a walk, which is no walk by far, however long it is"));
  const auto failsWith = [&](const fs::path& file, const std::string& text) {
    session.open(file);
    waitFor(
        session, [&] { return !session.opening().running(); }, "failed.");
    EXPECT_TRUE(told(session, text)) << session.messages().all().back().text;
  };
  failsWith(cut, cut.string() + ": has ");
  EXPECT_TRUE(told(session, "it is cut off, or not copied whole; copy the walk again"));
  failsWith(foreign, foreign.string() + ": is neither a walk (*.acentric) nor the folder of a bundle");
  failsWith(folder_, folder_.string() + ": is neither a walk");
  failsWith(folder_ / "none.acentric", "no such file");
  EXPECT_EQ(session.file(), room / "small.acentric") << "is still open";
}

TEST_F(ShippedWalkTest, ActionsThatNeedAProjectSaySo) {
  Session session(options());
  EditorState state;
  ActionContext context{session, state};
  openWhole(session, room / "small.acentric");
  state.overlay = PlanOverlay::coverage;
  state.walkLook = WalkLook::split;
  state.centreView = View::scene3d;
  beginAfresh(context);
  EXPECT_EQ(state.overlay, PlanOverlay::none);
  EXPECT_EQ(state.walkLook, WalkLook::picture);
  EXPECT_EQ(state.centreView, View::plan);
  EXPECT_EQ(state.planTool.mode(), PlanMode::eye);
  const std::vector<Action> table = makeActionTable();
  const auto action = [&](const char* id) -> const Action& { return *findAction(table, std::string(id)); };
  for (const char* id :
       {"bake.start", "tool.cells", "view.coverage", "view.split", "view.scene3d", "walk.record",
        "file.saveAs", "path.export", "sweep.start", "storey.find", "storey.stairs", "outline.clear"})
    EXPECT_EQ(whyDisabled(action(id), context), kIsWalk) << id;
  for (const char* id : {"file.open", "file.close", "walk.restart", "walk.screenshot", "tool.eye",
                         "overlay.bytes", "view.sources", "tab.paths", "window.larger", "help.about"})
    EXPECT_EQ(whyDisabled(action(id), context), "") << id;
}

}  // namespace
}  // namespace acentric::editor
