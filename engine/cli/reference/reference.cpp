#include "engine/cli/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "engine/base/file.h"
#include "engine/cli/reference/completion.h"
#include "engine/cli/reference/manual.h"

namespace acentric::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::string nameOf(const CLI::Option& option) {
  if (!option.get_lnames().empty()) return "--" + option.get_lnames().front();
  if (!option.get_snames().empty()) return "-" + option.get_snames().front();
  return option.get_name(true);
}

std::vector<std::string> namesOf(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(nameOf(*option));
  std::ranges::sort(names);  // options lie where memory was free
  return names;
}

/// "TEXT:{a,b}" and "INT:INT in [1 - 10]": what is taken, then what checks say of themselves.
void readType(const std::string& type, ReferenceOption& option) {
  const auto parts = split(type, ':');
  if (parts.empty()) return;
  option.value = parts.front();
  for (const std::string& check : std::span(parts).subspan(1)) {
    if (check.starts_with("{") && check.ends_with("}"))
      option.choices = split(check.substr(1, check.size() - 2), ',');
    else if (const auto open = check.find(" in ["); open != std::string::npos) {
      option.limits = check.substr(open + 5, check.size() - open - 6);
      if (const auto dash = option.limits.find(" - "); dash != std::string::npos)
        option.limits.replace(dash, 3, " to ");
    } else if (check == "POSITIVE")
      option.limits = "more than 0";
    else if (check == "NONNEGATIVE")
      option.limits = "0 or more";
  }
}

ReferenceOption describe(const CLI::Option& option) {
  ReferenceOption result;
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  if (option.get_positional()) result.names = {option.get_name(true)};
  result.description = option.get_description();
  result.required = option.get_required();
  result.several = option.get_items_expected_max() > 1;
  if (option.get_items_expected_max() > 0) {
    readType(option.get_type_name(), result);
    result.defaultValue = option.get_default_str();
    if (result.defaultValue.starts_with("["))  // several
      result.defaultValue = result.defaultValue.substr(1, result.defaultValue.size() - 2);
  }
  result.needs = namesOf(option.get_needs());
  result.excludes = namesOf(option.get_excludes());
  return result;
}

/// Command lines are indented below "Examples:".
void readFooter(const std::string& footer, ReferenceCommand& command) {
  for (const std::string& line : split(footer, '\n')) {
    if (line.empty() || line == "Examples:") continue;
    if (line.starts_with("  "))
      command.examples.push_back(line.substr(2));
    else
      command.note += (command.note.empty() ? "" : " ") + line;
  }
}

ReferenceCommand describe(CLI::App& app, const std::string& before) {
  ReferenceCommand command;
  command.name = before + app.get_name();
  command.description = app.get_description();
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty())
      (option->get_positional() ? command.positionals : command.options).push_back(describe(*option));
  const bool hasOwnFooter = app.get_parent() == nullptr || app.get_footer() != app.get_parent()->get_footer();
  if (hasOwnFooter) readFooter(app.get_footer(), command);
  for (CLI::App* sub : app.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); }))
    command.commands.push_back(describe(*sub, command.name + " "));
  return command;
}

Status write(const fs::path& file, const std::string& text) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) return fail(ErrorKind::unreadable, error.message(), file.parent_path().string());
  return writeTextAtomically(file, text);
}

}  // namespace

ReferenceCommand describe(CLI::App& app) { return describe(app, ""); }

std::vector<const ReferenceOption*> sharedOptions(const ReferenceCommand& program) {
  std::vector<const ReferenceOption*> options;
  for (const ReferenceOption& option : program.options)
    if (option.names.back() != "--help" && option.names.back() != "--version") options.push_back(&option);
  return options;
}

Files filesOf(const ReferenceOption& option) {
  if (option.value == "PROJECT|BUNDLE|WALK") return Files::projectOrWalk;
  if (option.value != "PATH" && option.value != "FILE") return Files::none;
  return option.names.front().starts_with("project") ? Files::project : Files::any;
}

Status writeReference(CLI::App& app, const std::string& exitStatus, const fs::path& share) {
  const ReferenceCommand program = describe(app);
  std::vector<std::pair<fs::path, std::string>> files;
  for (auto& [name, page] : manualPages(program, exitStatus))
    files.emplace_back(fs::path("man/man1") / (name + ".1"), std::move(page));
  files.emplace_back("bash-completion/completions/" + program.name, bashCompletion(program));
  files.emplace_back("fish/vendor_completions.d/" + program.name + ".fish", fishCompletion(program));
  files.emplace_back("zsh/vendor-completions/_" + program.name, zshCompletion(program));
  for (const auto& [name, text] : files)
    if (Status written = write(share / name, text); !written) return written;
  return {};
}

}  // namespace acentric::cli
