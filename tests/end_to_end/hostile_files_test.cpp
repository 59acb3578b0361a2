/// Files that no program of ours wrote, and names that are no text: refused or shown, never a crash.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// What `validate` says of a project file of these bytes.
Json refusalOf(const std::string& bytes) {
  const TemporaryFolder folder("hostile");
  const fs::path file = folder.path() / "p.acentric.json";
  std::ofstream(file, std::ios::binary) << bytes;
  const auto ran = acentric({"--json", "validate", file.string()});
  EXPECT_EQ(ran.exitCode, 1) << "signal " << ran.signal << ": " << ran.errors;
  const Json report = Json::parse(ran.output, nullptr, false);
  EXPECT_TRUE(report.is_object() && report.contains("error")) << ran.output;
  return report.is_object() ? report.value("error", Json::object()) : Json::object();
}

TEST(HostileFiles, AProjectWithBytesThatAreNotUtf8IsRefusedInJson) {
  const Json error = refusalOf("{\"format\": \"acentric-project\", \"scene\": \"\xff.glb\"}");
  EXPECT_EQ(error.value("kind", ""), "malformed");
  EXPECT_THAT(error.value("message", ""), HasSubstr("UTF-8"));
}

TEST(HostileFiles, AProjectNestedTooDeepIsRefused) {
  for (const auto& [open, close] : {std::pair{"[", "]"}, {"{\"a\":", "}"}}) {
    std::string text;
    for (int level = 0; level < 200'000; ++level) text += open;
    text += "1";
    for (int level = 0; level < 200'000; ++level) text += close;
    EXPECT_THAT(refusalOf(text).value("message", ""), HasSubstr("levels deep"));
  }
}

TEST(HostileFiles, ASceneReferenceWithANulIsRefusedNotCut) {
  const SampleProject project("nul", "-1,-1;1,-1;1,1;-1,1");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  Json edited = project.read();
  edited["scene"] = std::string("gallery.glb\0.txt", 16);
  project.write(edited);
  const auto ran = acentric({"validate", project.file()});
  EXPECT_EQ(ran.exitCode, 1);
  EXPECT_THAT(ran.errors, HasSubstr("/scene: holds a NUL"));
}

TEST(HostileFiles, AProjectWhoseFileNameIsNotUtf8IsBakedValidatedAndExported) {
  const SampleProject sample("names", "-1,-1;1,-1;1,1;-1,1");
  ASSERT_EQ(sample.made().exitCode, 0) << sample.made().errors;
  const std::string file = (sample.folder() / "caf\xe9.acentric.json").string();
  fs::rename(sample.file(), file);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"bake", file},
        {"validate", file},
        {"info", file},
        {"export", file, (sample.folder() / "bundle\xff").string()}}) {
    auto arguments = command;
    arguments.push_back("--json");
    const auto ran = acentric(arguments);
    EXPECT_EQ(ran.exitCode, 0) << command.front() << ", signal " << ran.signal << ": " << ran.errors;
    EXPECT_TRUE(Json::accept(ran.output)) << command.front() << ": " << ran.output;
  }
  const Json index =
      Json::parse(std::ifstream(sample.folder() / "bundle\xff" / "bundle.json"), nullptr, false);
  EXPECT_EQ(index.value("name", ""), "caf\xef\xbf\xbd");
}

TEST(HostileFiles, AFolderInTheWayOfOneCaptureLeavesTheOthersBaked) {
  const SampleProject project("way", "-1,-1;1,-1;1,1;-1,1");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const Json dry =
      Json::parse(acentric({"bake", project.file(), "--dry-run", "--json"}).output, nullptr, false);
  const std::string key = dry["missing"][1]["key"];
  const fs::path way = project.captures() / (key + ".pack");
  fs::create_directories(way);
  const auto ran = acentric({"bake", project.file(), "--json"});
  EXPECT_EQ(ran.exitCode, 1);
  const Json report = Json::parse(ran.output, nullptr, false);
  EXPECT_EQ(report["baked"].get<std::size_t>() + 1, dry["missing"].size());
  EXPECT_TRUE(report["surfaceLight"]["baked"].get<bool>());
  ASSERT_EQ(report["refused"].size(), 1u);
  EXPECT_THAT(report["refused"][0].get<std::string>(),
              HasSubstr(key + ".pack: cannot be put in place: a folder"));

  fs::remove(way);
  const auto again = acentric({"bake", project.file(), "--json"});
  EXPECT_EQ(again.exitCode, 0) << again.errors;
  EXPECT_EQ(Json::parse(again.output, nullptr, false)["baked"], 1);
  EXPECT_EQ(acentric({"validate", project.file()}).exitCode, 0);
}

}  // namespace
}  // namespace acentric::test
