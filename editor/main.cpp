/// The editor's command line.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "editor/app.h"
#include "engine/base/interrupt.h"
#include "engine/base/physical_memory.h"

int main(int argc, char** argv) {
  acentric::giveBackLargeMemory();
  CLI::App command("Lay, bake and walk acentric panorama views in a window.", "acentric-editor");
  acentric::editor::AppOptions options;
  std::string size;
  command
      .add_option(
          "file", options.file,
          "a project (*.acentric.json), a walk (*.acentric, or the folder of a bundle), or a model for a "
          "new project")
      ->type_name("FILE");
  command
      .add_option("--sample", options.sample,
                  "a project to open where no file is named, as the preferences say")
      ->type_name("FILE");
  command.add_option("--size", size,
                     "of the window, as WIDTHxHEIGHT (default: as it was left, within the screen)");
  command.add_option("--importer", options.importHost.importer,
                     "program that parses models (default: beside this one)");
  command.add_flag("--outside-files", options.importHost.outsideFiles,
                   "let models name files outside their own folder");
  command.add_option("--log-ui", options.uiLog, "write where widgets are and what happens, for tests")
      ->type_name("FILE");
  command.add_option("--frame-times", options.frameTimes, "write how long each frame took, as CSV")
      ->type_name("FILE");
  command.add_option("--exit-after", options.exitAfterSeconds, "leave by itself after so many seconds")
      ->check(CLI::NonNegativeNumber);
  command.footer(
      "Examples:\n  acentric-editor\n  acentric-editor gallery.acentric.json\n  acentric-editor "
      "gallery.acentric\n  "
      "acentric-editor kitchen.glb");
  CLI11_PARSE(command, argc, argv);
  if (glm::ivec2 wanted(0); !size.empty())
    options.size = std::sscanf(size.c_str(), "%dx%d", &wanted.x, &wanted.y) == 2 ? wanted : glm::ivec2(0);
  if (options.size && (options.size->x < 640 || options.size->y < 400 || options.size->x > 16384 ||
                       options.size->y > 16384)) {
    std::fprintf(stderr, "acentric-editor: --size: give WIDTHxHEIGHT of at least 640x400, not \"%s\"\n",
                 size.c_str());
    return 2;
  }
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
