#include "editor/actions/action_search.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

#include "ui/translate.h"

namespace acentric::editor {
namespace {

char folded(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

/// Capitals are small, umlauts and other letters of Latin-1 too: in UTF-8 they are C3 and 80 to 9E.
std::string folded(std::string_view text) {
  std::string result(text);
  bool latin = false;
  for (char& c : result) {
    const auto byte = static_cast<unsigned char>(c);
    c = latin && byte >= 0x80 && byte <= 0x9e && byte != 0x97 ? char(byte + 0x20) : folded(c);
    latin = byte == 0xc3;
  }
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
      words.back() += c;
  std::erase(words, "");
  for (std::string& word : words) word = folded(word);
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
  const std::string label = tr(action.label), menu = tr(action.menu), help = tr(action.help);
  const std::array<Field, 8> fields = {{{label},
                                        {action.label},
                                        {menu, 1, MatchKind::wordBegin},
                                        {action.menu, 1, MatchKind::wordBegin},
                                        {key, 1, MatchKind::wordBegin},
                                        {alternative, 1, MatchKind::wordBegin},
                                        {help, kHelpPenalty, MatchKind::inside},
                                        {action.help, kHelpPenalty, MatchKind::inside}}};
  return rankOf(words, fields);
}

/// How much of the label the whole query is: 0 all of it, 1 its beginning, 2 neither.
int labelRank(std::string_view query, const std::string& name) {
  const std::string label = folded(name);
  if (!label.starts_with(query)) return 2;
  return label.size() == query.size() ? 0 : 1;
}

/// Of its name in the language that is shown, or in English.
int labelRank(std::string_view query, const Action& action) {
  return std::min(labelRank(query, tr(action.label)), labelRank(query, action.label));
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
      {trLater("W A S D, arrows"), trLater("walk; with Shift three times as fast"), trLater("Walk")},
      {trLater("Q E, or drag in the walk"), trLater("look around"), trLater("Walk")},
      {trLater("Page Up, Page Down"), trLater("raise and lower the eye within the baked range"),
       trLater("Walk")},
      {trLater("Wheel"), trLater("zoom the plan"), trLater("Plan")},
      {trLater("Right or middle drag"), trLater("pan the plan"), trLater("Plan")},
      {trLater("Shift+click or drag"), trLater("add cells to the selection; with Ctrl: add or take off"),
       trLater("Plan")},
      {trLater("Ctrl+arrows"), trLater("move the selection by one step of the lattice"), trLater("Plan")},
      {trLater("Enter, Esc"), trLater("close the outline in hand; give up what is in hand, or the selection"),
       trLater("Plan")},
      {trLater("Drag, right drag, wheel"), trLater("orbit, pan, come nearer to what is under the pointer"),
       trLater("3D view")},
      {trLater("Alt+click"), trLater("tell which cameras sample the surface, and how finely"),
       trLater("3D view")},
      {trLater("Double click"), trLater("centre on the surface, or look through the camera"),
       trLater("3D view")},
      {trLater("Drag a number"), trLater("change it; double click to type a value"), trLater("Settings")},
      {trLater("Tab, arrows, Space"),
       trLater("go from widget to widget, change the one that is lit; Esc ends"), trLater("Window")},
      {trLater("Alt"), trLater("open the menus, as F10"), trLater("Window")}};
  for (const Action& action : table)
    for (const Shortcut& key : {action.shortcut, action.alternative})
      if (key.key != 0) all.push_back({describe(key), action.label, menuOf(action)});
  const std::vector<std::string> words = wordsOf(query);
  std::erase_if(all, [&words](const KeyHelp& line) {
    const std::string keys = tr(line.keys), what = tr(line.what), where = tr(line.where);
    const std::array<Field, 6> fields = {{{keys, 0, MatchKind::inside},
                                          {line.keys, 0, MatchKind::inside},
                                          {what, 0, MatchKind::inside},
                                          {line.what, 0, MatchKind::inside},
                                          {where, 0, MatchKind::wordBegin},
                                          {line.where, 0, MatchKind::wordBegin}}};
    return !rankOf(words, fields);
  });
  for (KeyHelp& line : all) line = {tr(line.keys), tr(line.what), tr(line.where)};
  return all;
}

}  // namespace acentric::editor
