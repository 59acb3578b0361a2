#include "engine/pipeline/project_lock.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <memory>

#include "engine/base/file.h"
#include "engine/pipeline/bake_guard.h"
#include "tests/support/project_folder.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

class ProjectLocks : public test::ProjectFolder {
 protected:
  Result<BakeGuard> begin(BakePart part = {}, bool takeOver = false) const {
    return BakeGuard::begin(file_, {part, takeOver});
  }
  /// Files beside the project.
  std::vector<std::string> beside() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path() != file_) names.push_back(entry.path().filename().string());
    return names;
  }
};

TEST_F(ProjectLocks, ALockIsHeldByOneAndGoneWithIt) {
  {
    const auto first = ProjectLock::take(file_, false);
    ASSERT_TRUE(first.lock.has_value());
    EXPECT_TRUE(first.note.empty());
    const auto second = ProjectLock::take(file_, false);
    EXPECT_FALSE(second.lock.has_value());
    ASSERT_TRUE(second.heldBy.has_value());
    EXPECT_EQ(second.heldBy->process, ::getpid());
    EXPECT_NE(describe(*second.heldBy).find(std::to_string(::getpid())), std::string::npos);
    EXPECT_FALSE(first.lock->lostTo().has_value());
  }
  EXPECT_FALSE(fs::exists(lockFileFor(file_)));
  EXPECT_TRUE(ProjectLock::take(file_, false).lock.has_value());
}

TEST_F(ProjectLocks, ALockOfADeadProcessIsTakenOverWithANote) {
  inAnotherProcess([&] { new ProjectLock::Attempt(ProjectLock::take(file_, false)); });
  ASSERT_TRUE(fs::exists(lockFileFor(file_)));
  EXPECT_TRUE(isStale(*readLock(file_)));
  const auto attempt = ProjectLock::take(file_, false);
  EXPECT_TRUE(attempt.lock.has_value());
  EXPECT_NE(attempt.note.find("ended without closing"), std::string::npos) << attempt.note;
}

TEST_F(ProjectLocks, AProcessOfTheSameNumberThatBeganLaterIsAnother) {
  const auto held = ProjectLock::take(file_, false);
  LockOwner owner = *readLock(file_);
  EXPECT_FALSE(isStale(owner));
  owner.processStart = "1";
  EXPECT_TRUE(isStale(owner));
}

TEST_F(ProjectLocks, ALockOfAnotherMachineIsNamedAndNeverStale) {
  write(lockFileFor(file_),
        R"({"format":"acentric-lock","host":"far.example","user":"ann","since":"2026-01-01 10:00",
            "process":999999999,"processStart":"5","machine":".acentric-tmp-00000000-","token":"t"})");
  const auto attempt = ProjectLock::take(file_, false);
  ASSERT_TRUE(attempt.heldBy.has_value());
  EXPECT_EQ(describe(*attempt.heldBy), "ann on far.example since 2026-01-01 10:00 (process 999999999)");
}

TEST_F(ProjectLocks, WhoLosesALockNoticesAndDoesNotRemoveTheOther) {
  auto first = ProjectLock::take(file_, false);
  const auto second = ProjectLock::take(file_, true);
  ASSERT_TRUE(second.lock.has_value());
  ASSERT_TRUE(first.lock->lostTo().has_value());
  first.lock.reset();
  EXPECT_TRUE(fs::exists(lockFileFor(file_)));
  EXPECT_FALSE(second.lock->lostTo().has_value());
}

TEST_F(ProjectLocks, ADamagedLockIsReplacedWithANote) {
  for (const char* damage :
       {"", "{", "[]", R"({"format":"acentric-lock","process":"seven"})", "\xff\xfe\x00"}) {
    write(lockFileFor(file_), damage);
    const auto attempt = ProjectLock::take(file_, false);
    EXPECT_TRUE(attempt.lock.has_value()) << damage;
    EXPECT_NE(attempt.note.find("damaged"), std::string::npos) << damage;
  }
}

TEST_F(ProjectLocks, WhereNoLockCanBeWrittenItIsToldAndNothingBlocks) {
  const auto attempt = ProjectLock::take(folder_ / "no such folder" / "walk.acentric.json", false);
  EXPECT_FALSE(attempt.lock.has_value());
  EXPECT_FALSE(attempt.heldBy.has_value());
  EXPECT_FALSE(attempt.note.empty());
}

// ---- Bakes -----------------------------------------------------------------------------------------------

constexpr BakePart kLight{BakePart::Kind::light, {}};
constexpr BakePart kCameras{BakePart::Kind::cameras, {}};
constexpr BakePart shard(int number) { return {BakePart::Kind::shard, {number, 3}}; }

TEST_F(ProjectLocks, ASecondBakeIsRefusedByNameAndTheWayOutIsTold) {
  {
    const auto first = begin();
    ASSERT_TRUE(first.has_value());
    EXPECT_TRUE(first->note().empty());
    const auto second = begin();
    ASSERT_FALSE(second.has_value());
    const std::string told = second.error().describe();
    EXPECT_NE(told.find("walk.acentric.json: is being baked by"), std::string::npos) << told;
    EXPECT_NE(told.find(std::to_string(::getpid())), std::string::npos) << told;
    EXPECT_NE(told.find(thisOwner().host), std::string::npos) << told;
    EXPECT_NE(told.find("since 20"), std::string::npos) << told;
    EXPECT_NE(told.find("--take-over"), std::string::npos) << told;
    EXPECT_TRUE(first->check().has_value()) << "who asked in vain changes nothing";
    EXPECT_TRUE(ProjectLock::take(file_, false).lock.has_value()) << "an editor's lock is another";
  }
  EXPECT_TRUE(beside().empty()) << "locks go with the bake";
  EXPECT_TRUE(begin().has_value());
}

TEST_F(ProjectLocks, ABakeThatIsTakenOverMayNotGoOn) {
  const auto first = begin();
  const auto second = begin({}, true);
  ASSERT_TRUE(first && second);
  const Status lost = first->check();
  ASSERT_FALSE(lost.has_value());
  EXPECT_NE(lost.error().message.find("taken over by"), std::string::npos) << lost.error().message;
  EXPECT_TRUE(second->check().has_value());
}

TEST_F(ProjectLocks, ABakeThatDiedIsTakenOverWithoutAsking) {
  inAnotherProcess([&] { new Result<BakeGuard>(begin()); });
  ASSERT_EQ(beside().size(), 1U);
  const auto next = begin();
  ASSERT_TRUE(next.has_value());
  EXPECT_NE(next->note().find("ended before it had finished"), std::string::npos) << next->note();
  inAnotherProcess([&] { new Result<BakeGuard>(BakeGuard::begin(file_, {shard(2), true})); });
  EXPECT_TRUE(begin({}, true).has_value()) << "a share that died neither";
}

TEST_F(ProjectLocks, SharesAreBakedSideBySideAndTwiceAtOnceButNotBesideAWholeBake) {
  {
    const auto one = begin(shard(1)), two = begin(shard(2)), again = begin(shard(2)), light = begin(kLight);
    ASSERT_TRUE(one && two && again && light);
    const auto whole = begin();
    ASSERT_FALSE(whole.has_value());
    EXPECT_NE(whole.error().message.find("has its share 1/3 baked by"), std::string::npos)
        << whole.error().message;
    EXPECT_FALSE(begin(kCameras).has_value());
    EXPECT_TRUE(begin({}, true).has_value());
    EXPECT_TRUE(one->check() && two->check()) << "shares go on: they write the same bytes";
  }
  {
    const auto whole = begin();
    ASSERT_TRUE(whole.has_value());
    EXPECT_FALSE(begin(shard(1)).has_value());
    EXPECT_FALSE(begin(kLight).has_value());
    EXPECT_TRUE(begin(shard(1), true).has_value());
    EXPECT_TRUE(whole->check().has_value()) << "a share takes nothing away";
  }
  const auto cameras = begin(kCameras), light = begin(kLight);
  EXPECT_TRUE(cameras && light) << "the light may be left to a process of its own";
  EXPECT_FALSE(begin(kCameras).has_value());
  EXPECT_FALSE(begin().has_value());
}

TEST_F(ProjectLocks, AModelThatChangesWhileItIsBakedEndsTheBake) {
  const fs::path model = folder_ / "room.obj";
  write(model, "v 0 0 0");
  auto guard = begin();
  ASSERT_TRUE(guard.has_value());
  guard->watch({stampOf(model)});
  EXPECT_TRUE(guard->check().has_value());
  fs::last_write_time(model, fs::last_write_time(model) + std::chrono::seconds(5));
  EXPECT_TRUE(guard->check().has_value()) << "a time alone is no change";
  write(model, "v 0 0 1");
  fs::last_write_time(model, fs::last_write_time(model) + std::chrono::seconds(9));
  const Status changed = guard->check();
  ASSERT_FALSE(changed.has_value());
  EXPECT_EQ(changed.error().where, model.string());
  EXPECT_NE(changed.error().message.find("changed while it was baked"), std::string::npos);
  EXPECT_NE(changed.error().message.find("bake again"), std::string::npos);
  fs::remove(model);
  EXPECT_FALSE(guard->check().has_value());
}

TEST_F(ProjectLocks, AModelWrittenToSinceItWasAskedForCountsAsChanged) {
  write(folder_ / "room.obj", "v 0 0 0");
  Project project;
  project.scene = "room.obj";
  ImportHost host;
  host.cacheFolder = folder_ / "cache";
  const auto written = fs::last_write_time(folder_ / "room.obj");
  auto guard = begin();
  ASSERT_TRUE(guard.has_value());
  guard->watch(modelFiles(file_, project, host, written + std::chrono::seconds(1)));
  EXPECT_TRUE(guard->check().has_value());
  guard->watch(modelFiles(file_, project, host, written - std::chrono::seconds(1)));
  EXPECT_FALSE(guard->check().has_value());
}

}  // namespace
}  // namespace acentric
