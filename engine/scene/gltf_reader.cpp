/// glTF 2.0 and GLB: tinygltf takes the JSON apart and fetches buffers; every number is checked here.

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/base/file.h"
#include "engine/scene/gltf_accessors.h"
#include "engine/scene/gltf_materials.h"
#include "engine/scene/source_scene.h"

namespace acentric {
namespace {

constexpr std::array<const char*, 9> kPlayed{
    "KHR_lights_punctual",        "KHR_texture_transform", "KHR_materials_emissive_strength",
    "KHR_materials_transmission", "KHR_materials_unlit",   "KHR_materials_pbrSpecularGlossiness",
    "EXT_mesh_gpu_instancing",    "KHR_mesh_quantization", "EXT_texture_webp"};

tl::unexpected<Error> malformed(std::string message) {
  return fail(ErrorKind::malformed, std::move(message));
}

std::string oneLine(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() > 300 ? text.substr(0, 300) + "..." : text;
}

/// What tinygltf's callbacks need. Its own reading of files would follow any path.
struct FileAccess {
  const ReadContext* context = nullptr;
  ReportLines* ignored = nullptr;
  std::map<std::string, std::size_t> bufferBytes;  ///< declared length by URI as tinygltf asks for it
};

/// tinygltf joins base folder and name; we hand it an empty base folder, and it tries "./name" as well.
std::string nameOf(const std::string& asked) {
  return std::filesystem::path(asked).lexically_normal().string();
}

bool fileExists(const std::string& asked, void* user) {
  FileAccess& access = *static_cast<FileAccess*>(user);
  const auto found = access.context->references.find(nameOf(asked));
  if (!found) access.ignored->add(fmt::format("file {}: {}", nameOf(asked), found.error().message));
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
Status checkJson(std::string_view text, FileAccess& access) {
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    return malformed(fmt::format("is not valid JSON: {}", oneLine(error.what())));
  }
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
  return {};
}

Status checkExtensions(const tinygltf::Model& model, ReportLines& ignored) {
  const auto played = [](const std::string& name) {
    return std::find(kPlayed.begin(), kPlayed.end(), name) != kPlayed.end();
  };
  for (const std::string& name : model.extensionsRequired) {
    if (played(name)) continue;
    const bool packed = name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression";
    return fail(ErrorKind::unsupported,
                fmt::format("requires the extension {}, which is not supported{}", name,
                            packed ? "; export it without mesh compression" : ""));
  }
  for (const std::string& name : model.extensionsUsed)
    if (!played(name)) ignored.add("extension " + name);
  return {};
}

glm::dmat4 matrixOf(const std::vector<double>& translation, const std::vector<double>& rotation,
                    const std::vector<double>& scale) {
  glm::dmat4 out(1);
  if (rotation.size() == 4) {
    const glm::dquat q(rotation[3], rotation[0], rotation[1], rotation[2]);
    const double length = glm::length(q);
    if (length > 0) out = glm::mat4_cast(q / length);
  }
  if (scale.size() == 3)
    for (int axis = 0; axis < 3; ++axis) out[axis] *= scale[std::size_t(axis)];
  if (translation.size() == 3) out[3] = glm::dvec4(translation[0], translation[1], translation[2], 1);
  return out;
}

glm::dmat4 matrixOf(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
  return matrixOf(node.translation, node.rotation, node.scale);
}

class GltfReader {
 public:
  GltfReader(const tinygltf::Model& model, const ReadContext& context, SourceScene scene)
      : model_(model), context_(context), scene_(std::move(scene)), materials_(model, context, scene_) {}

  Result<SourceScene> read() {
    scene_.metresPerUnit = 1;
    scene_.unitSource = scene_.upSource = "glTF";
    scene_.up = UpAxis::y;
    const auto roots = rootNodes();
    if (!roots) return tl::unexpected(roots.error());
    if (auto status = walk(*roots); !status) return tl::unexpected(status.error());
    if (!model_.animations.empty())
      scene_.ignored.add(counted(model_.animations.size(), "animation", "animations"));
    if (!model_.cameras.empty()) scene_.ignored.add(counted(model_.cameras.size(), "camera", "cameras"));
    return std::move(scene_);
  }

 private:
  Result<std::vector<int>> rootNodes() {
    if (model_.scenes.empty()) return fail(ErrorKind::unsupported, "has no scene; export it with one");
    int index = model_.defaultScene;
    if (index < 0 || std::size_t(index) >= model_.scenes.size()) {
      if (index >= 0) return malformed(fmt::format("its default scene {} does not exist", index));
      index = 0;
      scene_.guessed.add(model_.scenes.size() == 1 ? "scene: the only one (the file names no default)"
                                                   : "scene: the first one (the file names no default)");
    }
    if (model_.scenes.size() > 1)
      scene_.ignored.add(counted(model_.scenes.size() - 1, "other scene", "other scenes"));
    return model_.scenes[std::size_t(index)].nodes;
  }

  /// Depth first with a stack of our own: a file may nest nodes deeper than the call stack reaches.
  Status walk(const std::vector<int>& roots) {
    struct Step {
      int node;
      glm::dmat4 parent;
      bool leave;
    };
    enum class Seen : char { no, onPath, done };
    std::vector<Seen> seen(model_.nodes.size(), Seen::no);
    std::vector<Step> stack;
    std::size_t visited = 0;
    const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& parent) {
      for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) stack.push_back({*it, parent, false});
    };
    push(roots, glm::dmat4(1));
    while (!stack.empty()) {
      const Step step = stack.back();
      stack.pop_back();
      if (step.node < 0 || std::size_t(step.node) >= model_.nodes.size())
        return malformed(fmt::format("node {} does not exist", step.node));
      Seen& state = seen[std::size_t(step.node)];
      if (step.leave) {
        state = Seen::done;
        continue;
      }
      if (state == Seen::onPath) return malformed(fmt::format("node {} is its own ancestor", step.node));
      if (state == Seen::done) {
        scene_.ignored.add(fmt::format("a second parent of node {}", step.node));
        continue;
      }
      state = Seen::onPath;
      const tinygltf::Node& node = model_.nodes[std::size_t(step.node)];
      const glm::dmat4 worldFromNode = step.parent * matrixOf(node);
      if (auto status = readNode(node, worldFromNode); !status) return status;
      if (++visited % 64 == 0) context_.tell(double(visited), double(model_.nodes.size()), "reading meshes");
      stack.push_back({step.node, {}, true});
      push(node.children, worldFromNode);
    }
    return {};
  }

  Status readNode(const tinygltf::Node& node, const glm::dmat4& worldFromNode) {
    if (const auto light = node.extensions.find("KHR_lights_punctual"); light != node.extensions.end())
      readLight(int(numberOr(light->second, "light", -1)), worldFromNode);
    if (node.mesh < 0) return {};
    if (std::size_t(node.mesh) >= model_.meshes.size())
      return malformed(fmt::format("mesh {} does not exist", node.mesh));
    if (node.skin >= 0) scene_.ignored.add("skins (the meshes stand as modelled)");
    const tinygltf::Mesh& mesh = model_.meshes[std::size_t(node.mesh)];
    const auto instances = instancesOf(node);
    if (!instances) return tl::unexpected(instances.error());
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      auto read = readPrimitive(primitive, node.name.empty() ? mesh.name : node.name);
      if (!read) {
        read.error().message = fmt::format("mesh {} ({}): {}", node.mesh, mesh.name, read.error().message);
        return tl::unexpected(read.error());
      }
      if (read->triangles.empty()) continue;
      for (std::size_t i = 0; i < instances->size(); ++i) {
        scene_.indexCount += 3 * read->triangles.size();
        if (scene_.indexCount > kMaxSceneIndices)
          return fail(ErrorKind::tooLarge, "has more than 2^31 indices with all instances; split it");
        const bool last = i + 1 == instances->size();
        scene_.meshes.push_back(last ? std::move(*read) : *read);
        applyTransform(scene_.meshes.back(), worldFromNode * (*instances)[i]);
      }
    }
    return {};
  }

  /// EXT_mesh_gpu_instancing, or one instance in place.
  Result<std::vector<glm::dmat4>> instancesOf(const tinygltf::Node& node) {
    const auto extension = node.extensions.find("EXT_mesh_gpu_instancing");
    if (extension == node.extensions.end() || !extension->second.Has("attributes"))
      return std::vector<glm::dmat4>{glm::dmat4(1)};
    const tinygltf::Value& attributes = extension->second.Get("attributes");
    std::size_t count = 0;
    std::map<std::string, GltfNumbers> numbers;
    for (const auto& [name, components] : {std::pair{"TRANSLATION", 3}, {"ROTATION", 4}, {"SCALE", 3}}) {
      const double accessor = numberOr(attributes, name, -1);
      if (accessor < 0) continue;
      auto read = readGltfNumbers(model_, int(accessor), std::string_view(name) == "ROTATION");
      if (!read) return tl::unexpected(read.error());
      if (read->components != components || (count != 0 && read->count != count))
        return malformed(fmt::format("instances of node {} have broken {}", node.name, name));
      count = read->count;
      numbers[name] = std::move(*read);
    }
    std::vector<glm::dmat4> out(count);
    const auto row = [&](const char* name, std::size_t i) {
      const auto found = numbers.find(name);
      if (found == numbers.end()) return std::vector<double>{};
      const auto begin =
          found->second.values.begin() + std::ptrdiff_t(i * std::size_t(found->second.components));
      return std::vector<double>(begin, begin + found->second.components);
    };
    for (std::size_t i = 0; i < count; ++i)
      out[i] = matrixOf(row("TRANSLATION", i), row("ROTATION", i), row("SCALE", i));
    return out;
  }

  void readLight(int index, const glm::dmat4& worldFromNode) {
    if (index < 0 || std::size_t(index) >= model_.lights.size()) {
      scene_.ignored.add(fmt::format("light {}, which does not exist", index));
      return;
    }
    const tinygltf::Light& source = model_.lights[std::size_t(index)];
    SourceLight out;
    if (source.type == "directional")
      out.light.kind = LightKind::directional;
    else if (source.type == "point")
      out.light.kind = LightKind::point;
    else if (source.type == "spot")
      out.light.kind = LightKind::spot;
    else {
      scene_.ignored.add(fmt::format("light {} of unknown type '{}'", source.name, source.type));
      return;
    }
    const auto positive = [](double v, double otherwise) {
      return float(std::isfinite(v) && v >= 0 ? v : otherwise);
    };
    out.light.name = source.name;
    if (source.color.size() == 3)
      for (int c = 0; c < 3; ++c) out.light.colour[c] = positive(source.color[std::size_t(c)], 1);
    out.light.intensity = positive(source.intensity, 1);
    out.light.range = positive(source.range, 0);
    out.light.outerCone = glm::clamp(positive(source.spot.outerConeAngle, 0.785398), 1e-3f, 1.570796f);
    out.light.innerCone = glm::clamp(positive(source.spot.innerConeAngle, 0), 0.0f, out.light.outerCone);
    const glm::dvec3 direction = -glm::dvec3(worldFromNode[2]);
    const double length = glm::length(direction);
    out.position = glm::dvec3(worldFromNode[3]);
    if (!(length > 0) || !std::isfinite(length + glm::dot(out.position, out.position))) {
      scene_.ignored.add(fmt::format("light {} with a broken transform", source.name));
      return;
    }
    out.light.direction = glm::vec3(direction / length);
    scene_.lights.push_back(std::move(out));
  }

  Result<SourceMesh> readPrimitive(const tinygltf::Primitive& primitive, const std::string& name) {
    SourceMesh out;
    out.name = name;
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES) {
      scene_.ignored.add(mode == TINYGLTF_MODE_POINTS ? "points" : "lines");
      return out;
    }
    if (mode > TINYGLTF_MODE_TRIANGLE_FAN)
      return malformed(fmt::format("primitive mode {} does not exist", mode));
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
      scene_.ignored.add(fmt::format("mesh {} without positions", name));
      return out;
    }
    const auto positions = readGltfNumbers(model_, position->second);
    if (!positions) return tl::unexpected(positions.error());
    if (positions->components != 3) return malformed("positions are not 3-vectors");
    out.positions.resize(positions->count);
    for (std::size_t i = 0; i < positions->count; ++i)
      out.positions[i] =
          glm::dvec3(positions->values[3 * i], positions->values[3 * i + 1], positions->values[3 * i + 2]);

    std::vector<std::uint32_t> indices;
    if (primitive.indices >= 0) {
      auto read = readGltfIndices(model_, primitive.indices);
      if (!read) return tl::unexpected(read.error());
      indices = std::move(*read);
    } else {
      indices.resize(out.positions.size());
      for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = std::uint32_t(i);
    }
    assemble(indices, mode, out.triangles);

    const GltfMaterial material = materials_.take(primitive.material);
    out.material = material.index;
    readAttributes(primitive, material, out);
    if (!primitive.targets.empty()) scene_.ignored.add("morph targets");
    return out;
  }

  static void assemble(const std::vector<std::uint32_t>& indices, int mode,
                       std::vector<glm::uvec3>& triangles) {
    const std::size_t n = indices.size();
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      triangles.reserve(n / 3);
      for (std::size_t i = 0; i + 2 < n; i += 3)
        triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      for (std::size_t i = 0; i + 2 < n; ++i)
        triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
    } else {
      for (std::size_t i = 0; i + 2 < n; ++i)
        triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
    }
  }

  /// An attribute of wrong length or type is left out and reported: the surface itself is still sound.
  GltfNumbers attribute(const tinygltf::Primitive& primitive, const std::string& key, const SourceMesh& mesh,
                        int least, int most, bool normalize = false) {
    const auto found = primitive.attributes.find(key);
    if (found == primitive.attributes.end()) return {};
    auto read = readGltfNumbers(model_, found->second, normalize);
    if (!read)
      scene_.ignored.add(fmt::format("{} of mesh {}: {}", key, mesh.name, read.error().message));
    else if (read->count != mesh.positions.size() || read->components < least || read->components > most)
      scene_.ignored.add(fmt::format("{} of mesh {}: {} rows of {} for {} positions", key, mesh.name,
                                     read->count, read->components, mesh.positions.size()));
    else
      return std::move(*read);
    return {};
  }

  void readAttributes(const tinygltf::Primitive& primitive, const GltfMaterial& material, SourceMesh& mesh) {
    const std::size_t count = mesh.positions.size();
    if (const GltfNumbers n = attribute(primitive, "NORMAL", mesh, 3, 3, true); n.count) {
      mesh.normals.resize(count);
      for (std::size_t i = 0; i < count; ++i)
        mesh.normals[i] = {n.values[3 * i], n.values[3 * i + 1], n.values[3 * i + 2]};
    }
    if (material.wantsTangents)
      if (const GltfNumbers t = attribute(primitive, "TANGENT", mesh, 4, 4, true); t.count) {
        mesh.tangents.resize(count);
        for (std::size_t i = 0; i < count; ++i)
          mesh.tangents[i] = {t.values[4 * i], t.values[4 * i + 1], t.values[4 * i + 2],
                              t.values[4 * i + 3] < 0 ? -1 : 1};
      }
    for (int slot = 0; slot < 2; ++slot) {
      if (material.uvSet[slot] < 0) continue;
      const std::string key = fmt::format("TEXCOORD_{}", material.uvSet[slot]);
      const GltfNumbers uv = attribute(primitive, key, mesh, 2, 2);
      // Without coordinates a texture shows its first texel: the arrays that a material reads are always
      // there.
      mesh.uv[slot].assign(count, glm::vec2(0));
      if (!uv.count)
        scene_.ignored.add(fmt::format("textures of mesh {}: it has no usable {}", mesh.name, key));
      for (std::size_t i = 0; i < uv.count; ++i) mesh.uv[slot][i] = {uv.values[2 * i], uv.values[2 * i + 1]};
    }
    if (const GltfNumbers c = attribute(primitive, "COLOR_0", mesh, 3, 4, true); c.count) {
      mesh.colours.assign(count, glm::u8vec4(255));
      for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < c.components; ++k) {
          const float v = c.values[i * std::size_t(c.components) + std::size_t(k)];
          mesh.colours[i][k] = std::uint8_t(std::lround(255 * (v > 0 ? std::min(v, 1.0f) : 0.0f)));
        }
    }
  }

  const tinygltf::Model& model_;
  const ReadContext& context_;
  SourceScene scene_;
  GltfMaterials materials_;
};

}  // namespace

Result<SourceScene> readGltf(const ReadContext& context) {
  const auto bytes = readFile(context.path, (std::size_t(1) << 32) - 1);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->empty()) return malformed("is empty");
  const auto text = jsonOf(*bytes);
  if (!text) return tl::unexpected(text.error());

  SourceScene scene;
  FileAccess access{&context, &scene.ignored, {}};
  if (auto status = checkJson(text->json, access); !status) return tl::unexpected(status.error());

  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(&keepImageBytes, nullptr);
  loader.SetFsCallbacks({&fileExists, &expandNothing, &readWholeFile, nullptr, &access});
  tinygltf::Model model;
  std::string error, warning;
  context.tell(0, 0, "reading the file");
  const unsigned int size = unsigned(bytes->size());
  const bool loaded =
      text->binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                 reinterpret_cast<const unsigned char*>(bytes->data()), size)
                   : loader.LoadASCIIFromString(&model, &error, &warning,
                                                reinterpret_cast<const char*>(bytes->data()), size, "");
  if (!loaded) return malformed(error.empty() ? "is not a sound glTF file" : oneLine(error));
  if (auto status = checkExtensions(model, scene.ignored); !status) return tl::unexpected(status.error());
  return GltfReader(model, context, std::move(scene)).read();
}

}  // namespace acentric
