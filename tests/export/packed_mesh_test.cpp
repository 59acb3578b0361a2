/// Meshes for EXT_meshopt_compression are what they were, to the errors that are stated.

#include "engine/export/packed_mesh.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace acentric {
namespace {

template <class Value>
std::vector<Value> decoded(const PackedAttribute& attribute, std::size_t vertices) {
  EXPECT_EQ(attribute.stride, sizeof(Value));
  std::vector<Value> out(vertices);
  EXPECT_EQ(meshopt_decodeVertexBuffer(out.data(), vertices, sizeof(Value),
                                       reinterpret_cast<const unsigned char*>(attribute.coded.data()),
                                       attribute.coded.size()),
            0);
  if (attribute.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), vertices, sizeof(Value));
  return out;
}

std::vector<unsigned> indicesOf(const PackedMesh& packed) {
  std::vector<unsigned> out(3 * packed.triangles);
  EXPECT_EQ(meshopt_decodeIndexBuffer(out.data(), out.size(), sizeof(unsigned),
                                      reinterpret_cast<const unsigned char*>(packed.coded.data()),
                                      packed.coded.size()),
            0);
  return out;
}

/// A sheet of squares, each with corners of its own, its colours and coordinates told by place.
DrawMesh sheet(int side, float scale, float uvScale) {
  DrawMesh mesh;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const auto first = std::uint32_t(mesh.positions.size());
      for (const auto& [a, b] : {std::pair(i, j), {i + 1, j}, {i, j + 1}, {i + 1, j + 1}}) {
        const glm::vec2 at(float(a) / float(side), float(b) / float(side));
        mesh.positions.push_back(scale * glm::vec3(at.x - 0.3F, at.y - 0.6F, at.x * at.y + 0.1F));
        mesh.uv.push_back(uvScale * at);
        mesh.colours.emplace_back(at.x, at.y, at.x * at.x);
      }
      mesh.triangles.emplace_back(first, first + 1, first + 2);
      mesh.triangles.emplace_back(first + 2, first + 1, first + 3);
    }
  return mesh;
}

/// The vertex of `mesh` that is nearest in colour, which tells them apart.
std::size_t sourceOf(const DrawMesh& mesh, const glm::vec3& colour) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < mesh.colours.size(); ++i)
    if (glm::distance(mesh.colours[i], colour) < glm::distance(mesh.colours[best], colour)) best = i;
  return best;
}

TEST(PackedMesh, IsWhatItWasToTheErrorsThatAreStated) {
  for (const float scale : {0.1F, 3.0F, 700.0F})
    for (const double error : {1e-3, 1e-5, 3e-7}) {
      const DrawMesh mesh = sheet(20, scale, 1);
      const PackedMesh packed = packMesh(mesh, error);
      EXPECT_EQ(packed.vertices, 21U * 21U) << "corners that squares share are one vertex";
      ASSERT_EQ(packed.triangles, mesh.triangles.size());
      const auto positions = decoded<glm::vec3>(packed.positions, packed.vertices);
      const auto uv = decoded<std::array<std::uint16_t, 2>>(packed.uv, packed.vertices);
      const auto colours = decoded<std::array<std::uint16_t, 4>>(packed.colour, packed.vertices);
      glm::vec3 low(positions.front()), high(low);
      for (std::size_t v = 0; v < packed.vertices; ++v) {
        const glm::vec3 colour = glm::vec3(colours[v][0], colours[v][1], colours[v][2]) / 65535.0F;
        const std::size_t source = sourceOf(mesh, colour);
        const float slack = 1e-6F;  // of floats
        EXPECT_LE(glm::distance(positions[v], mesh.positions[source]),
                  (error + slack) * std::max(1.0F, glm::length(mesh.positions[source])));
        for (int i = 0; i < 2; ++i)
          EXPECT_NEAR(float(uv[v][std::size_t(i)]) / 65535, mesh.uv[source][i], kPackedUvError + slack);
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(colour[i], mesh.colours[source][i], kPackedColourError + 2e-5);
        low = glm::min(low, positions[v]), high = glm::max(high, positions[v]);
      }
      EXPECT_EQ(low, packed.low);
      EXPECT_EQ(high, packed.high);
      double area = 0;
      const auto indices = indicesOf(packed);
      for (std::size_t i = 0; i < indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) {
          return glm::vec2(uv[indices[i + k]][0], uv[indices[i + k]][1]) / 65535.0F;
        };
        const glm::vec2 a = corner(1) - corner(0), b = corner(2) - corner(0);
        area += double(a.x * b.y - a.y * b.x) / 2;
      }
      EXPECT_NEAR(area, 1, 1e-3) << "each triangle once, turned as it was";
    }
}

TEST(PackedMesh, KeepsCoordinatesThatRepeatATexture) {
  const DrawMesh mesh = sheet(10, 2, 7.5F);
  const PackedMesh packed = packMesh(mesh, 1e-4);
  ASSERT_EQ(packed.uv.componentType, kGltfFloat);
  const auto uv = decoded<glm::vec2>(packed.uv, packed.vertices);
  const auto colours = decoded<std::array<std::uint16_t, 4>>(packed.colour, packed.vertices);
  for (std::size_t v = 0; v < packed.vertices; ++v) {
    const std::size_t source =
        sourceOf(mesh, glm::vec3(colours[v][0], colours[v][1], colours[v][2]) / 65535.0F);
    EXPECT_LT(glm::distance(uv[v], mesh.uv[source]), 2e-5F);
  }
}

TEST(PackedMesh, KeepsNormalsToAboutADegree) {
  const DrawMesh mesh = sheet(12, 2, 1);
  std::vector<glm::vec3> normals;
  for (const glm::vec3& colour : mesh.colours)
    normals.push_back(
        glm::normalize(glm::vec3(colour.x - 0.4F, colour.y - 0.6F, colour.x * colour.y - 0.2F)));
  const PackedMesh packed = packMesh(mesh, 1e-5, normals);
  ASSERT_EQ(packed.normals.filter, "OCTAHEDRAL");
  ASSERT_EQ(packed.normals.componentType, kGltfByte);
  auto rows = decoded<std::array<std::int8_t, 4>>(packed.normals, packed.vertices);
  meshopt_decodeFilterOct(rows.data(), rows.size(), 4);
  const auto colours = decoded<std::array<std::uint16_t, 4>>(packed.colour, packed.vertices);
  for (std::size_t v = 0; v < packed.vertices; ++v) {
    const std::size_t source =
        sourceOf(mesh, glm::vec3(colours[v][0], colours[v][1], colours[v][2]) / 65535.0F);
    const glm::vec3 normal = glm::normalize(glm::vec3(rows[v][0], rows[v][1], rows[v][2]));
    EXPECT_GT(glm::dot(normal, normals[source]), std::cos(0.02F)) << v;
  }
  EXPECT_TRUE(packMesh(mesh, 1e-5).normals.coded.empty()) << "none where there are none";
}

TEST(PackedMesh, TakesAFractionOfTheBytes) {
  const DrawMesh mesh = sheet(60, 3, 1);
  const PackedMesh packed = packMesh(mesh, 1e-5);
  const std::size_t before = mesh.positions.size() * (12 + 8 + 12) + mesh.triangles.size() * 12;
  EXPECT_LT(packed.positions.coded.size() + packed.uv.coded.size() + packed.colour.coded.size() +
                packed.coded.size(),
            before / 8);
}

}  // namespace
}  // namespace acentric
