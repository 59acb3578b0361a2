#include "engine/pipeline/knobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/file.h"
#include "engine/layout/panoramas.h"

namespace acentric {
namespace {

Error refused(const std::string& value, const std::string& expected) {
  return {ErrorKind::invalidArgument, fmt::format("'{}' is not {}", value, expected), "knob"};
}

template <class T>
Status setNumber(T& field, const std::string& value) {
  T number{};
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size())
    return tl::unexpected(refused(value, std::is_integral_v<T> ? "a whole number" : "a number"));
  field = number;
  return {};
}

auto tries(std::vector<std::string> values) {
  return [values = std::move(values)](const Project&) { return values; };
}

/// `field(project)`: the number that it sets.
template <class Field>
Knob numberKnob(std::string name, std::string what, bool bakes, Field field, std::vector<std::string> tried) {
  return {std::move(name),
          std::move(what),
          bakes,
          [field](const Project& project) {
            Project copy = project;
            return fmt::format("{}", field(copy));
          },
          [field](Project& project, const std::string& value) { return setNumber(field(project), value); },
          tries(std::move(tried))};
}

template <class Field>
Knob switchKnob(std::string name, std::string what, bool bakes, Field field) {
  return {std::move(name),
          std::move(what),
          bakes,
          [field](const Project& project) -> std::string {
            Project copy = project;
            return field(copy) ? "on" : "off";
          },
          [field](Project& project, const std::string& value) -> Status {
            if (value != "on" && value != "off") return tl::unexpected(refused(value, "on or off"));
            field(project) = value == "on";
            return {};
          },
          tries({"on", "off"})};
}

/// `parse(name)` gives the value, `field(project)` is where it goes.
template <class Field, class Parse>
Knob nameKnob(std::string name, std::string what, bool bakes, Field field, Parse parse,
              std::vector<std::string> tried) {
  return {std::move(name),
          std::move(what),
          bakes,
          [field](const Project& project) -> std::string {
            Project copy = project;
            return nameOf(field(copy));
          },
          [field, parse](Project& project, const std::string& value) -> Status {
            const auto parsed = parse(value);
            if (!parsed) return tl::unexpected(parsed.error());
            field(project) = *parsed;
            return {};
          },
          tries(std::move(tried))};
}

void viewKnobs(std::vector<Knob>& table) {
  table.push_back(nameKnob("reconstruction", "how samples become pixels", false,
                           [](Project & p) -> auto& { return p.view.reconstruction; }, parseReconstruction,
                           {"point", "splat", "patches"}));
  table.push_back(nameKnob(
      "renderer", "list priority, depth buffer or OpenGL", false,
      [](Project & p) -> auto& { return p.view.renderer; }, parseRenderer, rendererNames()));
  table.push_back(numberKnob("splat-limit", "side of the largest splat, pixels", false,
                             [](Project & p) -> auto& { return p.view.maxSplatPixels; },
                             {"2", "4", "8", "16", "32"}));
  table.push_back(switchKnob(
      "other-hand", "cameras of the other hand behind a ring's own", false,
      [](Project & p) -> auto& { return p.view.secondaryCover; }));
  table.push_back(switchKnob(
      "fill-holes", "holes are filled on the screen", false,
      [](Project & p) -> auto& { return p.view.fillHoles; }));
  table.push_back(switchKnob(
      "local-geometry", "near triangles are drawn", false,
      [](Project & p) -> auto& { return p.view.localGeometry; }));
  Knob budget =
      numberKnob("local-budget", "triangles per region that near geometry is simplified to; 0 = all", false,
                 [](Project & p) -> auto& { return p.budget.trianglesPerRegion; }, {"0", "20000", "5000"});
  budget.value = [](const Project& project) {
    return fmt::format("{}", project.budget.simplifies() ? project.budget.trianglesPerRegion : 0);
  };
  budget.set = [set = budget.set](Project& project, const std::string& value) {
    const Status done = set(project, value);
    project.budget.simplify = project.budget.trianglesPerRegion > 0;
    return done;
  };
  table.push_back(std::move(budget));
}

void layoutKnobs(std::vector<Knob>& table) {
  Knob configuration = nameKnob("configuration", "of the paper", true,
                                [](Project & p) -> auto& { return p.layout().configuration; },
                                parseConfiguration, {"a", "b", "c", "d", "e", "f", "g"});
  configuration.set = [set = configuration.set](Project& project, const std::string& value) {
    const Status done = set(project, value);
    project.layout().forgetCells();
    return done;
  };
  table.push_back(std::move(configuration));
  Knob cell = numberKnob("cell-size", "edge of a cell, metres", true,
                         [](Project & p) -> auto& { return p.layout().cellSize; }, {});
  cell.set = [set = cell.set](Project& project, const std::string& value) {
    const Status done = set(project, value);
    project.layout().forgetCells();
    return done;
  };
  cell.tried = [](const Project& project) {
    std::vector<std::string> values;
    for (const double factor : {0.7, 1.4})
      values.push_back(fmt::format("{:.6g}", project.layout().cellSize * factor));
    return values;
  };
  table.push_back(std::move(cell));
  table.push_back(numberKnob("near-band", "metres around a region that are drawn as polygons", true,
                             [](Project & p) -> auto& { return p.layout().nearBand; }, {"0.5", "1", "2"}));
  table.push_back({"panoramas", "traditional panoramas in the middle of rings", true,
                   [](const Project& project) -> std::string {
                     LayoutSpec spec = project.layout();
                     return removePanoramas(spec) > 0 ? "on" : "off";
                   },
                   [](Project& project, const std::string& value) -> Status {
                     if (value != "on" && value != "off") return tl::unexpected(refused(value, "on or off"));
                     removePanoramas(project.layout());
                     if (value == "off") return {};
                     const auto added = addPanoramas(project.layout(), PanoramaPlaces::rings);
                     if (!added) return tl::unexpected(added.error());
                     return {};
                   },
                   tries({"on", "off"})});
}

void bakeKnobs(std::vector<Knob>& table) {
  table.push_back(numberKnob("samples-per-degree", "resolution of the captures", true,
                             [](Project & p) -> auto& { return p.bake.samplesPerDegree; },
                             {"4", "8", "12", "16"}));
  table.push_back(numberKnob("layers", "samples kept per pixel at most", true,
                             [](Project & p) -> auto& { return p.bake.maxLayers; }, {"1", "2", "4", "8"}));
  table.push_back(switchKnob(
      "pruning", "only what a test eye sees is kept", true,
      [](Project & p) -> auto& { return p.bake.pruning; }));
  table.push_back(numberKnob("test-eyes", "placed evenly in each region, that pruning asks", true,
                             [](Project & p) -> auto& { return p.bake.testEyes; }, {"2", "4", "8", "16"}));
  table.push_back(numberKnob("pruning-loss", "of what is seen, that pruning may lose; 0 = adds no eyes", true,
                             [](Project & p) -> auto& { return p.bake.pruningLoss; },
                             {"0", "0.0001", "0.002"}));
  table.push_back(numberKnob(
      "distance-shift", "samples that pictures may shift by as inverse distances are rounded; 0 = 16 bits",
      true, [](Project & p) -> auto& { return p.bake.distanceShift; }, {"0", "0.025", "0.4", "1.6"}));
  table.push_back(numberKnob("colour-quality", "how true captures' colours are; 100 = every bit", true,
                             [](Project & p) -> auto& { return p.bake.colourQuality; },
                             {"80", "90", "97", "100"}));
  table.push_back(numberKnob("shadow-rays", "per sample towards each light with a size", true,
                             [](Project & p) -> auto& { return p.bake.shadowRays; }, {"4", "16", "64"}));
  table.push_back(numberKnob("ambient-rays", "per place that light is gathered for", true,
                             [](Project & p) -> auto& { return p.bake.ambientRays; }, {"8", "32", "128"}));
  table.push_back(numberKnob("bounces", "of light between surfaces", true,
                             [](Project & p) -> auto& { return p.bake.bounces; }, {"1", "2", "4"}));
  table.push_back(numberKnob("surface-texel", "metres between light samples on near polygons", true,
                             [](Project & p) -> auto& { return p.bake.surfaceTexel; },
                             {"0.02", "0.04", "0.08"}));
}

std::vector<Knob> makeTable() {
  std::vector<Knob> table;
  viewKnobs(table);
  layoutKnobs(table);
  bakeKnobs(table);
  return table;
}

std::string namesOf() {
  std::vector<std::string> names;
  for (const Knob& knob : knobs()) names.push_back(knob.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// As the knob itself writes it: "8.0" is "8".
Result<std::string> normalised(const Knob& knob, const std::string& value, Project project) {
  if (Status set = knob.set(project, value); !set)
    return fail(set.error().kind, fmt::format("{}: {}", knob.name, set.error().message), "knob");
  return knob.value(project);
}

}  // namespace

std::span<const Knob> knobs() {
  static const std::vector<Knob> table = makeTable();
  return table;
}

Result<const Knob*> knobOf(const std::string& name) {
  const auto found = std::ranges::find(knobs(), name, &Knob::name);
  if (found == knobs().end())
    return fail(ErrorKind::notFound, fmt::format("there is no knob '{}'; there are {}", name, namesOf()),
                "knob");
  return &*found;
}

Result<SweepSetting> inOrder(SweepSetting setting, const Project& project) {
  SweepSetting ordered;
  for (KnobChoice& choice : setting) {
    const auto knob = knobOf(choice.knob);
    if (!knob) return tl::unexpected(knob.error());
    const auto value = normalised(**knob, choice.value, project);
    if (!value) return tl::unexpected(value.error());
    choice.value = *value;
  }
  for (const Knob& knob : knobs()) {
    const auto mine = std::ranges::count(setting, knob.name, &KnobChoice::knob);
    if (mine > 1)
      return fail(ErrorKind::invalidArgument, fmt::format("{} is given twice", knob.name), "knob");
    if (mine == 0) continue;
    const KnobChoice& choice = *std::ranges::find(setting, knob.name, &KnobChoice::knob);
    if (choice.value != knob.value(project)) ordered.push_back(choice);
  }
  return ordered;
}

Result<Project> applySetting(Project project, const SweepSetting& setting) {
  const auto ordered = inOrder(setting, project);
  if (!ordered) return tl::unexpected(ordered.error());
  for (const KnobChoice& choice : *ordered)
    if (Status set = (*knobOf(choice.knob))->set(project, choice.value); !set)
      return tl::unexpected(set.error());
  if (Status sound = project.check(); !sound) return tl::unexpected(sound.error());
  return project;
}

Result<KnobRange> parseKnobRange(const std::string& text, const Project& project) {
  const auto equals = text.find('=');
  const auto knob = knobOf(text.substr(0, equals));
  if (!knob) return tl::unexpected(knob.error());
  KnobRange range{*knob, {}};
  std::vector<std::string> given;
  if (equals == std::string::npos) {
    given = (*knob)->tried(project);
  } else {
    for (std::size_t from = equals + 1; from <= text.size();) {
      const std::size_t to = std::min(text.find('/', from), text.size());
      given.push_back(text.substr(from, to - from));
      from = to + 1;
    }
  }
  for (const std::string& value : given) {
    const auto sound = normalised(**knob, value, project);
    if (!sound) return tl::unexpected(sound.error());
    if (*sound != (*knob)->value(project) && std::ranges::find(range.values, *sound) == range.values.end())
      range.values.push_back(*sound);
  }
  return range;
}

Result<SweepSetting> presetOf(const std::filesystem::path& sweepFile, const std::string& name) {
  const auto text = readText(sweepFile);
  if (!text)
    return fail(text.error().kind, "has no presets: `acentric sweep` finds them", sweepFile.string());
  const auto presets = parsePresets(*text, sweepFile.string());
  if (!presets) return tl::unexpected(presets.error());
  std::vector<std::string> names;
  for (const SweepPreset& preset : *presets) {
    if (preset.name == name) return preset.setting;
    names.push_back(preset.name);
  }
  return fail(ErrorKind::notFound,
              names.empty() ? fmt::format("has no preset '{}': nothing was measured yet", name)
                            : fmt::format("has no preset '{}', but {}", name, fmt::join(names, ", ")),
              sweepFile.string());
}

std::filesystem::path sweepFolderFor(const std::filesystem::path& projectPath) {
  std::filesystem::path folder = captureFolderFor(projectPath);
  return folder.replace_extension(".sweep");
}

std::filesystem::path goalsFolderFor(const std::filesystem::path& projectPath) {
  std::filesystem::path folder = captureFolderFor(projectPath);
  return folder.replace_extension(".goals");
}

std::filesystem::path sweepFileOf(const std::filesystem::path& projectPath,
                                  const std::filesystem::path& from) {
  if (from.empty()) return sweepFolderFor(projectPath) / kSweepFile;
  std::error_code error;
  return std::filesystem::is_directory(from, error) ? from / kSweepFile : from;
}

}  // namespace acentric
