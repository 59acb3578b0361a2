#include <fmt/format.h>

#include "engine/cli/reference/completion.h"

namespace acentric::cli {
namespace {

std::string quoted(const std::string& text) { return inQuotes(text, "\\'"); }

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

/// What `complete` is told of a value, whether an option takes it or stands for itself.
std::string completion(const ReferenceOption& option) {
  std::string text;
  for (const std::string& name : option.names)
    if (name.starts_with("-"))
      text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.choices.empty())
    text += " -x -a " + quoted(joined(option.choices));
  else if (filesOf(option) == Files::project)
    text += " -k -x -a '(__fish_complete_suffix .acentric.json)'";
  else if (filesOf(option) != Files::none)
    text += " -r -F";
  else if (!option.value.empty())
    text += " -x";
  return text + " -d " + quoted(option.description) + "\n";
}

/// Commands that have some below them, whose names may be those of others: "bake" and "bench bake".
std::vector<std::string> groupsOf(const ReferenceCommand& program) {
  std::vector<std::string> names;
  for (const ReferenceCommand& command : program.commands)
    if (!command.commands.empty()) names.push_back(command.lastName());
  return names;
}

/// True when the words so far are those of the command; empty for the program.
std::string condition(const ReferenceCommand& command, const ReferenceCommand& program) {
  const auto first = command.name.find(' ');
  if (first == std::string::npos) return "";
  std::vector<std::string> conditions;
  std::size_t begin = first + 1;
  for (auto space = begin; space != std::string::npos; begin = space + 1) {
    space = command.name.find(' ', begin);
    conditions.push_back("__fish_seen_subcommand_from " + command.name.substr(begin, space - begin));
    if (space == std::string::npos) break;
  }
  if (conditions.size() == 1 && command.commands.empty() && !groupsOf(program).empty())
    conditions.push_back("not __fish_seen_subcommand_from " + joined(groupsOf(program)));
  return fmt::format("{}", fmt::join(conditions, "; and "));
}

}  // namespace

std::string fishCompletion(const ReferenceCommand& program) {
  std::string text = fmt::format("# Completion of {0} for fish.\ncomplete -c {0} -f\n", program.name);
  forEachCommand(program, [&](const ReferenceCommand& command) {
    const std::string inside = condition(command, program);
    std::string undecided = inside;  // none of the commands below has been named
    if (!command.commands.empty())
      undecided += (inside.empty() ? "" : "; and ") +
                   ("not __fish_seen_subcommand_from " + joined(lastNamesBelow(command)));
    const auto add = [&](const std::string& when, const std::string& what) {
      text +=
          fmt::format("complete -c {}{}{}", program.name, when.empty() ? "" : " -n " + quoted(when), what);
    };
    for (const ReferenceCommand& below : command.commands)
      add(undecided, fmt::format(" -a {} -d {}\n", below.lastName(), quoted(below.description)));
    for (const ReferenceOption& option : command.options) add(inside, completion(option));
    for (const ReferenceOption& positional : command.positionals)
      if (filesOf(positional) != Files::none || !positional.choices.empty())
        add(undecided, completion(positional));
  });
  return text;
}

}  // namespace acentric::cli
