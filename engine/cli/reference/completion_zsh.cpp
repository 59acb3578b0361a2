#include <fmt/format.h>

#include "engine/cli/reference/completion.h"

namespace acentric::cli {
namespace {

std::string quoted(const std::string& text) { return inQuotes(text, "'\\''"); }

/// Brackets and colons part what _arguments is given.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

/// What offers a value.
std::string action(const ReferenceOption& option) {
  if (!option.choices.empty()) return fmt::format("({})", fmt::join(option.choices, " "));
  switch (filesOf(option)) {
    case Files::project:
      return "_files -g \"*.acentric.json(-.)\"";
    case Files::projectOrWalk:
    case Files::any:
      return "_files";
    case Files::none:
      break;
  }
  return " ";
}

std::string specifications(const ReferenceOption& option) {
  std::string text;
  const std::string once =
      option.several ? "*" : fmt::format("({})", fmt::join(option.names, " "));  // not again, by any name
  const std::string taken = option.value.empty() ? "" : ":" + escaped(option.value) + ":" + action(option);
  for (const std::string& name : option.names)
    text += " \\\n    " + quoted(once + name + "[" + escaped(option.description) + "]" + taken);
  return text;
}

std::string function(const ReferenceCommand& command, const ReferenceCommand& program) {
  const std::string name = functionNameOf(command);
  std::string text = "\n" + name + "() {\n";
  if (!command.commands.empty()) text += "  local context state line\n  typeset -A opt_args\n";
  text += command.commands.empty() ? "  _arguments -s" : "  _arguments -C -s";
  for (const ReferenceOption& option : command.options) text += specifications(option);
  if (&command != &program)
    for (const ReferenceOption* option : sharedOptions(program)) text += specifications(*option);
  for (const ReferenceOption& positional : command.positionals)
    text += " \\\n    " + quoted(fmt::format("{}:{}:{}", positional.several ? "*" : "",
                                             positional.names.front(), action(positional)));
  if (command.commands.empty()) return text + "\n}\n";
  text +=
      " \\\n    '1:command:->command' '*::argument:->argument'\n"
      "  case $state in\n    command)\n      local -a commands=(";
  for (const ReferenceCommand& below : command.commands)
    text += "\n        " + quoted(below.lastName() + ":" + escaped(below.description));
  return text + fmt::format(
                    "\n      )\n      _describe command commands ;;\n"
                    "    argument) _call_function - {}_${{line[1]//-/_}} ;;\n  esac\n}}\n",
                    name);
}

}  // namespace

std::string zshCompletion(const ReferenceCommand& program) {
  std::string text = fmt::format("#compdef {0}\n# Completion of {0} for zsh.\n", program.name);
  forEachCommand(program, [&](const ReferenceCommand& command) { text += function(command, program); });
  return text + fmt::format("\n{} \"$@\"\n", functionNameOf(program));
}

}  // namespace acentric::cli
