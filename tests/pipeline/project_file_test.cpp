#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "engine/base/file.h"
#include "engine/geometry/conventions.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/project.h"
#include "engine/pipeline/schema_check.h"

namespace acentric {
namespace {

using testing::HasSubstr;

Project everythingSet() {
  Project project;
  project.scene = "models/house with spaces.glb";
  project.import = {0.01, UpAxis::z, false, Lighting::inTextures};
  project.effects = {{Effect::ambientOcclusion, false}, {Effect::normalMaps, true}};
  project.layout().configuration = Configuration::e;
  project.layout().cellSize = 1.7000000000000002;
  project.layout().latticeOrigin = {0.1, -1e6 / 3};
  project.layout().rotationRadians = radians(12.5);
  project.layout().floorHeight = -0.25;
  project.layout().eyeHeight = 1.55;
  project.layout().nearBand = 0.75;
  project.layout().outline.loops = {{{0, 0}, {8, 0}, {8, 6}, {0, 6}}, {{2, 2}, {3, 2}, {3, 3}}};
  project.layout().added = {{1, -2, 0}, {4, 5, 0}};
  project.layout().removed = {{0, 0, 0}};
  project.layout().split = {{1, -2, 0}, {2, -4, 0, 1}};
  project.layout().freeApvs = {{3, {{1, 2}, {0.5, -0.25}, 360.0 / 7, Hand::clockwise}},
                               {12, {{-4, 0.1}, {0, 0}, 60, Hand::counterClockwise}}};
  project.layout().density = {
      {{1, -2, 0}, 1.4142135623730951}, {{2, -4, 0, 1}, 0.5}, {{12, 0, kFreeSlot}, 4}};
  project.bake = {12.5, 24, 1.5, 32, 3, 0.02, 4};
  project.bake.colourQuality = 63;
  project.budget = {150000, 0.0025, true};
  project.view.renderer = Renderer::zbuffer;
  project.view.reconstruction = Reconstruction::point;
  project.view.maxSplatPixels = 7;
  project.view.localGeometry = false;
  project.view.secondaryCover = false;
  project.view.fillHoles = false;
  project.fovDegrees = 72.5;
  project.exposure = 0.123f;
  project.spawn() = {{1.25, 2.5}, radians(-90.0)};
  project.storeys.push_back({"second [1, 2]", project.layout(), {{-3, 4}, radians(15.0)}, {}});
  project.storeys.back().layout.floorHeight = 3.1;
  project.storey = 1;
  project.bookmarks = {{"door", 0, {1, -2.5, 1.6}, radians(90.0), radians(-12.0), 75},
                       {"attic \"window\"", 1, {0, 0, 4.7}, 0, 0, 60}};
  project.paths = {{"there and back",
                    1,
                    {{{{0, 0, 4.7}, radians(10.0), 0, 0},
                      {{1.0 / 3, 2, 4.7}, radians(-170.0), radians(5.0), 2.25},
                      {{0, 0, 4.7}, radians(350.0), 0, 7}}}}};
  return project;
}

std::string refusalOf(const std::string& text) {
  const auto project = parseProject(text, "p.acentric.json");
  if (project) return "accepted";
  EXPECT_EQ(project.error().where, "p.acentric.json");
  return project.error().message;
}

std::string minimal(const std::string& layout, const std::string& more = "") {
  return R"({"format":"acentric-project","version":1,"scene":"a.glb","layout":)" + layout + more + "}";
}

TEST(ProjectFile, RoundTripsEveryField) {
  Project project = everythingSet();
  project.storeys.back().walkable = parseOutline("0,0;9,0;9,9").value();
  const auto back = parseProject(formatProject(project), "p");
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(*back, project);
}

TEST(ProjectFile, RoundTripsEveryReconstruction) {
  Project project = everythingSet();
  for (Reconstruction reconstruction : kReconstructions) {
    project.view.reconstruction = reconstruction;
    const auto back = parseProject(formatProject(project), "p");
    ASSERT_TRUE(back) << back.error().describe();
    EXPECT_EQ(back->view.reconstruction, reconstruction);
  }
  EXPECT_FALSE(parseReconstruction("smooth"));
}

TEST(ProjectFile, WritingIsStable) {
  const std::string once = formatProject(everythingSet());
  EXPECT_EQ(formatProject(*parseProject(once, "p")), once);
  EXPECT_EQ(once.back(), '\n');
}

TEST(ProjectFile, PointsStandOnOneLineAndNamesAreLeftAlone) {
  Project project = everythingSet();
  project.scene = "odd [1,2] \"name\" [3,\\\" 4].glb\\";
  const std::string text = formatProject(project);
  EXPECT_THAT(text, HasSubstr("[8.0, 6.0]"));
  EXPECT_THAT(text, HasSubstr("[1, -2, 0]"));
  const auto back = parseProject(text, "p");
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(*back, project);
}

TEST(ProjectFile, FillsInDefaultsForWhatIsNotNamed) {
  const auto project = parseProject(minimal(R"({"configuration":"b","cellSize":2})"), "p");
  ASSERT_TRUE(project) << project.error().describe();
  Project expected;
  expected.scene = "a.glb";
  expected.layout().configuration = Configuration::b;
  expected.layout().cellSize = 2;
  expected.spawn().stored = false;
  EXPECT_EQ(*project, expected);
}

TEST(ProjectFile, RefusesWithAPointerToTheCulprit) {
  EXPECT_THAT(refusalOf(minimal(R"({"configuration":"b","cellSize":-1})")), HasSubstr("/layout/cellSize"));
  EXPECT_THAT(refusalOf(minimal(R"({"configuration":"z","cellSize":1})")),
              HasSubstr("/layout/configuration"));
  EXPECT_THAT(refusalOf(minimal(R"({"configuration":"b","cellSize":"2"})")), HasSubstr("/layout/cellSize"));
  EXPECT_THAT(refusalOf(minimal(R"({"configuration":"b","cellSize":2,"outline":[[[0,0],[1,0]]]})")),
              HasSubstr("/layout/outline/0"));
  EXPECT_THAT(refusalOf(minimal(R"({"configuration":"b","cellSize":2})", R"(,"bake":{"ambientRays":1e9})")),
              HasSubstr("/bake/ambientRays"));
  EXPECT_THAT(refusalOf(minimal(R"({"configuration":"b","cellSize":2})", R"(,"view":{"exposure":0})")),
              HasSubstr("/view/exposure"));
}

TEST(ProjectFile, RefusesHostileWalkableGround) {
  const auto with = [](const std::string& walkable) {
    return R"({"format":"acentric-project","version":1,"scene":"a.glb","storeys":[{"name":"floor","layout":)"
           R"({"configuration":"b","cellSize":2},"walkable":)" +
           walkable + "}]}";
  };
  EXPECT_TRUE(parseProject(with("[[[0,0],[1,0],[1,1]]]"), "p"));
  EXPECT_THAT(refusalOf(with("7")), HasSubstr("/storeys/0/walkable"));
  EXPECT_THAT(refusalOf(with("[[[0,0],[1,0]]]")), HasSubstr("/storeys/0/walkable/0"));
  EXPECT_THAT(refusalOf(with("[[[0,0],[1,0],[1e9,1]]]")), HasSubstr("/storeys/0/walkable/0"));
  std::string many = "[[[0,0]";
  for (int k = 1; k < 5000; ++k) many += ",[" + std::to_string(k) + ",1]";
  EXPECT_THAT(refusalOf(with(many + "]]")), HasSubstr("/storeys/0/walkable"));
}

TEST(ProjectFile, RefusesAModelOutsideItsFolder) {
  const std::string sound = formatProject(everythingSet());
  const auto stating = [&](const std::string& scene) {
    std::string text = sound;
    const std::string was = "models/house with spaces.glb";
    return text.replace(text.find(was), was.size(), scene);
  };
  for (const char* outside : {"../a.glb", "..", "models/../../a.glb", "models/..", "/a.glb", "a/../a.glb"}) {
    EXPECT_THAT(refusalOf(stating(outside)), HasSubstr(std::string("/scene: ") + outside)) << outside;
    const Status schema = checkSchema(nlohmann::ordered_json::parse(stating(outside)), projectSchema(), "p");
    EXPECT_FALSE(schema) << outside << ": the published schema allows it";
  }
  for (const char* within : {"a..glb", "..a/b.glb", "a../b.glb", "...", "./a.glb", "b/.../a.glb"}) {
    const auto read = parseProject(stating(within), "p");
    EXPECT_TRUE(read) << read.error().describe();
  }
}

TEST(ProjectFile, RefusesTwoFreeApvsOfOneNumber) {
  const std::string apv = R"({"number":4,"centre":[0,0],"offset":[1,0],"cameras":6})";
  const std::string one = R"({"configuration":"b","cellSize":2,"freeApvs":[)" + apv;
  EXPECT_EQ(refusalOf(minimal(one + "]}")), "accepted");
  EXPECT_THAT(refusalOf(minimal(one + "," + apv + "]}")), HasSubstr("two of them have the number 4"));
}

TEST(ProjectFile, RefusesStoreysThatCannotBeToldApartOrFound) {
  const auto storeys = [](const std::string& list, const std::string& more = "") {
    return R"({"format":"acentric-project","version":1,"scene":"a.glb","storeys":[)" + list + "]" + more +
           "}";
  };
  const std::string one = R"({"name":"hall","layout":{"configuration":"b","cellSize":2}})";
  const std::string two = R"({"name":"attic","layout":{"configuration":"e","cellSize":1}})";
  EXPECT_EQ(refusalOf(storeys(one + "," + two)), "accepted");
  EXPECT_EQ(parseProject(storeys(one + "," + two, R"(,"storey":"attic")"), "p")->layout().cellSize, 1);
  EXPECT_THAT(refusalOf(storeys(one + "," + one)), HasSubstr("name of another"));
  EXPECT_THAT(refusalOf(storeys(one, R"(,"storey":"cellar")")), HasSubstr("/storey"));
  EXPECT_THAT(refusalOf(storeys("")), HasSubstr("/storeys"));
  EXPECT_NE(refusalOf(storeys(one, R"(,"layout":{"configuration":"b","cellSize":2})")), "accepted")
      << "a layout within and without the list";
  EXPECT_NE(refusalOf(R"({"format":"acentric-project","version":1,"scene":"a.glb"})"), "accepted");
  EXPECT_THAT(refusalOf(storeys(R"({"name":"hall","layout":{"configuration":"b","cellSize":-2}})")),
              HasSubstr("/storeys/0/layout/cellSize"));
}

TEST(ProjectFile, SaysNothingOfBookmarksAndPathsWhereThereAreNone) {
  Project project = everythingSet();
  project.bookmarks.clear();
  project.paths.clear();
  const std::string text = formatProject(project);
  EXPECT_THAT(text, testing::Not(HasSubstr("bookmarks")));
  EXPECT_THAT(text, testing::Not(HasSubstr("paths")));
  EXPECT_EQ(*parseProject(text, "p"), project);
}

TEST(ProjectFile, KeyPosesStandOnALineEach) {
  EXPECT_THAT(formatProject(everythingSet()), HasSubstr("[7.0, 0.0, 0.0, 4.7, 350.0, 0.0]"));
}

TEST(ProjectFile, RefusesHostileBookmarks) {
  const auto refusal = [](const std::string& list) {
    return refusalOf(minimal(R"({"configuration":"b","cellSize":2})", R"(,"bookmarks":[)" + list + "]"));
  };
  const std::string door = R"({"name":"door","eye":[0,0,1.6]})";
  EXPECT_EQ(refusal(door), "accepted");
  EXPECT_THAT(refusal(door + "," + door), HasSubstr("/bookmarks/0/name: 'door'"));
  EXPECT_THAT(refusal(R"({"name":"door","eye":[0,0]})"), HasSubstr("/bookmarks/0/eye"));
  EXPECT_THAT(refusal(R"({"name":"door","eye":[0,0,1e300]})"), HasSubstr("/bookmarks/0/eye"));
  EXPECT_THAT(refusal(R"({"name":"","eye":[0,0,0]})"), HasSubstr("/bookmarks/0/name"));
  EXPECT_THAT(refusal(R"({"name":"door","eye":[0,0,0],"storey":"cellar"})"),
              HasSubstr("/bookmarks/0/storey"));
  EXPECT_THAT(refusal(R"({"name":"door","eye":[0,0,0],"pitchDegrees":91})"),
              HasSubstr("/bookmarks/0/pitchDegrees"));
  EXPECT_THAT(refusal(R"({"name":"door","eye":[0,0,0],"fovDegrees":0})"),
              HasSubstr("/bookmarks/0/fovDegrees"));
  EXPECT_THAT(refusal(R"({"name":"door","eye":[0,0,0],"colour":1})"), HasSubstr("/bookmarks/0"));
}

TEST(ProjectFile, RefusesHostilePaths) {
  const auto refusal = [](const std::string& poses) {
    return refusalOf(minimal(R"({"configuration":"b","cellSize":2})",
                             R"(,"paths":[{"name":"walk","poses":[)" + poses + "]}]"));
  };
  EXPECT_EQ(refusal("[0,0,0,1.6,0,0],[1,2,0,1.6,0,0]"), "accepted");
  EXPECT_THAT(refusal(""), HasSubstr("/paths/0/poses"));
  EXPECT_THAT(refusal("[0,0,0,1.6,0]"), HasSubstr("/paths/0/poses/0"));
  EXPECT_THAT(refusal("[0,0,0,1.6,0,\"up\"]"), HasSubstr("/paths/0/poses/0/5"));
  EXPECT_THAT(refusal("[0,0,0,1.6,0,91]"), HasSubstr("/paths/0/poses/0"));
  EXPECT_THAT(refusal("[1,0,0,1.6,0,0],[2,0,0,1.6,0,0]"), HasSubstr("/paths/0/poses/0"));
  EXPECT_THAT(refusal("[0,0,0,1.6,0,0],[0,1,0,1.6,0,0]"), HasSubstr("/paths/0/poses/1"));
  EXPECT_THAT(refusal("[0,0,0,1.6,0,0],[2,1,0,1.6,0,0],[1,1,0,1.6,0,0]"), HasSubstr("/paths/0/poses/2"));
  EXPECT_THAT(refusal("[0,0,0,1.6,0,0],[9000000,1,0,1.6,0,0]"), HasSubstr("/paths/0/poses/1"));
}

TEST(ProjectFile, RemovingAStoreyTakesItsBookmarksAndPathsAlong) {
  Project project = everythingSet();
  Project below = project;
  removeStorey(below, 0);
  EXPECT_TRUE(below.check());
  ASSERT_EQ(below.bookmarks.size(), 1u);
  EXPECT_EQ(below.bookmarks[0].name, "attic \"window\"");
  EXPECT_EQ(below.bookmarks[0].storey, 0);
  EXPECT_EQ(below.paths[0].storey, 0);
  removeStorey(project, 1);
  EXPECT_TRUE(project.check());
  EXPECT_TRUE(project.paths.empty());
  EXPECT_EQ(project.storey, 0);
}

TEST(ProjectFile, RefusesUnknownKeys) {
  EXPECT_THAT(refusalOf(minimal(R"({"configuration":"b","cellSize":2,"colour":1})")), HasSubstr("colour"));
}

TEST(ProjectFile, RefusesWhatIsNoProject) {
  for (const char* text :
       {"", "{", "[]", "null", "42", "{}", "\xff\xfe", R"({"format":"other","version":1})"})
    EXPECT_NE(refusalOf(text), "accepted") << text;
  EXPECT_THAT(refusalOf(std::string(100000, '[')), testing::Not(testing::IsEmpty()));
}

TEST(ProjectFile, SaysThatANewerVersionIsNewer) {
  EXPECT_THAT(refusalOf(R"({"format":"acentric-project","version":2})"), HasSubstr("newer"));
}

TEST(ProjectFile, RefusesAbsoluteScenePaths) {
  EXPECT_THAT(
      refusalOf(
          R"({"format":"acentric-project","version":1,"scene":"/etc/passwd","layout":{"configuration":"b","cellSize":2}})"),
      HasSubstr("/scene"));
}

TEST(ProjectFile, SavesAndLoads) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("acentric-project-test-" + std::to_string(::getpid()) + ".acentric.json");
  ASSERT_TRUE(saveProject(everythingSet(), file));
  const auto back = loadProject(file);
  std::filesystem::remove(file);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, everythingSet());
}

/// Files as earlier builds saved them; they are read forever.
std::filesystem::path oldProject(const char* name) {
  return std::filesystem::path(ACENTRIC_SOURCE_DIR) / "tests/pipeline/old_projects" / name;
}

TEST(OldProjectFiles, OfOneLayoutAreProjectsOfOneStorey) {
  const auto project = loadProject(oldProject("one_layout.acentric.json"));
  ASSERT_TRUE(project) << project.error().describe();
  ASSERT_EQ(project->storeys.size(), 1U);
  EXPECT_EQ(project->current().name, "floor");
  EXPECT_EQ(project->layout().configuration, Configuration::b);
  EXPECT_EQ(project->layout().cellSize, 2.0);
  EXPECT_EQ(project->layout().outline.loops.size(), 2U);
  EXPECT_EQ(project->spawn().position, glm::dvec2(-1.33, -0.48));
  EXPECT_EQ(project->bake.ambientRays, 12);
  EXPECT_EQ(project->view.reconstruction, Reconstruction::splat);
  EXPECT_NEAR(project->exposure, 0.646, 1e-6);
}

TEST(OldProjectFiles, OfOneStoreyMoreAreReadWithoutWhatWasNotThereYet) {
  const auto project = loadProject(oldProject("storeys_without_bounces.acentric.json"));
  ASSERT_TRUE(project) << project.error().describe();
  EXPECT_EQ(project->spawn().position, glm::dvec2(-3.2, -0.5));
  EXPECT_NEAR(project->spawn().yawRadians, radians(5), 1e-12);
  EXPECT_EQ(project->bake.bounces, BakeSettings{}.bounces);
  EXPECT_EQ(project->bake.pruning, BakeSettings{}.pruning);
  EXPECT_EQ(project->bake.distanceShift, BakeSettings{}.distanceShift);
  EXPECT_EQ(project->bake.colourQuality, BakeSettings{}.colourQuality);
}

TEST(OldProjectFiles, AreSavedAsTheyAreReadAndReadAgain) {
  for (const char* name : {"one_layout.acentric.json", "storeys_without_bounces.acentric.json"}) {
    const auto project = loadProject(oldProject(name));
    ASSERT_TRUE(project) << name;
    const auto again = parseProject(formatProject(*project), name);
    ASSERT_TRUE(again) << again.error().describe();
    EXPECT_EQ(*again, *project) << name;
  }
}

/// Holds every field: a change that reads one of them in another way is found here, and needs a new version.
TEST(OldProjectFiles, OfVersion1MeanWhatTheyMeant) {
  const auto project = loadProject(oldProject("everything.acentric.json"));
  ASSERT_TRUE(project) << project.error().describe() << "\ntoday it would be\n"
                       << formatProject(everythingSet());
  Project expected = everythingSet();
  for (Storey& storey : expected.storeys) storey.layout.density.clear();  // came later
  EXPECT_EQ(*project, expected);
}

TEST(ProjectFile, NeverSavesWhatItWouldNotLoad) {
  Project broken = everythingSet();
  broken.exposure = std::numeric_limits<float>::quiet_NaN();
  const auto file = std::filesystem::temp_directory_path() / "acentric-never-written.acentric.json";
  EXPECT_FALSE(saveProject(broken, file));
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(ProjectFile, CapturesLieBesideTheProject) {
  EXPECT_EQ(captureFolderFor("/a/b/gallery.acentric.json"), "/a/b/gallery.captures");
  EXPECT_EQ(captureFolderFor("gallery.json"), "gallery.captures");
}

TEST(ProjectFile, ASceneThatNoFileCanHaveOrNoProjectFileCanStateIsRefused) {
  Project project = everythingSet();
  project.scene = std::string("house.glb\0.txt", 14);
  EXPECT_THAT(project.check().error().message, HasSubstr("/scene: holds a NUL"));
  // As JSON states it, which the path must not cut.
  std::string text = formatProject(everythingSet());
  const std::string name = "house with spaces.glb";
  text.replace(text.find(name), name.size(), "house.glb\\u0000.txt");
  const auto read = parseProject(text, "p");
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("/scene: holds a NUL"));

  project.scene = "caf\xe9.glb";
  EXPECT_THAT(project.check().error().message, HasSubstr("/scene: the name of the model is not UTF-8"));
}

}  // namespace
}  // namespace acentric
