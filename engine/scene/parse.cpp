#include "engine/scene/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "engine/scene/finish_scene.h"
#include "engine/scene/source_scene.h"

namespace acentric {
namespace {

bool isGltf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (extension == ".gltf" || extension == ".glb" || extension == ".vrm") return true;
  std::array<char, 4> magic{};
  std::ifstream(path, std::ios::binary).read(magic.data(), magic.size());
  return std::string_view(magic.data(), magic.size()) == "glTF";
}

Result<SceneFile> parseUnguarded(const std::filesystem::path& path, const ImportOptions& options,
                                 const Progress& progress, std::uint64_t memoryBytes) {
  if (auto status = options.check(); !status) return tl::unexpected(status.error());
  std::error_code error;
  const auto type = std::filesystem::status(path, error).type();
  if (type == std::filesystem::file_type::not_found) return fail(ErrorKind::notFound, "does not exist");
  if (type == std::filesystem::file_type::directory)
    return fail(ErrorKind::invalidArgument, "is a folder; name the model file in it");
  if (type != std::filesystem::file_type::regular)
    return fail(ErrorKind::unreadable, "is not a regular file");
  if (std::filesystem::file_size(path, error) == 0) return fail(ErrorKind::malformed, "is empty");

  References references(path, options.outsideFiles);
  const ReadContext context{path, references, progress, memoryBytes};
  auto source = isGltf(path) ? readGltf(context) : readWithAssimp(context);
  if (!source) return tl::unexpected(source.error());
  if (Status fits = checkRoom(source->indexCount / 3, memoryBytes); !fits)
    return tl::unexpected(fits.error());
  auto scene = finishScene(std::move(*source), path.stem().string(), options, progress);
  if (!scene) return tl::unexpected(scene.error());
  auto dependencies = references.dependencies();
  if (!dependencies) return tl::unexpected(dependencies.error());
  return SceneFile{std::move(*scene), std::move(*dependencies)};
}

}  // namespace

Result<SceneFile> parseModel(const std::filesystem::path& path, const ImportOptions& options,
                             const Progress& progress, std::uint64_t memoryBytes) {
  Result<SceneFile> result = [&]() -> Result<SceneFile> {
    try {
      return parseUnguarded(path, options, progress, memoryBytes);
    } catch (const std::bad_alloc&) {
      return fail(ErrorKind::outOfSpace, "needs more memory than there is");
    } catch (const std::length_error&) {
      return fail(ErrorKind::malformed, "states an absurd size");
    } catch (const std::exception& error) {
      return fail(ErrorKind::malformed, std::string("cannot be read: ") + error.what());
    }
  }();
  if (!result && result.error().where.empty()) result.error().where = path.string();
  if (!result && result.error().where != path.string()) {  // a file that the model names
    result.error().message = result.error().where + ": " + result.error().message;
    result.error().where = path.string();
  }
  return result;
}

Result<Scene> parseScene(const std::filesystem::path& path, const ImportOptions& options) {
  auto parsed = parseModel(path, options, {});
  if (!parsed) return tl::unexpected(parsed.error());
  return std::move(parsed->scene);
}

}  // namespace acentric
