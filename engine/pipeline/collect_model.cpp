#include "engine/pipeline/collect_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/file.h"
#include "engine/base/folder.h"
#include "engine/base/json_text.h"
#include "engine/base/link_file.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

/// Tells models of one name apart: as many as nobody has in a project.
constexpr int kMostPlaces = 1000;

fs::path absoluteOf(const fs::path& file) {
  std::error_code error;
  const fs::path absolute = fs::absolute(file, error);
  return (error ? file : absolute).lexically_normal();
}

fs::path canonicalOf(const fs::path& file) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(file, error);
  return error ? absoluteOf(file) : canonical;
}

/// A file and where it comes to lie in the collected folder.
struct Move {
  fs::path from, to;
};

/// As what nobody means to share is named.
bool hidden(const fs::path& part) { return part.native().starts_with('.') && part != ".." && part != "."; }

/// A model may name files beside its folder ("../textures/x.png"): then its folder keeps its name.
std::vector<Move> movesOf(const std::vector<fs::path>& files, std::vector<fs::path>& left) {
  const fs::path folder = files.front().parent_path();
  std::vector<Move> moves;
  bool beside = false;
  for (const fs::path& file : files) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) continue;  // looked for, and not found
    const fs::path relative = file.lexically_normal().lexically_relative(folder);
    const auto ups = std::ranges::count(relative, "..");
    if (relative.empty() || ups > 1 || std::ranges::any_of(relative, hidden)) {
      left.push_back(file);
      continue;
    }
    beside = beside || ups == 1;
    moves.push_back({file, relative});
  }
  if (beside)
    for (Move& move : moves) move.to = (folder.filename() / move.to).lexically_normal();
  return moves;
}

bool sameContent(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  if (fs::file_size(a, error) != fs::file_size(b, error) || error) return false;
  const auto one = hashFile(a), other = hashFile(b);
  return one && other && *one == *other;
}

/// Is a link to the model all that lies there? Then its files may take the place.
bool holdsOnlyLinkTo(const fs::path& model, const fs::path& folder) {
  std::error_code error;
  const auto entries = std::distance(fs::directory_iterator(folder, error), fs::directory_iterator());
  return !error && entries == 1 && fs::read_symlink(folder / model.filename(), error) == model && !error;
}

Status place(const Move& move, const fs::path& folder) {
  std::error_code error;
  const fs::path to = folder / move.to;
  fs::create_directories(to.parent_path(), error);
  return linkOrCopyFile(move.from, to);
}

struct Place {
  fs::path folder;
  bool holdsIt = false;  ///< there is nothing to bring
};

/// models/NAME, models/NAME-2 ... below the project: the first that is free, holds the model, or may be
/// replaced.
template <class Holds, class Replaceable>
Result<Place> placeFor(const fs::path& model, const fs::path& projectFolder, const Holds& holds,
                       const Replaceable& replaceable) {
  const std::string name = model.stem().string();
  for (int number = 1; number <= kMostPlaces; ++number) {
    const fs::path place =
        projectFolder / "models" / (number == 1 ? name : fmt::format("{}-{}", name, number));
    std::error_code error;
    if (!fs::exists(fs::symlink_status(place, error))) return Place{place};
    if (holds(place)) return Place{place, true};
    if (replaceable(place)) return Place{place};
  }
  return fail(ErrorKind::invalidArgument, "there are too many models of this name",
              (projectFolder / "models").string());
}

Result<CollectedModel> collectFiles(const std::vector<fs::path>& files, const fs::path& projectFolder) {
  CollectedModel collected;
  const std::vector<Move> moves = movesOf(files, collected.left);
  if (moves.empty()) return fail(ErrorKind::notFound, "is not there any more", files.front().string());
  const auto there = [&](const fs::path& folder) {
    return std::ranges::all_of(moves, [&](const Move& m) {
      std::error_code error;
      return !fs::is_symlink(folder / m.to, error) && sameContent(m.from, folder / m.to);
    });
  };
  // Where a project has a link to the model its files take that place, under the same name.
  const bool plain = !moves.front().to.has_parent_path();
  const auto at = placeFor(files.front(), projectFolder, there, [&](const fs::path& place) {
    return plain && holdsOnlyLinkTo(files.front(), place);
  });
  if (!at) return tl::unexpected(at.error());
  collected.scene = (at->folder / moves.front().to).lexically_relative(projectFolder);
  if (at->holdsIt) return collected;
  std::error_code error;
  for (const Move& move : moves) collected.bytes += fs::file_size(move.from, error);
  collected.files = moves.size();
  collected.folder = at->folder;
  const Status written = replaceFolderAtomically(at->folder, [&](const fs::path& temporary) -> Status {
    for (const Move& move : moves)
      if (Status placed = place(move, temporary); !placed) return placed;
    return {};
  });
  if (!written) return tl::unexpected(written.error());
  return collected;
}

Result<CollectedModel> collectLink(const fs::path& model, const fs::path& projectFolder) {
  CollectedModel collected;
  const auto at = placeFor(
      model, projectFolder, [&](const fs::path& place) { return holdsOnlyLinkTo(model, place); },
      [](const fs::path&) { return false; });
  if (!at) return tl::unexpected(at.error());
  collected.scene = (at->folder / model.filename()).lexically_relative(projectFolder);
  if (at->holdsIt) return collected;
  collected.folder = at->folder;
  const Status written = replaceFolderAtomically(at->folder, [&](const fs::path& temporary) -> Status {
    std::error_code error;
    fs::create_symlink(model, temporary / model.filename(), error);
    if (error)
      return fail(ErrorKind::unreadable, "a link to the model cannot be made: " + error.message(),
                  at->folder.string());
    return {};
  });
  if (!written) return tl::unexpected(written.error());
  return collected;
}

/// The JSON of a project file, and the scene it states; null where it is none.
Result<std::pair<Json, fs::path>> statedScene(const fs::path& projectFile) {
  const auto text = readText(projectFile);
  if (!text) return tl::unexpected(text.error());
  Json json = parseJson<Json>(*text).value_or(Json());
  const bool sound = json.is_object() && json.value("format", Json()) == "acentric-project" &&
                     json.contains("scene") && json["scene"].is_string();
  fs::path scene = sound ? fs::path(json["scene"].get<std::string>()) : fs::path();
  return std::pair(std::move(json), std::move(scene));
}

}  // namespace

Result<fs::path> scenePathFor(const fs::path& model, const fs::path& projectFile) {
  const fs::path lies = absoluteOf(model), folder = absoluteOf(projectFile).parent_path();
  // As the paths are written, so that a link in the folder counts as lying there; then where the folders are.
  for (const fs::path& relative :
       {lies.lexically_relative(folder),
        (canonicalOf(lies.parent_path()) / lies.filename()).lexically_relative(canonicalOf(folder))})
    if (liesWithin(relative)) return relative;
  return fail(ErrorKind::invalidArgument, "lies outside the project's folder, " + folder.string(),
              model.string());
}

Result<CollectedModel> collectModel(const fs::path& model, const fs::path& projectFile,
                                    const std::vector<fs::path>& files, Collect how) {
  if (const auto within = scenePathFor(model, projectFile)) return CollectedModel{*within, {}, 0, 0, {}};
  std::error_code error;
  if (!fs::is_regular_file(model, error))
    return fail(ErrorKind::notFound, "no such model file", model.string());
  const fs::path folder = absoluteOf(projectFile).parent_path();
  if (how == Collect::link) return collectLink(canonicalOf(model), folder);
  if (files.empty())
    return fail(
        ErrorKind::unreadable,
        "what files it names is not known, since imports cannot be kept: link to it, or bring it into "
        "the project's folder yourself",
        model.string());
  return collectFiles(files, folder);
}

Result<CollectedModel> collectModel(const fs::path& model, const fs::path& projectFile,
                                    const ImportOptions& import, Collect how, const ImportHost& host,
                                    const Progress& progress, std::stop_token stop) {
  std::vector<fs::path> files;
  if (how == Collect::files && !scenePathFor(model, projectFile)) {
    if (const auto scene = importScene(model, import, host, progress, stop); !scene)
      return tl::unexpected(scene.error());
    if (progress) progress({0, 0, "bringing the model into the project's folder"});
    files = importedFiles(model, import, host);
  }
  return collectModel(model, projectFile, files, how);
}

std::optional<fs::path> sceneOutside(const fs::path& projectFile) {
  const auto stated = statedScene(projectFile);
  if (!stated || stated->second.empty() || liesWithin(stated->second)) return std::nullopt;
  return stated->second;
}

Result<CollectedModel> collectProject(const fs::path& projectFile, Collect how, const ImportHost& host,
                                      const Progress& progress, std::stop_token stop) {
  auto stated = statedScene(projectFile);
  if (!stated) return tl::unexpected(stated.error());
  auto& [json, scene] = *stated;
  if (!scene.empty()) json["scene"] = "model";  // any that is allowed
  auto project = parseProject(jsonText(json), projectFile.string());
  if (!project) return tl::unexpected(project.error());

  fs::path model = (absoluteOf(projectFile).parent_path() / scene).lexically_normal();
  const fs::path target = canonicalOf(model);
  if (how == Collect::files && !scenePathFor(target, projectFile)) model = target;  // where a link leads
  const auto collected = collectModel(model, projectFile, project->import, how, host, progress, stop);
  if (!collected) return tl::unexpected(collected.error());
  project->scene = collected->scene;
  if (collected->scene != scene)
    if (Status saved = saveProject(*project, projectFile); !saved) return tl::unexpected(saved.error());
  return collected;
}

}  // namespace acentric
