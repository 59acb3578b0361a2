/// acentric-bench-gl: times the OpenGL renderers on a packed walk, without a window.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/cli/bench_gl/gl_timing.h"

namespace {

using namespace acentric;
using namespace acentric::cli;

constexpr int kFailed = 1;

int failed(const Error& error) {
  fmt::print(stderr, "acentric-bench-gl: {}\n", error.describe());
  return kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Times Acentric's OpenGL renderer along the path of a packed walk, without a window"};
  app.set_version_flag("--version", ACENTRIC_VERSION);
  GlTimingOptions options;
  std::filesystem::path walk, jsonFile;
  app.add_option("--walk", walk, "Folder that `acentric bench pack` wrote")->required();
  app.add_option("--width", options.pixels.x, "Of the pictures")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  app.add_option("--height", options.pixels.y, "Of the pictures")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  app.add_option("--frames", options.frames, "Only so many of the path, evenly chosen (0 = all)")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  app.add_option("--repeats", options.repeats, "Times each frame is drawn, after once to warm up")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--json", jsonFile, "File to write the figures to as JSON");
  CLI11_PARSE(app, argc, argv);

  TaskRunner runner(0);
  const auto packed = readPackedWalk(walk, runner);
  if (!packed) return failed(packed.error());
  const auto timing = timeGl(*packed, options);
  if (!timing) return failed(timing.error());
  fmt::print("{}", timing->text);
  if (jsonFile.empty()) return 0;
  const Status written = writeTextAtomically(jsonFile, jsonText(timing->json, 2) + "\n");
  return written ? 0 : failed(written.error());
}
