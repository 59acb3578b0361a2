#include "engine/store/capture_store.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "engine/base/file.h"
#include "tests/store/synthetic_capture.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {
namespace fs = std::filesystem;

const ContentKey kFirst{1, 2};
const ContentKey kSecond{3, 4};

void damage(const fs::path& path) {
  auto bytes = readFile(path);
  ASSERT_TRUE(bytes) << bytes.error().describe();
  // Inside the blocks of a pack.
  for (std::size_t i = 0; i < 16; ++i) (*bytes)[bytes->size() * 3 / 4 + i] ^= std::byte(0x5a);
  ASSERT_TRUE(writeFileAtomically(path, *bytes));
}

bool hasTemporaries(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(kTemporaryPrefix)) return true;
  return false;
}

class StoreTest : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    capture_ = syntheticCapture({32, 24, true, true, 1});
  }
  CaptureStore openStore() {
    auto store = CaptureStore::open(folder_ / "captures");
    EXPECT_TRUE(store) << store.error().describe();
    return *store;
  }
  fs::path file(const ContentKey& key, const char* extension) const {
    return folder_ / "captures" / (key.toHex() + extension);
  }

  Capture capture_;
};

TEST_F(StoreTest, StoppedAtAnyMomentItHoldsACaptureWholeOrNotAtAll) {
  const CaptureStore store = openStore();
  const Capture heavy = syntheticCapture({900, 800, true, true, 1});
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  ASSERT_TRUE(store.put(kFirst, heavy));
  const auto whole = Clock::now() - began;
  constexpr int kMoments = 12;
  int stopped = 0;
  for (int n = 0; n < kMoments; ++n) {
    const ContentKey key{3, std::uint64_t(n)};
    std::stop_source stop;
    std::jthread timer([&] {
      std::this_thread::sleep_for(whole * n / kMoments);
      stop.request_stop();
    });
    const Status put = store.put(key, heavy, stop.get_token());
    EXPECT_EQ(store.has(key), put.has_value());
    EXPECT_EQ(store.bytesOf(key) > 0, put.has_value());
    EXPECT_FALSE(hasTemporaries(store.folder()));
    if (put) continue;
    ++stopped;
    EXPECT_EQ(put.error().kind, ErrorKind::cancelled);
  }
  EXPECT_GT(stopped, 0);

  std::stop_source stop;
  stop.request_stop();
  const auto read = store.inspect(kFirst, true, stop.get_token());
  EXPECT_TRUE(!read && read.error().kind == ErrorKind::cancelled);
  EXPECT_EQ(store.inspect(kFirst, true)->condition, CaptureStore::Condition::sound);
  const Status light = store.putSurfaceLight(kSecond, {{0}, {}, {}, {}}, stop.get_token());
  EXPECT_TRUE(!light && light.error().kind == ErrorKind::cancelled);
  EXPECT_FALSE(store.hasSurfaceLight(kSecond) || hasTemporaries(store.folder()));
}

TEST_F(StoreTest, GivesBackWhatWasPut) {
  const CaptureStore store = openStore();
  EXPECT_FALSE(store.has(kFirst));
  EXPECT_EQ(store.get(kFirst).error().kind, ErrorKind::notFound);
  ASSERT_TRUE(store.put(kFirst, capture_));
  EXPECT_TRUE(store.has(kFirst));
  EXPECT_FALSE(store.has(kSecond));
  const auto back = store.get(kFirst);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->colour, capture_.colour);
  EXPECT_EQ(back->inverseDistance, capture_.inverseDistance);
  EXPECT_EQ(store.bytesOf(kFirst), fs::file_size(file(kFirst, ".pack")));
  EXPECT_EQ(std::distance(fs::directory_iterator(store.folder()), {}), 1) << "a capture is one file";
  EXPECT_EQ(store.bytesOf(kSecond), 0u);
}

TEST_F(StoreTest, AdoptsWhatAnotherHasAndNeitherLosesItByTheOther) {
  const CaptureStore from = openStore();
  const auto to = CaptureStore::open(folder_ / "others");
  ASSERT_TRUE(to);
  ASSERT_TRUE(from.put(kFirst, capture_));
  ASSERT_TRUE(from.putRecord(kFirst, "camera", {}));
  ASSERT_TRUE(to->adopt(kFirst, from));
  ASSERT_TRUE(to->adopt(kSecond, from)) << "there is nothing to adopt";
  EXPECT_FALSE(to->has(kSecond));
  EXPECT_EQ(to->inspect(kFirst)->condition, CaptureStore::Condition::sound);
  EXPECT_TRUE(to->inspect(kFirst)->recorded);
  damage(folder_ / "others" / (kFirst.toHex() + ".pack"));
  ASSERT_TRUE(to->adopt(kFirst, from)) << "what is there stays";
  ASSERT_FALSE(to->get(kFirst)) << "and is set aside";
  ASSERT_TRUE(to->adopt(kFirst, from));
  ASSERT_TRUE(to->get(kFirst)) << "taken again";
  EXPECT_EQ(from.check(kFirst).size(), 0u);
  to->prune({});
  EXPECT_TRUE(from.get(kFirst));
}

TEST_F(StoreTest, ADamagedCaptureIsSetAsideAndReplacedByTheNextPut) {
  const CaptureStore store = openStore();
  ASSERT_TRUE(store.put(kFirst, capture_));
  damage(file(kFirst, ".pack"));
  const auto back = store.get(kFirst);
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().kind, ErrorKind::malformed);
  EXPECT_NE(back.error().describe().find(kFirst.toHex()), std::string::npos);
  EXPECT_FALSE(store.has(kFirst));
  EXPECT_EQ(store.inspect(kFirst)->condition, CaptureStore::Condition::damaged);
  EXPECT_TRUE(fs::exists(file(kFirst, ".pack.damaged")));
  ASSERT_TRUE(store.put(kFirst, capture_));
  EXPECT_TRUE(store.get(kFirst));
}

TEST_F(StoreTest, FilesUnderAnotherKeysNameAreRefused) {
  const CaptureStore store = openStore();
  ASSERT_TRUE(store.put(kFirst, capture_));
  fs::copy(file(kFirst, ".pack"), file(kSecond, ".pack"));
  EXPECT_TRUE(store.has(kSecond));
  const auto wrong = store.get(kSecond);
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().kind, ErrorKind::malformed);
  EXPECT_TRUE(store.get(kFirst));
}

TEST_F(StoreTest, PruneDeletesOnlyWhatIsNotKept) {
  const CaptureStore store = openStore();
  ASSERT_TRUE(store.put(kFirst, capture_));
  ASSERT_TRUE(store.put(kSecond, capture_));
  ASSERT_TRUE(store.putSurfaceLight(kFirst, {{0}, {}, {}, {}}));
  ASSERT_TRUE(store.putSurfaceLight(kSecond, {{0}, {}, {}, {}}));
  const std::uint64_t light = fs::file_size(folder_ / "captures" / ("surface-" + kSecond.toHex() + ".light"));
  ASSERT_TRUE(writeTextAtomically(folder_ / "captures" / "notes.txt", "mine"));
  const std::uint64_t bytes = fs::file_size(file(kSecond, ".pack"));
  EXPECT_EQ(store.prune({kFirst}), bytes + light);
  EXPECT_TRUE(store.get(kFirst));
  EXPECT_FALSE(store.has(kSecond));
  EXPECT_TRUE(store.hasSurfaceLight(kFirst));
  EXPECT_FALSE(store.hasSurfaceLight(kSecond));
  EXPECT_TRUE(fs::exists(folder_ / "captures" / "notes.txt"));
  EXPECT_EQ(store.prune({kFirst}), 0u);
}

TEST_F(StoreTest, AFileInPlaceOfTheFolderIsAnError) {
  ASSERT_TRUE(writeTextAtomically(folder_ / "captures", "a file"));
  const auto store = CaptureStore::open(folder_ / "captures");
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().kind, ErrorKind::unreadable);
}

TEST_F(StoreTest, DamagedSurfaceLightIsSetAside) {
  const CaptureStore store = openStore();
  EXPECT_EQ(store.getSurfaceLight(kFirst).error().kind, ErrorKind::notFound);
  ASSERT_TRUE(store.putSurfaceLight(kFirst, {{0}, {}, {}, {}}));
  ASSERT_TRUE(store.getSurfaceLight(kFirst));
  damage(folder_ / "captures" / ("surface-" + kFirst.toHex() + ".light"));
  EXPECT_EQ(store.getSurfaceLight(kFirst).error().kind, ErrorKind::malformed);
  EXPECT_FALSE(store.hasSurfaceLight(kFirst));
}

/// A child puts captures, one after the other, and is killed at some moment.
TEST_F(StoreTest, AKilledPutLeavesNothingThatIsTakenForACapture) {
  constexpr int kRounds = 20;
  constexpr std::uint64_t kKeys = 40;
  std::vector<Capture> captures;
  for (unsigned i = 0; i < 4; ++i) captures.push_back(syntheticCapture({96, 80, i % 2 == 1, true, i}));
  const auto captureOf = [&](std::uint64_t key) -> const Capture& { return captures[key % captures.size()]; };
  std::mt19937 random(23);
  int killedAtWork = 0;
  for (int round = 0; round < kRounds; ++round) {
    const fs::path folder = folder_ / ("round-" + std::to_string(round));
    ASSERT_TRUE(CaptureStore::open(folder));
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const auto store = CaptureStore::open(folder);
      for (std::uint64_t key = 0; store && key < kKeys; ++key)
        if (!store->put({key, 0}, captureOf(key))) ::_exit(1);
      ::_exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(500 + random() % 60000));
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    killedAtWork += WIFSIGNALED(status) ? 1 : 0;

    const auto store = CaptureStore::open(folder);
    ASSERT_TRUE(store);
    EXPECT_FALSE(hasTemporaries(folder));
    bool missingSeen = false;
    for (std::uint64_t key = 0; key < kKeys; ++key) {
      if (!store->has({key, 0})) {
        missingSeen = true;
        continue;
      }
      EXPECT_FALSE(missingSeen) << "captures are finished in order";
      const auto capture = store->get({key, 0});
      ASSERT_TRUE(capture) << capture.error().describe();
      ASSERT_EQ(capture->inverseDistance, captureOf(key).inverseDistance);
      ASSERT_EQ(capture->colour, captureOf(key).colour);
    }
    EXPECT_TRUE(store->put({kKeys, 0}, captures[0]));
    EXPECT_TRUE(store->get({kKeys, 0}));
  }
  EXPECT_GE(killedAtWork, kRounds / 2) << "the kills came too late to test anything";
}

}  // namespace
}  // namespace acentric
