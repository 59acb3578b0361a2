#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "editor/actions/action_table.h"
#include "editor/session/adaptive_resolution.h"
#include "editor/session/eta.h"
#include "editor/session/job.h"
#include "editor/session/preferences.h"
#include "editor/session/project_files.h"
#include "tests/editor/session_fixture.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;

void deliverUntil(Inbox& inbox, const std::function<bool()>& done) {
  for (int i = 0; i < 2000 && !done(); ++i) {
    inbox.deliver();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ASSERT_TRUE(done()) << "nothing came";
}

TEST(Job, DeliversItsResultOnTheMainThread) {
  Inbox inbox;
  Job job(inbox);
  std::thread::id deliveredOn;
  job.restart("Work", [&](const Job::Context& context) {
    context.post([&] { deliveredOn = std::this_thread::get_id(); });
  });
  deliverUntil(inbox, [&] { return !job.running(); });
  EXPECT_EQ(deliveredOn, std::this_thread::get_id());
}

TEST(Job, TheNewestRequestWinsAndResultsOfReplacedWorkAreDropped) {
  Inbox inbox;
  Job job(inbox);
  std::vector<int> results;
  const auto work = [&results](int number) {
    return [&results, number](const Job::Context& context) {
      while (number < 3 && !context.stop().stop_requested()) std::this_thread::yield();
      context.post([&results, number] { results.push_back(number); });
    };
  };
  job.restart("1", work(1));
  job.restart("2", work(2));
  job.restart("3", work(3));
  deliverUntil(inbox, [&] { return !job.running(); });
  EXPECT_EQ(results, std::vector<int>{3});
}

TEST(Job, CancelledWorkStillSaysSoButAbandonedWorkDoesNot) {
  Inbox inbox;
  Job job(inbox);
  int said = 0;
  const Job::Work work = [&said](const Job::Context& context) {
    while (!context.stop().stop_requested()) std::this_thread::yield();
    context.post([&said] { ++said; });
  };
  job.restart("cancelled", work);
  job.cancel();
  deliverUntil(inbox, [&] { return !job.running(); });
  EXPECT_EQ(said, 1);
  job.restart("abandoned", work);
  job.abandon();
  deliverUntil(inbox, [&] { return !job.running(); });
  EXPECT_EQ(said, 1);
}

TEST(Job, ShowsProgressAndDropsLateMessagesWhenItIsGone) {
  Inbox inbox;
  bool late = false;
  {
    Job job(inbox);
    job.restart("Work", [&](const Job::Context& context) {
      context.progress()({3, 3, "stage"});
      context.post([&] { late = true; });
    });
    while (job.progress().done != 3) {
      ASSERT_TRUE(job.running());
      if (late) break;
      inbox.deliver();
    }
    EXPECT_EQ(job.progress().stage, "stage");
    late = false;
    job.restart("Late", [&](const Job::Context& context) { context.post([&] { late = true; }); });
  }
  inbox.deliver();
  EXPECT_FALSE(late);
}

TEST(Eta, FollowsTheRateAndForgetsAnotherStage) {
  Eta eta;
  EXPECT_FALSE(eta.secondsLeft(0).has_value());
  for (int i = 0; i <= 10; ++i) eta.report(i, i, 100);
  ASSERT_TRUE(eta.secondsLeft(10).has_value());
  EXPECT_NEAR(*eta.secondsLeft(10), 90, 1e-9);
  EXPECT_NEAR(*eta.secondsLeft(12), 88, 1e-9);
  eta.report(13, 0, 5);
  EXPECT_FALSE(eta.secondsLeft(13).has_value());
}

TEST(AdaptiveResolution, SettlesWhereAFrameTakesTheTargetTime) {
  AdaptiveResolution resolution;
  const auto cost = [](double scale) { return 0.003 + 0.4 * scale * scale; };
  for (int i = 0; i < 40; ++i) resolution.measured(resolution.movingScale(), cost(resolution.movingScale()));
  EXPECT_NEAR(cost(resolution.movingScale()), AdaptiveResolution::kTargetSeconds, 0.005);
  for (int i = 0; i < 60; ++i) resolution.measured(resolution.movingScale(), 10);
  EXPECT_DOUBLE_EQ(resolution.movingScale(), AdaptiveResolution::kLeast);
  for (int i = 0; i < 60; ++i) resolution.measured(resolution.movingScale(), 1e-5);
  EXPECT_DOUBLE_EQ(resolution.movingScale(), 1.0);
}

class FilesTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("acentric_editor_files_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "a");
    fs::create_directories(folder_ / "b" / "deep");
    std::ofstream(folder_ / "a" / "room.obj") << "v 0 0 0\n";
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(FilesTest, PreferencesSurviveARoundTripAndADamagedFile) {
  const fs::path file = folder_ / "config" / "editor.json";
  Preferences preferences;
  preferences.bakeThreads = 3;
  preferences.walkMegabytes = 700;
  preferences.walkMetresPerSecond = 2.5;
  preferences.walkWidth = 512;
  for (int i = 0; i < 15; ++i) preferences.addRecent("/p/" + std::to_string(i));
  preferences.addRecent("/p/9");
  const PublishPlace first{"/srv/a", true, false, "https://example.org/"};
  for (std::size_t i = 0; i < Preferences::kMostPublished; ++i)
    preferences.rememberPublished("/p/" + std::to_string(i), {"/srv/" + std::to_string(i)});
  preferences.rememberPublished("/p/9", first);
  preferences.rememberPublished("/p/more", {"/srv/more"});
  ASSERT_TRUE(savePreferences(preferences, file));
  const Preferences read = loadPreferences(file);
  ASSERT_EQ(read.published.size(), Preferences::kMostPublished);
  EXPECT_EQ(read.published[0].project, "/p/more");
  EXPECT_EQ(read.published[1].project, "/p/9");
  EXPECT_EQ(read.published[1].place, first);
  EXPECT_EQ(read.bakeThreads, 3);
  EXPECT_EQ(read.walkMegabytes, 700);
  EXPECT_EQ(read.walkMetresPerSecond, 2.5);
  EXPECT_EQ(read.walkWidth, 512);
  EXPECT_EQ(read.recent, preferences.recent);
  EXPECT_EQ(read.recent.size(), Preferences::kMostRecent);
  EXPECT_EQ(read.recent.front(), "/p/9");
  for (
      const char* damage :
      {"", "{", "[1,2]",
       R"({"recent":7,"walkWidth":"x","bakeThreads":-5,"settingsWidth":1e99,"published":[3,{"project":"/p","folder":"web"}]})"}) {
    std::ofstream(file, std::ios::trunc) << damage;
    std::string problem;
    const Preferences fallback = loadPreferences(file, &problem);
    const bool unusable = *damage != '{' || damage[1] == '\0';
    EXPECT_EQ(!problem.empty(), unusable) << damage;
    EXPECT_EQ(fs::exists(file.string() + ".damaged"), unusable) << "kept, not written over";
    fs::remove(file.string() + ".damaged");
    EXPECT_TRUE(fallback.recent.empty()) << damage;
    EXPECT_TRUE(fallback.published.empty()) << damage;
    EXPECT_EQ(fallback.settingsWidth, Preferences().settingsWidth) << damage;
    EXPECT_EQ(fallback.bakeThreads, 0) << damage;
  }
}

TEST_F(FilesTest, AutosaveNeverTouchesTheProjectAndIsOfferedOnlyWhenItDiffers) {
  Project project;
  project.scene = "room.obj";
  const fs::path file = folder_ / "a" / "room.acentric.json";
  ASSERT_TRUE(saveProject(project, file));
  EXPECT_EQ(recoverableAutosave(file, project).value(), std::nullopt);
  Project edited = project;
  edited.layout().cellSize = 3.5;
  ASSERT_TRUE(writeAutosave(edited, file));
  EXPECT_EQ(*loadProject(file), project);
  EXPECT_EQ(recoverableAutosave(file, project).value(), edited);
  EXPECT_EQ(recoverableAutosave(file, edited).value(), std::nullopt);
  std::ofstream(autosaveFileFor(file), std::ios::trunc) << "{ half a fi";
  EXPECT_FALSE(recoverableAutosave(file, project).has_value()) << "it cannot be read, and says so";
  removeAutosave(file);
  EXPECT_FALSE(fs::exists(autosaveFileFor(file)));
}

TEST_F(FilesTest, AProjectThatMovesTakesItsModelAlong) {
  ImportHost host;
  host.importer = ACENTRIC_IMPORTER;
  host.cacheFolder = folder_ / "cache";
  const fs::path from = folder_ / "a" / "x.acentric.json", to = folder_ / "b" / "deep" / "y.acentric.json";
  Project project;
  project.scene = "gone.obj";
  EXPECT_EQ(*movedProject(project, from, to, host), project) << "of a model that is gone the name is kept";
  project.scene = "room.obj";
  fs::create_directories(folder_ / "a");
  writeRoom(folder_ / "a" / "room.obj");
  const auto unknown = movedProject(project, from, folder_ / "c" / "y.acentric.json", host);
  ASSERT_TRUE(unknown) << unknown.error().describe();
  EXPECT_TRUE(fs::is_symlink(folder_ / "c" / unknown->scene)) << "it was never imported here";
  ASSERT_TRUE(importScene(folder_ / "a" / "room.obj", {}, host));
  const auto moved = movedProject(project, from, to, host);
  ASSERT_TRUE(moved) << moved.error().describe();
  EXPECT_EQ(moved->scene, "models/room/room.obj");
  EXPECT_TRUE(fs::is_regular_file(folder_ / "b" / "deep" / moved->scene));
  EXPECT_FALSE(fs::is_symlink(folder_ / "b" / "deep" / moved->scene));
  EXPECT_EQ(*movedProject(project, from, folder_ / "a" / "y.acentric.json", host), project);
  EXPECT_EQ(movedProject(project, from, folder_ / "y.acentric.json", host)->scene, "a/room.obj");
}

TEST_F(FilesTest, CapturesGoAlongAndTemporariesStay) {
  const fs::path from = folder_ / "a" / "x.acentric.json";
  const fs::path to = folder_ / "b" / "y.acentric.json";
  fs::create_directories(captureFolderFor(from));
  std::ofstream(captureFolderFor(from) / "k1.pack") << "one";
  std::ofstream(captureFolderFor(from) / "k1.record") << "two";
  std::ofstream(captureFolderFor(from) / ".acentric-tmp-1-k2.pack") << "half";
  EXPECT_EQ(shareCaptures(from, to).value(), 2);
  EXPECT_TRUE(fs::exists(captureFolderFor(to) / "k1.pack"));
  EXPECT_TRUE(fs::exists(captureFolderFor(to) / "k1.record"));
  EXPECT_FALSE(fs::exists(captureFolderFor(to) / ".acentric-tmp-1-k2.pack"));
  EXPECT_EQ(shareCaptures(from, to).value(), 0);
}

TEST(ProjectFiles, AModelsProjectIsProposedBesideIt) {
  EXPECT_EQ(suggestedProjectFile("/models/hall.glb"), "/models/hall.acentric.json");
  EXPECT_TRUE(isProjectFile("/x/hall.acentric.json"));
  EXPECT_FALSE(isProjectFile("/x/hall.json"));
}

TEST(Actions, HaveUniqueIdsAndKeysAndCanBeFoundByBoth) {
  const std::vector<Action> table = makeActionTable();
  std::set<std::string> ids;
  std::set<std::string> keys;
  for (const Action& action : table) {
    EXPECT_TRUE(ids.insert(action.id).second) << action.id;
    EXPECT_TRUE(action.enabled && action.run) << action.id;
    for (const Shortcut& shortcut : {action.shortcut, action.alternative}) {
      if (shortcut.key == 0) continue;
      EXPECT_TRUE(keys.insert(describe(shortcut)).second) << describe(shortcut);
      ASSERT_NE(findAction(table, shortcut), nullptr);
      EXPECT_EQ(findAction(table, shortcut)->id, action.id);
    }
    // Walking keys are held, not pressed: no action may take them.
    for (const int code : {ui::key::w, ui::key::a, ui::key::s, ui::key::d, ui::key::q, ui::key::e})
      EXPECT_FALSE(action.shortcut == (Shortcut{code, 0})) << action.id;
  }
  EXPECT_EQ(findAction(table, std::string("no.such")), nullptr);
  EXPECT_EQ(findAction(table, Shortcut{}), nullptr);
}

}  // namespace
}  // namespace acentric::editor
