/// Storeys, layouts and their placement, as a user types them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

class LayoutCommandsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { made = new SampleProject("layout"), asMade = made->read(); }
  static void TearDownTestSuite() { delete made; }
  void SetUp() override {
    ASSERT_EQ(made->made().exitCode, 0) << made->made().errors;
    made->write(asMade);
  }
  Json report(std::vector<std::string> arguments) {
    arguments.push_back("--json");
    const auto result = acentric(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    return Json::parse(result.output, nullptr, false);
  }
  std::string path(const char* name) const { return (made->folder() / name).string(); }
  std::string scene() const { return path("gallery.glb"); }

  static inline SampleProject* made = nullptr;
  static inline Json asMade;
};

TEST_F(LayoutCommandsTest, StoreysAreListedForASceneAndForItsProjectAlike) {
  const Json ofScene = report({"storeys", scene()}), ofProject = report({"storeys", made->file()});
  ASSERT_GE(ofScene["storeys"].size(), 2u) << "the ground and the gallery's raised floor";
  EXPECT_EQ(ofScene, ofProject);
  double last = -1e9;
  for (const Json& storey : ofScene["storeys"]) {
    EXPECT_GE(storey["height"].get<double>(), last);
    last = storey["height"];
    EXPECT_GE(storey["squareMetres"].get<double>(), 2);
  }
  const auto text = acentric({"storeys", scene()});
  EXPECT_THAT(text.output, testing::HasSubstr("% covered"));
  EXPECT_EQ(report({"new", scene(), "-o", path("none.acentric.json"), "--storey", "list"}), ofScene);
  EXPECT_FALSE(std::filesystem::exists(path("none.acentric.json"))) << "a list writes nothing";
}

TEST_F(LayoutCommandsTest, ANewProjectIsLaidOnTheStoreyChosen) {
  const Json storeys = report({"storeys", scene()})["storeys"];
  const double height = storeys[1]["height"];
  const Json byNumber =
      report({"new", scene(), "-o", path("one.acentric.json"), "--storey", "1", "--cell", "4"});
  EXPECT_NEAR(byNumber["storeys"][0]["floorHeight"].get<double>(), height, 1e-3);
  const Json byHeight = report({"new", scene(), "-o", path("height.acentric.json"), "--storey",
                                std::to_string(height) + "m", "--cell", "4"});
  EXPECT_NEAR(byHeight["storeys"][0]["floorHeight"].get<double>(), height, 1e-3);
}

TEST_F(LayoutCommandsTest, ALayoutIsFittedToTheFloor) {
  const Json loose = report({"layout", made->file(), "--config", "b", "--cell", "2", "--rotate", "11"});
  const Json fitted =
      report({"layout", made->file(), "--config", "b", "--cell", "2", "--rotate", "11", "--fit"});
  EXPECT_LT(fitted["cameras"].get<int>(), loose["cameras"].get<int>());
  EXPECT_GT(fitted["removed"].get<int>(), 0);
  EXPECT_THAT(fitted["notes"][0].get<std::string>(), testing::HasSubstr("% of the floor lies in cells"));
}

TEST_F(LayoutCommandsTest, ALayoutIsTriedAndThenApplied) {
  const Json now = report({"layout", made->file()});
  EXPECT_FALSE(now["changed"].get<bool>());
  EXPECT_EQ(now["configuration"], "b");
  EXPECT_GT(now["megapixels"].get<double>(), 0);
  EXPECT_NEAR(now["meanSpacing"].get<double>(), 2.5, 0.01) << "hexagons' corners are an edge apart";
  double area = 0;
  std::size_t regions = 0;
  for (const auto& [kind, count] : now["kinds"].items())
    area += count["squareMetres"].get<double>(), regions += count["regions"].get<std::size_t>();
  EXPECT_EQ(regions, now["regions"].get<std::size_t>());
  EXPECT_NEAR(area, now["squareMetres"]["regions"].get<double>(), 1e-6);
  EXPECT_NEAR(now["squareMetres"]["outline"].get<double>(), 10 * 7, 1e-9);

  const std::vector<std::string> edit{"layout", made->file(),      "--config",  "e",         "--cell",
                                      "2",      "--origin",        "-0.5,0.25", "--rotate",  "10",
                                      "--free", "1,1,0.5,0,60,cw", "--split",   "0,0,0",     "--remove",
                                      "1,0,0",  "--density",       "0,0,0=2",   "--density", "0,0,-1=0.5"};
  const Json tried = report(edit);
  EXPECT_TRUE(tried["changed"].get<bool>());
  EXPECT_FALSE(tried["applied"].get<bool>());
  EXPECT_EQ(made->read(), asMade) << "trying writes nothing";
  EXPECT_EQ(tried["split"], 1);
  EXPECT_EQ(tried["freeApvs"], 1);
  EXPECT_EQ(tried["density"], 2);

  auto applying = edit;
  applying.insert(applying.end(), {"--apply", "-o", path("layout.svg")});
  const Json applied = report(applying);
  EXPECT_TRUE(applied["applied"].get<bool>());
  EXPECT_TRUE(std::filesystem::exists(path("layout.svg")));
  const Json after = report({"layout", made->file()});
  for (const char* same :
       {"configuration", "cellSize", "latticeOrigin", "regions", "cameras", "split", "density", "megapixels"})
    EXPECT_EQ(after[same], tried[same]) << same;
  EXPECT_NEAR(after["rotationDegrees"].get<double>(), 10, 1e-9);

  const Json denser = report({"layout", made->file(), "--density", "0,0,0=4"});
  EXPECT_EQ(denser["cameras"], after["cameras"]);
  EXPECT_GT(denser["megapixels"].get<double>(), after["megapixels"].get<double>());
  EXPECT_EQ(report({"layout", made->file(), "--density", "0,0,0=1"})["density"], 1) << "taken back";

  const Json other = report({"layout", made->file(), "--config", "g"});
  EXPECT_EQ(other["split"], 0);
  EXPECT_EQ(other["notes"].size(), 1u) << "the cells of the former lattice are forgotten, and it is said";
  EXPECT_EQ(report({"layout", made->file(), "--remove-free", "0", "--join", "0,0,0"})["freeApvs"], 0);
}

TEST_F(LayoutCommandsTest, EveryConfigurationHasALayout) {
  for (const char* configuration : {"a", "b", "c", "d", "e", "f", "g"}) {
    const Json layout = report({"layout", made->file(), "--config", configuration});
    EXPECT_EQ(layout["configuration"], configuration);
    EXPECT_GT(layout["cameras"].get<int>(), 0);
  }
}

TEST_F(LayoutCommandsTest, TheOutlineIsFoundAgainAtTheProjectsFloor) {
  const Json found = report({"layout", made->file(), "--outline", "auto"});
  EXPECT_NEAR(found["floorHeight"].get<double>(), asMade["storeys"][0]["layout"]["floorHeight"].get<double>(),
              1e-9);
  EXPECT_GT(found["squareMetres"]["outline"].get<double>(), 20);
}

TEST_F(LayoutCommandsTest, ACheckSaysWhatIsWrongAndWithWhat) {
  const Json checked = report({"check", made->file(), "-o", path("check.png")});
  EXPECT_TRUE(std::filesystem::exists(path("check.png")));
  const Json layout = report({"layout", made->file()});
  EXPECT_EQ(checked["centres"], layout["centres"]);
  EXPECT_EQ(checked["regions"], layout["regions"]);
  int errors = 0;
  for (const Json& finding : checked["findings"]) {
    EXPECT_FALSE(finding["reason"].get<std::string>().empty());
    errors += finding["severity"] == "error" ? 1 : 0;
    EXPECT_EQ(finding.contains("region"), finding["flaw"] == "noStandingRoom");
  }
  EXPECT_EQ(checked["counts"]["errors"], errors);
  // A walk plane half a metre too low: every region is without standing room, and it is said.
  Json sunk = asMade;
  sunk["storeys"][0]["layout"]["floorHeight"] =
      asMade["storeys"][0]["layout"]["floorHeight"].get<double>() - 0.5;
  made->write(sunk);
  std::size_t without = 0;
  const Json sunkReport = report({"check", made->file(), "--all"});
  for (const Json& finding : sunkReport["findings"]) without += finding["flaw"] == "noStandingRoom" ? 1 : 0;
  EXPECT_GT(2 * without, layout["regions"].get<std::size_t>());
}

TEST_F(LayoutCommandsTest, WhatIsWrongIsSaid) {
  struct Case {
    std::vector<std::string> arguments;
    const char* said;
  };
  for (const Case& c : std::vector<Case>{
           {{"layout", made->file(), "--config", "z"}, "there is no configuration"},
           {{"layout", made->file(), "--origin", "1"}, "x,y"},
           {{"layout", made->file(), "--remove", "1,2"}, "i,j,slot"},
           {{"layout", made->file(), "--density", "1,2,0"}, "i,j,slot=times"},
           {{"layout", made->file(), "--density", "0,0,0=9"}, "density"},
           {{"layout", made->file(), "--free", "1,2,3"}, "x,y,dx,dy,fov,hand"},
           {{"layout", made->file(), "--free", "1,2,1,0,50,ccw"}, "360"},
           {{"layout", made->file(), "--split", "0,0,0"}, "cannot be split"},
           {{"layout", made->file(), "--remove-free", "7"}, "free APV 7"},
           {{"layout", made->file(), "-o", path("x.gif")}, "x.gif"},
           {{"check", made->file(), "--room", "-1"}, "room around a camera"},
           {{"check", path("none.acentric.json")}, "none.acentric.json"},
           {{"storeys", path("none.glb")}, "none.glb"},
           {{"storeys", scene(), "--least-area", "1e9"}, "no floor"},
           {{"new", scene(), "-o", path("n.acentric.json"), "--storey", "77"}, "no storey 77"},
           {{"new", scene(), "-o", path("n.acentric.json"), "--storey", "500m"}, "500 m"},
           {{"new", scene(), "-o", path("n.acentric.json"), "--storey", "up"}, "names no storey"},
           {{"new", scene(), "-o", path("n.acentric.json"), "--storey", "0", "--outline", "0,0;1,0;1,1"},
            "not both"}}) {
    const auto result = acentric(c.arguments);
    EXPECT_EQ(result.exitCode, 1) << c.arguments.back();
    EXPECT_THAT(result.errors, testing::HasSubstr(c.said));
  }
  EXPECT_EQ(made->read(), asMade);
}

TEST_F(LayoutCommandsTest, AModelFromElsewhereComesIntoTheProjectsFolder) {
  namespace fs = std::filesystem;
  const fs::path folder = path("of its own"), file = folder / "walk.acentric.json";
  fs::create_directories(folder);
  // What fails leaves nothing of the model behind.
  EXPECT_EQ(acentric({"new", scene(), "-o", file.string(), "--storey", "77"}).exitCode, 1);
  EXPECT_TRUE(fs::is_empty(folder));

  const Json linked = report({"new", scene(), "-o", file.string(), "--link"});
  EXPECT_EQ(linked["model"]["scene"], "models/gallery/gallery.glb");
  EXPECT_TRUE(fs::is_symlink(folder / "models" / "gallery" / "gallery.glb"));
  const auto brought = acentric({"collect", file.string()});
  EXPECT_EQ(brought.exitCode, 0) << brought.errors;
  EXPECT_THAT(brought.output, testing::HasSubstr("brought to models/gallery/gallery.glb: 1 file"));
  EXPECT_FALSE(fs::is_symlink(folder / "models" / "gallery" / "gallery.glb"));
  fs::rename(folder, path("moved"));
  EXPECT_EQ(report({"info", path("moved/walk.acentric.json")})["scene"]["triangles"], linked["triangles"]);
  EXPECT_EQ(acentric({"collect", path("none.acentric.json")}).exitCode, 1);
}

}  // namespace
}  // namespace acentric::test
