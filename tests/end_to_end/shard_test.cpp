/// Shares of a bake give the very store that one bake gives, whatever order they run in.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <map>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> contentsOf(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    contents[entry.path().filename()] = {std::istreambuf_iterator<char>(file), {}};
  }
  return contents;
}

/// Names first: contents are too long to print.
void expectSame(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b) {
  const auto names = [](const auto& contents) {
    std::vector<std::string> all;
    for (const auto& [name, bytes] : contents) all.push_back(name);
    return all;
  };
  EXPECT_EQ(names(a), names(b));
  for (const auto& [name, bytes] : a) {
    const auto other = b.find(name);
    EXPECT_TRUE(other == b.end() || bytes == other->second) << name << " differs";
  }
}

Json bakeShard(const std::string& file, int number, int count, std::vector<std::string> more = {}) {
  more.insert(more.begin(),
              {"bake", file, "--json", "--shard", std::to_string(number) + "/" + std::to_string(count)});
  const auto baked = acentric(more);
  EXPECT_EQ(baked.exitCode, 0) << baked.errors;
  return Json::parse(baked.output, nullptr, false);
}

TEST(Shards, SideBySideMakeTheStoreOfOneBake) {
  SampleProject project("shards", "-3,-3;3,-3;3,3;-3,3");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const auto whole = acentric({"bake", project.file(), "--json"});
  ASSERT_EQ(whole.exitCode, 0) << whole.errors;
  const int cameras = Json::parse(whole.output)["baked"].get<int>();
  const auto expected = contentsOf(project.captures());
  fs::remove_all(project.captures());

  constexpr int kShards = 3;
  std::vector<std::future<Json>> running;
  for (int n = 1; n <= kShards; ++n)
    running.push_back(std::async(std::launch::async, [&, n] {
      return bakeShard(project.file(), n, kShards, {"--threads", "1"});
    }));
  // The second share twice at once, as when a farm takes a machine for lost that is not.
  running.push_back(std::async(std::launch::async, [&] { return bakeShard(project.file(), 2, kShards); }));
  int baked = 0, lights = 0;
  for (int n = 0; n <= kShards; ++n) {
    const Json report = running[std::size_t(n)].get();
    const int share = report["baked"].get<int>() + report["reused"].get<int>();
    EXPECT_THAT(share, testing::AnyOf(cameras / kShards, cameras / kShards + 1));
    if (n < kShards) baked += share, lights += report["surfaceLight"]["asked"].get<bool>();
  }
  EXPECT_EQ(baked, cameras) << "each camera is of one share";
  EXPECT_EQ(lights, 1);
  expectSame(contentsOf(project.captures()), expected);

  EXPECT_EQ(bakeShard(project.file(), 2, kShards)["baked"], 0) << "repeating bakes nothing";
  expectSame(contentsOf(project.captures()), expected);
}

TEST(Shards, CountTheCamerasOfAllStoreysOrOfOne) {
  SampleProject project("storey-shards", "-3,-3;3,-3;3,3;-3,3");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  Json json = project.read();
  json["storeys"].push_back(json["storeys"][0]);
  json["storeys"][1]["name"] = "upstairs";
  json["storeys"][1]["layout"]["floorHeight"] = 1;
  project.write(json);

  const std::vector<std::string> upstairs = {"--storey", "upstairs"};
  int baked = 0, lights = 0;
  for (const int n : {1, 2}) {
    const Json report = bakeShard(project.file(), n, 2, upstairs);
    baked += report["baked"].get<int>(), lights += report["surfaceLight"]["asked"].get<bool>();
  }
  EXPECT_EQ(lights, 1);
  int all = 0, reused = 0;
  for (const int n : {2, 1}) {
    const Json report = bakeShard(project.file(), n, 2);
    ASSERT_EQ(report["storeys"].size(), 2u);
    for (const Json& storey : report["storeys"])
      all += storey["baked"].get<int>() + storey["reused"].get<int>();
    reused += report["storeys"][1]["reused"].get<int>();
  }
  EXPECT_EQ(reused, baked) << "the storey's own shares made all of it";
  EXPECT_EQ(all, 2 * baked);
  EXPECT_EQ(acentric({"validate", project.file()}).exitCode, 0);
}

TEST(Shards, ThatMakeNoSenseAreRefused) {
  const std::string project = "unopened.acentric.json";
  for (const char* shard : {"0/2", "3/2", "2", "1/0", "a/b", "1/2/3", "-1/2", "1/999999", " 1/2"}) {
    const auto refused = acentric({"bake", project, "--shard", shard});
    EXPECT_EQ(refused.exitCode, 1) << shard;
    EXPECT_THAT(refused.errors, testing::HasSubstr("such as 2/8")) << shard;
  }
  EXPECT_EQ(acentric({"bake", project, "--shard", "1/2", "--prune"}).exitCode, 1);
  EXPECT_EQ(acentric({"bake", project, "--shard", "1/2", "--only", "0"}).exitCode, 1);
  EXPECT_EQ(acentric({"bake", project, "--light", "only", "--only", "0"}).exitCode, 1);
}

}  // namespace
}  // namespace acentric::test
