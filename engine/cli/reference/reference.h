#pragma once
/// A command line as data, read from the CLI11 App that parses it: what manual pages and shell completion are
/// made of, so that neither can differ from the program. Hidden commands and options (those of no group) are
/// left out.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

/// Paths are called so in help, manual pages and completion, which offers files for them.
template <>
constexpr const char* CLI::detail::type_name<std::filesystem::path>() {
  return "PATH";
}

namespace acentric::cli {

struct ReferenceOption {
  std::vector<std::string> names;    ///< "-o", "--output"; a positional has its name alone
  std::string value;                 ///< what it takes, such as "PATH"; empty: nothing
  std::vector<std::string> choices;  ///< the only values; none: others too
  std::string limits;                ///< "1 to 1024"; empty: none
  std::string defaultValue;          ///< empty: none, or the description says it
  std::string description;
  std::vector<std::string> needs, excludes;  ///< names of other options
  bool required = false, several = false;
};

struct ReferenceCommand {
  std::string name;         ///< in full: "acentric bench view"
  std::string description;  ///< its first line is the summary
  std::vector<ReferenceOption> positionals, options;
  std::vector<std::string> examples;  ///< command lines
  std::string note;                   ///< what else the help ends on
  std::vector<ReferenceCommand> commands;

  std::string lastName() const { return name.substr(name.rfind(' ') + 1); }
};

ReferenceCommand describe(CLI::App& app);

/// Options of the program that may be given after any command.
std::vector<const ReferenceOption*> sharedOptions(const ReferenceCommand& program);

/// The kind of file that a value names.
enum class Files { none, any, project, projectOrWalk };
Files filesOf(const ReferenceOption& option);

/// Writes into a folder such as /usr/share where man, bash, fish and zsh look: man/man1/NAME.1,
/// bash-completion/completions/NAME, fish/vendor_completions.d/NAME.fish, zsh/vendor-completions/_NAME. Each
/// command of `app` has a page, with the commands below it. `exitStatus`: what the program's page says of it.
/// Stops at the first file that cannot be written.
Status writeReference(CLI::App& app, const std::string& exitStatus, const std::filesystem::path& share);

}  // namespace acentric::cli
