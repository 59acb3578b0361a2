#pragma once
/// A small project of the generated gallery, so coarse that it bakes in seconds.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/process.h"

namespace acentric::test {

using Json = nlohmann::json;

inline ProcessResult acentric(std::vector<std::string> arguments,
                              std::chrono::milliseconds limit = std::chrono::minutes(5)) {
  arguments.insert(arguments.begin(), ACENTRIC_PROGRAM);
  return runProcess(arguments, limit);
}

/// What a command that succeeds reports as JSON.
inline Json jsonOf(std::vector<std::string> arguments) {
  arguments.push_back("--json");
  const auto result = acentric(arguments);
  EXPECT_EQ(result.exitCode, 0) << result.errors;
  return Json::parse(result.output, nullptr, false);
}

/// A copy of the gallery and a coarse project of it.
class SampleProject {
 public:
  /// `outline`: of where one walks, metres.
  explicit SampleProject(const std::string& name, const std::string& outline = "-5,-3.5;5,-3.5;5,3.5;-5,3.5")
      : folder_(name) {
    std::filesystem::copy_file(ACENTRIC_SAMPLE_SCENE, folder_.path() / "gallery.glb");
    made_ = acentric({"new", (folder_.path() / "gallery.glb").string(), "-o", file(), "--samples-per-degree",
                      "1", "--cell", "2.5", "--outline", outline, "--no-estimate"});
    Json project = read();
    project["bake"]["ambientRays"] = 4;
    project["bake"]["surfaceTexel"] = 0.5;
    project["bake"]["pruningLoss"] = 0.005;
    write(project);
  }
  /// A copy, with all that is baked.
  SampleProject(const std::string& name, const SampleProject& of) : folder_(name), made_(of.made_) {
    std::filesystem::copy(of.folder(), folder_.path(), std::filesystem::copy_options::recursive);
  }
  std::string file() const { return (folder_.path() / "gallery.acentric.json").string(); }
  std::filesystem::path captures() const { return folder_.path() / "gallery.captures"; }
  const std::filesystem::path& folder() const { return folder_.path(); }
  const ProcessResult& made() const { return made_; }
  Json read() const { return Json::parse(std::ifstream(file()), nullptr, false); }
  void write(const Json& project) const { std::ofstream(file()) << project.dump(2); }

 private:
  TemporaryFolder folder_;
  ProcessResult made_;
};

}  // namespace acentric::test
