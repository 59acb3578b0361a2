#pragma once
/// Finds actions and keys by a few letters: the words of a query, in any order, each at the beginning of a
/// word, as initials of words, inside of a word, or as letters that follow one another with gaps.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "editor/actions/action.h"

namespace acentric::editor {

/// How a word of a query is found in a text; the first is best.
enum class MatchKind { wordBegin, initials, inside, scattered };
/// The best of them; nothing if none. ASCII letters match without regard to case. An empty word begins any.
std::optional<MatchKind> matchWord(std::string_view word, std::string_view text);

/// The actions that match every word of `query`, by label, menu, key or help: first what is called like the
/// query, then labels that begin with it, then the best matches; of equally good ones those of `recent` (ids,
/// newest first), then in the order of the table. An empty query finds all.
std::vector<const Action*> searchActions(const std::vector<Action>& table, std::string_view query,
                                         const std::vector<std::string>& recent);

/// A line of the list of keys and what the mouse does.
struct KeyHelp {
  std::string keys;  ///< "Ctrl+Shift+S"
  std::string what;
  std::string where;  ///< menu, or where the mouse is
};
/// Keys of the walk and what the mouse does, then all keys of the table; those that match `query`.
std::vector<KeyHelp> searchKeys(const std::vector<Action>& table, std::string_view query);

}  // namespace acentric::editor
