/// Budgets of triangles, as a user types them.

#include <gtest/gtest.h>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

class BudgetCommandTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { made = new SampleProject("budget"), asMade = made->read(); }
  static void TearDownTestSuite() { delete made; }
  BudgetCommandTest() : project(*made) {}
  void SetUp() override {
    ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
    project.write(asMade);
  }
  Json report(std::vector<std::string> arguments, int exitCode = 0) {
    arguments.push_back("--json");
    const auto result = acentric(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.errors;
    return Json::parse(result.output, nullptr, false);
  }
  std::string path(const char* name) const { return (project.folder() / name).string(); }

  static inline SampleProject* made = nullptr;
  static inline Json asMade;
  SampleProject& project;
};

TEST_F(BudgetCommandTest, CountsEveryRegionAndNamesThoseOverTheBudget) {
  const Json counted = report({"budget", project.file()});
  const Json info = report({"info", project.file(), "--regions"});
  ASSERT_EQ(counted["regions"].size(), info["regions"].size());
  for (std::size_t r = 0; r < counted["regions"].size(); ++r) {
    EXPECT_EQ(counted["regions"][r]["cell"], info["regions"][r]["cell"]);
    EXPECT_EQ(counted["regions"][r]["triangles"], info["regions"][r]["localTriangles"]);
  }
  const int most = counted["most"];
  EXPECT_EQ(report({"budget", project.file(), "--max", std::to_string(most)})["over"].size(), 0u);
  const Json over =
      report({"budget", project.file(), "--max", std::to_string(most - 1), "-o", path("plan.png")});
  ASSERT_GE(over["over"].size(), 1u);
  EXPECT_EQ(over["over"][0]["triangles"], most);
  EXPECT_GT(std::filesystem::file_size(path("plan.png")), 10000u);
}

TEST_F(BudgetCommandTest, FitsCellsAndWritesThemOnlyWhenAsked) {
  const int most = report({"budget", project.file()})["most"];
  const std::string limit = std::to_string(most * 8 / 10);
  const Json before = project.read();
  const Json fitted = report({"fit", project.file(), "--max", limit, "-o", path("fit.svg")});
  EXPECT_TRUE(fitted["satisfied"].get<bool>());
  EXPECT_GE(fitted["curve"].size(), 20u);
  EXPECT_TRUE(std::filesystem::exists(path("fit.svg")));
  EXPECT_EQ(project.read(), before);
  const Json applied = report({"fit", project.file(), "--max", limit, "--apply"});
  EXPECT_TRUE(applied["applied"].get<bool>());
  EXPECT_EQ(project.read()["storeys"][0]["layout"]["cellSize"], fitted["cellSize"]);
  const Json after = report({"budget", project.file(), "--max", limit});
  EXPECT_EQ(after["most"], fitted["most"]);
  EXPECT_EQ(after["over"].size(), 0u);
}

TEST_F(BudgetCommandTest, SimplifiesWhatNoCellsCanFitOnceAndSaysSoInEveryWalk) {
  const Json counted = report({"budget", project.file()});
  const int most = counted["most"].get<int>() * 3 / 4;
  const std::vector<std::string> fit{
      "fit",         project.file(), "--max",  std::to_string(most), "--min-cell", "6", "--simplify",
      "--max-error", "0.05",         "--apply"};
  const Json first = report(fit);
  ASSERT_FALSE(first["satisfied"].get<bool>());
  ASSERT_GE(first["simplified"].size(), 1u);
  for (const Json& region : first["simplified"]) {
    EXPECT_FALSE(region["fromStore"].get<bool>());
    const Json& cost = region["report"];
    EXPECT_GT(cost["before"].get<int>(), most);
    EXPECT_LE(cost["after"].get<int>(), most);
    EXPECT_TRUE(cost["withinBudget"].get<bool>());
    EXPECT_LE(cost["maxErrorMetres"].get<double>(), 0.05);
    EXPECT_GT(cost["comparedFrames"].get<int>(), 8);
    EXPECT_GT(cost["psnr"].get<double>(), 25);
  }
  const Json written = project.read();
  EXPECT_EQ(written["budget"],
            (Json{{"trianglesPerRegion", most}, {"maxErrorMetres", 0.05}, {"simplify", true}}));
  EXPECT_EQ(written["storeys"][0]["layout"]["cellSize"], 2.5) << "the cells stay";
  EXPECT_EQ(report({"budget", project.file()})["limit"], most) << "the project's own";
  for (const Json& region : report(fit)["simplified"]) EXPECT_TRUE(region["fromStore"].get<bool>());

  // A walk takes it from the store, and says so.
  ASSERT_EQ(acentric({"bake", project.file(), "--only", "0", "--prune"}).exitCode, 0);
  const Json& within = first["simplified"][0]["centre"];
  const Json rendered =
      report({"render", project.file(), "--size", "160x90", "--eye",
              std::to_string(within[0].get<double>()) + "," + std::to_string(within[1].get<double>()), "-o",
              path("view.png")});
  ASSERT_EQ(rendered["warnings"].size(), 1u);
  EXPECT_NE(rendered["warnings"][0].get<std::string>().find("simplified"), std::string::npos);
  for (const Json& region : report(fit)["simplified"])
    EXPECT_TRUE(region["fromStore"].get<bool>()) << "pruning kept it";
}

TEST_F(BudgetCommandTest, ValidatesSimplifiedRegionsAndFindsDamagedOnes) {
  const int most = report({"budget", project.file()})["most"].get<int>() * 3 / 4;
  const std::vector<std::string> validate{"validate", project.file()};
  EXPECT_EQ(report(validate)["simplifiedMissing"], 0) << "nothing is to be simplified yet";
  const Json simplified = report({"fit", project.file(), "--max", std::to_string(most), "--min-cell", "6",
                                  "--simplify", "--max-error", "0.05", "--apply"});
  const Json sound = report(validate);
  EXPECT_EQ(sound["simplifiedChecked"], simplified["simplified"].size());
  EXPECT_EQ(sound["simplifiedMissing"], 0);

  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(project.captures()))
    if (entry.path().extension() == ".local") files.push_back(entry.path());
  ASSERT_GE(files.size(), 1u);
  const std::filesystem::path& file = files[0];
  const auto kept = path("kept");
  const auto restore = [&] {
    std::filesystem::copy_file(kept, file, std::filesystem::copy_options::overwrite_existing);
  };
  std::filesystem::copy_file(file, kept);
  const auto expectProblem = [&](const char* what) {
    const Json found = report(validate, 1);
    EXPECT_FALSE(found["valid"].get<bool>()) << what;
    ASSERT_EQ(found["problems"].size(), 1u) << what;
    EXPECT_NE(found["problems"][0].get<std::string>().find(file.filename().string()), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(file)) << "checking sets nothing aside";
    restore();
  };
  std::filesystem::resize_file(file, std::filesystem::file_size(file) * 2 / 3);
  expectProblem("truncated");
  {
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    const auto middle = std::streamoff(std::filesystem::file_size(file) / 2);
    char byte = 0;
    bytes.seekg(middle).get(byte);
    bytes.seekp(middle).put(static_cast<char>(byte ^ 4));
  }
  expectProblem("one bit");
  const auto elsewhere = project.captures() / ("simplified-" + std::string(32, '5') + ".local");
  std::filesystem::copy_file(file, elsewhere);
  EXPECT_EQ(report(validate)["simplifiedChecked"], simplified["simplified"].size()) << "of no region";
  std::filesystem::remove(elsewhere);
  if (files.size() > 1) {
    std::filesystem::copy_file(files[1], file, std::filesystem::copy_options::overwrite_existing);
    expectProblem("made for another region");
  }
  std::filesystem::remove(file);
  const Json missing = report(validate);
  EXPECT_EQ(missing["simplifiedMissing"], 1);
  EXPECT_EQ(missing["simplifiedChecked"], simplified["simplified"].size() - 1);
  restore();
}

TEST_F(BudgetCommandTest, SaysWhereNothingFits) {
  const Json before = project.read();
  const Json fitted = report({"fit", project.file(), "--max", "1", "--min-cell", "1"}, 1);
  EXPECT_FALSE(fitted["satisfied"].get<bool>());
  EXPECT_GE(fitted["over"].size(), 1u);
  EXPECT_EQ(report({"fit", project.file(), "--max", "1", "--min-cell", "1", "--apply"}, 1)["error"]["kind"],
            "invalidArgument");
  EXPECT_EQ(project.read(), before);
  EXPECT_EQ(acentric({"fit", project.file()}).exitCode, 2) << "--max is required";
  EXPECT_EQ(acentric({"budget", project.file(), "-o", path("plan.txt")}).exitCode, 1);
}

TEST_F(BudgetCommandTest, SplitsOnlyWhatExceedsTheBudgetAndSimplifiesTheRest) {
  const auto refused = acentric({"fit", project.file(), "--max", "1000", "--split"});
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_NE(refused.errors.find("configuration b cannot be split, only those of e (squares) and g"),
            std::string::npos)
      << refused.errors;
  EXPECT_EQ(acentric({"fit", project.file(), "--max", "1000", "--split", "--rotate"}).exitCode, 2);

  ASSERT_EQ(acentric({"layout", project.file(), "--config", "e", "--apply"}).exitCode, 0);
  const Json before = project.read();
  const Json counted = report({"budget", project.file()});
  const std::string limit = std::to_string(counted["most"].get<int>() * 8 / 10);
  const Json over = report({"budget", project.file(), "--max", limit})["over"];
  const Json tried = report({"fit", project.file(), "--max", limit, "--split", "-o", path("split.png")});
  EXPECT_TRUE(tried["satisfied"].get<bool>());
  EXPECT_EQ(tried["overBefore"], over.size());
  EXPECT_GE(tried["split"].get<std::size_t>(), over.size());
  EXPECT_GT(std::filesystem::file_size(path("split.png")), 10000u);
  EXPECT_EQ(project.read(), before);

  EXPECT_TRUE(report({"fit", project.file(), "--max", limit, "--split", "--apply"})["applied"].get<bool>());
  Json after = project.read();
  EXPECT_EQ(after["storeys"][0]["layout"]["split"].size(), tried["split"]);
  EXPECT_EQ(after["storeys"][0]["layout"]["cellSize"], before["storeys"][0]["layout"]["cellSize"]);
  const Json recounted = report({"budget", project.file(), "--max", limit});
  EXPECT_EQ(recounted["over"].size(), 0u);
  EXPECT_EQ(recounted["most"], tried["most"]);
  EXPECT_EQ(recounted["regions"].size(), tried["regions"]);
  // What is split no more than the number calls for stays; a larger number calls for nothing.
  EXPECT_EQ(report({"fit", project.file(), "--max", limit, "--split", "--merge"})["merged"], 0);
  const std::string most = counted["most"].dump();
  const Json merged = report({"fit", project.file(), "--max", most, "--split", "--merge", "--apply"});
  EXPECT_EQ(merged["merged"], tried["split"]);
  after = project.read();
  EXPECT_EQ(after["storeys"][0]["layout"].value("split", Json::array()).size(), 0u);

  // Where no smaller cells are allowed, what exceeds the number is simplified.
  const std::vector<std::string> simplify{"fit",         project.file(), "--max",  limit,
                                          "--split",     "--min-cell",   "2.5",    "--simplify",
                                          "--max-error", "0.05",         "--apply"};
  const Json simplified = report(simplify);
  EXPECT_FALSE(simplified["satisfied"].get<bool>());
  ASSERT_EQ(simplified["simplified"].size(), over.size());
  for (const Json& region : simplified["over"]) EXPECT_EQ(region["why"], "smallest");
  for (const Json& region : simplified["simplified"])
    EXPECT_TRUE(region["report"]["withinBudget"].get<bool>());
  EXPECT_EQ(project.read()["budget"]["simplify"], true);
}

}  // namespace
}  // namespace acentric::test
