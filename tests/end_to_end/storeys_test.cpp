/// A project with two storeys, as a user works with it: the gallery's floor and the ground outside.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {
using testing::HasSubstr;

/// The gallery with cells on all its storeys, of which the first two are kept.
class TwoStoreysTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(sample.made().exitCode, 0) << sample.made().errors;
    made = jsonOf({"new", (sample.folder() / "gallery.glb").string(), "-o", file, "--storey", "all", "--cell",
                   "5", "--samples-per-degree", "0.6"});
    ASSERT_GE(made["storeys"].size(), 2u);
    for (std::size_t s = made["storeys"].size(); s-- > 2;)
      jsonOf({"storeys", file, "--remove", made["storeys"][s]["name"].get<std::string>()});
    Json project = Json::parse(std::ifstream(file));
    project["bake"]["ambientRays"] = 0;
    project["bake"]["surfaceTexel"] = 1;
    std::ofstream(file) << project.dump(2);
  }
  double eyeZ(int storey) const {
    return made["storeys"][std::size_t(storey)]["floorHeight"].get<double>() + 1.6;
  }
  Json spawnOf(int storey) const {
    return Json::parse(std::ifstream(file))["storeys"][std::size_t(storey)]["spawn"]["position"];
  }
  std::string eyeOf(int storey) const {
    return std::to_string(spawnOf(storey)[0].get<double>()) + "," +
           std::to_string(spawnOf(storey)[1].get<double>()) + "," + std::to_string(eyeZ(storey));
  }

  SampleProject sample{"storeys"};
  std::string file = (sample.folder() / "two.acentric.json").string();
  Json made;
};

TEST_F(TwoStoreysTest, AreBakedCheckedAndWalkedTogetherOrOneByOne) {
  const Json info = jsonOf({"info", file});
  ASSERT_EQ(info["storeys"].size(), 2u);
  EXPECT_NE(made["storeys"][0]["floorHeight"], made["storeys"][1]["floorHeight"]);

  const Json first = jsonOf({"bake", file, "--storey", "storey 1"});
  EXPECT_EQ(first["baked"], made["storeys"][1]["cameras"]);
  const Json all = jsonOf({"bake", file});
  ASSERT_EQ(all["storeys"].size(), 2u);
  EXPECT_EQ(all["storeys"][0]["baked"], made["storeys"][0]["cameras"]);
  EXPECT_EQ(all["storeys"][1]["baked"], 0);
  EXPECT_EQ(all["storeys"][1]["reused"], made["storeys"][1]["cameras"]);
  const Json pruned = jsonOf({"bake", file, "--prune"});
  EXPECT_EQ(pruned["prunedBytes"], 0) << "each storey's captures are used";
  for (const Json& storey : jsonOf({"validate", file})["storeys"]) {
    EXPECT_TRUE(storey["valid"].get<bool>());
    EXPECT_EQ(storey["capturesMissing"], 0);
  }

  // Frames choose their storey by the eye's height.
  const std::string picture = (sample.folder() / "x.png").string();
  for (const int storey : {0, 1}) {
    const Json seen = jsonOf({"render", file, "--eye", eyeOf(storey), "--size", "96x54", "-o", picture});
    const Json forced = jsonOf({"render", file, "--eye", eyeOf(storey), "--size", "96x54", "-o", picture,
                                "--storey", std::to_string(storey)});
    EXPECT_EQ(seen["stats"]["samplesRead"], forced["stats"]["samplesRead"]);
    EXPECT_EQ(seen["openShare"], forced["openShare"]);
    EXPECT_GT(seen["stats"]["samplesRead"], 0);
    EXPECT_EQ(seen["stats"]["missingImages"], 0);
  }
  Json path = {{"version", 1}, {"frames", Json::array()}};
  for (const int storey : {0, 1, 0}) {
    Json eye = spawnOf(storey);
    eye.push_back(eyeZ(storey));
    path["frames"].push_back({{"eye", eye}, {"yawDegrees", 20}, {"pitchDegrees", 0}});
  }
  const std::string pathFile = (sample.folder() / "path.json").string();
  std::ofstream(pathFile) << path.dump(2);
  const Json walked = jsonOf(
      {"walk", file, "--path", pathFile, "--size", "96x54", "-o", (sample.folder() / "frames").string()});
  EXPECT_EQ(walked["frames"], 3);
  EXPECT_LT(walked["openShare"].get<double>(), 0.5);
}

TEST_F(TwoStoreysTest, AreEditedOneAtATime) {
  const Json before = Json::parse(std::ifstream(file));
  jsonOf({"layout", file, "--storey", "storey 1", "--cell", "4", "--apply"});
  const Json after = Json::parse(std::ifstream(file));
  EXPECT_EQ(after["storeys"][0], before["storeys"][0]);
  EXPECT_EQ(after["storeys"][1]["layout"]["cellSize"], 4);
  EXPECT_EQ(after["storey"], before["storey"]) << "the walk begins where it did";

  jsonOf({"storeys", file, "--rename", "storey 1=terrace", "--begin", "terrace"});
  EXPECT_EQ(jsonOf({"info", file})["storey"], "terrace");
  const Json removed = jsonOf({"storeys", file, "--remove", "terrace"});
  ASSERT_EQ(removed["storeys"].size(), 1u);
  EXPECT_EQ(removed["storey"], "storey 0");
  const Json added = jsonOf({"storeys", file, "--add", "1"});
  ASSERT_EQ(added["storeys"].size(), 2u) << "found again";
  EXPECT_EQ(added["storeys"][1]["floorHeight"], made["storeys"][1]["floorHeight"]);
}

TEST_F(TwoStoreysTest, RefusalsSayWhatThereIs) {
  const auto refusal = [&](std::vector<std::string> arguments) {
    const auto result = acentric(arguments);
    EXPECT_EQ(result.exitCode, 1);
    return result.errors;
  };
  EXPECT_THAT(refusal({"check", file, "--storey", "attic"}),
              testing::AllOf(HasSubstr("attic"), HasSubstr("storey 0"), HasSubstr("storey 1")));
  EXPECT_THAT(refusal({"bake", file, "--only", "0"}), HasSubstr("--storey"));
  EXPECT_THAT(refusal({"bake", file, "--prune", "--storey", "0"}), HasSubstr("--storey"));
  EXPECT_THAT(refusal({"storeys", file, "--add", "1"}), HasSubstr("already"));
  EXPECT_THAT(refusal({"storeys", file, "--rename", "storey 1=storey 0"}), HasSubstr("name of another"));
  EXPECT_THAT(refusal({"storeys", (sample.folder() / "gallery.glb").string(), "--add", "1"}),
              HasSubstr("acentric new"));
}

}  // namespace
}  // namespace acentric::test
