#include "editor/session/engine_texts.h"

#include <fmt/args.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <regex>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "editor/session/engine_error_parts.h"
#include "editor/session/engine_errors.h"
#include "editor/session/engine_import.h"
#include "editor/session/engine_names.h"
#include "editor/session/engine_walk_errors.h"
#include "ui/text_format.h"

namespace acentric::editor {
namespace {

constexpr std::size_t kLongestText = 4000;  // bytes; beyond it nothing is looked up
constexpr std::size_t kMostKept = 4000;     // texts
constexpr int kMostParts = 8;               // an error within an error, and places before it
constexpr int kDeepest = 4;

/// What may stand for a pattern's "{}": in lists a number at the beginning, and no ", " but in the last; in
/// errors anything, of which errors and their parts are translated.
enum class Values { list, error };

struct Pattern {
  const char* english;
  Values values;
  std::size_t literal;  ///< bytes of its text without the "{}"
};

std::size_t literalOf(std::string_view pattern) {
  std::size_t bytes = pattern.size();
  for (std::size_t at = pattern.find("{}"); at != pattern.npos; at = pattern.find("{}", at + 2)) bytes -= 2;
  return bytes;
}

/// Those with most text first: they say most about what they match.
const std::vector<Pattern>& patterns() {
  static const std::vector<Pattern> sorted = [] {
    std::vector<Pattern> all;
    const auto add = [&](const auto& table, Values values) {
      for (const char* english : table) all.push_back({english, values, literalOf(english)});
    };
    add(kEnginePatterns, Values::list), add(kImportPatterns, Values::list);
    add(kErrors, Values::error), add(kWalkErrors, Values::error);
    std::ranges::stable_sort(all, std::ranges::greater{}, &Pattern::literal);
    return all;
  }();
  return sorted;
}

template <class... Tables>
std::unordered_set<std::string_view> setOf(const Tables&... tables) {
  std::unordered_set<std::string_view> all;
  (all.insert(tables.begin(), tables.end()), ...);
  return all;
}

/// What stands for each "{}" of the pattern: as little as possible, but something. Nothing: it is another
/// text.
std::optional<std::vector<std::string>> valuesIn(std::string_view text, const Pattern& known) {
  std::vector<std::string> values;
  std::string_view pattern = known.english;
  while (true) {
    const std::size_t field = pattern.find("{}");
    const std::string_view before = pattern.substr(0, field);
    if (!text.starts_with(before)) return std::nullopt;
    text.remove_prefix(before.size());
    if (field == std::string_view::npos) return text.empty() ? std::optional(values) : std::nullopt;
    pattern.remove_prefix(field + 2);
    const std::size_t next = pattern.find("{}");
    const std::string_view after = pattern.substr(0, next);
    std::size_t end = text.size();
    if (next != std::string_view::npos)
      end = text.find(after, 1);
    else if (text.ends_with(after))
      end -= after.size();
    else
      return std::nullopt;
    if (end == std::string_view::npos || end == 0) return std::nullopt;
    values.emplace_back(text.substr(0, end));
    const bool last = next == std::string_view::npos && after.empty();
    if (known.values == Values::list) {
      if (!last && values.back().find(", ") != std::string::npos) return std::nullopt;
      const bool first = values.size() == 1 && before.empty();
      if (first && !(values.back().front() >= '0' && values.back().front() <= '9')) return std::nullopt;
    }
    text.remove_prefix(end);
  }
}

/// A count as the language writes it; other values as they are.
std::string inLanguage(const std::string& value) {
  static const std::regex count("[0-9]{1,3}(,[0-9]{3}){1,5}");
  if (!std::regex_match(value, count)) return value;
  std::string digits = value;
  std::erase(digits, ',');
  return ui::formatCount(std::stoull(digits));
}

std::optional<std::string> inError(const std::string& english, int depth);

std::optional<std::string> byPattern(const std::string& english, bool errorsOnly, int depth) {
  for (const Pattern& pattern : patterns()) {
    if (errorsOnly && pattern.values != Values::error) continue;
    const auto values = valuesIn(english, pattern);
    if (!values) continue;
    fmt::dynamic_format_arg_store<fmt::format_context> store;
    bool fits = true;
    for (const std::string& value : *values) {
      const auto known = pattern.values == Values::error ? inError(value, depth + 1) : std::nullopt;
      // What begins with a place is an error itself, or the place is taken off first.
      const bool first = &value == &values->front() && std::string_view(pattern.english).starts_with("{}");
      fits = fits && (known || !first || pattern.values == Values::list || value.find(": ") == value.npos);
      store.push_back(known.value_or(inLanguage(value)));
    }
    if (fits) return translated(pattern.english, store);
  }
  return std::nullopt;
}

bool isPart(const std::string& english) {
  static const auto parts = setOf(kErrorParts, kSystemTexts);
  return parts.contains(english);
}

/// What names where an error is: parts of it with ": " between them, such as "FILE: layout".
std::string placeText(const std::string& where) {
  static const auto places = setOf(kErrorPlaces);
  const std::size_t colon = where.rfind(": ");
  const std::string last = colon == std::string::npos ? where : where.substr(colon + 2);
  const std::string before = colon == std::string::npos ? "" : where.substr(0, colon + 2);
  return places.contains(last) ? before + tr(last) : before + byPattern(last, true, kDeepest).value_or(last);
}

std::optional<std::string> behindPlace(const std::string& english, int depth) {
  std::size_t colon = english.find(": ");
  for (int part = 0; part < kMostParts && colon != std::string::npos; ++part) {
    const std::string rest = english.substr(colon + 2);
    if (const auto known = isPart(rest) ? std::optional(tr(rest)) : byPattern(rest, true, depth + 1))
      return placeText(english.substr(0, colon)) + ": " + *known;
    colon = english.find(": ", colon + 2);
  }
  return std::nullopt;
}

/// The text of an error, or of a value in it.
std::optional<std::string> inError(const std::string& english, int depth) {
  if (isPart(english)) return tr(english);
  if (depth > kDeepest) return std::nullopt;
  if (auto known = byPattern(english, true, depth)) return known;
  return behindPlace(english, depth);
}

std::string lookUp(const std::string& english) {
  if (std::string known = tr(english); known != english) return known;
  if (auto known = byPattern(english, false, 0)) return *std::move(known);
  if (const std::size_t comma = english.find(", "); comma != std::string::npos)
    if (const auto first = byPattern(english.substr(0, comma), false, 0))
      return *first + ", " + engineText(english.substr(comma + 2));
  return behindPlace(english, 0).value_or(english);
}

/// What `find` made of the text when it was asked for first.
template <class Find>
std::string remembered(const std::string& english, bool isError, const Find& find) {
  using Kept = std::unordered_map<std::string, std::string>;
  static std::mutex mutex;
  static std::string keptIn;
  static std::array<Kept, 2> kept;
  const std::string now = language();
  if (now == "en" || english.empty() || english.size() > kLongestText) return english;
  {
    const std::lock_guard lock(mutex);
    if (keptIn != now || kept[0].size() + kept[1].size() >= kMostKept) kept = {}, keptIn = now;
    if (const auto found = kept[isError].find(english); found != kept[isError].end()) return found->second;
  }
  std::string text = find();
  const std::lock_guard lock(mutex);
  if (keptIn == now) kept[isError].emplace(english, text);
  return text;
}

}  // namespace

std::string engineText(const std::string& english) {
  return remembered(english, false, [&] { return lookUp(english); });
}

std::string engineText(const Error& error) {
  return remembered(error.describe(), true, [&] {
    const std::string message = inError(error.message, 0).value_or(error.message);
    return error.where.empty() ? message : placeText(error.where) + ": " + message;
  });
}

}  // namespace acentric::editor
