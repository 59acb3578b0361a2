#pragma once
/// A cell of a table of values separated by commas.

#include <string>

namespace acentric {

/// In quotation marks where it must be.
inline std::string csvCell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + "\"";
}

}  // namespace acentric
