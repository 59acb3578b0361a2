#pragma once
/// The command line's options by command. Each command's options live as long as the App.

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "engine/cli/commands.h"
#include "engine/cli/reference/reference.h"  // how paths are called

namespace acentric::cli {

/// What parsing leaves to be run.
struct Chosen {
  std::function<Result<Report>(const Common&)> run;
  std::string storey, preset;
  std::filesystem::path presetFrom;
  std::optional<double> walkMegabytes;
};

/// Adds a subcommand that does `run`; returns it with the options that it will be run with.
template <class Options>
std::pair<CLI::App*, Options&> add(CLI::App& app, Chosen& chosen, const char* name, const char* description,
                                   const char* examples,
                                   Result<Report> (*run)(const Options&, const Common&)) {
  CLI::App* command = app.add_subcommand(name, description);
  command->footer(std::string("Examples:\n") + examples);
  const auto options = std::make_shared<Options>();
  command->callback([&chosen, options, run] {
    chosen.run = [options, run](const Common& common) { return run(*options, common); };
  });
  return {command, *options};
}

/// With its default, from `low` to `high`.
template <class T, class Bound>
CLI::Option* addNumber(CLI::App& command, const char* name, T& value, const std::string& description,
                       Bound low, Bound high) {
  return command.add_option(name, value, description)->check(CLI::Range(low, high))->capture_default_str();
}
/// With its default, one of these.
template <class T>
CLI::Option* addChoice(CLI::App& command, const char* name, T& value, const std::string& description,
                       const std::vector<T>& choices) {
  return command.add_option(name, value, description)->check(CLI::IsMember(choices))->capture_default_str();
}
void addSize(CLI::App& command, std::string& size);
void addTruthSamples(CLI::App& command, int& samples);

/// A project file, and its storey.
void addProject(CLI::App& command, Chosen& chosen, std::filesystem::path& project, const char* otherwise);
/// `otherwise`: what is meant where no storey is given.
void addStoreyOption(CLI::App& command, Chosen& chosen, const char* otherwise);
/// The project is taken as a sweep found worth having; its file is not changed.
void addPresetOption(CLI::App& command, Chosen& chosen);

/// Projects: made, changed, baked, checked.
void addProjectCommands(CLI::App& app, Chosen& chosen);
/// What a layout will give, before it is baked.
void addInspectionCommands(CLI::App& app, Chosen& chosen);
/// Pictures of what is baked, and how good and fast they are.
void addWalkCommands(CLI::App& app, Chosen& chosen);
/// Bundles for other programs.
void addExportCommand(CLI::App& app, Chosen& chosen);
/// Of published walks.
void addServeCommand(CLI::App& app, Chosen& chosen);
/// What accuracy costs, and settings chosen by it.
void addSweepCommands(CLI::App& app, Chosen& chosen);
/// Of those of `acentric bench`.
void addPackCommand(CLI::App& bench, Chosen& chosen);
void addRepresentationsCommand(CLI::App& bench, Chosen& chosen);
void addFirstViewCommand(CLI::App& bench, Chosen& chosen);
void addNumericsCommand(CLI::App& bench, Chosen& chosen);
void addFunctionsCommand(CLI::App& bench, Chosen& chosen);

}  // namespace acentric::cli
