/// The Python package over the library that was built: python_test.py tests it on a bundle, a walk and frames
/// of the C library that are made here. And its wheel, built without a network.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/base/file.h"
#include "engine/capi/acentric_runtime.h"
#include "engine/export/walk_write.h"
#include "tests/export/small_walk.h"
#include "tests/support/process.h"

namespace acentric::test {
namespace {

#ifndef ACENTRIC_SANITIZED  // Python itself is not made for sanitizers

namespace fs = std::filesystem;

/// Runs Debian's Python, of whose surroundings nothing helps.
std::vector<std::string> python(std::vector<std::string> environment, const std::vector<std::string>& words) {
  environment.insert(environment.begin(),
                     {"env", "-u", "PYTHONPATH", "-u", "ACENTRIC_RUNTIME", "PYTHONDONTWRITEBYTECODE=1"});
  environment.push_back(ACENTRIC_PYTHON);
  environment.insert(environment.end(), words.begin(), words.end());
  return environment;
}

/// A bundle, the walk of it and, as the C library draws them, frames N.rgba, N.holes and N.depth of
/// views.json.
class PythonTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    room = new TemporaryFolder("python");
    TaskRunner runner(1);
    OpenProject project = bakedProject(at("walk.acentric.json"), runner);
    const auto written = exportBundle({&project, 1}, at("bundle"), {false, "", kLosslessColours}, runner);
    ASSERT_TRUE(written) << written.error().describe();
    ASSERT_TRUE(writeWalk(at("bundle"), at("room.acentric"), {3}));
    acentric_bundle* bundle = nullptr;
    ASSERT_EQ(acentric_open_folder(at("bundle").c_str(), &bundle), ACENTRIC_OK);
    nlohmann::json views;
    for (const PerspectiveView& from : everyView(*project.layout)) {
      const acentric_view view{{from.eye.x, from.eye.y, from.eye.z},
                               from.yawRadians,
                               from.pitchRadians,
                               from.fovRadians,
                               from.width,
                               from.height};
      draw(bundle, view, std::to_string(views.size()));
      views.push_back({{"eye", view.eye},
                       {"yaw", view.yaw},
                       {"pitch", view.pitch},
                       {"fov", view.fov},
                       {"width", view.width},
                       {"height", view.height}});
    }
    acentric_close(bundle);
    ASSERT_TRUE(writeTextAtomically(at("views.json"), views.dump()));
  }
  static void TearDownTestSuite() { delete room; }

  static void draw(acentric_bundle* bundle, const acentric_view& view, const std::string& name) {
    const std::size_t pixels = std::size_t(view.width) * std::size_t(view.height);
    std::vector<std::uint8_t> rgba(4 * pixels), holes(pixels);
    std::vector<float> depth(pixels);
    const acentric_picture picture{rgba.data(), 0, holes.data(), depth.data()};
    ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK)
        << acentric_message(bundle);
    ASSERT_EQ(acentric_render(bundle, &view, nullptr, &picture), ACENTRIC_OK) << acentric_message(bundle);
    for (const auto& [ending, bytes] : {std::pair(".rgba", std::as_bytes(std::span(rgba))),
                                        std::pair(".holes", std::as_bytes(std::span(holes))),
                                        std::pair(".depth", std::as_bytes(std::span(depth)))})
      ASSERT_TRUE(writeFileAtomically(at(name + ending), bytes));
  }
  static std::string at(const std::string& name) { return (room->path() / name).string(); }
  static void expectOk(const std::vector<std::string>& words) {
    const ProcessResult result = runProcess(words);
    EXPECT_EQ(result.exitCode, 0) << result.output << result.errors;
  }

  static inline TemporaryFolder* room = nullptr;
};

TEST_F(PythonTest, DrawsReadsAndRefusesAsTheLibraryDoes) {
  expectOk(python({"PYTHONPATH=" + std::string(ACENTRIC_SOURCES) + "/python",
                   "ACENTRIC_RUNTIME=" ACENTRIC_RUNTIME_LIBRARY},
                  {std::string(ACENTRIC_SOURCES) + "/tests/capi/python_test.py", room->path().string(),
                   ACENTRIC_RUNTIME_HEADER}));
}

TEST_F(PythonTest, WheelIsBuiltWithoutANetworkAndInstalledElsewhere) {
  const auto pip = [](std::vector<std::string> words) {
    words.insert(words.begin(), {"-m", "pip", "--no-input", "--disable-pip-version-check"});
    return python(
        {"PIP_NO_INDEX=1", "PIP_CONFIG_FILE=/dev/null", "ACENTRIC_BUILD_FOLDER=" ACENTRIC_BUILD_FOLDER},
        words);
  };
  const std::string sources = std::string(ACENTRIC_SOURCES) + "/python";
  expectOk(pip({"wheel", "--no-build-isolation", "--no-deps", "--wheel-dir", at("wheels"), sources}));
  std::vector<std::string> wheels;
  for (const auto& entry : fs::directory_iterator(at("wheels"))) wheels.push_back(entry.path());
  ASSERT_EQ(wheels.size(), 1u);
  EXPECT_NE(wheels[0].find("-py3-none-linux_"), std::string::npos) << wheels[0];
  for (const char* left : {"build", "acentric.egg-info", "dist"})
    EXPECT_FALSE(fs::exists(sources + "/" + left)) << "within the sources";
  expectOk(pip({"install", "--no-deps", "--target", at("installed"), wheels[0]}));
  // The library is the package's own.
  EXPECT_TRUE(fs::exists(at("installed/acentric/libacentric_runtime.so.1")));
  const std::vector<std::string> environment{"PYTHONPATH=" + at("installed")};
  expectOk(python(environment, {std::string(ACENTRIC_SOURCES) + "/tests/capi/python_test.py", "Frames",
                                room->path().string(), ACENTRIC_RUNTIME_HEADER}));
  expectOk(python(environment,
                  {std::string(ACENTRIC_EXAMPLES) + "/frame.py", at("room.acentric"), at("frame.ppm")}));
  EXPECT_GT(fs::file_size(at("frame.ppm")), 960u * 540u * 3u);

  const ProcessResult nowhere = runProcess(python(
      environment, {std::string(ACENTRIC_EXAMPLES) + "/frame.py", at("none.acentric"), at("none.ppm")}));
  EXPECT_EQ(nowhere.exitCode, 1);
  EXPECT_NE(nowhere.errors.find("none.acentric"), std::string::npos) << nowhere.errors;
}

#endif

}  // namespace
}  // namespace acentric::test
