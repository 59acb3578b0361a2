#include "engine/scene/gltf_deformation.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "engine/scene/gltf_accessors.h"

namespace acentric {
namespace {

/// Rows of `components` for each of the mesh's positions.
Result<GltfNumbers> rowsFor(const tinygltf::Model& model, int accessor, std::size_t count, int components,
                            const std::string& what) {
  auto read = readGltfNumbers(model, accessor);
  if (!read) return tl::unexpected(read.error());
  if (read->count != count || read->components != components)
    return malformed(
        fmt::format("{}: {} rows of {} for {} positions", what, read->count, read->components, count));
  return read;
}

/// A mesh's attribute `name`; none where it has none.
Result<std::optional<GltfNumbers>> attributeRows(const tinygltf::Model& model,
                                                 const tinygltf::Primitive& primitive,
                                                 const std::string& name, std::size_t count) {
  const auto found = primitive.attributes.find(name);
  if (found == primitive.attributes.end()) return std::optional<GltfNumbers>();
  auto rows = rowsFor(model, found->second, count, 4, name);
  if (!rows) return tl::unexpected(rows.error());
  return std::optional(std::move(*rows));
}

}  // namespace

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

Status morph(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
             const std::vector<double>& weights, SourceMesh& mesh) {
  const std::size_t count = std::min(weights.size(), primitive.targets.size());
  for (std::size_t t = 0; t < count; ++t) {
    if (!std::isfinite(weights[t]))
      return malformed(fmt::format("the weight of morph target {} is no number", t));
    if (weights[t] == 0) continue;
    const auto add = [&](const char* name, const auto& to) -> Status {
      const auto found = primitive.targets[t].find(name);
      if (found == primitive.targets[t].end()) return {};
      const auto rows =
          rowsFor(model, found->second, mesh.positions.size(), 3, fmt::format("morph target {}", t));
      if (!rows) return tl::unexpected(rows.error());
      for (std::size_t i = 0; i < rows->count; ++i)
        to(i, glm::dvec3(rows->values[3 * i], rows->values[3 * i + 1], rows->values[3 * i + 2]) * weights[t]);
      return {};
    };
    if (Status added = add("POSITION", [&](std::size_t i, const glm::dvec3& d) { mesh.positions[i] += d; });
        !added)
      return added;
    if (mesh.normals.empty()) continue;
    if (Status added =
            add("NORMAL", [&](std::size_t i, const glm::dvec3& d) { mesh.normals[i] += glm::vec3(d); });
        !added)
      return added;
  }
  return {};
}

GltfSkins::GltfSkins(const tinygltf::Model& model)
    : model_(model), parent_(model.nodes.size(), -1), world_(model.nodes.size()) {
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    for (const int child : model.nodes[n].children)
      if (child >= 0 && std::size_t(child) < parent_.size() && parent_[std::size_t(child)] < 0)
        parent_[std::size_t(child)] = int(n);
}

const glm::dmat4& GltfSkins::worldFromNode(int node) {
  // From the nearest ancestor that is known; one that is its own ancestor ends the chain.
  std::vector<int> chain;
  for (int n = node; n >= 0 && !world_[std::size_t(n)] && chain.size() <= world_.size();
       n = parent_[std::size_t(n)])
    chain.push_back(n);
  for (auto n = chain.rbegin(); n != chain.rend(); ++n) {
    const int parent = parent_[std::size_t(*n)];
    const bool known = parent >= 0 && world_[std::size_t(parent)];
    world_[std::size_t(*n)] =
        (known ? *world_[std::size_t(parent)] : glm::dmat4(1)) * matrixOf(model_.nodes[std::size_t(*n)]);
  }
  return *world_[std::size_t(node)];
}

Result<std::vector<glm::dmat4>> GltfSkins::jointMatrices(int index) {
  if (index < 0 || std::size_t(index) >= model_.skins.size())
    return malformed(fmt::format("skin {} does not exist", index));
  const tinygltf::Skin& skin = model_.skins[std::size_t(index)];
  std::vector<glm::dmat4> out;
  for (const int joint : skin.joints) {
    if (joint < 0 || std::size_t(joint) >= model_.nodes.size())
      return malformed(fmt::format("skin {}: joint {} does not exist", index, joint));
    out.push_back(worldFromNode(joint));
  }
  if (skin.inverseBindMatrices < 0) return out;
  const auto inverse = readGltfNumbers(model_, skin.inverseBindMatrices);
  if (!inverse) return tl::unexpected(inverse.error());
  if (inverse->components != 16 || inverse->count < out.size())
    return malformed(
        fmt::format("skin {}: {} inverse bind matrices for {} joints", index, inverse->count, out.size()));
  for (std::size_t j = 0; j < out.size(); ++j)
    out[j] = out[j] * glm::dmat4(glm::make_mat4(&inverse->values[16 * j]));
  return out;
}

Result<bool> GltfSkins::bend(int skin, const tinygltf::Primitive& primitive, SourceMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  const auto joints = jointMatrices(skin);
  if (!joints) return tl::unexpected(joints.error());
  std::vector<glm::dmat4> blended(count, glm::dmat4(0));
  std::vector<double> sums(count, 0);
  for (int set = 0; set < 2; ++set) {
    const auto indices = attributeRows(model_, primitive, fmt::format("JOINTS_{}", set), count);
    const auto weights = attributeRows(model_, primitive, fmt::format("WEIGHTS_{}", set), count);
    if (!indices) return tl::unexpected(indices.error());
    if (!weights) return tl::unexpected(weights.error());
    if (!indices->has_value() || !weights->has_value()) {
      if (set == 0) return false;
      break;
    }
    for (std::size_t i = 0; i < 4 * count; ++i) {
      const double weight = (*weights)->values[i];
      if (!(weight > 0) || !std::isfinite(weight)) continue;
      const float joint = (*indices)->values[i];
      if (!(joint >= 0) || std::size_t(joint) >= joints->size())
        return malformed(fmt::format("skin {} has no joint {}", skin, joint));
      blended[i / 4] += (*joints)[std::size_t(joint)] * weight;
      sums[i / 4] += weight;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!(sums[i] > 0)) return malformed(fmt::format("vertex {} hangs on no joint of skin {}", i, skin));
    const glm::dmat4 world = blended[i] / sums[i];
    mesh.positions[i] = glm::dvec3(world * glm::dvec4(mesh.positions[i], 1));
    if (!mesh.normals.empty()) {
      const glm::dvec3 turned = glm::dmat3(world) * glm::dvec3(mesh.normals[i]);
      const double length = glm::length(turned);
      if (length > 0) mesh.normals[i] = glm::vec3(turned / length);
    }
    if (!mesh.tangents.empty()) {
      const glm::dvec3 turned = glm::dmat3(world) * glm::dvec3(mesh.tangents[i]);
      const double length = glm::length(turned);
      if (length > 0) mesh.tangents[i] = glm::vec4(glm::vec3(turned / length), mesh.tangents[i].w);
    }
  }
  return true;
}

}  // namespace acentric
