#include "editor/actions/action_search.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

namespace acentric::editor {
namespace {

char folded(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

std::string folded(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](char c) { return folded(c); });
  return result;
}

/// Bytes above ASCII are parts of letters.
bool inWord(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c & '\x80') != 0; }

bool beginsWord(std::string_view text, std::size_t at) { return at == 0 || !inWord(text[at - 1]); }

std::vector<std::string> wordsOf(std::string_view query) {
  std::vector<std::string> words(1);
  for (const char c : query)
    if (c == ' ')
      words.emplace_back();
    else
      words.back() += folded(c);
  std::erase(words, "");
  return words;
}

std::string initialsOf(std::string_view text) {
  std::string initials;
  for (std::size_t at = 0; at < text.size(); ++at)
    if (inWord(text[at]) && beginsWord(text, at)) initials += text[at];
  return initials;
}

/// The first letter begins a word: else nearly everything would match.
bool scattered(std::string_view word, std::string_view text) {
  for (std::size_t begin = 0; begin < text.size(); ++begin) {
    if (text[begin] != word.front() || !beginsWord(text, begin)) continue;
    std::size_t found = 0;
    for (std::size_t at = begin; at < text.size() && found < word.size(); ++at)
      if (text[at] == word[found]) ++found;
    if (found == word.size()) return true;
  }
  return false;
}

/// One of the texts that are searched, and how much its matches count for.
struct Field {
  std::string_view text;
  int penalty = 0;
  MatchKind poorest = MatchKind::scattered;  ///< long texts match by accident
};

/// The rank of the worst and the sum of all words; smaller is better.
struct Rank {
  int worst = 0, sum = 0;
};

std::optional<Rank> rankOf(std::span<const std::string> words, std::span<const Field> fields) {
  Rank rank;
  for (const std::string& word : words) {
    std::optional<int> best;
    for (const Field& field : fields) {
      const auto kind = matchWord(word, field.text);
      if (!kind || *kind > field.poorest) continue;
      const int here = int(*kind) + field.penalty;
      best = std::min(best.value_or(here), here);
    }
    if (!best) return std::nullopt;
    rank.worst = std::max(rank.worst, *best);
    rank.sum += *best;
  }
  return rank;
}

std::optional<Rank> rankOf(std::span<const std::string> words, const Action& action) {
  const std::string key = describe(action.shortcut), alternative = describe(action.alternative);
  constexpr int kHelpPenalty = 4;
  const std::array<Field, 5> fields = {{{action.label},
                                        {action.menu, 1, MatchKind::wordBegin},
                                        {key, 1, MatchKind::wordBegin},
                                        {alternative, 1, MatchKind::wordBegin},
                                        {action.help, kHelpPenalty, MatchKind::inside}}};
  return rankOf(words, fields);
}

/// How much of the label the whole query is: 0 all of it, 1 its beginning, 2 neither.
int labelRank(std::string_view query, const Action& action) {
  const std::string label = folded(action.label);
  if (!label.starts_with(query)) return 2;
  return label.size() == query.size() ? 0 : 1;
}

}  // namespace

std::optional<MatchKind> matchWord(std::string_view word, std::string_view text) {
  if (word.empty()) return MatchKind::wordBegin;
  const std::string sought = folded(word), in = folded(text);
  std::optional<MatchKind> best;
  for (std::size_t at = in.find(sought); at != std::string::npos; at = in.find(sought, at + 1)) {
    if (beginsWord(in, at)) return MatchKind::wordBegin;
    best = MatchKind::inside;
  }
  if (sought.size() > 1 && initialsOf(in).find(sought) != std::string::npos) return MatchKind::initials;
  if (best) return best;
  if (sought.size() > 2 && scattered(sought, in)) return MatchKind::scattered;
  return std::nullopt;
}

std::vector<const Action*> searchActions(const std::vector<Action>& table, std::string_view query,
                                         const std::vector<std::string>& recent) {
  struct Found {
    int label = 0;
    Rank rank;
    std::ptrdiff_t recency;
    const Action* action;
  };
  const std::vector<std::string> words = wordsOf(query);
  std::string whole;
  for (const std::string& word : words) whole += (whole.empty() ? "" : " ") + word;
  std::vector<Found> found;
  for (const Action& action : table)
    if (const auto rank = rankOf(words, action))
      found.push_back(
          {labelRank(whole, action), *rank, std::ranges::find(recent, action.id) - recent.begin(), &action});
  std::ranges::stable_sort(
      found, {}, [](const Found& f) { return std::tuple(f.label, f.rank.worst, f.recency, f.rank.sum); });
  std::vector<const Action*> actions;
  actions.reserve(found.size());
  for (const Found& one : found) actions.push_back(one.action);
  return actions;
}

std::vector<KeyHelp> searchKeys(const std::vector<Action>& table, std::string_view query) {
  std::vector<KeyHelp> all = {
      {"W A S D, arrows", "walk; with Shift three times as fast", "Walk"},
      {"Q E, or drag in the walk", "look around", "Walk"},
      {"Page Up, Page Down", "raise and lower the eye within the baked range", "Walk"},
      {"Wheel", "zoom the plan", "Plan"},
      {"Right or middle drag", "pan the plan", "Plan"},
      {"Shift+click or drag", "add cells to the selection; with Ctrl: add or take off", "Plan"},
      {"Ctrl+arrows", "move the selection by one step of the lattice", "Plan"},
      {"Enter, Esc", "close the outline in hand; give up what is in hand, or the selection", "Plan"},
      {"Drag, right drag, wheel", "orbit, pan, come nearer to what is under the pointer", "3D view"},
      {"Alt+click", "tell which cameras sample the surface, and how finely", "3D view"},
      {"Double click", "centre on the surface, or look through the camera", "3D view"},
      {"Drag a number", "change it; double click to type a value", "Settings"},
      {"Tab, arrows, Space", "go from widget to widget, change the one that is lit; Esc ends", "Window"},
      {"Alt", "open the menus, as F10", "Window"}};
  for (const Action& action : table)
    for (const Shortcut& key : {action.shortcut, action.alternative})
      if (key.key != 0)
        all.push_back({describe(key), action.label, action.menu.empty() ? "Window" : action.menu});
  const std::vector<std::string> words = wordsOf(query);
  std::erase_if(all, [&words](const KeyHelp& line) {
    const std::array<Field, 3> fields = {{{line.keys, 0, MatchKind::inside},
                                          {line.what, 0, MatchKind::inside},
                                          {line.where, 0, MatchKind::wordBegin}}};
    return !rankOf(words, fields);
  });
  return all;
}

}  // namespace acentric::editor
