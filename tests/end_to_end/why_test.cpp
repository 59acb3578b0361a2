/// What would be baked, and why: as a designer sees it who changes one thing at a time.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

Json dryRun(const std::string& file) {
  const auto ran = acentric({"bake", file, "--dry-run", "--json"});
  EXPECT_EQ(ran.exitCode, 0) << ran.errors;
  return Json::parse(ran.output, nullptr, false);
}

Json bake(const std::string& file, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"bake", file, "--json"});
  const auto ran = acentric(more);
  EXPECT_EQ(ran.exitCode, 0) << ran.errors;
  return Json::parse(ran.output, nullptr, false);
}

/// The reasons of all that is missing, each once.
std::set<std::string> reasonsOf(const Json& report) {
  std::set<std::string> reasons;
  for (const Json& entry : report["missing"]) {
    std::string reason = entry["reason"];
    for (const Json& part : entry["changed"]) reason += " " + part.get<std::string>();
    reasons.insert(reason);
  }
  return reasons;
}

void flipBytes(const fs::path& path, std::streamoff at) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekg(at);
  char bytes[4];
  file.read(bytes, sizeof bytes);
  for (char& byte : bytes) byte = char(byte ^ 0x5a);
  file.seekp(at);
  file.write(bytes, sizeof bytes);
}

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class BakeReasonsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made = new SampleProject("why", "-3,-3;3,-3;3,3;-3,3");
    first = dryRun(made->file());
    baked = bake(made->file());
  }
  static void TearDownTestSuite() { delete made; }
  void SetUp() override { ASSERT_EQ(made->made().exitCode, 0) << made->made().errors; }
  fs::path fileOf(int camera, const char* extension) const {
    return project.captures() / (baked["cameras"][std::size_t(camera)]["key"].get<std::string>() + extension);
  }
  static inline SampleProject* made = nullptr;
  static inline Json first, baked;
  SampleProject project{"why-copy", *made};  ///< each test changes its own
  std::string file = project.file();
};

TEST_F(BakeReasonsTest, NameWhatChanged) {
  EXPECT_THAT(reasonsOf(first), ElementsAre("neverBaked"));
  EXPECT_EQ(first["missing"].size(), baked["cameras"].size());
  EXPECT_EQ(first["surfaceLight"]["reason"], "neverBaked");
  EXPECT_GT(first["bytes"].get<double>(), 0);
  EXPECT_GT(first["freeBytes"].get<double>(), first["bytes"].get<double>());
  EXPECT_GT(first["seconds"].get<double>(), 0);

  const Json none = dryRun(file);
  EXPECT_EQ(none["missing"].size(), 0u);
  EXPECT_EQ(none["surfaceLight"]["reason"], "baked");
  EXPECT_EQ(none["seconds"], 0);
  EXPECT_EQ(none["bytes"], 0);

  const Json plain = project.read();
  const auto with = [&](auto change) {
    Json changed = plain;
    change(changed);
    project.write(changed);
    return dryRun(file);
  };
  const Json settings = with([](Json& p) { p["bake"]["samplesPerDegree"] = 1.5; });
  EXPECT_THAT(reasonsOf(settings), ElementsAre("changed settings"));
  EXPECT_EQ(settings["surfaceLight"]["reason"], "baked") << "it has no part in the captures' resolution";
  EXPECT_THAT(reasonsOf(with([](Json& p) {
                p["effects"] = {{"hardShadows", false}};
              })),
              ElementsAre("changed effects"));
  EXPECT_THAT(reasonsOf(with([](Json& p) { p["storeys"][0]["layout"]["eyeHeight"] = 1.7; })),
              ElementsAre("changed place"));
  EXPECT_THAT(reasonsOf(with([](Json& p) { p["storeys"][0]["layout"]["nearBand"] = 1.4; })),
              ElementsAre("changed regions"));
  EXPECT_THAT(reasonsOf(with([](Json& p) { p["view"]["exposure"] = 2; })), testing::IsEmpty());
  EXPECT_THAT(reasonsOf(with([](Json&) {})), testing::IsEmpty()) << "taken back";

  // Another model under the same name: its scale, and with it its geometry and lights.
  const auto scaled = with([](Json& p) { p["import"]["metresPerUnit"] = 1.01; });
  EXPECT_THAT(*reasonsOf(scaled).begin(), HasSubstr("geometry"));
  EXPECT_THAT(*reasonsOf(scaled).begin(), testing::Not(HasSubstr("materials")));
}

TEST_F(BakeReasonsTest, DamageIsNamedAndBakedAgain) {
  const fs::path pack = fileOf(1, ".pack"), middle = fileOf(2, ".pack"), cut = fileOf(3, ".pack");
  const fs::path gone = fileOf(4, ".pack");
  const std::string packBefore = contentOf(pack), middleBefore = contentOf(middle),
                    cutBefore = contentOf(cut);
  flipBytes(pack, 300);
  flipBytes(middle, std::streamoff(fs::file_size(middle)) / 2);
  fs::resize_file(cut, fs::file_size(cut) - 5);
  fs::remove(gone);

  const Json dry = dryRun(file);
  EXPECT_EQ(dry["missing"].size(), 4u);
  EXPECT_THAT(reasonsOf(dry), ElementsAre("damaged", "neverBaked"));
  EXPECT_THAT(dry["missing"].dump(), HasSubstr(pack.filename().string()));

  const Json again = bake(file);
  EXPECT_EQ(again["baked"], 4);
  const std::string named = again["damaged"].dump();
  for (const fs::path& path : {pack, middle, cut}) EXPECT_THAT(named, HasSubstr(path.filename().string()));
  EXPECT_TRUE(contentOf(pack) == packBefore && contentOf(middle) == middleBefore &&
              contentOf(cut) == cutBefore);
  EXPECT_EQ(bake(file)["baked"], 0);
  EXPECT_EQ(acentric({"validate", file}).exitCode, 0);
}

TEST_F(BakeReasonsTest, DamageThatShowsInNoTimeIsFoundByReadingToTheEnd) {
  const fs::path pack = fileOf(0, ".pack");
  const std::string before = contentOf(pack);
  const auto written = fs::last_write_time(pack);
  flipBytes(pack, 300);
  fs::last_write_time(pack, written);
  const Json verified = bake(file, {"--verify"});
  EXPECT_EQ(verified["baked"], 1);
  EXPECT_THAT(verified["damaged"].dump(), HasSubstr(pack.filename().string()));
  EXPECT_TRUE(contentOf(pack) == before);
}

TEST_F(BakeReasonsTest, StoresWithoutRecordsAndCopiesOfStoresAreReusedWhole) {
  for (const auto& entry : fs::directory_iterator(project.captures()))
    if (entry.path().extension() == ".record") fs::remove(entry.path());
  EXPECT_EQ(dryRun(file)["missing"].size(), 0u);
  EXPECT_EQ(bake(file)["baked"], 0);
  EXPECT_TRUE(fs::exists(fileOf(0, ".record"))) << "noted again";
  const fs::path copy = project.captures().string() + ".copy";
  fs::copy(project.captures(), copy);
  fs::remove_all(project.captures());
  fs::rename(copy, project.captures());
  EXPECT_EQ(bake(file)["baked"], 0);
}

}  // namespace
}  // namespace acentric::test
