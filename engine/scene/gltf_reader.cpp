/// glTF 2.0: nodes, meshes, instances and lights of the file's scene, every index and transform checked.

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>

#include "engine/scene/gltf_accessors.h"
#include "engine/scene/gltf_deformation.h"
#include "engine/scene/gltf_file.h"
#include "engine/scene/gltf_materials.h"
#include "engine/scene/instances.h"
#include "engine/scene/source_scene.h"

namespace acentric {
namespace {

class GltfReader {
 public:
  GltfReader(const tinygltf::Model& model, const ReadContext& context, SourceScene scene)
      : model_(model),
        context_(context),
        scene_(std::move(scene)),
        materials_(model, context, scene_),
        skins_(model),
        users_(usersOf(model)) {}

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
    const tinygltf::Mesh& mesh = model_.meshes[std::size_t(node.mesh)];
    const auto instances = instancesOf(node);
    if (!instances) return tl::unexpected(instances.error());
    const bool bends = node.skin >= 0 || !node.weights.empty();
    const bool shared = !bends && (users_[std::size_t(node.mesh)] > 1 || instances->size() > 1);
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const std::string& name = node.name.empty() ? mesh.name : node.name;
      if (shared) {
        const auto known = prototypeOf(node, std::size_t(p));
        if (!known) return tl::unexpected(known.error());
        if (*known == kNoPrototype) continue;
        for (const glm::dmat4& instance : *instances) {
          if (scene_.instances.size() >= kMaxInstances)
            return fail(ErrorKind::tooLarge,
                        fmt::format("has more than {} instances; make one mesh of those that stand together",
                                    kMaxInstances));
          scene_.instances.push_back(
              {*known, std::uint32_t(scene_.meshes.size()), name, worldFromNode * instance});
        }
        continue;
      }
      bool placed = false;
      auto read = readNamed(node, p, placed);
      if (!read) return tl::unexpected(read.error());
      if (read->triangles.empty()) continue;
      for (std::size_t i = 0; i < instances->size(); ++i) {
        const bool last = i + 1 == instances->size();
        scene_.meshes.push_back(last ? std::move(*read) : *read);
        applyTransform(scene_.meshes.back(), (placed ? glm::dmat4(1) : worldFromNode) * (*instances)[i]);
        if (Status counted = count(scene_.meshes.back()); !counted) return counted;
      }
    }
    return {};
  }

  Status count(const SourceMesh& mesh) {
    scene_.indexCount += 3 * mesh.triangles.size();
    if (scene_.indexCount > kMaxSceneIndices)
      return fail(ErrorKind::tooLarge, "has more than 2^31 indices; split it");
    return {};
  }

  Result<SourceMesh> readNamed(const tinygltf::Node& node, std::size_t primitive, bool& placed) {
    const tinygltf::Mesh& mesh = model_.meshes[std::size_t(node.mesh)];
    auto read = readPrimitive(mesh.primitives[primitive], node, mesh, placed);
    if (!read)
      read.error().message = fmt::format("mesh {} ({}): {}", node.mesh, mesh.name, read.error().message);
    return read;
  }

  /// Read when it is first met; kNoPrototype where it has no triangles.
  Result<std::uint32_t> prototypeOf(const tinygltf::Node& node, std::size_t primitive) {
    const auto [known, isNew] = prototypes_.try_emplace({node.mesh, primitive}, kNoPrototype);
    if (!isNew) return known->second;
    bool placed = false;
    auto read = readNamed(node, primitive, placed);
    if (!read) return tl::unexpected(read.error());
    if (read->triangles.empty()) return kNoPrototype;
    if (Status counted = count(*read); !counted) return tl::unexpected(counted.error());
    known->second = std::uint32_t(scene_.prototypes.size());
    scene_.prototypes.push_back(std::move(*read));
    return known->second;
  }

  /// How many nodes show each mesh, of the whole file.
  static std::vector<std::uint32_t> usersOf(const tinygltf::Model& model) {
    std::vector<std::uint32_t> users(model.meshes.size(), 0);
    for (const tinygltf::Node& node : model.nodes)
      if (node.mesh >= 0 && std::size_t(node.mesh) < users.size()) ++users[std::size_t(node.mesh)];
    return users;
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
      if (accessor < double(model_.accessors.size()) &&
          model_.accessors[std::size_t(accessor)].count > kMaxInstances)
        return fail(
            ErrorKind::tooLarge,
            fmt::format("node {} has {} instances; no more than {} can be: make one mesh of those that "
                        "stand together",
                        node.name, model_.accessors[std::size_t(accessor)].count, kMaxInstances));
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
    // glTF has no size of lights; these are the names under which Blender keeps it.
    if (source.extras.IsObject() && out.light.kind == LightKind::directional)
      out.light.angularRadius =
          glm::clamp(0.5f * positive(numberOr(source.extras, "angle", 0), 0), 0.0f, 0.785398f);
    else if (source.extras.IsObject())
      out.light.radius =
          positive(numberOr(source.extras, "radius", numberOr(source.extras, "shadow_soft_size", 0)), 0);
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

  /// `placed`: it stands in the world already, by its skin's joints.
  Result<SourceMesh> readPrimitive(const tinygltf::Primitive& primitive, const tinygltf::Node& node,
                                   const tinygltf::Mesh& mesh, bool& placed) {
    SourceMesh out;
    const std::string& name = out.name = node.name.empty() ? mesh.name : node.name;
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
    if (Status bent = bend(primitive, node, mesh, out, placed); !bent) return tl::unexpected(bent.error());
    return out;
  }

  /// Morph targets and skin, as they are at rest.
  Status bend(const tinygltf::Primitive& primitive, const tinygltf::Node& node, const tinygltf::Mesh& mesh,
              SourceMesh& out, bool& placed) {
    if (!primitive.targets.empty()) {
      scene_.guessed.add("morph targets: by their default weights");
      if (Status done = morph(model_, primitive, node.weights.empty() ? mesh.weights : node.weights, out);
          !done)
        return done;
    }
    if (node.skin < 0) return {};
    scene_.guessed.add("skins: in the pose of the file's nodes");
    const auto bent = skins_.bend(node.skin, primitive, out);
    if (!bent) return tl::unexpected(bent.error());
    placed = *bent;
    return {};
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
  GltfSkins skins_;
  static constexpr std::uint32_t kNoPrototype = ~0u;
  std::vector<std::uint32_t> users_;                                 ///< by mesh
  std::map<std::pair<int, std::size_t>, std::uint32_t> prototypes_;  ///< by mesh and primitive
};

}  // namespace

Result<SourceScene> readGltf(const ReadContext& context) {
  SourceScene scene;
  tinygltf::Model model;
  if (auto status = loadGltf(context, model, scene.ignored); !status) return tl::unexpected(status.error());
  return GltfReader(model, context, std::move(scene)).read();
}

}  // namespace acentric
