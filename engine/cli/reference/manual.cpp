#include "engine/cli/reference/manual.h"

#include <fmt/format.h>

#include <cctype>
#include <sstream>

namespace acentric::cli {
namespace {

/// Characters that roff would take for its own, or draw as typographic ones.
std::string roff(const std::string& text) {
  std::string result;
  bool bold = false;  // `between such quotes`
  for (const char c : text) switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;
      case '\'':
        result += "\\(aq";
        break;
      case '~':
        result += "\\(ti";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '`':
        bold = !bold;
        result += bold ? "\\fB" : "\\fR";
        break;
      default:
        result += c;
    }
  return result;
}

/// A line of text; at its start a dot would be a macro.
std::string line(const std::string& text) {
  const std::string escaped = roff(text);
  return (escaped.starts_with(".") ? "\\&" : "") + escaped + "\n";
}

std::string sentence(std::string text) {
  if (!text.empty() && text.back() != '.') text += '.';
  return text;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string pageName(const std::string& command) {
  std::string name = command;
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string value(const ReferenceOption& option) {
  return italic(option.value) + (option.several ? " ..." : "");
}

/// "acentric export [OPTION]... project output".
std::string synopsis(const ReferenceCommand& command) {
  std::string text = bold(command.name);
  if (!command.options.empty()) text += " [" + italic("OPTION") + "]...";
  if (!command.commands.empty()) text += " " + italic("COMMAND") + " ...";
  for (const ReferenceOption& option : command.options)
    if (option.required) text += fmt::format(" {} {}", bold(option.names.back()), value(option));
  for (const ReferenceOption& positional : command.positionals) {
    const std::string name =
        italic(positional.names.front()) + (positional.several ? " [" + italic("...") + "]" : "");
    text += positional.required ? " " + name : " [" + name + "]";
  }
  return text + "\n";
}

std::string list(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

std::string entry(const ReferenceOption& option) {
  std::string text = ".TP\n";
  if (option.names.front().starts_with("-")) {
    for (std::size_t i = 0; i < option.names.size(); ++i) text += (i > 0 ? ", " : "") + bold(option.names[i]);
    if (!option.value.empty()) text += " " + value(option);
  } else {
    text += italic(option.names.front()) + (option.several ? " ..." : "");
  }
  text += "\n" + line(sentence(option.description));
  std::vector<std::string> facts;
  if (!option.choices.empty()) facts.push_back(fmt::format("One of: {}.", list(option.choices)));
  if (!option.limits.empty()) facts.push_back(fmt::format("Range: {}.", option.limits));
  if (!option.defaultValue.empty()) facts.push_back(fmt::format("Default: {}.", option.defaultValue));
  if (!option.needs.empty()) facts.push_back(fmt::format("Needs {}.", list(option.needs)));
  if (!option.excludes.empty()) facts.push_back(fmt::format("Not with {}.", list(option.excludes)));
  for (const std::string& fact : facts) text += line(fact);
  return text;
}

/// Of a command `below` that of the page, they follow without a heading.
std::string entries(const ReferenceCommand& command, bool below) {
  std::string text;
  if (!command.positionals.empty() && !below) text += ".SH ARGUMENTS\n";
  for (const ReferenceOption& positional : command.positionals) text += entry(positional);
  if (!command.options.empty() && !below) text += ".SH OPTIONS\n";
  for (const ReferenceOption& option : command.options)
    if (!below || option.names.back() != "--help") text += entry(option);
  return text;
}

std::string examples(const ReferenceCommand& command) {
  std::string text;
  for (const std::string& example : command.examples) text += line(example);
  return text.empty() ? text : ".EX\n" + text + ".EE\n";
}

std::string heading(const ReferenceCommand& command) {
  std::string name = pageName(command.name), title = name;
  for (char& c : title) c = char(std::toupper(static_cast<unsigned char>(c)));
  std::istringstream lines(command.description);
  std::string summary, rest;
  std::getline(lines, summary);
  if (summary.ends_with(".")) summary.pop_back();
  std::string text = fmt::format(".TH {} 1 \"\" \"Acentric {}\" \"Manual of Acentric\"\n.nh\n.ad l\n",
                                 roff(title), ACENTRIC_VERSION);
  text += fmt::format(".SH NAME\n{} \\- {}", roff(name), line(summary));
  text += ".SH SYNOPSIS\n" + synopsis(command);
  text += ".SH DESCRIPTION\n" + line(sentence(summary));
  while (std::getline(lines, rest)) text += ".PP\n" + line(sentence(rest));
  if (!command.note.empty()) text += ".PP\n" + line(command.note);
  return text;
}

std::string reference(const std::string& page) { return bold(page) + "(1)"; }

/// The page of one of a program's commands, with the commands below it.
std::string commandPage(const ReferenceCommand& command, const ReferenceCommand& program) {
  std::string text = heading(command) + entries(command, false);
  for (const ReferenceCommand& below : command.commands) {
    text += (&below == &command.commands.front() ? ".SH COMMANDS\n" : "") +
            fmt::format(".SS {}\n", roff(below.name)) + line(sentence(below.description)) + ".PP\n" +
            synopsis(below) + entries(below, true);
    if (!below.examples.empty()) text += ".PP\n" + examples(below);
  }
  std::vector<std::string> shared;
  for (const ReferenceOption* option : sharedOptions(program)) shared.push_back(bold(option->names.back()));
  text += fmt::format(".SH OPTIONS OF ALL COMMANDS\n{} are described in {}.\n", list(shared),
                      reference(pageName(program.name)));
  if (!command.examples.empty()) text += ".SH EXAMPLES\n" + examples(command);
  return text + ".SH SEE ALSO\n" + reference(pageName(program.name)) + "\n";
}

std::string programPage(const ReferenceCommand& program, const std::string& exitStatus) {
  std::string text = heading(program);
  std::vector<std::string> pages;
  if (!program.commands.empty()) text += ".SH COMMANDS\n";
  for (const ReferenceCommand& command : program.commands) {
    pages.push_back(reference(pageName(command.name)));
    text += fmt::format(".TP\n{}\n{}", pages.back(), line(sentence(command.description)));
  }
  text += entries(program, false);
  if (!program.examples.empty()) text += ".SH EXAMPLES\n" + examples(program);
  if (!exitStatus.empty()) text += ".SH EXIT STATUS\n" + line(exitStatus);
  pages.push_back(reference(program.name == "acentric" ? "acentric-editor" : "acentric"));
  return text + ".SH SEE ALSO\n" + list(pages) + "\n";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> manualPages(const ReferenceCommand& program,
                                                             const std::string& exitStatus) {
  std::vector<std::pair<std::string, std::string>> pages;
  pages.emplace_back(pageName(program.name), programPage(program, exitStatus));
  for (const ReferenceCommand& command : program.commands)
    pages.emplace_back(pageName(command.name), commandPage(command, program));
  return pages;
}

}  // namespace acentric::cli
