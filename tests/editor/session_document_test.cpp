/// The session as the keeper of a document: crashes, other editors and other programs lose nothing.

#include <algorithm>

#include "editor/actions/action_table.h"
#include "editor/session/project_files.h"
#include "engine/base/file.h"
#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

class DocumentTest : public SessionTest {
 protected:
  SessionOptions options() const {
    SessionOptions options = SessionTest::options();
    options.unsavedFolder = folder_ / "state";
    options.watchSeconds = 0;
    return options;
  }
  /// A saved project of the room, closed again.
  fs::path savedProject() {
    const fs::path file = folder_ / "room.acentric.json";
    Session session(options());
    openAndSettle(session, folder_ / "room.obj");
    makeCoarse(session);
    EXPECT_TRUE(session.saveAs(file));
    waitFor(session, [&] { return !session.working(); });
    return file;
  }
  static bool lists(const Session& session, const std::string& text) {
    return std::ranges::any_of(session.problems(), [&](const Problem& problem) {
      return problem.text.find(text) != std::string::npos;
    });
  }
  /// As a process that was killed leaves it.
  void forsake(const fs::path& json) {
    std::string text = *readText(json);
    const auto at = text.find("\"processStart\": \"");
    ASSERT_NE(at, std::string::npos);
    text.insert(at + 17, "1");
    std::ofstream(json, std::ios::trunc) << text;
  }
};

TEST_F(DocumentTest, WorkThatWasNeverSavedIsOfferedAfterACrash) {
  {
    Session session(options());
    openAndSettle(session, folder_ / "room.obj");
    session.poll(now_ += 100);
    EXPECT_FALSE(fs::exists(unsavedWorkFile(folder_ / "state", session.file()))) << "nothing was done yet";
    session.apply(setEyeHeight(session.project(), 1.23));
    waitFor(session, [&] { return !session.working(); });
    session.poll(now_ += 100);
  }
  const fs::path autosave = unsavedWorkFile(folder_ / "state", folder_ / "room.acentric.json");
  ASSERT_TRUE(fs::exists(autosave));
  forsake(autosave);
  const fs::path left = folder_ / "state" / "left.unsaved.json";
  fs::rename(autosave, left);
  {
    Session session(options());
    ASSERT_EQ(session.unsavedWork().size(), 1U);
    openAndSettle(session, session.unsavedWork().front().autosave);
    EXPECT_EQ(session.project().layout().eyeHeight, 1.23);
    EXPECT_TRUE(session.untitled());
    EXPECT_TRUE(session.dirty());
    EXPECT_TRUE(session.worthAsking());
    session.poll(now_ += 100);
    EXPECT_FALSE(fs::exists(left)) << "this editor keeps it now";
    EXPECT_TRUE(fs::exists(autosave));
    ASSERT_TRUE(session.saveAs(folder_ / "room.acentric.json"));
    EXPECT_FALSE(fs::exists(autosave));
    waitFor(session, [&] { return !session.working(); });
  }
  EXPECT_TRUE(Session(options()).unsavedWork().empty());
}

TEST_F(DocumentTest, OpeningTheModelAgainOffersWhatWasNotSaved) {
  {
    Session session(options());
    openAndSettle(session, folder_ / "room.obj");
    session.apply(setEyeHeight(session.project(), 1.23));
    waitFor(session, [&] { return !session.working(); });
    session.poll(now_ += 100);
  }
  const fs::path autosave = unsavedWorkFile(folder_ / "state", folder_ / "room.acentric.json");
  forsake(autosave);
  const fs::path left = folder_ / "state" / "left.unsaved.json";
  fs::rename(autosave, left);
  Session session(options());
  openAndSettle(session, folder_ / "room.obj");
  ASSERT_TRUE(session.recoveryOffered());
  session.poll(now_ += 100);
  EXPECT_TRUE(fs::exists(left)) << "kept until it is answered";
  session.answerRecovery(true);
  EXPECT_EQ(session.project().layout().eyeHeight, 1.23);
  session.poll(now_ += 100);
  EXPECT_FALSE(fs::exists(left));
  waitFor(session, [&] { return !session.working(); });
  session.close();
  EXPECT_FALSE(fs::exists(autosave)) << "closed on the user's word";
}

TEST_F(DocumentTest, ADamagedAutosaveIsPutAsideAndTold) {
  const fs::path file = savedProject();
  std::ofstream(autosaveFileFor(file)) << "{ half a fi";
  std::ofstream(folder_ / "editor.json", std::ios::trunc) << "{ half a fi";
  fs::create_directories(folder_ / "state");
  std::ofstream(folder_ / "state" / "x.unsaved.json") << "]";
  Session session(options());
  EXPECT_TRUE(told(session, "The preferences were damaged"));
  EXPECT_TRUE(told(session, "x.unsaved.json.damaged"));
  openAndSettle(session, file);
  EXPECT_FALSE(session.recoveryOffered());
  EXPECT_TRUE(told(session, "autosave"));
  EXPECT_TRUE(fs::exists(autosaveFileFor(file).string() + ".damaged"));
}

TEST_F(DocumentTest, ASecondEditorIsReadOnlyAndTakesOverOnTheUsersWord) {
  const fs::path file = savedProject();
  Session first(options());
  openAndSettle(first, file);
  EXPECT_FALSE(first.readOnly());
  first.apply(setEyeHeight(first.project(), 1.1));
  first.poll(now_ += 100);
  ASSERT_TRUE(fs::exists(autosaveFileFor(file)));

  Session second(options());
  openAndSettle(second, file);
  EXPECT_TRUE(second.readOnly());
  EXPECT_TRUE(second.lockQuestion());
  EXPECT_FALSE(second.recoveryOffered()) << "the first is at work on it";
  EXPECT_TRUE(lists(second, "read-only"));
  second.answerLock(LockAnswer::readOnly);
  second.apply(setEyeHeight(second.project(), 1.2));
  EXPECT_EQ(second.saveObstacle(), SaveObstacle::readOnly);
  EXPECT_FALSE(second.save());
  EXPECT_FALSE(second.saveAs(file)) << "the same file by another way";
  EXPECT_NE(second.title().find("read-only"), std::string::npos);
  second.poll(now_ += 100);
  EXPECT_TRUE(fs::exists(unsavedWorkFile(folder_ / "state", file))) << "edits are kept, elsewhere";
  second.close();
  EXPECT_TRUE(fs::exists(lockFileFor(file))) << "it is the first's";
  EXPECT_TRUE(fs::exists(autosaveFileFor(file))) << "so is this";

  openAndSettle(second, file);
  second.answerLock(LockAnswer::takeOver);
  EXPECT_FALSE(second.readOnly());
  EXPECT_TRUE(second.recoveryOffered());
  second.answerRecovery(false);
  EXPECT_EQ(first.saveObstacle(), SaveObstacle::readOnly);
  EXPECT_TRUE(told(first, "was taken over"));
  EXPECT_FALSE(first.save());
  ASSERT_TRUE(first.saveAs(folder_ / "mine.acentric.json"));
  EXPECT_FALSE(first.readOnly());
  waitFor(first, [&] { return !first.working(); });
  waitFor(second, [&] { return !second.working(); });
}

TEST_F(DocumentTest, ACopyOfALockedProjectHasItsOwnFile) {
  const fs::path file = savedProject();
  Session first(options()), second(options());
  openAndSettle(first, file);
  openAndSettle(second, file);
  ASSERT_TRUE(second.lockQuestion());
  second.answerLock(LockAnswer::copy);
  EXPECT_EQ(second.file(), folder_ / "room copy.acentric.json");
  EXPECT_FALSE(second.readOnly());
  second.apply(setEyeHeight(second.project(), 1.2));
  EXPECT_TRUE(second.save());
  EXPECT_NE(loadProject(file)->layout().eyeHeight, 1.2);
  waitFor(second, [&] { return !second.working(); });
}

TEST_F(DocumentTest, AProjectThatAnotherProgramChangedIsNotOverwrittenUnasked) {
  const fs::path file = savedProject();
  Session session(options());
  openAndSettle(session, file);
  EXPECT_EQ(session.saveObstacle(), SaveObstacle::none);
  session.apply(setEyeHeight(session.project(), 1.1));
  Project theirs = *loadProject(file);
  theirs.fovDegrees = 77;
  ASSERT_TRUE(saveProject(theirs, file));
  session.poll(now_ += 100);
  EXPECT_TRUE(session.projectFileChanged());
  EXPECT_TRUE(lists(session, "changed the project's file"));
  EXPECT_FALSE(session.save());
  EXPECT_EQ(*loadProject(file), theirs);

  ASSERT_TRUE(session.reload());
  EXPECT_EQ(session.project(), theirs);
  EXPECT_FALSE(session.dirty());
  EXPECT_FALSE(session.projectFileChanged());
  session.undo();
  EXPECT_EQ(session.project().layout().eyeHeight, 1.1) << "what was here is not lost";
  EXPECT_TRUE(session.save()) << "it was told of";

  theirs.fovDegrees = 78;
  ASSERT_TRUE(saveProject(theirs, file));
  EXPECT_FALSE(session.save());
  EXPECT_TRUE(session.save(true));
  EXPECT_EQ(loadProject(file)->layout().eyeHeight, 1.1);
  waitFor(session, [&] { return !session.working(); });
}

TEST_F(DocumentTest, SavingAsksBeforeItOverwrites) {
  const fs::path file = savedProject();
  Session session(options());
  EditorState state;
  ActionContext actions{session, state};
  openAndSettle(session, file);
  session.apply(setEyeHeight(session.project(), 1.1));
  std::ofstream(file, std::ios::app) << "\n";
  saveThen(actions, {});
  EXPECT_EQ(state.dialog, Dialog::changedOnDisk);
  EXPECT_TRUE(session.dirty());
  overwriteThen(actions, {});
  EXPECT_FALSE(session.dirty());
  waitFor(session, [&] { return !session.working(); });
}

TEST_F(DocumentTest, ABakeOfAnotherProgramIsNotDisturbedUntilItIsTakenOver) {
  const fs::path file = savedProject();
  const auto other = BakeGuard::begin(file, {});
  ASSERT_TRUE(other.has_value());
  Session session(options());
  openAndSettle(session, file);
  const std::string refused = "is being baked by";
  session.startBake();
  waitFor(
      session, [&] { return told(session, refused); }, refused);
  EXPECT_TRUE(told(session, "Take over bake"));
  waitFor(
      session, [&] { return !session.working(); }, refused);
  EXPECT_FALSE(session.captures()->complete());
  EXPECT_TRUE(other->check().has_value());
  session.startBake({}, true);
  waitFor(
      session, [&] { return session.baking().running(); }, refused);
  waitFor(
      session, [&] { return !session.working() && session.captures()->complete(); }, refused);
  EXPECT_FALSE(fs::exists(lockFileFor(file.string() + ".bake")));
}

TEST_F(DocumentTest, AModelThatChangedIsToldAndImportedAgainOnTheUsersWord) {
  const fs::path file = savedProject();
  Session session(options());
  openAndSettle(session, file);
  session.startBake();
  waitFor(session, [&] { return !session.working() && session.captures()->complete(); });
  const ContentKey before = session.built()->scene->key;
  std::ofstream(folder_ / "room.obj", std::ios::app) << "v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nf 9 10 11\n";
  waitFor(session, [&] { return session.sceneFiles().state == SceneFiles::State::changed; });
  EXPECT_TRUE(lists(session, "room.obj changed on disk"));
  EXPECT_EQ(session.built()->scene->key, before) << "not without the user's word";
  const Project project = session.project();
  session.reimport();
  waitFor(session, [&] { return !session.working() && session.built()->scene->key != before; });
  waitFor(session, [&] { return std::ranges::count(session.captures()->stale, true) > 0; });
  EXPECT_EQ(session.project(), project) << "no edit";
  EXPECT_FALSE(session.captures()->complete());
  EXPECT_EQ(session.sceneFiles().state, SceneFiles::State::asImported);
  waitFor(session, [&] { return lists(session, "out of date"); });
}

TEST_F(DocumentTest, AModelThatChangedIsImportedByItselfWhereThatIsWanted) {
  const fs::path file = savedProject();
  Session session(options());
  session.preferences().reimportAutomatically = true;
  openAndSettle(session, file);
  const ContentKey before = session.built()->scene->key;
  waitFor(session, [&] { return !session.working(); });
  std::ofstream(folder_ / "room.obj", std::ios::app) << "v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nf 9 10 11\n";
  waitFor(session, [&] { return session.built()->scene->key != before; });
  waitFor(session, [&] { return !session.working(); });
}

TEST_F(DocumentTest, AProjectWhoseModelIsGoneOpensAsLastImportedAndTheModelIsLocated) {
  const fs::path file = savedProject();
  ContentKey key;
  {
    Session session(options());
    openAndSettle(session, file);
    key = session.built()->scene->key;
    session.startBake();
    waitFor(session, [&] { return !session.working() && session.captures()->complete(); });
  }
  fs::create_directories(folder_ / "models");
  fs::rename(folder_ / "room.obj", folder_ / "models" / "hall.obj");
  Session session(options());
  openAndSettle(session, file);
  EXPECT_TRUE(session.locateQuestion());
  EXPECT_EQ(session.sceneFiles().state, SceneFiles::State::missing);
  EXPECT_TRUE(session.sceneFiles().fromCache);
  EXPECT_EQ(session.built()->scene->key, key);
  EXPECT_TRUE(session.captures()->complete()) << "what is baked is still walked";
  EXPECT_TRUE(lists(session, "not where it was"));
  // Edits go on as ever.
  session.apply(setEyeHeight(session.project(), 1.3));
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  EXPECT_EQ(session.sceneFiles().state, SceneFiles::State::missing);

  session.locateScene(folder_ / "models" / "hall.obj");
  EXPECT_EQ(session.project().scene, fs::path("models/hall.obj"));
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  EXPECT_EQ(session.built()->scene->key, key);
  EXPECT_EQ(session.sceneFiles().state, SceneFiles::State::asImported);
  session.undo();
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  EXPECT_EQ(session.sceneFiles().state, SceneFiles::State::missing) << "an edit like any other";
  session.redo();
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
}

TEST_F(DocumentTest, AModelLocatedOutsideTheProjectsFolderIsLinkedTo) {
  fs::create_directories(folder_ / "walk");
  fs::copy_file(folder_ / "room.obj", folder_ / "walk" / "room.obj");
  Session session(options());
  openAndSettle(session, folder_ / "walk" / "room.obj");
  ASSERT_TRUE(session.save());
  session.locateScene(folder_ / "room.obj");
  EXPECT_EQ(session.project().scene, fs::path("models/room/room.obj"));
  EXPECT_EQ(fs::read_symlink(folder_ / "walk" / session.project().scene),
            fs::canonical(folder_ / "room.obj"));
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  EXPECT_TRUE(session.save());
}

TEST_F(DocumentTest, AProjectWhoseModelLiesOutsideIsAskedAboutAndOpensOnceItIsBroughtIn) {
  const fs::path inside = savedProject();
  fs::create_directories(folder_ / "walk");
  const fs::path file = folder_ / "walk" / "walk.acentric.json";
  std::string text = *readText(inside);
  text.replace(text.find("room.obj"), 8, "../room.obj");
  ASSERT_TRUE(writeTextAtomically(file, text));
  Session session(options());
  session.open(file);
  waitFor(session, [&] { return session.outsideModel().has_value(); });
  EXPECT_FALSE(session.hasProject());
  EXPECT_EQ(session.outsideModel()->scene, "../room.obj");
  session.answerOutside(std::nullopt);
  EXPECT_FALSE(session.outsideModel());
  EXPECT_EQ(*readText(file), text) << "as it was";
  EXPECT_FALSE(fs::exists(folder_ / "walk" / "models"));

  session.open(file);
  waitFor(session, [&] { return session.outsideModel().has_value(); });
  session.answerOutside(Collect::files);
  waitFor(session, [&] { return session.walk() && !session.working(); });
  EXPECT_EQ(session.file(), file);
  EXPECT_EQ(session.project().scene, "models/room/room.obj");
  EXPECT_EQ(loadProject(file)->scene, "models/room/room.obj");
}

TEST_F(DocumentTest, WithoutModelAndCacheTheLayoutIsStillThere) {
  const fs::path file = savedProject();
  fs::remove(folder_ / "room.obj");
  fs::remove_all(folder_ / "cache");
  Session session(options());
  openAndSettle(session, file);
  EXPECT_FALSE(session.sceneFiles().fromCache);
  EXPECT_GT(session.built()->layout->regions.size(), 0U);
  session.apply(setCellSize(session.project(), 2));
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  writeRoom(folder_ / "room.obj");
  waitFor(session, [&] { return session.sceneFiles().state == SceneFiles::State::asImported; });
  waitFor(session, [&] { return !session.working(); });
  EXPECT_FALSE(session.built()->scene->meshes.empty()) << "it is there again";
}

TEST_F(DocumentTest, AnImpossibleStateOfTheHistoryIsLeftForTheOneThatIsShown) {
  const fs::path file = savedProject();
  Session session(options());
  openAndSettle(session, file);
  fs::copy_file(folder_ / "room.obj", folder_ / "other.obj");
  session.locateScene(folder_ / "other.obj");
  waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  std::ofstream(folder_ / "room.obj", std::ios::trunc) << "this is no model";
  session.undo();
  for (int i = 0; i < 3000 && session.project().scene != fs::path("other.obj"); ++i) {
    session.poll(now_ += 0.05);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(session.project().scene, fs::path("other.obj"));
  EXPECT_EQ(session.history().size(), 2U) << "nothing of the history is lost";
}

TEST_F(DocumentTest, TheHistoryIsWalkedByItsListAndKeepsToItsMemory) {
  const fs::path file = savedProject();
  Session session(options());
  openAndSettle(session, file);
  const Project first = session.project();
  for (int i = 1; i <= 5; ++i) session.apply(setFieldOfView(session.project(), 60 + i));
  session.goTo(2);
  EXPECT_EQ(session.project().fovDegrees, 62);
  session.goTo(5);
  EXPECT_EQ(session.project().fovDegrees, 65);
  session.goTo(99);
  EXPECT_EQ(session.history().cursor(), 5U);
  session.goTo(0);
  EXPECT_EQ(session.project(), first);
  EXPECT_FALSE(session.dirty());
}

TEST_F(DocumentTest, ANewProjectIsLaidOutAsChosen) {
  Session session(options());
  NewProjectOptions chosen;
  chosen.configuration = Configuration::e;
  chosen.eyeHeight = 1.2;
  session.openNew(folder_ / "room.obj", chosen);
  waitFor(session, [&] { return session.walk() && !session.working(); });
  const LayoutSpec& spec = session.project().layout();
  EXPECT_EQ(spec.configuration, Configuration::e);
  EXPECT_EQ(spec.eyeHeight, 1.2);
  EXPECT_EQ(spec.cellSize, firstCellSize(spec.outline.area(), Configuration::e));
  EXPECT_TRUE(session.untitled());
}

TEST_F(DocumentTest, ProblemsAreLookedForWithoutBeingAsked) {
  const fs::path file = savedProject();
  SessionOptions always = options();
  always.inspectAlways = true;
  Session session(always);
  openAndSettle(session, file);
  TriangleBudget budget;
  budget.trianglesPerRegion = 1;
  session.apply(setBudget(session.project(), budget, "one"));
  waitFor(session, [&] { return lists(session, "the budget is 1"); });
  const auto inspected = session.inspection();
  session.apply(setCellSize(session.project(), 2));
  waitFor(session, [&] { return session.inspection() && session.inspection() != inspected; });
  waitFor(session, [&] { return !session.working(); });
}

}  // namespace
}  // namespace acentric::editor
