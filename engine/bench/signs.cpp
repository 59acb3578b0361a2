/// On which side of a border does a point lie: exact signs against naive ones.

#include <algorithm>
#include <limits>
#include <random>

#include "engine/base/stopwatch.h"
#include "engine/bench/numerics.h"
#include "engine/geometry/predicates/orientation.h"
#include "engine/measure/statistics.h"

namespace acentric {
namespace {

constexpr std::size_t kQuestions = 200'000;
constexpr double kFarAway = 5e6;  ///< metres, as map coordinates are

struct Question {
  BorderLine line;
  glm::dvec2 point{0};
};

template <class T>
int naiveSign(const Question& q) {
  const glm::tvec2<T> from(q.line.from), to(q.line.to), point(q.point);
  const glm::tvec2<T> a = to - from, b = point - from;
  const T cross = a.x * b.y - a.y * b.x;
  return cross > 0 ? 1 : cross < 0 ? -1 : 0;
}
int exactSign(const Question& q) { return orientation(q.line.from, q.line.to, q.point); }

/// Borders of all sectors, and points anywhere among them, or (`on`) on them but for rounding.
std::vector<Question> questions(const Layout& layout, bool on, double away) {
  std::vector<BorderLine> lines;
  glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
  for (const Region& region : layout.regions)
    for (const Cover& cover : region.covers)
      for (const Piece& piece : cover.pieces) {
        lines.push_back(piece.low);
        low = glm::min(low, piece.apex), high = glm::max(high, piece.apex);
      }
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  std::uniform_int_distribution<std::size_t> any(0, lines.size() - 1);
  std::vector<Question> all(kQuestions);
  for (Question& q : all) {
    q.line = lines[any(random)];
    const glm::dvec2 shift(away, away);
    q.line.from += shift, q.line.to += shift;
    const double along = 4 * share(random);
    q.point = on ? q.line.from + along * (q.line.to - q.line.from)
                 : shift + glm::mix(low, high, glm::dvec2(share(random), share(random)));
  }
  return all;
}

template <class Sign>
NumericsRow rowFor(const std::string& cases, bool hard, const std::string& way,
                   const std::vector<Question>& all, const std::vector<int>& right, int repeats, Sign sign) {
  std::vector<double> nanoseconds;
  std::vector<int> found(all.size());
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const Stopwatch watch;
    std::ranges::transform(all, found.begin(), sign);
    nanoseconds.push_back(1e9 * watch.seconds() / double(all.size()));
  }
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < all.size(); ++i) wrong += found[i] != right[i] ? 1 : 0;
  return {cases, hard, way, {100 * double(wrong) / double(all.size()), spreadOf(nanoseconds).median}};
}

}  // namespace

NumericsTable benchSigns(const Layout& layout, const NumericsBenchOptions& options) {
  NumericsTable table{"Sides of borders: exact and naive",
                      "On which side of a sector's border a point lies. On a border means as near as doubles "
                      "can say; naive signs are cross products. A wrong sign leaves out an image or draws it "
                      "in the wrong order.",
                      {"wrong signs, %", "ns a sign"},
                      {}};
  struct Case {
    const char* name;
    bool on;
    double away;
  };
  for (const auto& [name, on, away] : {Case{"points anywhere", false, 0}, Case{"points on borders", true, 0},
                                       Case{"points anywhere, 5000 km out", false, kFarAway},
                                       Case{"on borders, 5000 km out", true, kFarAway}}) {
    const std::vector<Question> all = questions(layout, on, away);
    std::vector<int> right(all.size());
    std::ranges::transform(all, right.begin(), exactSign);
    const bool hard = on || away > 0;
    table.rows.push_back(rowFor(name, hard, "exact", all, right, options.repeats, exactSign));
    table.rows.push_back(
        rowFor(name, hard, "naive in doubles", all, right, options.repeats, naiveSign<double>));
    table.rows.push_back(
        rowFor(name, hard, "naive in floats", all, right, options.repeats, naiveSign<float>));
  }
  return table;
}

}  // namespace acentric
