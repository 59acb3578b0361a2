#include "engine/store/capture_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/file.h"
#include "engine/store/capture_store.h"
#include "synthetic_capture.h"
#include "temporary_folder.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using Condition = CaptureStore::Condition;
using testing::ElementsAre;

ContentKey keyOfText(const char* text) { return Hasher().text(text).finish(); }

CaptureRecord sample() {
  return {"camera 1,-2,0,3,0 the hall",
          {{"scene", keyOfText("a")}, {"settings", keyOfText("b")}},
          {{".light", 123, keyOfText("c")}, {".pack", 45, keyOfText("d")}},
          SampleCounts{{1000, 200, 0, 0, 0, 0, 0, 3}, 40, 5}};
}

TEST(CaptureRecord, RoundTripsAndRefusesAnythingElse) {
  const std::string text = formatRecord(sample());
  const auto back = parseRecord(text, "x");
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, sample());
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string other = text;
    other[at] = char(other[at] ^ 1);
    EXPECT_FALSE(parseRecord(other, "x")) << at;
    EXPECT_FALSE(parseRecord(text.substr(0, at), "x")) << at;
  }
  EXPECT_FALSE(parseRecord(text + "\n", "x"));
  CaptureRecord odd = sample();
  odd.samples.reset();
  EXPECT_EQ(parseRecord(formatRecord(odd), "x").value(), odd);
  odd.subject = "two\nlines";
  EXPECT_TRUE(parseRecord(formatRecord(odd), "x")) << "a name never breaks the format";
}

TEST(CaptureRecord, TellsWhichPartsChanged) {
  const KeyParts before = sample().parts;
  KeyParts now = before;
  EXPECT_THAT(changedParts(before, now), ElementsAre());
  now[1].key = keyOfText("other");
  EXPECT_THAT(changedParts(before, now), ElementsAre("settings"));
  now.push_back({"light", keyOfText("new")});
  EXPECT_THAT(changedParts(before, now), ElementsAre("settings", "light"));
  EXPECT_THAT(changedParts(now, before), ElementsAre("settings", "light"));
}

class RecordsTest : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    auto opened = CaptureStore::open(folder_ / "captures");
    ASSERT_TRUE(opened);
    store = std::make_unique<CaptureStore>(*opened);
    ASSERT_TRUE(store->put(key, syntheticCapture({32, 24, true, true, 1})));
  }
  fs::path file(const char* extension) const { return folder_ / "captures" / (key.toHex() + extension); }
  Condition condition(bool toTheEnd = false) const {
    const auto found = store->inspect(key, toTheEnd);
    EXPECT_TRUE(found) << found.error().describe();
    return found->condition;
  }
  std::unique_ptr<CaptureStore> store;
  ContentKey key = keyOfText("key");
};

TEST_F(RecordsTest, AreBelievedWhileNoFileIsNewer) {
  EXPECT_FALSE(store->inspect(key)->recorded);
  EXPECT_EQ(condition(), Condition::sound) << "read to its end";
  ASSERT_TRUE(store->putRecord(key, "camera", sample().parts, sample().samples));
  const auto found = store->inspect(key);
  EXPECT_TRUE(found->recorded);
  EXPECT_EQ(found->condition, Condition::sound);
  EXPECT_EQ(store->record(key)->parts, sample().parts);
  EXPECT_EQ(store->record(key)->samples, sample().samples);

  // Rewritten with the same bytes: hashed once, then believed again.
  const auto bytes = readFile(file(".pack"));
  fs::last_write_time(file(".record"), fs::last_write_time(file(".pack")) - std::chrono::seconds(5));
  EXPECT_EQ(condition(), Condition::sound);
  EXPECT_GT(fs::last_write_time(file(".record")), fs::last_write_time(file(".pack")));

  auto damaged = *bytes;
  damaged[damaged.size() / 2] ^= std::byte(1);
  ASSERT_TRUE(writeFileAtomically(file(".pack"), damaged));
  fs::last_write_time(file(".pack"), fs::file_time_type::clock::now() + std::chrono::seconds(1));
  EXPECT_EQ(condition(), Condition::damaged);
  EXPECT_EQ(store->inspect(key)->damage.size(), 1u);
  fs::last_write_time(file(".pack"), fs::last_write_time(file(".record")) - std::chrono::seconds(1));
  EXPECT_EQ(condition(), Condition::sound) << "believed by its size and time";
  EXPECT_EQ(condition(true), Condition::damaged) << "but not when it is read";
}

TEST_F(RecordsTest, GoWithTheirCapturesAndTellWhatWasBakedBefore) {
  KeyParts old = sample().parts, now = old;
  now[0].key = keyOfText("changed");
  ASSERT_TRUE(store->putRecord(key, "camera", old));
  EXPECT_TRUE(store->formerRecords({key}).empty()) << "known keys are no former ones";
  auto former = store->formerRecords({});
  ASSERT_TRUE(former.contains("camera"));
  EXPECT_THAT(changedParts(former["camera"].parts, now), ElementsAre("scene"));

  // Of two bakes of one camera, the later one.
  const ContentKey later = keyOfText("later");
  ASSERT_TRUE(store->put(later, syntheticCapture({32, 24, true, true, 2})));
  ASSERT_TRUE(store->putRecord(later, "camera", now));
  fs::last_write_time(folder_ / "captures" / (later.toHex() + ".record"),
                      fs::last_write_time(file(".record")) + std::chrono::seconds(2));
  EXPECT_EQ(store->formerRecords({})["camera"].parts, now);

  EXPECT_GT(store->prune({later}), 0u);
  EXPECT_FALSE(fs::exists(file(".record")));
  EXPECT_EQ(condition(), Condition::missing);
}

}  // namespace
}  // namespace acentric
