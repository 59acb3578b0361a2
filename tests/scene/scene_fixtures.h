#pragma once
/// Shared by the scene tests: small scenes and glTF files made on the spot.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/base/file.h"
#include "engine/scene/import.h"
#include "engine/scene/scene.h"
#include "tests/support/process.h"
#include "tests/support/scenes.h"

namespace acentric::test {

inline std::string base64(const std::vector<unsigned char>& bytes) {
  static const char* const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned b0 = bytes[i], b1 = i + 1 < bytes.size() ? bytes[i + 1] : 0,
                   b2 = i + 2 < bytes.size() ? bytes[i + 2] : 0;
    const unsigned word = b0 << 16 | b1 << 8 | b2;
    for (int k = 0; k < 4; ++k)
      out += i + std::size_t(k) > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63];
  }
  return out;
}

/// A glTF file built array by array.
class GltfBuilder {
 public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}},
                         {"scene", 0},
                         {"scenes", {{{"nodes", {0}}}}},
                         {"nodes", {{{"mesh", 0}}}}};

  /// Appends an accessor over `values`; returns its index.
  template <class T>
  int accessor(const std::vector<T>& values, const char* type, int componentType, std::size_t components) {
    while (buffer_.size() % 4) buffer_.push_back(0);
    const std::size_t offset = buffer_.size();
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    buffer_.insert(buffer_.end(), bytes, bytes + values.size() * sizeof(T));
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", componentType},
                                 {"count", values.size() / components},
                                 {"type", type}});
    return int(json["accessors"].size()) - 1;
  }
  int vec3(const std::vector<float>& v) { return accessor(v, "VEC3", 5126, 3); }
  int vec2(const std::vector<float>& v) { return accessor(v, "VEC2", 5126, 2); }
  int vec4(const std::vector<float>& v) { return accessor(v, "VEC4", 5126, 4); }
  int indices(const std::vector<std::uint16_t>& v) { return accessor(v, "SCALAR", 5123, 1); }

  /// One mesh with one primitive: the triangle (0,0,0) (1,0,0) (0,1,0), facing +Z.
  nlohmann::json& triangle() {
    json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}}}}}};
    return primitive();
  }
  nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }

  std::filesystem::path write(const std::filesystem::path& path) {
    json["buffers"] = {
        {{"byteLength", buffer_.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer_)}}};
    const Status status = writeTextAtomically(path, json.dump());
    EXPECT_TRUE(status) << status.error().describe();
    return path;
  }
  Result<Scene> parse(const TemporaryFolder& folder, const ImportOptions& options = {}) {
    return parseScene(write(folder.path() / "model.gltf"), options);
  }

 private:
  std::vector<unsigned char> buffer_;
};

inline bool mentions(const std::vector<std::string>& lines, const std::string& text) {
  for (const std::string& line : lines)
    if (line.find(text) != std::string::npos) return true;
  return false;
}

inline glm::vec3 faceNormal(const Mesh& mesh, std::size_t triangle) {
  const glm::uvec3 t = mesh.triangles[triangle];
  return glm::normalize(
      glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
}

/// Every promise that scene.h makes about a scene from import.
inline void expectSound(const Scene& scene) {
  ASSERT_GT(scene.triangleCount(), 0u);
  for (const Mesh& mesh : scene.meshes) {
    const std::size_t n = mesh.positions.size();
    ASSERT_LT(std::size_t(mesh.material), scene.materials.size());
    ASSERT_EQ(mesh.normals.size(), n);
    for (const std::size_t size :
         {mesh.tangents.size(), mesh.uv[0].size(), mesh.uv[1].size(), mesh.colours.size()})
      ASSERT_TRUE(size == 0 || size == n);
    const Material& material = scene.materials[std::size_t(mesh.material)];
    for (const TextureUse* use : {&material.baseColourTexture, &material.emissiveTexture,
                                  &material.metallicRoughnessTexture, &material.normalTexture})
      if (use->used()) {
        ASSERT_EQ(mesh.uv[use->uvSet].size(), n) << material.name;
      }
    if (material.normalTexture.used()) {
      ASSERT_EQ(mesh.tangents.size(), n) << material.name;
    }
    for (const glm::vec3& p : mesh.positions) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
    for (const glm::vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1, 1e-4);
    for (const glm::vec4& t : mesh.tangents) ASSERT_NEAR(glm::length(glm::vec3(t)), 1, 1e-4);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int corner = 0; corner < 3; ++corner) ASSERT_LT(mesh.triangles[t][corner], n);
      const glm::dvec3 a(mesh.positions[mesh.triangles[t].x]), b(mesh.positions[mesh.triangles[t].y]),
          c(mesh.positions[mesh.triangles[t].z]);
      ASSERT_GT(glm::length(glm::cross(b - a, c - a)), 0);
    }
  }
  EXPECT_EQ(scene.key, keyOf(scene));
  EXPECT_EQ(scene.bounds.min, boundsOf(scene).min);
  EXPECT_EQ(scene.bounds.max, boundsOf(scene).max);
}

}  // namespace acentric::test
