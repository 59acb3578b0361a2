#pragma once
/// What careful arithmetic buys and costs: tables of ways to compute the same thing, error and time side by
/// side, on ordinary cases and on hard ones.

#include <string>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

struct NumericsRow {
  std::string cases;           ///< what was computed
  bool hard = false;           ///< made so that rounding matters
  std::string way;             ///< how
  std::vector<double> values;  ///< by column; NaN: none
};

struct NumericsTable {
  std::string title, explanation;
  std::vector<std::string> columns;  ///< what the values are, with units
  std::vector<NumericsRow> rows;
};

using Numerics = std::vector<NumericsTable>;

/// Stable order of keys; values that are none are left out.
std::string toJson(const Numerics& numerics);
/// `where` names the file in messages.
Result<Numerics> parseNumerics(const std::string& json, const std::string& where);
/// One line a value: table,cases,hard,way,column,value.
std::string toCsv(const Numerics& numerics);
/// For people; `toHtml` is a section of a page.
std::string toText(const Numerics& numerics);
std::string toHtml(const Numerics& numerics);

}  // namespace acentric
