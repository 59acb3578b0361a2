/// A first layout of ground that is too large to be laid out: what is laid out, what is said of it, and what
/// is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/layout/layout.h"
#include "engine/pipeline/project.h"
#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// `acentric new` of the sample town.
class Town {
 public:
  Town() : folder_("town") {}
  ProcessResult make(std::vector<std::string> more) const {
    std::vector<std::string> all = {"new",     ACENTRIC_SAMPLE_TOWN,   "-o", file(),
                                    "--force", "--samples-per-degree", "1"};
    all.insert(all.end(), more.begin(), more.end());
    return acentric(all);
  }
  std::string file() const { return (folder_.path() / "town.acentric.json").string(); }

 private:
  TemporaryFolder folder_;
};

TEST(Town, HasAFirstLayoutThatCanBeBaked) {
  const Town town;
  const ProcessResult made = town.make({"--bake-minutes", "0"});
  ASSERT_EQ(made.exitCode, 0) << made.errors;
  EXPECT_THAT(made.output,
              AllOf(HasSubstr("configuration e with cells of "), HasSubstr("laid out: only "),
                    HasSubstr("km2 that can be walked"), HasSubstr("2,000 cameras are the limit"),
                    HasSubstr("--max-cameras"), HasSubstr("--around x,y"), HasSubstr("plan: ")));
  const auto project = loadProject(town.file());
  ASSERT_TRUE(project) << project.error().describe();
  const Storey& storey = project->current();
  const auto layout = buildLayout(storey.layout);
  ASSERT_TRUE(layout);
  EXPECT_LE(layout->cameras.size(), 2000u);
  EXPECT_GT(layout->cameras.size(), 1500u);
  EXPECT_GT(storey.layout.outline.area(), 6000);
  EXPECT_GT(storey.walkable.area(), 3.5e6);
  EXPECT_TRUE(storey.layout.outline.contains(storey.spawn.position) ||
              layout->regionAt(storey.spawn.position));
  // Houses stand close together within 300 m of the middle.
  for (const auto& loop : storey.layout.outline.loops)
    for (const glm::dvec2& corner : loop) {
      EXPECT_LT(std::abs(corner.x), 450);
      EXPECT_LT(std::abs(corner.y), 450);
    }
  EXPECT_LT(std::filesystem::file_size(town.file()), 200'000u)
      << "cells are told apart only where it matters";
}

TEST(Town, HasNoCamerasInItsHousesAndNoRegionsWhereNobodyCanStand) {
  const Town town;
  ASSERT_EQ(town.make({"--bake-minutes", "0", "--no-estimate"}).exitCode, 0);
  const ProcessResult checked = acentric({"check", town.file(), "--all", "--json"});
  const Json report = Json::parse(checked.output);
  for (const Json& finding : report["findings"]) {
    EXPECT_NE(finding["flaw"], "insideSolid") << finding;
    EXPECT_NE(finding["flaw"], "noStandingRoom") << finding;
    EXPECT_NE(finding["severity"], "error") << finding;
  }
}

TEST(Town, IsLaidOutAsFarAsItIsBakedInTime) {
  const Town town;
  const ProcessResult made = town.make({"--bake-minutes", "0.05", "--json"});
  ASSERT_EQ(made.exitCode, 0) << made.errors;
  const Json report = Json::parse(made.output);
  EXPECT_EQ(report["bakeMinutes"], 0.05);
  EXPECT_EQ(report["limitedBy"], "minutes");
  const Json& storey = report["storeys"][0];
  EXPECT_LT(storey["cameras"].get<int>(), 1000);
  EXPECT_THAT(storey["leftOut"].get<std::string>(),
              AllOf(HasSubstr("as much as bakes in about 0.05 minutes here"), HasSubstr("--bake-minutes")));
  EXPECT_EQ(report["plan"]["cameras"], storey["cameras"]);
  const auto project = loadProject(town.file());
  ASSERT_TRUE(project);
  EXPECT_GT(project->current().walkable.area(), 3.5e6) << "what is left out is kept";

  // Without a forecast there is nothing to go by but the cameras.
  const ProcessResult blind = town.make({"--bake-minutes", "0.05", "--no-estimate", "--json"});
  ASSERT_EQ(blind.exitCode, 0) << blind.errors;
  EXPECT_EQ(Json::parse(blind.output)["limitedBy"], "cameras");
}

TEST(Town, IsLaidOutAsMuchAndWhereItIsAsked) {
  const Town town;
  const ProcessResult made =
      town.make({"--max-cameras", "300", "--bake-minutes", "0", "--around", "-702,398", "--json"});
  ASSERT_EQ(made.exitCode, 0) << made.errors;
  const Json report = Json::parse(made.output);
  EXPECT_EQ(report["mostCameras"], 300);
  const Json& storey = report["storeys"][0];
  EXPECT_LE(storey["cameras"].get<int>(), 300);
  EXPECT_GT(storey["cameras"].get<int>(), 200);
  EXPECT_GT(storey["walkableSquareMetres"].get<double>(), 3.5e6);
  EXPECT_LT(storey["laidOutSquareMetres"].get<double>(), 3e4);
  EXPECT_THAT(storey["leftOut"].get<std::string>(), HasSubstr("300 cameras are the limit"));
  EXPECT_EQ(report["plan"]["cameras"], storey["cameras"]);
  EXPECT_GT(report["plan"]["megapixels"].get<double>(), 0);
  const auto project = loadProject(town.file());
  ASSERT_TRUE(project);
  EXPECT_LT(glm::distance(project->spawn().position, glm::dvec2(-702, 398)), 200);

  const ProcessResult hexagons =
      town.make({"--max-cameras", "300", "--config", "b", "--no-estimate", "--json"});
  ASSERT_EQ(hexagons.exitCode, 0) << hexagons.errors;
  EXPECT_FALSE(Json::parse(hexagons.output).contains("plan"));
  EXPECT_EQ(Json::parse(hexagons.output)["storeys"][0]["configuration"], "b");
  EXPECT_LE(Json::parse(hexagons.output)["storeys"][0]["cameras"].get<int>(), 300);
}

TEST(Town, IsLaidOutAsDrawnWhateverTheLimit) {
  const Town town;
  const ProcessResult made = town.make({"--outline", "-6,-150;6,-150;6,150;-6,150", "--cell", "3",
                                        "--max-cameras", "100", "--no-estimate", "--json"});
  ASSERT_EQ(made.exitCode, 0) << made.errors;
  const Json storey = Json::parse(made.output)["storeys"][0];
  EXPECT_GT(storey["cameras"].get<int>(), 1000);
  EXPECT_FALSE(storey.contains("leftOut"));
  EXPECT_EQ(storey["walkableSquareMetres"], storey["laidOutSquareMetres"]);
}

TEST(Town, RefusesLimitsAndPlacesThatMakeNoSense) {
  const Town town;
  for (const std::vector<std::string>& given : {std::vector<std::string>{"--max-cameras", "-1"},
                                                {"--max-cameras", "1e99"},
                                                {"--max-cameras", "many"},
                                                {"--bake-minutes", "-1"},
                                                {"--bake-minutes", "nan"},
                                                {"--bake-minutes", "soon"},
                                                {"--around", "nan,0"},
                                                {"--around", "1"},
                                                {"--around", "90000,0"},
                                                {"--around", "0,0", "--outline", "0,0;5,0;5,5"}}) {
    const ProcessResult refused = town.make(given);
    EXPECT_NE(refused.exitCode, 0) << given.back();
    EXPECT_FALSE(refused.errors.empty());
    EXPECT_FALSE(std::filesystem::exists(town.file())) << given.back();
  }
  const ProcessResult few = town.make({"--max-cameras", "2"});
  EXPECT_EQ(few.exitCode, 1);
  EXPECT_THAT(few.errors, HasSubstr("2 cameras are too few for a single region"));
}

}  // namespace
}  // namespace acentric::test
