/// A bake killed at any moment loses nothing that was finished and leaves nothing half-written.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <future>
#include <map>
#include <random>

#include "engine/pipeline/project_lock.h"
#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;

using Identity = std::pair<ino_t, std::int64_t>;  // inode and time of change: a file written anew differs

Identity identityOf(const fs::path& path) {
  struct stat info {};
  ::stat(path.c_str(), &info);
  return {info.st_ino, std::int64_t(info.st_mtim.tv_sec) * 1'000'000'000 + info.st_mtim.tv_nsec};
}

/// Captures whose file is in place.
std::map<fs::path, Identity> finishedCaptures(const fs::path& folder) {
  std::map<fs::path, Identity> finished;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".pack" && entry.path().filename().string().front() != '.')
      finished[entry.path()] = identityOf(entry.path());
  }
  return finished;
}

TEST(KilledBake, FinishesNextTimeWithoutBakingAnythingTwice) {
  SampleProject project("kill", "-2,-2;2,-2;2,2;-2,2");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const auto whole = acentric({"bake", project.file(), "--json"});
  ASSERT_EQ(whole.exitCode, 0) << whole.errors;
  const int cameras = Json::parse(whole.output)["baked"].get<int>();

  std::mt19937 random(20030117);
  double seconds = whole.seconds;  // the least that a bake took: the machine may have other work now and then
  int interrupted = 0, halfway = 0;
  for (int round = 0; round < 6 || (round < 40 && (interrupted < 5 || halfway < 3)); ++round) {
    fs::remove_all(project.captures());
    const double share = std::uniform_real_distribution<double>(0.1, 0.75)(random);
    const auto killed =
        acentric({"bake", project.file()}, std::chrono::milliseconds(int(seconds * share * 1000)));
    interrupted += killed.signal == 9;
    if (killed.signal != 9) seconds = std::min(seconds, killed.seconds);
    const auto before = finishedCaptures(project.captures());
    halfway += !before.empty() && int(before.size()) < cameras;

    const auto next = acentric({"bake", project.file(), "--json"});
    ASSERT_EQ(next.exitCode, 0) << next.errors;
    const Json report = Json::parse(next.output);
    EXPECT_EQ(report["reused"].get<int>(), int(before.size()));
    EXPECT_EQ(report["baked"].get<int>(), cameras - int(before.size()));
    for (const auto& [path, identity] : before)
      EXPECT_EQ(identityOf(path), identity) << path << " was written again";
    for (const auto& entry : fs::directory_iterator(project.captures()))
      EXPECT_NE(entry.path().filename().string().front(), '.') << "left behind: " << entry.path();
    const auto validated = acentric({"validate", project.file()});
    EXPECT_EQ(validated.exitCode, 0) << validated.output;
  }
  EXPECT_GE(interrupted, 5) << "rounds must really be interrupted";
  EXPECT_GE(halfway, 3) << "some rounds must be interrupted between the first and the last capture";
}

TEST(InterruptedBake, WithCtrlCLeavesCompleteCapturesAndSaysSo) {
  SampleProject project("interrupt");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  auto running = std::async(std::launch::async, [&] {
    return acentric({"bake", project.file(), "--threads", "1", "--json"});
  });
  while (finishedCaptures(project.captures()).empty())
    ASSERT_NE(running.wait_for(std::chrono::milliseconds(1)), std::future_status::ready)
        << "it must still be baking when the signal comes";
  const auto owner = readLock(project.file() + ".bake");
  ASSERT_TRUE(owner.has_value()) << owner.error().describe();
  ASSERT_EQ(::kill(pid_t(owner->process), SIGINT), 0);
  const ProcessResult stopped = running.get();
  EXPECT_EQ(stopped.exitCode, 130);
  EXPECT_EQ(stopped.signal, 0) << "it ends by itself";
  EXPECT_TRUE(stopped.errors.find("was stopped") != std::string::npos ||
              stopped.errors.find("was cancelled") != std::string::npos)
      << stopped.errors;
  const auto kept = finishedCaptures(project.captures());
  const auto next = acentric({"bake", project.file(), "--json"});
  ASSERT_EQ(next.exitCode, 0) << next.errors;
  const Json report = Json::parse(next.output);
  EXPECT_EQ(report["reused"].get<int>(), int(kept.size()));
  EXPECT_GT(report["baked"].get<int>(), 0) << "stops before all is done";
  EXPECT_EQ(acentric({"validate", project.file()}).exitCode, 0);
}

}  // namespace
}  // namespace acentric::test
