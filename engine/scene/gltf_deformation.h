#pragma once
/// Meshes that animation bends, at rest: morph targets by their default weights, skins by the pose that the
/// file's nodes stand in. Private to this folder.

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/scene/source_scene.h"

namespace tinygltf {
class Model;
class Node;
struct Primitive;
}  // namespace tinygltf

namespace acentric {

/// Adds the primitive's targets to positions and normals, each by its weight.
Status morph(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
             const std::vector<double>& weights, SourceMesh& mesh);

/// Where joints are in the world, and meshes that hang on them.
class GltfSkins {
 public:
  explicit GltfSkins(const tinygltf::Model& model);

  /// Bends a mesh, and places it in the world: its node's own transform does not count any more. False where
  /// the primitive names no joints: it stays as it is.
  Result<bool> bend(int skin, const tinygltf::Primitive& primitive, SourceMesh& mesh);

 private:
  const glm::dmat4& worldFromNode(int node);
  Result<std::vector<glm::dmat4>> jointMatrices(int skin);

  const tinygltf::Model& model_;
  std::vector<int> parent_;
  std::vector<std::optional<glm::dmat4>> world_;
};

/// A node's own transform, by matrix or by its parts.
glm::dmat4 matrixOf(const std::vector<double>& translation, const std::vector<double>& rotation,
                    const std::vector<double>& scale);
glm::dmat4 matrixOf(const tinygltf::Node& node);

}  // namespace acentric
