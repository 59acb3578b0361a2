/// The folder that times OpenGL elsewhere: made, moved, and started where nothing is known of this machine.

#include <gtest/gtest.h>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 60'000'000;

std::uintmax_t bytesIn(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

TEST(BenchGlFolder, RunsWhereverItIsMovedWithoutAnEnvironment) {
  const SampleProject project("bench_gl");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const auto baked = acentric({"bake", project.file(), "--json"});
  ASSERT_EQ(baked.exitCode, 0) << baked.errors;

  const auto tooSmall = acentric({"bench", "pack", project.file(), "-o",
                                  (project.folder() / "small").string(), "--most-megabytes", "0.01"});
  EXPECT_EQ(tooSmall.exitCode, 1);
  EXPECT_NE(tooSmall.errors.find("0.0 MB. Allow more"), std::string::npos) << tooSmall.errors;

  const fs::path made = project.folder() / "made", moved = project.folder() / "else where" / "bench";
  const auto packed = runProcess({ACENTRIC_BENCH_GL_MAKER, project.file(), made.string(),
                                  fs::path(ACENTRIC_PROGRAM).parent_path().string(), "--", "--frames", "6"});
  ASSERT_EQ(packed.exitCode, 0) << packed.errors;
  EXPECT_LT(bytesIn(made), kMostBytes);
  fs::create_directories(moved.parent_path());
  fs::rename(made, moved);
  // What it was made of is out of reach.
  fs::rename(project.captures(), project.folder() / "hidden.captures");
  fs::rename(project.folder() / "gallery.glb", project.folder() / "hidden.glb");

  for (const auto& entry : fs::directory_iterator(moved)) {
    const std::string name = entry.path().filename().string();
    for (const char* notShipped : {"libGL", "libEGL", "libgbm", "libc.so", "libembree", "libOpenImageIO"})
      EXPECT_FALSE(name.starts_with(notShipped)) << name;
  }
  EXPECT_TRUE(fs::exists(moved / "runtime" / "libstdc++.so.6"));

  const fs::path figures = project.folder() / "figures.json";
  const auto ran = runProcess({"/usr/bin/env", "-i", (moved / "bench").string(), "--width", "320", "--height",
                               "180", "--repeats", "1", "--json", figures.string()});
  if (ran.exitCode != 0 && ran.errors.find("OpenGL without a window") != std::string::npos)
    GTEST_SKIP() << ran.errors;
  ASSERT_EQ(ran.exitCode, 0) << ran.errors;
  const Json json = Json::parse(std::ifstream(figures));
  EXPECT_FALSE(json["glRenderer"].get<std::string>().empty());
  EXPECT_NE(ran.output.find(json["glRenderer"].get<std::string>()), std::string::npos);
  EXPECT_GT(json["frames"].get<int>(), 0);
  EXPECT_GT(json["patchesPerFrame"].get<double>(), 100);
  EXPECT_GT(json["frameMsMedian"].get<double>(), 0);
  EXPECT_GE(json["frameMsP99"].get<double>(), json["frameMsMedian"].get<double>());
  EXPECT_GT(json["cardMsMedian"].get<double>(), 0);
  EXPECT_LT(json["cardMsMedian"].get<double>(), json["frameMsP99"].get<double>());

  // With the C++ runtime that travels along, and with no library from elsewhere but the C library's and
  // drivers'.
  const auto libraries = runProcess({"/usr/bin/env", "-i", "LD_LIBRARY_PATH=" + (moved / "runtime").string(),
                                     "/usr/bin/ldd", (moved / "acentric-bench-gl").string()});
  ASSERT_EQ(libraries.exitCode, 0) << libraries.errors;
  std::istringstream lines(libraries.output);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("=>") == std::string::npos) continue;
    const bool ofTheMachine =
        line.find("libc.so") != std::string::npos || line.find("libm.so") != std::string::npos ||
        line.find("libdl.so") != std::string::npos || line.find("libpthread.so") != std::string::npos;
    EXPECT_TRUE(ofTheMachine || line.find(moved.string()) != std::string::npos) << line;
  }
}

}  // namespace
}  // namespace acentric::test
