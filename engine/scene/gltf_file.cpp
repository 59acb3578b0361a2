#include "engine/scene/gltf_file.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <type_traits>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/scene/gltf_compression.h"
#include "engine/scene/gltf_extensions.h"

namespace acentric {
namespace {

std::string oneLine(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() > 300 ? text.substr(0, 300) + "..." : text;
}

/// What tinygltf's callbacks need. Its own reading of files would follow any path.
struct FileAccess {
  const ReadContext* context = nullptr;
  ReportLines* ignored = nullptr;
  std::optional<Error> refused;                    ///< the first file that may not be read
  std::map<std::string, std::size_t> bufferBytes;  ///< declared length by URI as tinygltf asks for it
};

/// tinygltf joins base folder and name; we hand it an empty base folder, and it tries "./name" as well.
std::string nameOf(const std::string& asked) {
  return std::filesystem::path(asked).lexically_normal().string();
}

bool fileExists(const std::string& asked, void* user) {
  FileAccess& access = *static_cast<FileAccess*>(user);
  const auto found = access.context->references.find(nameOf(asked));
  if (!found) {
    access.ignored->add(fmt::format("file {}: {}", nameOf(asked), found.error().message));
    if (found.error().kind == ErrorKind::unsupported && !access.refused) access.refused = found.error();
  }
  return found.has_value();
}

std::string expandNothing(const std::string& path, void*) { return path; }

bool readWholeFile(std::vector<unsigned char>* out, std::string* error, const std::string& asked,
                   void* user) {
  FileAccess& access = *static_cast<FileAccess*>(user);
  const auto bytes = access.context->references.read(nameOf(asked), std::size_t(4) << 30);
  if (!bytes) {
    if (error) *error = bytes.error().describe();
    return false;
  }
  std::size_t size = bytes->size();
  // A buffer file may be longer than the buffer (padding); tinygltf wants it exact.
  const auto declared = access.bufferBytes.find(nameOf(asked));
  if (declared != access.bufferBytes.end()) size = std::min(size, declared->second);
  out->resize(size);
  if (size > 0) std::memcpy(out->data(), bytes->data(), size);
  return true;
}

/// Keeps the bytes of image files and data URIs. Those in buffer views are read later, with bounds checks.
bool keepImageBytes(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                    const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

std::string percentDecoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = 0;
    if (text[i] == '%' && i + 2 < text.size() && std::isxdigit(static_cast<unsigned char>(text[i + 1])) &&
        std::isxdigit(static_cast<unsigned char>(text[i + 2]))) {
      code = unsigned(std::stoi(std::string(text.substr(i + 1, 2)), nullptr, 16));
      out += char(code);
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

struct GltfText {
  std::string_view json;
  bool binary = false;
};

Result<GltfText> jsonOf(std::span<const std::byte> bytes) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!all.starts_with("glTF")) return GltfText{all, false};
  const auto word = [&](std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, all.data() + at, sizeof value);
    return value;
  };
  if (all.size() < 20) return malformed("is cut off inside the GLB header");
  if (word(4) != 2)
    return fail(ErrorKind::unsupported, fmt::format("is GLB version {}; only version 2 is played", word(4)));
  const std::size_t length = word(12);
  if (length > all.size() - 20) return malformed("is cut off inside the GLB's JSON chunk");
  return GltfText{all.substr(20, length), true};
}

/// A look at the JSON before tinygltf: syntax with a position, version, required extensions, buffer lengths.
Result<nlohmann::json> checkJson(std::string_view text, FileAccess& access) {
  auto parsed = parseJson(text);
  if (!parsed) return malformed(oneLine(parsed.error().message));
  const nlohmann::json& json = *parsed;
  if (!json.is_object()) return malformed("is not a glTF file: its JSON is not an object");
  const auto asset = json.find("asset");
  if (asset == json.end() || !asset->is_object() || !asset->contains("version") ||
      !(*asset)["version"].is_string())
    return malformed("is not a glTF 2.0 file: asset.version is missing");
  const auto version = [&](const char* key) {
    return asset->contains(key) && (*asset)[key].is_string() ? (*asset)[key].get<std::string>()
                                                             : std::string();
  };
  const std::string minVersion = version("minVersion");
  if (!minVersion.empty() && minVersion != "2.0" && !minVersion.starts_with("1."))
    return fail(ErrorKind::unsupported, fmt::format("needs glTF {}; version 2.0 is played", minVersion));
  if (minVersion.empty() && !version("version").starts_with("2."))
    return fail(ErrorKind::unsupported, fmt::format("is glTF {}; version 2.0 is played", version("version")));
  if (const auto buffers = json.find("buffers"); buffers != json.end() && buffers->is_array())
    for (const auto& buffer : *buffers)
      if (buffer.is_object() && buffer.contains("uri") && buffer["uri"].is_string() &&
          buffer.contains("byteLength") && buffer["byteLength"].is_number_unsigned()) {
        const std::string uri = buffer["uri"].get<std::string>();
        if (!uri.starts_with("data:"))
          access.bufferBytes[nameOf(percentDecoded(uri))] = buffer["byteLength"].get<std::size_t>();
      }
  return parsed;
}

/// The member of an object, or the element of an array, of that name or number; null where there is none.
template <class Key>
const nlohmann::json& partOf(const nlohmann::json& whole, const Key& key) {
  static const nlohmann::json kNone;
  if constexpr (std::is_integral_v<Key>)
    return whole.is_array() && key < whole.size() ? whole[key] : kNone;
  else
    return whole.is_object() && whole.contains(key) ? whole[key] : kNone;
}

std::size_t numberOf(const nlohmann::json& json) {
  return json.is_number_unsigned() ? json.get<std::size_t>() : std::numeric_limits<std::size_t>::max();
}

/// Of meshes that nodes show, each counted once, by what the file says of them.
std::uint64_t triangleCount(const nlohmann::json& json) {
  std::set<std::size_t> shown;
  for (const auto& node : partOf(json, "nodes")) shown.insert(numberOf(partOf(node, "mesh")));
  std::uint64_t triangles = 0;
  for (const std::size_t mesh : shown)
    for (const auto& primitive : partOf(partOf(partOf(json, "meshes"), mesh), "primitives")) {
      const auto& indices = partOf(primitive, "indices");
      const auto& corners = indices.is_null() ? partOf(partOf(primitive, "attributes"), "POSITION") : indices;
      const std::size_t count =
          numberOf(partOf(partOf(partOf(json, "accessors"), numberOf(corners)), "count"));
      const bool isRow = numberOf(partOf(primitive, "mode")) != TINYGLTF_MODE_TRIANGLES &&
                         !partOf(primitive, "mode").is_null();
      if (count <= std::numeric_limits<std::uint32_t>::max()) triangles += isRow ? count : count / 3;
    }
  return triangles;
}

/// The file with other JSON: what follows a GLB's JSON chunk stays.
std::vector<std::byte> withJson(std::span<const std::byte> file, const GltfText& text, std::string json) {
  while (text.binary && json.size() % 4 != 0) json += ' ';
  const auto append = [](std::vector<std::byte>& out, const void* from, std::size_t size) {
    const auto* bytes = static_cast<const std::byte*>(from);
    out.insert(out.end(), bytes, bytes + size);
  };
  std::vector<std::byte> out;
  if (!text.binary) {
    append(out, json.data(), json.size());
    return out;
  }
  constexpr std::size_t kHeader = 20;
  const std::span<const std::byte> rest = file.subspan(kHeader + text.json.size());
  const std::uint32_t words[] = {std::uint32_t(kHeader + json.size() + rest.size()),
                                 std::uint32_t(json.size())};
  append(out, file.data(), 8);  // magic and version
  append(out, words, sizeof words);
  append(out, file.data() + 16, 4);  // "JSON"
  append(out, json.data(), json.size());
  append(out, rest.data(), rest.size());
  return out;
}

}  // namespace

Status loadGltf(const ReadContext& context, tinygltf::Model& model, ReportLines& ignored) {
  auto bytes = readFile(context.path, (std::size_t(1) << 32) - 1);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->empty()) return malformed("is empty");
  const auto text = jsonOf(*bytes);
  if (!text) return tl::unexpected(text.error());
  FileAccess access{&context, &ignored, {}, {}};
  auto json = checkJson(text->json, access);
  if (!json) return tl::unexpected(json.error());
  if (Status fits = checkRoom(triangleCount(*json), context.memoryBytes); !fits) return fits;
  const auto compression = takeCompression(*json, text->binary);
  if (!compression) return tl::unexpected(compression.error());
  if (compression->any()) *bytes = withJson(*bytes, *text, jsonText(*json));

  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(&keepImageBytes, nullptr);
  loader.SetFsCallbacks({&fileExists, &expandNothing, &readWholeFile, nullptr, &access});
  std::string error, warning;
  context.tell(0, 0, "reading the file");
  const unsigned int size = unsigned(bytes->size());
  const bool loaded =
      text->binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                 reinterpret_cast<const unsigned char*>(bytes->data()), size)
                   : loader.LoadASCIIFromString(&model, &error, &warning,
                                                reinterpret_cast<const char*>(bytes->data()), size, "");
  if (!loaded && access.refused) return tl::unexpected(*access.refused);
  if (!loaded) return malformed(error.empty() ? "is not a sound glTF file" : oneLine(error));
  if (Status played = checkExtensions(model.extensionsRequired, model.extensionsUsed, ignored); !played)
    return played;
  return decompress(*compression, model);
}

}  // namespace acentric
