#include "engine/measure/numerics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/base/json_text.h"
#include "engine/measure/csv_cell.h"
#include "engine/measure/svg_plot.h"

namespace acentric {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Four digits that count.
std::string numberText(double value) {
  if (std::isnan(value)) return "-";
  if (value != 0 && (std::abs(value) < 1e-3 || std::abs(value) >= 1e6)) return fmt::format("{:.2e}", value);
  return fmt::format("{:.4g}", value);
}

NumericsTable tableFrom(const Json& json) {
  NumericsTable table{json.at("title"), json.at("explanation"), json.at("columns"), {}};
  for (const Json& row : json.at("rows")) {
    NumericsRow& out =
        table.rows.emplace_back(NumericsRow{row.at("cases"), row.at("hard"), row.at("way"), {}});
    for (const std::string& column : table.columns)
      out.values.push_back(row.at("values").value(column, kNone));
  }
  return table;
}

}  // namespace

std::string toJson(const Numerics& numerics) {
  Json json = Json::array();
  for (const NumericsTable& table : numerics) {
    Json rows = Json::array();
    for (const NumericsRow& row : table.rows) {
      Json values = Json::object();
      for (std::size_t c = 0; c < row.values.size(); ++c)
        if (!std::isnan(row.values[c])) values[table.columns[c]] = row.values[c];
      rows.push_back(
          {{"cases", row.cases}, {"hard", row.hard}, {"way", row.way}, {"values", std::move(values)}});
    }
    json.push_back({{"title", table.title},
                    {"explanation", table.explanation},
                    {"columns", table.columns},
                    {"rows", std::move(rows)}});
  }
  return jsonText(json);
}

Result<Numerics> parseNumerics(const std::string& text, const std::string& where) {
  const auto parsed = parseJson<Json>(text, where);
  if (!parsed) return tl::unexpected(parsed.error());
  try {
    Numerics numerics;
    for (const Json& table : *parsed) numerics.push_back(tableFrom(table));
    return numerics;
  } catch (const nlohmann::json::exception& problem) {
    return fail(ErrorKind::malformed, fmt::format("holds no tables of numerics: {}", problem.what()), where);
  }
}

std::string toCsv(const Numerics& numerics) {
  std::string csv = "table,cases,hard,way,column,value\n";
  for (const NumericsTable& table : numerics)
    for (const NumericsRow& row : table.rows)
      for (std::size_t c = 0; c < row.values.size(); ++c)
        if (!std::isnan(row.values[c]))
          csv += fmt::format("{},{},{},{},{},{:.9g}\n", csvCell(table.title), csvCell(row.cases),
                             row.hard ? 1 : 0, csvCell(row.way), csvCell(table.columns[c]), row.values[c]);
  return csv;
}

std::string toText(const Numerics& numerics) {
  std::string text;
  for (const NumericsTable& table : numerics) {
    std::size_t cases = 0, ways = 0;
    for (const NumericsRow& row : table.rows)
      cases = std::max(cases, row.cases.size()), ways = std::max(ways, row.way.size());
    text += fmt::format("{}\n  {:<{}}  {:<{}}", table.title, "", cases, "", ways);
    for (const std::string& column : table.columns) text += fmt::format("  {:>12}", column);
    text += "\n";
    for (const NumericsRow& row : table.rows) {
      text += fmt::format("  {:<{}}  {:<{}}", row.cases, cases, row.way, ways);
      for (std::size_t c = 0; c < row.values.size(); ++c)
        text += fmt::format("  {:>{}}", numberText(row.values[c]),
                            std::max<std::size_t>(12, table.columns[c].size()));
      text += "\n";
    }
  }
  return text;
}

std::string toHtml(const Numerics& numerics) {
  if (numerics.empty()) return {};
  std::string html = "<h2>Numerical accuracy</h2>\n";
  for (const NumericsTable& table : numerics) {
    html += fmt::format("<h3>{}</h3>\n<p class=\"faint\">{}</p>\n<table><thead><tr><th></th><th></th>",
                        htmlText(table.title), htmlText(table.explanation));
    for (const std::string& column : table.columns) html += "<th>" + htmlText(column) + "</th>";
    html += "</tr></thead><tbody>\n";
    for (const NumericsRow& row : table.rows) {
      html += fmt::format("<tr class=\"{}\"><td>{}</td><td class=\"left\">{}</td>",
                          row.hard ? "hard" : "plain", htmlText(row.cases), htmlText(row.way));
      for (const double value : row.values) html += "<td>" + numberText(value) + "</td>";
      html += "</tr>\n";
    }
    html += "</tbody></table>\n";
  }
  return html;
}

}  // namespace acentric
