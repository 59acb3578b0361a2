#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "editor/session/file_watch.h"
#include "editor/session/project_files.h"
#include "editor/session/unsaved_work.h"
#include "engine/base/file.h"
#include "tests/support/project_folder.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;

class DocumentFiles : public test::ProjectFolder {};

TEST_F(DocumentFiles, AChangeIsToldOnceItKeepsStillAndOnlyIfTheContentDiffers) {
  write(folder_ / "a", "one");
  write(folder_ / "b", "two");
  FileWatch watch({stampOf(folder_ / "a"), stampOf(folder_ / "b")});
  EXPECT_FALSE(watch.look());
  write(folder_ / "a", "another");
  EXPECT_FALSE(watch.look()) << "it may still be written";
  EXPECT_TRUE(watch.look());
  EXPECT_EQ(watch.different(), std::vector{folder_ / "a"});
  EXPECT_FALSE(watch.look()) << "told once";
  write(folder_ / "a", "one");
  watch.look();
  EXPECT_TRUE(watch.look());
  EXPECT_TRUE(watch.different().empty()) << "as it was read";
  fs::remove(folder_ / "b");
  watch.look();
  EXPECT_TRUE(watch.look());
  EXPECT_EQ(watch.different(), std::vector{folder_ / "b"});
}

TEST_F(DocumentFiles, ACopyHasANameOfItsOwn) {
  EXPECT_EQ(freeCopyName(file_), folder_ / "walk copy.acentric.json");
  write(folder_ / "walk copy.acentric.json", "{}");
  EXPECT_EQ(freeCopyName(file_), folder_ / "walk copy 2.acentric.json");
}

TEST_F(DocumentFiles, WorkWithoutAFileIsListedOnceItsProcessIsGone) {
  Project project;
  project.scene = "room.obj";
  project.fovDegrees = 71;
  const fs::path folder = folder_ / "unsaved";
  ASSERT_TRUE(writeUnsavedWork(folder, file_, project));
  EXPECT_TRUE(listUnsavedWork(folder).works.empty()) << "this process is at work on it";
  EXPECT_EQ(readUnsavedWork(unsavedWorkFile(folder, file_))->project, project);
  fs::remove(unsavedWorkFile(folder, file_));
  inAnotherProcess([&] { (void)writeUnsavedWork(folder, file_, project); });
  const UnsavedWorks found = listUnsavedWork(folder);
  ASSERT_EQ(found.works.size(), 1U);
  EXPECT_EQ(found.works.front().project, project);
  EXPECT_EQ(found.works.front().projectFile, file_);
  EXPECT_TRUE(found.damaged.empty());
}

TEST_F(DocumentFiles, DamagedUnsavedWorkIsNamed) {
  const fs::path folder = folder_ / "unsaved";
  fs::create_directories(folder);
  write(folder / "a.unsaved.json", "{ half a fi");
  write(folder / "b.unsaved.json", R"({"format":"acentric-unsaved","process":1})");
  write(folder / "else.txt", "nothing of ours");
  const UnsavedWorks found = listUnsavedWork(folder);
  EXPECT_TRUE(found.works.empty());
  EXPECT_EQ(found.damaged.size(), 2U);
}

}  // namespace
}  // namespace acentric::editor
