/// acentric: every action of the editor has a twin here. Parses, runs one command, prints its report.

#include <fmt/format.h>

#include <cstdio>
#include <new>

#include "engine/base/interrupt.h"
#include "engine/base/json_text.h"
#include "engine/cli/command_line.h"
#include "engine/cli/terminal.h"
#include "engine/scene/import_cache.h"

namespace {

using namespace acentric;
using namespace acentric::cli;

/// As shells say of a program that SIGINT ended.
constexpr int kFailed = 1, kUsage = 2, kInterrupted = 130;
constexpr const char* kExitStatus =
    "0 if the command succeeded; 1 if it failed, if `validate` found damage, or if `fit` found nothing that "
    "keeps to the number; 2 if options are wrong; 130 after Ctrl+C.";

int finish(const Result<Report>& result, bool json) {
  finishProgress();
  if (!result) {
    const Error& error = result.error();
    if (json)
      fmt::print("{}\n", jsonText(Json{{"error",
                                        {{"kind", acentric::nameOf(error.kind)},
                                         {"message", error.message},
                                         {"where", error.where}}}},
                                  2));
    fmt::print(stderr, "acentric: {}\n", error.describe());
    return error.kind == ErrorKind::cancelled ? kInterrupted : kFailed;
  }
  if (json)
    fmt::print("{}\n", jsonText(result->json, 2));
  else
    fmt::print("{}", result->text);
  return result->success ? 0 : kFailed;
}

Result<Report> runWithinMemory(const Chosen& chosen, const Common& common) try {
  return chosen.run(common);
} catch (const std::bad_alloc&) {
  return fail(ErrorKind::outOfSpace,
              "there is not enough memory for this: close other programs, or make the scene smaller");
}

/// For the build: hidden, since it tells nothing that the help does not.
void addReferenceCommand(CLI::App& app, Chosen& chosen) {
  CLI::App* const command = app.add_subcommand("reference", "Write manual pages and shell completion");
  const auto share = std::make_shared<std::filesystem::path>();
  command->group("")->footer("");
  command->add_option("share", *share, "Folder that becomes share of an installation")->required();
  command->callback([&app, &chosen, share] {
    chosen.run = [&app, share](const Common&) -> Result<Report> {
      if (Status written = writeReference(app, kExitStatus, *share); !written)
        return tl::unexpected(written.error());
      return Report();
    };
  });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Walkthroughs made of acentric panorama views (APV)\nImport a scene, lay cameras over its floor, bake, "
      "walk",
      "acentric"};
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", ACENTRIC_VERSION);
  app.footer(
      "Examples:\n  acentric new room.glb -o room.acentric.json\n  acentric bake room.acentric.json\n"
      "  acentric render room.acentric.json -o view.png --stats\nEach command has its own --help.");
  Common common;
  bool json = false;
  app.add_flag("--json", json, "Print the report as JSON");
  app.add_option("--threads", common.threads, "Threads to use (default: all processors)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--import-seconds", common.host.timeLimitSeconds, "Time limit of an import")
      ->capture_default_str();
  app.add_option_function<double>(
         "--import-memory",
         [&common](double gigabytes) {
           common.host.memoryLimitBytes = std::size_t(gigabytes * double(std::size_t(1) << 30));
         },
         "Gigabytes that a scene may take (default: three quarters of the machine's)")
      ->check(CLI::Range(0.1, 1e5));
  app.add_option("--import-cache", common.host.cacheFolder,
                 "Folder where imported scenes are kept (default: of the user's cache); one that holds the "
                 "scene need not be writable");
  app.add_flag(
      "--outside-files", common.host.outsideFiles,
      "Let models name files outside their own folder; what they name may end up in what is exported");

  Chosen chosen;
  addProjectCommands(app, chosen);
  addInspectionCommands(app, chosen);
  addWalkCommands(app, chosen);
  addExportCommand(app, chosen);
  addServeCommand(app, chosen);
  addSweepCommands(app, chosen);
  addPackCommand(*app.get_subcommand("bench"), chosen);
  addRepresentationsCommand(*app.get_subcommand("bench"), chosen);
  addFirstViewCommand(*app.get_subcommand("bench"), chosen);
  addNumericsCommand(*app.get_subcommand("bench"), chosen);
  addFunctionsCommand(*app.get_subcommand("bench"), chosen);
  addReferenceCommand(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : kUsage;
  }
  common.storey = chosen.storey;
  common.preset = chosen.preset, common.presetFrom = chosen.presetFrom;
  common.walkMegabytes = chosen.walkMegabytes;
  common.stop = stopOnInterrupt();
  if (!json) common.progress = terminalProgress();
  common.notice = [json](const std::string& text, const Json& event) {
    if (!json) finishProgress();
    fmt::print(stderr, "{}\n", json ? jsonText(event, -1) : "acentric: " + text);
    (void)std::fflush(stderr);
  };
  if (const auto notice = importCacheNotice(common.host)) fmt::print(stderr, "acentric: {}\n", *notice);
  return finish(runWithinMemory(chosen, common), json);
}
