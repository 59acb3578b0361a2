#include "editor/session/engine_texts.h"

#include <fmt/args.h>

#include <optional>
#include <string_view>
#include <vector>

namespace acentric::editor {
namespace {

/// What stands for each "{}" of the pattern: as little as possible, but something, and a list (", ") only at
/// the end. Nothing: it is another text.
std::optional<std::vector<std::string>> valuesIn(std::string_view text, std::string_view pattern) {
  std::vector<std::string> values;
  while (true) {
    const std::size_t field = pattern.find("{}");
    const std::string_view before = pattern.substr(0, field);
    if (!text.starts_with(before)) return std::nullopt;
    text.remove_prefix(before.size());
    if (field == std::string_view::npos) return text.empty() ? std::optional(values) : std::nullopt;
    pattern.remove_prefix(field + 2);
    const std::string_view after = pattern.substr(0, pattern.find("{}"));
    const std::size_t end = after.empty() ? text.size() : text.find(after, 1);
    if (end == std::string_view::npos || text.empty()) return std::nullopt;
    values.emplace_back(text.substr(0, end));
    if (!after.empty() && values.back().find(", ") != std::string::npos) return std::nullopt;
    text.remove_prefix(end);
  }
}

std::optional<std::string> byPattern(const std::string& english) {
  for (const char* pattern : kEnginePatterns) {
    const auto values = valuesIn(english, pattern);
    if (!values) continue;
    fmt::dynamic_format_arg_store<fmt::format_context> store;
    for (const std::string& value : *values) store.push_back(value);
    return translated(pattern, store);
  }
  return std::nullopt;
}

}  // namespace

std::string engineText(const std::string& english) {
  if (language() == "en") return english;
  if (std::string known = tr(english); known != english) return known;
  if (auto known = byPattern(english)) return *std::move(known);
  const std::size_t comma = english.find(", ");
  if (comma == std::string::npos) return english;
  const auto first = byPattern(english.substr(0, comma));
  return first ? *first + ", " + engineText(english.substr(comma + 2)) : english;
}

}  // namespace acentric::editor
