#include "engine/cli/reference/completion.h"

#include <algorithm>

namespace acentric::cli {

void forEachCommand(const ReferenceCommand& command,
                    const std::function<void(const ReferenceCommand&)>& act) {
  for (const ReferenceCommand& below : command.commands) forEachCommand(below, act);
  act(command);
}

std::vector<std::string> lastNamesBelow(const ReferenceCommand& command) {
  std::vector<std::string> names;
  for (const ReferenceCommand& below : command.commands) names.push_back(below.lastName());
  return names;
}

std::string functionNameOf(const ReferenceCommand& command) {
  std::string name = "_" + command.name;
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == '-'; }, '_');
  return name;
}

std::string inQuotes(const std::string& text, const char* quote) {
  std::string result = "'";
  for (const char c : text)
    if (c == '\'')
      result += quote;
    else
      result += c == '\n' ? ' ' : c;
  return result + "'";
}

}  // namespace acentric::cli
