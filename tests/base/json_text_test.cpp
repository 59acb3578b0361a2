#include "engine/base/json_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace acentric {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

std::string nested(const std::string& open, const std::string& close, int levels) {
  std::string text;
  for (int level = 0; level < levels; ++level) text += open;
  text += "1";
  for (int level = 0; level < levels; ++level) text += close;
  return text;
}

TEST(JsonText, HoldsWhatIsNotUtf8AsReplacementCharacters) {
  const Json json = {{"file", "caf\xe9.glb"}, {"sound", "café"}};
  EXPECT_EQ(jsonText(json), "{\"file\":\"caf\xef\xbf\xbd.glb\",\"sound\":\"café\"}");
  EXPECT_EQ(jsonText(Json{1}, 2), "[\n  1\n]");
}

TEST(JsonText, GivesBackWhatIsUtf8) {
  EXPECT_TRUE(isUtf8("café \"x\"\n"));
  EXPECT_FALSE(isUtf8("caf\xe9"));
  EXPECT_FALSE(isUtf8("cut \xe2\x82"));
}

TEST(JsonText, IsReadAsDeepAsFilesGo) {
  for (const auto& [open, close] : {std::pair{"[", "]"}, {"{\"a\":", "}"}}) {
    const auto deepest = parseJson<Json>(nested(open, close, kMostJsonLevels), "file");
    ASSERT_TRUE(deepest) << deepest.error().describe();
    EXPECT_EQ(jsonText(*deepest), nested(open, close, kMostJsonLevels));
    for (const int levels : {kMostJsonLevels + 1, 200'000}) {
      const auto deeper = parseJson<Json>(nested(open, close, levels), "file");
      ASSERT_FALSE(deeper);
      EXPECT_EQ(deeper.error().kind, ErrorKind::malformed);
      EXPECT_EQ(deeper.error().where, "file");
      EXPECT_THAT(deeper.error().message, HasSubstr("nested more than 100 levels deep"));
    }
  }
}

TEST(JsonText, SaysWhereItStopsBeingJson) {
  const auto cut = parseJson("{\n  \"a\": tru", "file");
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().kind, ErrorKind::malformed);
  EXPECT_THAT(cut.error().message, HasSubstr("line 2"));
  const auto bytes = parseJson("\"\xff\"", "file");
  ASSERT_FALSE(bytes);
  EXPECT_THAT(bytes.error().message, HasSubstr("UTF-8"));
  EXPECT_THAT(jsonText(Json{{"message", bytes.error().message}}), HasSubstr("\xef\xbf\xbd"));
}

}  // namespace
}  // namespace acentric
