#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/base/json_text.h"
#include "engine/measure/csv_cell.h"
#include "engine/measure/sweep.h"

namespace acentric {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "acentric-sweep";
constexpr int kVersion = 1;

Json jsonOf(const Spread& spread) {
  return {{"median", spread.median},
          {"min", spread.min},
          {"max", spread.max},
          {"p99", spread.p99},
          {"count", spread.count}};
}
Spread spreadFrom(const Json& json) {
  return {json.at("min"), json.at("median"), json.at("p99"), json.at("max"), json.at("count")};
}

Json jsonOf(const SweepSetting& setting) {
  Json json = Json::object();
  for (const KnobChoice& choice : setting) json[choice.knob] = choice.value;
  return json;
}
SweepSetting settingFrom(const Json& json) {
  SweepSetting setting;
  for (const auto& [knob, value] : json.items()) setting.push_back({knob, value.get<std::string>()});
  return setting;
}

Json jsonOf(const SweepPoint& point) {
  Json json = {{"setting", jsonOf(point.setting)}};
  if (!point.measured()) {
    json["skipped"] = point.skipped;
    return json;
  }
  for (const char* group : {"errors", "costs"}) {
    json[group] = Json::object();
    for (const MeasureInfo& info : measures())
      if (info.error == (group[0] == 'e') && point[info.measure].count > 0)
        json[group][info.name] = jsonOf(point[info.measure]);
  }
  json["bakeEstimated"] = point.bakeEstimated;
  json["bakeKey"] = point.bakeKey;
  json["changedFrames"] = point.changedFrames;
  json["worstFrame"] = point.worstFrame;
  json["measureSeconds"] = point.measureSeconds;
  json["commit"] = point.commit;
  json["pictures"] = point.pictures;
  return json;
}
SweepPoint pointFrom(const Json& json) {
  SweepPoint point;
  point.setting = settingFrom(json.at("setting"));
  point.skipped = json.value("skipped", "");
  if (!point.measured()) return point;
  for (const MeasureInfo& info : measures()) {
    const Json& group = json.at(info.error ? "errors" : "costs");
    if (group.contains(info.name)) point[info.measure] = spreadFrom(group.at(info.name));
  }
  point.bakeEstimated = json.at("bakeEstimated");
  point.bakeKey = json.at("bakeKey");
  point.changedFrames = json.at("changedFrames");
  point.worstFrame = json.at("worstFrame");
  point.measureSeconds = json.at("measureSeconds");
  point.commit = json.value("commit", "unknown");
  point.pictures = json.at("pictures");
  return point;
}

Sweep sweepFrom(const Json& json) {
  Sweep sweep;
  sweep.version = json.at("programVersion");
  sweep.commit = json.value("commit", "unknown");
  sweep.project = json.at("project"), sweep.scene = json.at("scene"), sweep.path = json.at("path");
  sweep.processor = json.at("processor"), sweep.threads = json.at("threads");
  sweep.width = json.at("width"), sweep.height = json.at("height");
  sweep.frames = json.at("frames"), sweep.repeats = json.at("repeats");
  sweep.truthSamples = json.at("truthSamples");
  sweep.referenceMs = json.at("referenceMs");
  sweep.fingerprint = json.at("fingerprint");
  sweep.truthPictures = json.at("truthPictures");
  for (const Json& point : json.at("points")) sweep.points.push_back(pointFrom(point));
  if (json.contains("goals")) sweep.goals = goalsFrom(json.at("goals").get<std::map<std::string, double>>());
  if (json.contains("numerics")) {
    auto numerics = parseNumerics(jsonText(json.at("numerics")), "numerics");
    if (numerics) sweep.numerics = std::move(*numerics);
  }
  return sweep;
}

std::vector<SweepPreset> presetsFrom(const Json& json) {
  std::vector<SweepPreset> presets;
  for (const auto& [name, setting] : json.at("presets").items())
    presets.push_back({name, settingFrom(setting)});
  return presets;
}

template <class T>
Result<T> parse(const std::string& text, const std::string& where, T (*from)(const Json&)) {
  const auto parsed = parseJson<Json>(text, where);
  if (!parsed) return tl::unexpected(parsed.error());
  const Json& json = *parsed;
  try {
    if (json.at("format") != kFormat || json.at("version") != kVersion)
      return fail(ErrorKind::unsupported, "is no sweep that this version reads", where);
    return from(json);
  } catch (const nlohmann::json::exception& problem) {
    return fail(ErrorKind::malformed, fmt::format("is not a sweep's file: {}", problem.what()), where);
  }
}

}  // namespace

std::string toJson(const Sweep& sweep) {
  Json json = {{"format", kFormat},
               {"version", kVersion},
               {"programVersion", sweep.version},
               {"commit", sweep.commit},
               {"project", sweep.project},
               {"scene", sweep.scene},
               {"path", sweep.path},
               {"processor", sweep.processor},
               {"threads", sweep.threads},
               {"width", sweep.width},
               {"height", sweep.height},
               {"frames", sweep.frames},
               {"repeats", sweep.repeats},
               {"truthSamples", sweep.truthSamples},
               {"referenceMs", sweep.referenceMs},
               {"fingerprint", sweep.fingerprint},
               {"truthPictures", sweep.truthPictures},
               {"points", Json::array()},
               {"front", Json::array()},
               {"presets", Json::object()}};
  for (const SweepPoint& point : sweep.points) json["points"].push_back(jsonOf(point));
  for (const std::size_t i : frontOf(sweep)) json["front"].push_back(jsonOf(sweep.points[i].setting));
  for (const SweepPreset& preset : presetsOf(sweep)) json["presets"][preset.name] = jsonOf(preset.setting);
  if (sweep.goals) json["goals"] = numbersOf(*sweep.goals);
  if (!sweep.numerics.empty()) json["numerics"] = parseJson<Json>(toJson(sweep.numerics)).value_or(Json());
  return jsonText(json, 2) + "\n";
}

Result<Sweep> parseSweep(const std::string& json, const std::string& where) {
  return parse(json, where, sweepFrom);
}

Result<std::vector<SweepPreset>> parsePresets(const std::string& json, const std::string& where) {
  return parse(json, where, presetsFrom);
}

std::string toCsv(const Sweep& sweep) {
  std::string csv = "setting,skipped,front";
  for (const MeasureInfo& info : measures()) csv += fmt::format(",{0},{0}Min,{0}Max", info.name);
  csv += ",bakeEstimated,changedFrames\n";
  const std::vector<std::size_t> front = frontOf(sweep);
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const SweepPoint& point = sweep.points[i];
    csv += csvCell(textOf(point.setting)) + "," + csvCell(point.skipped) + "," +
           (std::ranges::find(front, i) != front.end() ? "1" : "0");
    for (const MeasureInfo& info : measures()) {
      const Spread& s = point[info.measure];
      csv += s.count > 0 ? fmt::format(",{},{},{}", s.median, s.min, s.max) : ",,,";
    }
    csv += fmt::format(",{},{}\n", point.bakeEstimated ? 1 : 0, point.changedFrames);
  }
  return csv;
}

}  // namespace acentric
