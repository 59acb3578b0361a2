/// The small pack that the page's unit tests read, and what the engine makes of it. UPDATE_WEB_FIXTURES=1
/// writes both anew.

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "engine/base/file.h"
#include "engine/store/capture_store.h"
#include "engine/view/walk_scene.h"
#include "tests/store/synthetic_capture.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr float kExposure = 4;  // some colours lie on the curve's shoulder
const ContentKey kKey{0x0123456789abcdef, 0xfedcba9876543210};

/// With glass behind glass in some pixels.
Capture fixtureCapture() {
  Capture capture = syntheticCapture({5, 40, true, true, 3, true});
  constexpr std::uint16_t kOne = 0x3c00, kHalf = 0x3800;
  for (std::size_t i = 1; i < capture.sampleCount(); ++i)
    if (capture.row[i] == capture.row[i - 1] && capture.colour[i - 1].a < kOne && capture.mirror[i] == 0)
      capture.colour[i].a = kHalf;
  return capture;
}

/// Texels in whole rows of the textures that hold them.
template <class Texel>
void addRows(std::vector<Texel>& all, const LargeVector<Texel>& texels) {
  constexpr std::size_t kAcross = 2048;
  const std::size_t first = all.size();
  all.insert(all.end(), texels.begin(), texels.end());
  all.resize(first + (texels.size() + kAcross - 1) / kAcross * kAcross);
}
template <class Texel>
std::string hashOf(const std::vector<Texel>& texels) {
  return Hasher().bytes(texels.data(), texels.size() * sizeof(Texel)).finish().toHex();
}

Json expected(const Capture& capture) {
  const DisplayCapture display = prepareForDisplay(capture, kExposure);
  std::vector<Rgba8> colours;
  std::vector<std::uint32_t> covers;
  for (const DisplayPatches* patches : {display.patches.get(), display.reflections->patches.get()})
    addRows(colours, patches->colour), addRows(covers, patches->cover);
  Json runs = Json::array();
  const CaptureBackground& background = capture.background;
  for (std::size_t i = 0; i < background.runCount(); ++i) {
    runs.push_back(background.firstRow[i] | std::uint32_t(background.endRow[i]) << 16);
    runs.push_back(background.roles[i]);
  }
  return {{"exposure", kExposure},
          {"texels", covers.size()},
          {"colours", hashOf(colours)},
          {"covers", hashOf(covers)},
          {"runs", std::move(runs)}};
}

class WebFixtureTest : public FolderTest {};

TEST_F(WebFixtureTest, IsWhatTheEngineWritesAndShows) {
  const Capture capture = fixtureCapture();
  ASSERT_TRUE(capture.check()) << capture.check().error().describe();
  const fs::path fixtures = ACENTRIC_WEB_FIXTURES;
  const bool renews = std::getenv("UPDATE_WEB_FIXTURES") != nullptr;
  const auto compare = [&](const Status& written, const char* name) {
    ASSERT_TRUE(written) << written.error().describe();
    const auto pack = readFile(folder_ / name);
    ASSERT_TRUE(pack);
    if (renews) {
      ASSERT_TRUE(writeFileAtomically(fixtures / name, *pack));
    }
    const auto stored = readFile(fixtures / name);
    ASSERT_TRUE(stored);
    EXPECT_EQ(*stored, *pack) << "a change of the format: UPDATE_WEB_FIXTURES=1 renews the fixture";
  };
  const Capture edged = withSilhouettes(capture);
  compare(writeCodedPack(capture, kKey, folder_ / "capture.pack", kLosslessColours), "capture.pack");
  compare(writeCodedPack(edged, kKey, folder_ / "coded.pack", kLosslessColours), "coded.pack");
  compare(writeDisplayPack(edged, kKey, folder_ / "display.pack", kUsualColourQuality, kExposure),
          "display.pack");

  const std::string text = expected(edged).dump(1) + "\n";
  if (renews) {
    ASSERT_TRUE(writeTextAtomically(fixtures / "capture.json", text));
  }
  const auto storedText = readText(fixtures / "capture.json");
  ASSERT_TRUE(storedText);
  EXPECT_EQ(*storedText, text);
}

}  // namespace
}  // namespace acentric
