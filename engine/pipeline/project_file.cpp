/// Project <-> JSON. The schema is checked first (valijson), so that reading can rely on types and ranges.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/geometry/conventions.h"
#include "engine/pipeline/project.h"
#include "engine/pipeline/project_walks.h"
#include "engine/pipeline/schema_check.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxStoreyName = 100;
constexpr std::size_t kMaxProjectBytes = std::size_t(64) << 20;

const char* nameOf(UpAxis up) {
  switch (up) {
    case UpAxis::guess:
      return "guess";
    case UpAxis::y:
      return "y";
    case UpAxis::z:
      return "z";
  }
  return "guess";
}

const char* nameOf(Lighting lighting) {
  switch (lighting) {
    case Lighting::guess:
      return "guess";
    case Lighting::inTextures:
      return "inTextures";
    case Lighting::computed:
      return "computed";
  }
  return "guess";
}

Json toJson(const glm::dvec2& point) { return Json::array({point.x, point.y}); }
glm::dvec2 pointFrom(const Json& json) { return {json[0].get<double>(), json[1].get<double>()}; }

Json toJson(const CellId& cell) {
  Json address{cell.i, cell.j, cell.slot};
  if (cell.level != 0) address.push_back(cell.level);
  return address;
}

CellId cellFrom(const Json& json) {
  return {json[0].get<int>(), json[1].get<int>(), json[2].get<int>(),
          json.size() > 3 ? json[3].get<int>() : 0};
}

Json toJson(const std::set<CellId>& cells) {
  Json out = Json::array();
  for (const CellId& cell : cells) out.push_back(toJson(cell));
  return out;
}

std::set<CellId> cellsFrom(const Json& json) {
  std::set<CellId> out;
  for (const Json& cell : json) out.insert(cellFrom(cell));
  return out;
}

Json toJson(const std::map<CellId, double>& density) {
  Json out = Json::array();
  for (const auto& [cell, factor] : density) out.push_back({{"cell", toJson(cell)}, {"times", factor}});
  return out;
}

std::map<CellId, double> densityFrom(const Json& json) {
  std::map<CellId, double> out;
  for (const Json& each : json) out[cellFrom(each.at("cell"))] = each.at("times").get<double>();
  return out;
}

Json toJson(const std::map<int, Apv>& apvs) {
  Json out = Json::array();
  for (const auto& [number, apv] : apvs)
    out.push_back({{"number", number},
                   {"centre", toJson(apv.centre)},
                   {"offset", toJson(apv.offset)},
                   {"cameras", apv.cameraCount()},
                   {"hand", apv.hand == Hand::clockwise ? "clockwise" : "counterClockwise"}});
  return out;
}

std::map<int, Apv> apvsFrom(const Json& json) {
  std::map<int, Apv> out;
  for (const Json& apv : json) {
    const int number = apv.at("number").get<int>();
    const bool clockwise = apv.value("hand", "counterClockwise") == "clockwise";
    const Apv value{pointFrom(apv.at("centre")), pointFrom(apv.at("offset")),
                    360.0 / apv.at("cameras").get<int>(),
                    clockwise ? Hand::clockwise : Hand::counterClockwise};
    if (!out.emplace(number, value).second)
      throw std::runtime_error(fmt::format("freeApvs: two of them have the number {}", number));
  }
  return out;
}

Json toJson(const Outline& outline) {
  Json loops = Json::array();
  for (const auto& loop : outline.loops) {
    Json corners = Json::array();
    for (const auto& corner : loop) corners.push_back(toJson(corner));
    loops.push_back(std::move(corners));
  }
  return loops;
}

Json toJson(const LayoutSpec& spec) {
  Json json{{"configuration", nameOf(spec.configuration)},
            {"cellSize", spec.cellSize},
            {"latticeOrigin", toJson(spec.latticeOrigin)},
            {"rotationDegrees", tidyDegrees(spec.rotationRadians)},
            {"floorHeight", spec.floorHeight},
            {"eyeHeight", spec.eyeHeight},
            {"nearBand", spec.nearBand},
            {"outline", toJson(spec.outline)},
            {"added", toJson(spec.added)},
            {"removed", toJson(spec.removed)},
            {"split", toJson(spec.split)},
            {"freeApvs", toJson(spec.freeApvs)}};
  if (!spec.density.empty()) json["density"] = toJson(spec.density);
  if (spec.slope) json["slope"] = {{"at", toJson(spec.slope->at)}, {"rise", toJson(spec.slope->rise)}};
  return json;
}

template <class T>
void read(const Json& json, const char* key, T& value) {
  if (const auto found = json.find(key); found != json.end()) value = found->get<T>();
}

Outline outlineFrom(const Json& json) {
  Outline outline;
  for (const Json& loop : json) {
    outline.loops.emplace_back();
    for (const Json& corner : loop) outline.loops.back().push_back(pointFrom(corner));
  }
  return outline;
}

LayoutSpec layoutFrom(const Json& json) {
  LayoutSpec spec;
  spec.configuration = *parseConfiguration(json.at("configuration").get<std::string>());
  read(json, "cellSize", spec.cellSize);
  if (json.contains("latticeOrigin")) spec.latticeOrigin = pointFrom(json["latticeOrigin"]);
  double rotationDegrees = 0;
  read(json, "rotationDegrees", rotationDegrees);
  spec.rotationRadians = radians(rotationDegrees);
  read(json, "floorHeight", spec.floorHeight);
  read(json, "eyeHeight", spec.eyeHeight);
  read(json, "nearBand", spec.nearBand);
  if (const auto slope = json.find("slope"); slope != json.end())
    spec.slope = GroundSlope{pointFrom(slope->at("at")), pointFrom(slope->at("rise"))};
  if (json.contains("outline")) spec.outline = outlineFrom(json["outline"]);
  if (json.contains("added")) spec.added = cellsFrom(json["added"]);
  if (json.contains("removed")) spec.removed = cellsFrom(json["removed"]);
  if (json.contains("split")) spec.split = cellsFrom(json["split"]);
  if (json.contains("freeApvs")) spec.freeApvs = apvsFrom(json["freeApvs"]);
  if (json.contains("density")) spec.density = densityFrom(json["density"]);
  return spec;
}

Json toJson(const Storey& storey) {
  Json json{{"name", storey.name}, {"layout", toJson(storey.layout)}};
  if (!storey.walkable.empty()) json["walkable"] = toJson(storey.walkable);
  if (storey.spawn.stored)
    json["spawn"] = {{"position", toJson(storey.spawn.position)},
                     {"yawDegrees", tidyDegrees(storey.spawn.yawRadians)}};
  return json;
}

Storey storeyFrom(const Json& json, std::string name) {
  Storey storey{std::move(name), layoutFrom(json.at("layout")), {{}, 0, false}, {}};
  if (const auto spawn = json.find("spawn"); spawn != json.end())
    storey.spawn = {pointFrom(spawn->at("position")), radians(spawn->value("yawDegrees", 0.0)), true};
  if (json.contains("walkable")) storey.walkable = outlineFrom(json["walkable"]);
  return storey;
}

/// A file may give its only layout without a list of storeys.
std::vector<Storey> storeysFrom(const Json& json) {
  if (!json.contains("storeys")) return {storeyFrom(json, "floor")};
  std::vector<Storey> storeys;
  for (const Json& storey : json["storeys"])
    storeys.push_back(storeyFrom(storey, storey.at("name").get<std::string>()));
  return storeys;
}

void readImport(const Json& json, ImportOptions& options) {
  read(json, "metresPerUnit", options.metresPerUnit);
  read(json, "defaultLight", options.defaultLight);
  const std::string up = json.value("up", "guess");
  options.up = up == "y" ? UpAxis::y : up == "z" ? UpAxis::z : UpAxis::guess;
  const std::string lighting = json.value("lighting", "guess");
  options.lighting = lighting == "inTextures" ? Lighting::inTextures
                     : lighting == "computed" ? Lighting::computed
                                              : Lighting::guess;
}

void readView(const Json& json, Project& project) {
  project.view.renderer = *parseRenderer(rendererNow(json.value("renderer", nameOf(project.view.renderer))));
  project.view.reconstruction = *parseReconstruction(
      reconstructionNow(json.value("reconstruction", nameOf(project.view.reconstruction))));
  read(json, "maxSplatPixels", project.view.maxSplatPixels);
  read(json, "localGeometry", project.view.localGeometry);
  read(json, "secondaryCover", project.view.secondaryCover);
  read(json, "fillHoles", project.view.fillHoles);
  read(json, "fovDegrees", project.fovDegrees);
  read(json, "exposure", project.exposure);
}

Project projectFrom(const Json& json) {
  Project project;
  project.scene = json.at("scene").get<std::string>();
  if (json.contains("import")) readImport(json["import"], project.import);
  if (json.contains("effects"))
    for (int i = 0; i < kEffectCount; ++i)
      if (const auto found = json["effects"].find(nameOf(Effect(i))); found != json["effects"].end())
        project.effects[Effect(i)] = found->get<bool>();
  project.storeys = storeysFrom(json);
  if (json.contains("storey")) {
    const auto found = std::ranges::find(project.storeys, json["storey"].get<std::string>(), &Storey::name);
    if (found == project.storeys.end()) throw std::runtime_error("/storey: names none of the storeys");
    project.storey = int(found - project.storeys.begin());
  }
  if (json.contains("bake")) {
    read(json["bake"], "samplesPerDegree", project.bake.samplesPerDegree);
    read(json["bake"], "ambientRays", project.bake.ambientRays);
    read(json["bake"], "ambientRadius", project.bake.ambientRadius);
    read(json["bake"], "shadowRays", project.bake.shadowRays);
    read(json["bake"], "bounces", project.bake.bounces);
    read(json["bake"], "surfaceTexel", project.bake.surfaceTexel);
    read(json["bake"], "maxLayers", project.bake.maxLayers);
    read(json["bake"], "pruning", project.bake.pruning);
    read(json["bake"], "testEyes", project.bake.testEyes);
    read(json["bake"], "pruningLoss", project.bake.pruningLoss);
    read(json["bake"], "eyeRange", project.bake.eyeRange);
    read(json["bake"], "distanceShift", project.bake.distanceShift);
    read(json["bake"], "colourQuality", project.bake.colourQuality);
  }
  if (json.contains("budget")) {
    read(json["budget"], "trianglesPerRegion", project.budget.trianglesPerRegion);
    read(json["budget"], "maxErrorMetres", project.budget.maxErrorMetres);
    read(json["budget"], "simplify", project.budget.simplify);
  }
  if (json.contains("view")) readView(json["view"], project);
  readWalks(json, project);
  return project;
}

/// Arrays that hold only numbers (points, cells) on one line each: files stay short and diff point by point.
std::string withShortArraysOnOneLine(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (inString && text[i] == '\\') {  // an escape: the next character ends no string
      out.append(text, i++, 2);
      continue;
    }
    if (text[i] == '"') inString = !inString;
    const bool opens = !inString && text[i] == '[';
    const std::size_t close =
        opens ? text.find_first_not_of("0123456789+-.eE, \n", i + 1) : std::string::npos;
    if (close == std::string::npos || text[close] != ']') {
      out += text[i];
      continue;
    }
    for (; i < close; ++i)
      if (text[i] != '\n' && text[i] != ' ')
        out += text[i] == ',' ? std::string(", ") : std::string(1, text[i]);
    out += ']';
  }
  return out;
}

Status checkStoreys(const Project& project) {
  const std::vector<Storey>& storeys = project.storeys;
  if (storeys.empty() || storeys.size() > std::size_t(kMaxStoreys))
    return fail(ErrorKind::malformed,
                fmt::format("/storeys: there must be 1 to {} storeys, not {}", kMaxStoreys, storeys.size()));
  if (project.storey < 0 || project.storey >= int(storeys.size()))
    return fail(ErrorKind::malformed, fmt::format("/storey: there is no storey {}", project.storey));
  for (std::size_t s = 0; s < storeys.size(); ++s) {
    const auto refuse = [&](std::string_view what) {
      return fail(ErrorKind::malformed, fmt::format("/storeys/{}{}", s, what));
    };
    const Storey& storey = storeys[s];
    if (storey.name.empty() || storey.name.size() > kMaxStoreyName)
      return refuse(fmt::format("/name: must have 1 to {} bytes", kMaxStoreyName));
    if (std::ranges::count(storeys, storey.name, &Storey::name) > 1)
      return refuse(fmt::format("/name: '{}' is the name of another storey too", storey.name));
    if (const Status sound = storey.layout.check(); !sound)
      return refuse("/layout: " + sound.error().message);
    if (const Status sound = checkOutline(storey.walkable); !sound)
      return refuse("/walkable: " + sound.error().message);
    if (!std::isfinite(storey.spawn.position.x) || !std::isfinite(storey.spawn.position.y) ||
        !std::isfinite(storey.spawn.yawRadians))
      return refuse("/spawn: must hold finite numbers");
  }
  return {};
}

Status checkScene(const fs::path& scene) {
  if (scene.empty()) return fail(ErrorKind::malformed, "/scene: names no model file");
  if (scene.native().find('\0') != std::string::npos)
    return fail(ErrorKind::malformed, "/scene: holds a NUL character, which no file name does");
  if (!isUtf8(scene.native()))
    return fail(ErrorKind::malformed,
                "/scene: the name of the model is not UTF-8, and a project file cannot state it; rename the "
                "model");
  if (!liesWithin(scene))
    return fail(
        ErrorKind::malformed,
        fmt::format("/scene: {} leaves the project's folder; `acentric collect PROJECT` brings the model "
                    "into it",
                    scene.string()));
  return {};
}

}  // namespace

bool liesWithin(const fs::path& scene) {
  return scene.is_relative() && std::ranges::find(scene, "..") == scene.end();
}

Status TriangleBudget::check() const {
  if (trianglesPerRegion < 0)
    return fail(ErrorKind::malformed, "/budget/trianglesPerRegion: must be 0 (no limit) or more");
  if (!(maxErrorMetres > 0 && maxErrorMetres <= 10))
    return fail(ErrorKind::malformed, "/budget/maxErrorMetres: must lie above 0 and up to 10");
  return {};
}

Status Project::check() const {
  for (const Status& part : {checkScene(scene), import.check(), checkStoreys(*this), bake.check(),
                             budget.check(), view.check(), checkWalks(*this)})
    if (!part) return part;
  if (!(fovDegrees >= 1 && fovDegrees <= 179))
    return fail(ErrorKind::malformed, "/view/fovDegrees: must lie in 1..179");
  if (!(exposure > 0 && std::isfinite(exposure)))
    return fail(ErrorKind::malformed, "/view/exposure: must be a positive number");
  return {};
}

std::string formatProject(const Project& project) {
  Json effects = Json::object();
  for (const auto& [effect, on] : project.effects) effects[nameOf(effect)] = on;
  Json storeys = Json::array();
  for (const Storey& storey : project.storeys) storeys.push_back(toJson(storey));
  Json json = {
      {"format", "acentric-project"},
      {"version", 1},
      {"scene", project.scene.generic_string()},
      {"import",
       {{"metresPerUnit", project.import.metresPerUnit},
        {"up", nameOf(project.import.up)},
        {"defaultLight", project.import.defaultLight},
        {"lighting", nameOf(project.import.lighting)}}},
      {"effects", std::move(effects)},
      {"storeys", std::move(storeys)},
      {"storey", project.storeys[std::size_t(project.storey)].name},
      {"bake",
       {{"samplesPerDegree", project.bake.samplesPerDegree},
        {"ambientRays", project.bake.ambientRays},
        {"ambientRadius", project.bake.ambientRadius},
        {"shadowRays", project.bake.shadowRays},
        {"bounces", project.bake.bounces},
        {"surfaceTexel", project.bake.surfaceTexel},
        {"maxLayers", project.bake.maxLayers},
        {"pruning", project.bake.pruning},
        {"testEyes", project.bake.testEyes},
        {"pruningLoss", project.bake.pruningLoss},
        {"eyeRange", project.bake.eyeRange},
        {"distanceShift", project.bake.distanceShift},
        {"colourQuality", project.bake.colourQuality}}},
      {"budget",
       {{"trianglesPerRegion", project.budget.trianglesPerRegion},
        {"maxErrorMetres", project.budget.maxErrorMetres},
        {"simplify", project.budget.simplify}}},
      {"view",
       {{"renderer", nameOf(project.view.renderer)},
        {"reconstruction", nameOf(project.view.reconstruction)},
        {"maxSplatPixels", project.view.maxSplatPixels},
        {"localGeometry", project.view.localGeometry},
        {"secondaryCover", project.view.secondaryCover},
        {"fillHoles", project.view.fillHoles},
        {"fovDegrees", project.fovDegrees},
        {"exposure", std::stod(fmt::format("{}", project.exposure))}}}};  // the shortest decimal of the float
  addWalks(project, json);
  return withShortArraysOnOneLine(jsonText(json, 2)) + "\n";
}

Result<Project> parseProject(const std::string& text, const std::string& where) {
  const auto parsed = parseJson<Json>(text, where);
  if (!parsed) return tl::unexpected(parsed.error());
  const Json& json = *parsed;
  try {
    if (json.is_object() && json.value("format", Json()) == "acentric-project" && json.contains("version") &&
        json["version"].is_number_integer() && json["version"].get<std::int64_t>() > 1)
      return fail(ErrorKind::unsupported,
                  fmt::format("/version: {} was written by a newer Acentric; this one reads version 1",
                              json["version"].get<std::int64_t>()),
                  where);
    // In words that lead on; the schema says no more than that it is not allowed.
    if (json.is_object() && json.contains("scene") && json["scene"].is_string())
      if (const Status within = checkScene(json["scene"].get<std::string>()); !within)
        return fail(ErrorKind::malformed, within.error().message, where);
    if (const Status valid = checkSchema(json, projectSchema(), where); !valid)
      return tl::unexpected(valid.error());
    Project project = projectFrom(json);
    if (Status sound = project.check(); !sound) {
      Error error = sound.error();
      error.message = error.describe();
      error.where = where;
      return tl::unexpected(std::move(error));
    }
    return project;
  } catch (const nlohmann::json::exception& problem) {
    return fail(ErrorKind::malformed, fmt::format("is not JSON that can be read: {}", problem.what()), where);
  } catch (const std::exception& problem) {
    return fail(ErrorKind::malformed, problem.what(), where);
  }
}

Result<Project> loadProject(const fs::path& path) {
  const auto text = readText(path, kMaxProjectBytes);
  if (!text) return tl::unexpected(text.error());
  return parseProject(*text, path.string());
}

Status saveProject(const Project& project, const fs::path& path) {
  if (Status sound = project.check(); !sound) return sound;
  return writeTextAtomically(path, formatProject(project));
}

fs::path captureFolderFor(const fs::path& projectPath) {
  std::string name = projectPath.filename().string();
  for (const std::string_view ending : {".acentric.json", ".json"})
    if (name.size() > ending.size() && name.ends_with(ending)) {
      name.resize(name.size() - ending.size());
      break;
    }
  return projectPath.parent_path() / (name + ".captures");
}

}  // namespace acentric
