#include "editor/session/sweep_watch.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <functional>
#include <thread>

#include "editor/actions/accuracy_actions.h"
#include "editor/actions/action_table.h"
#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

/// The project as it is, and points that are worse and quicker.
Sweep smallSweep() {
  Sweep sweep;
  sweep.frames = 4;
  const auto add = [&](SweepSetting setting, double msSsim, double milliseconds) {
    SweepPoint point;
    point.setting = std::move(setting);
    const auto single = [](double value) { return Spread{value, value, value, value, 1}; };
    point[Measure::msSsim] = single(msSsim), point[Measure::frameMs] = single(milliseconds);
    point[Measure::bytes] = single(1e6);
    sweep.points.push_back(std::move(point));
  };
  add({}, 0.98, 6);
  add({{"reconstruction", "point"}}, 0.95, 2);
  return sweep;
}

/// A program in the place of `acentric` that does what a script says; $FOLDER is the sweep's.
class SweepWatchTest : public SessionTest {
 protected:
  fs::path program(const std::string& script) {
    const fs::path file = folder_ / "acentric";
    std::ofstream(file) << "#!/bin/bash\necho \"$@\" > " << (folder_ / "words").string()
                        << "\nFOLDER=" << sweepFolder().string() << "\n"
                        << script;
    fs::permissions(file, fs::perms::owner_all);
    return file;
  }
  fs::path project() const { return folder_ / "room.acentric.json"; }
  fs::path sweepFolder() const { return folder_ / "room.sweep"; }
  void await(SweepWatch& watch, const std::function<bool()>& done) {
    for (int i = 0; i < 3000 && !done(); ++i) {
      watch.poll(now_ += 2);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_TRUE(done());
  }
  void writeSweep(const std::string& text) const {
    fs::create_directories(sweepFolder());
    std::ofstream(sweepFolder() / "new") << text;
    fs::rename(sweepFolder() / "new", sweepFolder() / "sweep.json");
  }
};

TEST_F(SweepWatchTest, ReadsWhatIsMeasuredAsItGrows) {
  std::ofstream(folder_ / "ready.json") << toJson(smallSweep());
  // A trap: a shell that is interrupted while a command ends well would go on.
  SweepWatch watch(program("trap 'exit 0' INT; mv " + (folder_ / "ready.json").string() +
                           " $FOLDER/sweep.json; while true; do sleep 0.1; done"));
  watch.watch(project());
  EXPECT_FALSE(watch.poll(now_ += 2));
  ASSERT_TRUE(watch.start({3, 5, 320, 180, true}));
  await(watch, [&] { return watch.sweep() != nullptr; });
  EXPECT_TRUE(watch.running());
  EXPECT_EQ(watch.sweep()->points.size(), 2u);
  std::ifstream words(folder_ / "words");
  std::string said;
  std::getline(words, said);
  EXPECT_EQ(said, "sweep " + project().string() + " --budget-minutes 3 --frames 5 --size 320x180 --again");
  watch.stop();
  EXPECT_TRUE(watch.stopping());
  await(watch, [&] { return !watch.running(); });
  EXPECT_EQ(watch.trouble(), "") << "it was asked to end";
  EXPECT_NE(watch.sweep(), nullptr) << "what is measured is kept";
}

TEST_F(SweepWatchTest, LooksForWhatKeepsGoalsInAFolderOfItsOwn) {
  Sweep found = smallSweep();
  found.goals = Goals{2e6, 4, {}};
  std::ofstream(folder_ / "ready.json") << toJson(found);
  SweepWatch watch(program("mv " + (folder_ / "ready.json").string() + " " +
                           (folder_ / "room.goals" / "sweep.json").string()),
                   SweepWatch::Kind::goals);
  watch.watch(project());
  ASSERT_TRUE(watch.start({.minutes = 3, .frames = 2, .width = 320, .height = 180, .goals = *found.goals}));
  await(watch, [&] { return watch.sweep() != nullptr && !watch.running(); });
  std::ifstream words(folder_ / "words");
  std::string said;
  std::getline(words, said);
  EXPECT_EQ(said, "propose " + project().string() +
                      " --budget-minutes 3 --frames 2 --size 320x180 --max-mb 2 --max-ms 4");
  ASSERT_EQ(watch.sweep()->goals, found.goals);
  EXPECT_EQ(proposalOf(*watch.sweep(), *found.goals)->setting, found.points[1].setting);
  EXPECT_EQ(presetsOf(*watch.sweep()).back().name, "proposal");
}

TEST_F(SweepWatchTest, TellsWhyItFailed) {
  SweepWatch watch(program("echo working >&2; echo 'room: is not baked' >&2; exit 1"));
  watch.watch(project());
  ASSERT_TRUE(watch.start({}));
  await(watch, [&] { return !watch.running(); });
  EXPECT_EQ(watch.trouble(), "room: is not baked");
  SweepWatch none(folder_ / "nothing here");
  none.watch(project());
  const Status started = none.start({});
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().where, (folder_ / "nothing here").string());
}

TEST_F(SweepWatchTest, NamesAFileThatItCannotRead) {
  writeSweep("{ half a fi");
  SweepWatch watch(program(""));
  watch.watch(project());
  await(watch, [&] { return !watch.trouble().empty(); });
  EXPECT_NE(watch.trouble().find("sweep.json"), std::string::npos) << watch.trouble();
  writeSweep(toJson(smallSweep()));
  await(watch, [&] { return watch.sweep() != nullptr; });
  EXPECT_EQ(watch.trouble(), "") << "the file is whole now";
  watch.watch({});
  EXPECT_EQ(watch.sweep(), nullptr) << "of no project";
}

TEST_F(SweepWatchTest, EndsWhatItHasStarted) {
  pid_t pid = 0;
  {
    SweepWatch watch(program("trap '' INT; echo $$ > $FOLDER/pid; while true; do sleep 0.1; done"));
    watch.watch(project());
    ASSERT_TRUE(watch.start({}));
    await(watch, [&] { return bool(std::ifstream(sweepFolder() / "pid") >> pid); });
    EXPECT_EQ(::kill(pid, 0), 0);
  }
  EXPECT_NE(::kill(pid, 0), 0) << "it would not listen, and is gone all the same";
}

TEST_F(SweepWatchTest, PresetsAreEditsOfTheProject) {
  Session session(options());
  openAndSettle(session, folder_ / "room.obj");
  ASSERT_TRUE(session.saveAs(project()));
  EditorState state;
  ActionContext context{session, state};
  const std::vector<Action> table = makeActionTable();
  const Action& fast = *findAction(table, std::string("preset.fast"));
  EXPECT_FALSE(fast.enabled(context));
  EXPECT_EQ(whyDisabled(fast, context), "needs a measurement of accuracy against time");
  writeSweep(toJson(smallSweep()));
  waitFor(session, [&] { return session.sweeping().sweep() != nullptr; });
  ASSERT_TRUE(fast.enabled(context));
  const Project before = session.project();
  fast.run(context);
  EXPECT_EQ(session.project().view.reconstruction, Reconstruction::point);
  EXPECT_EQ(session.history().cursor(), 1u);
  fast.run(context);
  EXPECT_EQ(session.history().cursor(), 1u) << "it is so already";
  session.undo();
  EXPECT_EQ(session.project(), before);
  applySetting(context, {{"layers", "many"}}, "Use layers many");
  EXPECT_EQ(session.history().cursor(), 0u);
  EXPECT_EQ(session.messages().all().back().level, MessageLevel::error);
  const Action& start = *findAction(table, std::string("sweep.start"));
  EXPECT_TRUE(start.enabled(context));
  applySetting(context, {{"reconstruction", "point"}}, "Use points");
  EXPECT_FALSE(start.enabled(context)) << "the file is not what would be measured";
}

}  // namespace
}  // namespace acentric::editor
