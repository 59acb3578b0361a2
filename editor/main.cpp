/// The editor's command line.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "editor/app.h"
#include "editor/session/installed_sample.h"
#include "engine/base/interrupt.h"
#include "engine/base/physical_memory.h"
#include "engine/base/program_file.h"
#include "engine/cli/reference/reference.h"

namespace {

/// The user's copy of the sample that is installed with this program; empty where there is none.
std::filesystem::path ownSample() {
  const auto installed = acentric::editor::installedSample(acentric::ownProgram());
  const auto folder = acentric::editor::userDataFolder();
  if (installed.empty() || folder.empty()) return {};
  const auto copy = acentric::editor::copyOfSample(installed, folder);
  if (!copy) std::fprintf(stderr, "acentric-editor: %s\n", copy.error().describe().c_str());
  return copy.value_or("");
}

}  // namespace

int main(int argc, char** argv) {
  acentric::giveBackLargeMemory();
  CLI::App command("Lay, bake and walk acentric panorama views in a window.", "acentric-editor");
  acentric::editor::AppOptions options;
  std::string size;
  command
      .add_option(
          "file", options.file,
          "A project (*.acentric.json), a walk (*.acentric, or the folder of a bundle), or a model for a "
          "new project")
      ->type_name("FILE");
  command
      .add_option(
          "--sample", options.sample,
          "A project to open where no file is named, as the preferences say (default: a copy of the sample "
          "that is installed)")
      ->type_name("FILE");
  command.add_option("--size", size,
                     "Of the window, as WIDTHxHEIGHT (default: as it was left, within the screen)");
  command.add_option("--importer", options.importHost.importer,
                     "Program that parses models (default: the one that came with this one)");
  command.add_flag("--outside-files", options.importHost.outsideFiles,
                   "Let models name files outside their own folder");
  command.add_option("--log-ui", options.uiLog, "Write where widgets are and what happens, for tests")
      ->type_name("FILE");
  command.add_option("--frame-times", options.frameTimes, "Write how long each frame took, as CSV")
      ->type_name("FILE");
  command.add_option("--exit-after", options.exitAfterSeconds, "Leave by itself after so many seconds")
      ->check(CLI::NonNegativeNumber);
  command.footer(
      "Examples:\n  acentric-editor\n  acentric-editor gallery.acentric.json\n  acentric-editor "
      "gallery.acentric\n  "
      "acentric-editor kitchen.glb");
  std::filesystem::path reference;
  command.add_option("--reference", reference, "For the build: write the manual page and shell completion")
      ->group("");  // hidden
  CLI11_PARSE(command, argc, argv);
  if (!reference.empty()) {
    const auto written = acentric::cli::writeReference(
        command, "0; 1 if no window could be opened; more if options are wrong.", reference);
    if (!written) std::fprintf(stderr, "acentric-editor: %s\n", written.error().describe().c_str());
    return written ? 0 : 1;
  }
  if (glm::ivec2 wanted(0); !size.empty())
    options.size = std::sscanf(size.c_str(), "%dx%d", &wanted.x, &wanted.y) == 2 ? wanted : glm::ivec2(0);
  if (options.size && (options.size->x < 640 || options.size->y < 400 || options.size->x > 16384 ||
                       options.size->y > 16384)) {
    std::fprintf(stderr, "acentric-editor: --size: give WIDTHxHEIGHT of at least 640x400, not \"%s\"\n",
                 size.c_str());
    return 2;
  }
  if (options.file.empty() && options.sample.empty()) options.sample = ownSample();
  options.stop = acentric::stopOnInterrupt();
  const auto app = acentric::editor::App::create(options);
  if (!app) {
    std::fprintf(
        stderr,
        "acentric-editor: %s. The command line program \"acentric\" does all of this without a window.\n",
        app.error().c_str());
    return 1;
  }
  (*app)->run();
  return 0;
}
