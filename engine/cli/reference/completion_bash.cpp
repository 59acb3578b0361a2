#include <fmt/format.h>

#include "engine/cli/reference/completion.h"

namespace acentric::cli {
namespace {

/// Where words have led to: command "bench view" of the program; it has no name itself.
std::string wordsOf(const ReferenceCommand& command) {
  const auto space = command.name.find(' ');
  return space == std::string::npos ? "" : command.name.substr(space + 1);
}

/// What sets the words, or the pattern of files, that are offered for a value.
std::string offer(const ReferenceOption& option) {
  if (!option.choices.empty()) return fmt::format("words=\"{}\" ", fmt::join(option.choices, " "));
  switch (filesOf(option)) {
    case Files::any:
      return "files='*' ";
    case Files::project:
      return "files='*.acentric.json' ";
    case Files::projectOrWalk:
      return "files='*.acentric*' ";
    case Files::none:
      break;
  }
  return "";
}

/// The cases of the script below.
struct Cases {
  std::string commands, skipped, values, options, positionals;

  void add(const ReferenceCommand& command, const ReferenceCommand& program) {
    const std::string at = wordsOf(command);
    // Those of the program may be given after any command.
    const std::string before = &command == &program ? "*" : fmt::format("\"{}\"", at);
    for (const ReferenceCommand& below : command.commands)
      commands += fmt::format("      \"{}:{}\") command=\"{}\" ;;\n", at, below.lastName(), wordsOf(below));
    std::vector<std::string> names, taking;
    for (const ReferenceOption& option : command.options) {
      names.insert(names.end(), option.names.begin(), option.names.end());
      if (option.value.empty()) continue;
      std::vector<std::string> patterns;
      for (const std::string& name : option.names) patterns.push_back(before + ":" + name);
      taking.insert(taking.end(), patterns.begin(), patterns.end());
      values += fmt::format("    {}) taken=yes {};;\n", fmt::join(patterns, " | "), offer(option));
    }
    if (!taking.empty())
      skipped +=
          fmt::format("      {})\n        ((++i))\n        [[ ${{COMP_WORDS[i]}} != \"=\" ]] || ((++i)) ;;\n",
                      fmt::join(taking, " | "));
    if (&command != &program)
      for (const ReferenceOption* option : sharedOptions(program))
        names.insert(names.end(), option->names.begin(), option->names.end());
    options += fmt::format("      \"{}\") options=\"{}\" words=\"{}\" ;;\n", at, fmt::join(names, " "),
                           fmt::join(lastNamesBelow(command), " "));
    for (std::size_t i = 0; i < command.positionals.size(); ++i)
      if (const std::string offered = offer(command.positionals[i]); !offered.empty())
        positionals += fmt::format("      \"{}:\"{}) {};;\n", at,
                                   command.positionals[i].several ? "*" : std::to_string(i), offered);
  }
};

}  // namespace

std::string bashCompletion(const ReferenceCommand& program) {
  Cases cases;
  forEachCommand(program, [&](const ReferenceCommand& command) { cases.add(command, program); });
  return fmt::format(R"bash(# Completion of {name} for bash.

{function}() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  local command="" place=0 taken="" words="" options="" files="" i
  # --option=value comes as three words.
  if [[ $current == "=" ]]; then
    current=""
  elif [[ $previous == "=" ]]; then
    previous=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$command:${{COMP_WORDS[i]}}" in
{commands}{skipped}      *:-*) ;;
      *) ((++place)) ;;
    esac
  done
  case "$command:$previous" in
{values}  esac
  if [[ -z $taken ]]; then
    case "$command" in
{options}    esac
    case "$command:$place" in
{positionals}    esac
    [[ $current != -* ]] || words=$options files=""
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  [[ -n $files ]] || return 0
  compopt -o filenames 2> /dev/null
  local IFS=$'\n'
  local folders=($(compgen -d -- "$current")) found=($(compgen -f -X "!$files" -- "$current"))
  ((${{#found[@]}} > 0)) || found=($(compgen -f -- "$current"))
  COMPREPLY+=($(printf '%s\n' "${{folders[@]}}" "${{found[@]}}" | sort -u))
}}
complete -F {function} {name}
)bash",
                     fmt::arg("name", program.name), fmt::arg("function", functionNameOf(program)),
                     fmt::arg("commands", cases.commands), fmt::arg("skipped", cases.skipped),
                     fmt::arg("values", cases.values), fmt::arg("options", cases.options),
                     fmt::arg("positionals", cases.positionals));
}

}  // namespace acentric::cli
