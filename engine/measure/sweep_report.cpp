#include "engine/measure/sweep_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/base/file.h"
#include "engine/measure/svg_plot.h"

namespace acentric {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body { font: 15px/1.45 system-ui, "DejaVu Sans", sans-serif; color: #1c2733; background: #f5f7f9; margin: 0 auto;
  max-width: 1360px; padding: 24px 20px 60px; }
h1 { font-size: 26px; margin: 0 0 2px; } h2 { font-size: 19px; margin: 34px 0 10px; }
p { margin: 4px 0 10px; max-width: 1000px; } .faint { color: #586573; }
.row { display: flex; flex-wrap: wrap; gap: 14px; }
.card { background: #fff; border: 1px solid #dde3e8; border-radius: 8px; padding: 10px 14px; }
.preset { flex: 1 1 380px; } .preset b { font-size: 17px; text-transform: capitalize; }
.preset span { display: block; }
table { border-collapse: collapse; background: #fff; border: 1px solid #dde3e8; width: 100%; font-size: 13px; }
th, td { padding: 5px 8px; text-align: right; border-bottom: 1px solid #e8ecf0; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; white-space: normal; } th { background: #eef2f5; }
td small { display: block; color: #586573; font-size: 11px; } tr.front td:first-child { font-weight: 600; }
tr.front td:first-child::before { content: "\25CF "; color: #0b62b8; }
tr.base td:first-child::before { content: "\25CF "; color: #b3263c; } tr.hard td:first-child { font-weight: 600; } td.left { text-align: left; color: #586573; }
figure { margin: 0; flex: 1 1 400px; } figure img { width: 100%; display: block; border-radius: 4px; }
figcaption { color: #586573; font-size: 13px; margin-top: 3px; }
.shots { margin-bottom: 14px; } .shots h3 { font-size: 15px; margin: 0 0 8px; }
svg.plot text { font-family: system-ui, "DejaVu Sans", sans-serif; fill: #1c2733; }
svg .title { font-size: 15px; font-weight: 600; } svg .tick { font-size: 11px; } svg .name { font-size: 12.5px; }
svg .label { font-size: 11px; paint-order: stroke; stroke: #fff; stroke-width: 3px; stroke-linejoin: round; } svg .grid { stroke: #e6eaee; } svg .axis { stroke: #8a96a3; }
svg .bar { stroke: #c3ccd5; stroke-width: 1; } svg .line { stroke: #0b62b8; stroke-width: 1.6; fill: none; opacity: .7; }
svg circle { stroke: #fff; stroke-width: 1; } svg .plain { fill: #7c8a98; } svg .front { fill: #0b62b8; }
svg .base { fill: #b3263c; }
</style>
)";

/// Costs that lie closer together than by this factor are the same: there is nothing to plot.
constexpr double kLeastRange = 1.02;

std::string number(const MeasureInfo& info, double value) {
  return fmt::format("{:.{}f}", value * info.shown, info.digits);
}
std::string withUnit(const MeasureInfo& info) {
  return info.unit[0] == '\0' ? info.label : fmt::format("{}, {}", info.label, info.unit);
}

class ReportWriter {
 public:
  ReportWriter(const Sweep& sweep, const std::filesystem::path& folder) : sweep_(sweep), folder_(folder) {
    for (const std::size_t i : frontOf(sweep)) front_.insert(i);
    for (std::size_t i = 0; i < sweep.points.size(); ++i)
      if (sweep.points[i].measured()) measured_.push_back(i);
  }

  Result<std::string> write() {
    intro();
    presets();
    plots();
    knobPlots();
    table();
    html_ += toHtml(sweep_.numerics);
    if (Status shown = pictures(); !shown) return tl::unexpected(shown.error());
    return reportPage("What accuracy costs: " + sweep_.scene, html_);
  }

 private:
  const SweepPoint& at(std::size_t i) const { return sweep_.points[i]; }
  PlotPoint::Kind kindOf(std::size_t i) const {
    return at(i).setting.empty() ? PlotPoint::Kind::base
           : front_.contains(i)  ? PlotPoint::Kind::front
                                 : PlotPoint::Kind::plain;
  }

  void intro() {
    html_ += fmt::format(
        "<h1>What accuracy costs</h1>\n<p class=\"faint\">{} ({}) along {} &middot; {} &times; "
        "{}, {} frames, {} repeats, truth with {} rays per pixel &middot; {}, {} threads "
        "&middot; Acentric {}, commit {}</p>\n",
        htmlText(sweep_.scene), htmlText(sweep_.project), htmlText(sweep_.path), sweep_.width, sweep_.height,
        sweep_.frames, sweep_.repeats, sweep_.truthSamples, htmlText(sweep_.processor), sweep_.threads,
        htmlText(sweep_.version), htmlText(commits()));
    html_ +=
        "<p>Each dot is one setting of the project, measured on the same frames against the same ray-traced "
        "truth. Blue: nothing else has less error, quicker frames and fewer bytes at once. Red: the project "
        "as it is. Bars reach from the smallest to the largest, of errors over the frames, of times over the "
        "repeats; where they go on beyond the plot they are cut, and dots far from all others lie at its "
        "border.</p>\n";
  }

  /// Of all points: a sweep may have gone on with another build.
  std::string commits() const {
    std::set<std::string> names;
    for (const std::size_t i : measured_) names.insert(at(i).commit);
    return fmt::format("{}", fmt::join(names, ", "));
  }

  void presets() {
    html_ += "<h2>Presets</h2><div class=\"row\">\n";
    for (const SweepPreset& preset : presetsOf(sweep_)) {
      const SweepPoint& p = *sweep_.find(preset.setting);
      html_ += fmt::format("<div class=\"card preset\"><b>{}</b><span>{}</span><span class=\"faint\">",
                           htmlText(preset.name), htmlText(textOf(preset.setting)));
      std::string figures;
      for (const Measure m : {Measure::psnr, Measure::msSsim, Measure::frameMs, Measure::bytes}) {
        const MeasureInfo& info = infoOf(m);
        figures += fmt::format("{}{} {} {}", figures.empty() ? "" : " &middot; ", info.label,
                               number(info, p[m].median), info.unit);
      }
      html_ += figures + "</span></div>\n";
    }
    html_ += "</div>\n";
  }

  PlotPoint pointOf(std::size_t i, Measure x, Measure y) const {
    const SweepPoint& p = at(i);
    const MeasureInfo &mx = infoOf(x), &my = infoOf(y);
    PlotPoint point{p[x].median * mx.shown,
                    p[y].median * my.shown,
                    p[x].min * mx.shown,
                    p[x].max * mx.shown,
                    p[y].min * my.shown,
                    p[y].max * my.shown,
                    textOf(p.setting),
                    {},
                    kindOf(i)};
    point.hint = fmt::format("{}: {} {} {}, {} {} {}", textOf(p.setting), my.label, number(my, p[y].median),
                             my.unit, mx.label, number(mx, p[x].median), mx.unit);
    return point;
  }

  /// Of `which`, those that have both.
  Plot plotOf(const std::vector<std::size_t>& which, Measure x, Measure y) const {
    Plot plot;
    plot.across = withUnit(infoOf(x)), plot.up = withUnit(infoOf(y));
    plot.logAcross = true;
    for (const std::size_t i : which)
      if (at(i)[x].count > 0 && at(i)[y].count > 0 && at(i)[x].min > 0)
        plot.points.push_back(pointOf(i, x, y));
    return plot;
  }

  /// What is worth having of two measures, from the cheapest on.
  static std::vector<std::size_t> frontLine(const Plot& plot, bool moreIsBetter) {
    std::vector<Objectives> objectives;
    for (const PlotPoint& p : plot.points) objectives.push_back({p.x, moreIsBetter ? -p.y : p.y});
    std::vector<std::size_t> line = paretoFront(objectives);
    std::ranges::stable_sort(line, {}, [&](std::size_t i) { return plot.points[i].x; });
    return line;
  }

  void plots() {
    struct Pair {
      Measure cost, error;
      const char* title;
    };
    html_ += "<h2>Error against cost</h2><div class=\"row\">\n";
    for (const Pair& pair : {Pair{Measure::frameMs, Measure::msSsim, "Similarity and the time of a frame"},
                             {Measure::frameMs, Measure::psnr, "PSNR and the time of a frame"},
                             {Measure::bytes, Measure::msSsim, "Similarity and bytes on disk"},
                             {Measure::bakeSeconds, Measure::msSsim, "Similarity and the time of a bake"},
                             {Measure::frameP99Ms, Measure::holeShare, "Holes and the slowest frames"},
                             {Measure::frameMs, Measure::flicker, "Flicker at borders of regions"}}) {
      Plot plot = plotOf(measured_, pair.cost, pair.error);
      const auto range = std::ranges::minmax_element(plot.points, {}, &PlotPoint::x);
      if (plot.points.empty() || range.max->x < kLeastRange * range.min->x) continue;
      plot.title = pair.title;
      plot.steps = true;
      plot.lines = {frontLine(plot, infoOf(pair.error).moreIsBetter)};
      html_ += "<div class=\"card\">" + svgOf(plot) + "</div>\n";
    }
    html_ += "</div>\n";
  }

  /// One choice at a time, against what it costs: where bytes change those, else time.
  void knobPlots() {
    std::vector<std::string> names;
    std::map<std::string, std::vector<std::size_t>> byKnob;
    for (const std::size_t i : measured_)
      if (at(i).setting.size() == 1) {
        const std::string& name = at(i).setting.front().knob;
        if (byKnob[name].empty()) names.push_back(name);
        byKnob[name].push_back(i);
      }
    if (names.empty() || at(0).setting.size() > 0 || !at(0).measured()) return;
    html_ += "<h2>One knob at a time</h2><div class=\"row\">\n";
    for (const std::string& name : names) {
      std::vector<std::size_t>& which = byKnob[name];
      const bool bakes = std::ranges::any_of(
          which, [&](std::size_t i) { return at(i)[Measure::bytes].median != at(0)[Measure::bytes].median; });
      which.insert(which.begin(), 0);
      const Measure cost = bakes ? Measure::bytes : Measure::frameMs;
      Plot plot = plotOf(which, cost, Measure::msSsim);
      plot.width = 425, plot.height = 300;
      plot.title = name;
      for (std::size_t k = 1; k < plot.points.size(); ++k) {
        plot.points[k].label = at(which[k]).setting.front().value;
        plot.points[k].yLow = plot.points[k].yHigh = plot.points[k].y;  // medians: their difference is meant
      }
      if (!plot.points.empty()) plot.points[0].yLow = plot.points[0].yHigh = plot.points[0].y;
      html_ += "<div class=\"card\">" + svgOf(plot) + "</div>\n";
    }
    html_ += "</div>\n";
  }

  std::string cellOf(const SweepPoint& p, const MeasureInfo& info) const {
    const Spread& s = p[info.measure];
    if (s.count == 0) return "<td>&ndash;</td>";
    std::string cell = "<td>" + number(info, s.median);
    if (s.count > 1)
      cell +=
          fmt::format("<small>{}&hairsp;&ndash;&hairsp;{}</small>", number(info, s.min), number(info, s.max));
    if (info.measure == Measure::bakeSeconds && p.bakeEstimated) cell += "<small>predicted</small>";
    return cell + "</td>";
  }

  void table() {
    html_ +=
        "<h2>All settings</h2>\n<p class=\"faint\">Medians; below them the smallest and the largest.</p>\n"
        "<table><thead><tr><th>Setting</th>";
    for (const MeasureInfo& info : measures()) html_ += "<th>" + htmlText(withUnit(info)) + "</th>";
    html_ += "</tr></thead><tbody>\n";
    for (std::size_t i = 0; i < sweep_.points.size(); ++i) {
      const SweepPoint& p = at(i);
      html_ += fmt::format("<tr class=\"{}\"><td>{}</td>",
                           p.setting.empty()    ? "base"
                           : front_.contains(i) ? "front"
                                                : "plain",
                           htmlText(textOf(p.setting)));
      if (p.measured())
        for (const MeasureInfo& info : measures()) html_ += cellOf(p, info);
      else
        html_ +=
            fmt::format("<td class=\"left\" colspan=\"{}\">skipped: {}</td>", kMeasures, htmlText(p.skipped));
      html_ += "</tr>\n";
    }
    html_ += "</tbody></table>\n";
  }

  /// A figure of a picture in the folder, if it is there.
  Result<std::string> figureOf(const std::string& file, const std::string& caption) const {
    const auto path = folder_ / file;
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return std::string();
    const auto bytes = readFile(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\"><figcaption>{0}</figcaption></figure>",
        htmlText(caption), base64Of(*bytes));
  }

  /// The front's first.
  Status pictures() {
    html_ += "<h2>The worst frame of each setting</h2>\n";
    std::vector<std::size_t> order = measured_;
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return !front_.contains(i); });
    for (const std::size_t i : order) {
      const SweepPoint& p = at(i);
      std::string row;
      const std::string frame = fmt::format("frame {}", p.worstFrame);
      for (const auto& [file, caption] :
           {std::pair{p.pictures + ".jpg", frame},
            {fmt::format("{}/truth-{}.jpg", sweep_.truthPictures, p.worstFrame), "the truth"},
            {p.pictures + "-difference.jpg", "their difference, amplified"}}) {
        const auto figure = figureOf(file, caption);
        if (!figure) return tl::unexpected(figure.error());
        row += *figure;
      }
      if (row.empty()) continue;
      const MeasureInfo& info = infoOf(Measure::msSsim);
      html_ += fmt::format(
          "<div class=\"card shots\"><h3>{} <span class=\"faint\">MS-SSIM {} here</span></h3>"
          "<div class=\"row\">{}</div></div>\n",
          htmlText(textOf(p.setting)), number(info, p[Measure::msSsim].min), row);
    }
    return {};
  }

  static std::string base64Of(const std::vector<std::byte>& bytes) {
    constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
      unsigned group = 0;
      for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? unsigned(bytes[i + k]) : 0);
      for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kLetters[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
  }

  const Sweep& sweep_;
  const std::filesystem::path folder_;
  std::set<std::size_t> front_;
  std::vector<std::size_t> measured_;
  std::string html_;
};

}  // namespace

std::string reportPage(const std::string& title, const std::string& body) {
  return fmt::format("{}<title>{}</title></head><body>\n{}</body></html>\n", kHead, htmlText(title), body);
}

Result<std::string> sweepReport(const Sweep& sweep, const std::filesystem::path& folder) {
  return ReportWriter(sweep, folder).write();
}

}  // namespace acentric
