// The sample scene: the same bytes every time, sound geometry, and everything in it that it is there to show.

#include "projects/gallery/generator/gallery.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/base/file.h"

namespace acentric::gallery {
namespace {

namespace fs = std::filesystem;

/// Of the pictures' size: geometry and structure do not depend on it.
constexpr float kCoarse = 0.1f;

/// Every triangle where it stands, Z up.
struct Placed {
  glm::vec3 a, b, c;
  int material;
};

class Gallery : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    model_ = new Model(makeGallery(kCoarse));
    folder_ = new fs::path(fs::path(testing::TempDir()) / ("gallery-" + std::to_string(getpid())));
    fs::create_directories(*folder_);
  }
  static void TearDownTestSuite() {
    fs::remove_all(*folder_);
    delete folder_;
    delete model_;
  }

  static std::vector<Placed> placed() {
    std::vector<Placed> out;
    for (const Thing& thing : model_->things)
      for (const glm::mat4& placement : thing.placements)
        for (const Part& part : thing.parts) {
          const Shape& s = part.shape;
          const auto at = [&](std::size_t i) {
            return glm::vec3(placement * glm::vec4(s.positions[s.indices[i]], 1));
          };
          for (std::size_t i = 0; i + 2 < s.indices.size(); i += 3)
            out.push_back({at(i), at(i + 1), at(i + 2), part.material});
        }
    return out;
  }
  /// Distance to the nearest surface along a ray, skipping glass; infinity if there is none.
  static float nearest(const std::vector<Placed>& triangles, const glm::vec3& from,
                       const glm::vec3& direction) {
    float best = std::numeric_limits<float>::infinity();
    for (const Placed& t : triangles) {
      if (model_->materials[static_cast<std::size_t>(t.material)].transmission > 0) continue;
      const glm::vec3 ab = t.b - t.a, ac = t.c - t.a, p = glm::cross(direction, ac);
      const float determinant = glm::dot(ab, p);
      if (std::abs(determinant) < 1e-12f) continue;
      const glm::vec3 offset = from - t.a, q = glm::cross(offset, ab);
      const float u = glm::dot(offset, p) / determinant, v = glm::dot(direction, q) / determinant;
      const float distance = glm::dot(ac, q) / determinant;
      if (u >= 0 && v >= 0 && u + v <= 1 && distance > 1e-4f) best = std::min(best, distance);
    }
    return best;
  }
  /// Those that reach into the ball of one metre's radius, for questions about what is near.
  static std::vector<Placed> within(const std::vector<Placed>& triangles, const glm::vec3& centre) {
    std::vector<Placed> out;
    for (const Placed& t : triangles) {
      const glm::vec3 low = glm::min(glm::min(t.a, t.b), t.c), high = glm::max(glm::max(t.a, t.b), t.c);
      if (glm::length(glm::clamp(centre, low, high) - centre) < 1) out.push_back(t);
    }
    return out;
  }
  static const Light& light(bool directional) {
    return *std::ranges::find(model_->lights, directional, &Light::directional);
  }

  static inline Model* model_ = nullptr;
  static inline fs::path* folder_ = nullptr;
};

TEST_F(Gallery, IsTheSameBytesEveryTime) {
  ASSERT_TRUE(writeModel(*model_, *folder_ / "first.glb").has_value());
  ASSERT_TRUE(writeModel(makeGallery(kCoarse), *folder_ / "second.glb").has_value());
  const auto first = readFile(*folder_ / "first.glb"), second = readFile(*folder_ / "second.glb");
  ASSERT_TRUE(first.has_value() && second.has_value());
  EXPECT_TRUE(*first == *second);
}

TEST_F(Gallery, ParsesAsGltfWithEveryEffectItIsThereToShow) {
  ASSERT_TRUE(writeModel(*model_, *folder_ / "gallery.glb").has_value());
  tinygltf::Model read;
  std::string error, warning;
  ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&read, &error, &warning, *folder_ / "gallery.glb"))
      << error;
  EXPECT_EQ(error + warning, "");
  const auto some = [&](auto&& holds) { return std::ranges::any_of(read.materials, holds); };
  using M = tinygltf::Material;
  EXPECT_TRUE(some([](const M& m) { return m.pbrMetallicRoughness.baseColorTexture.index >= 0; }))
      << "textures";
  EXPECT_TRUE(some([](const M& m) { return m.normalTexture.index >= 0; })) << "normal map";
  EXPECT_TRUE(some([](const M& m) { return m.alphaMode == "MASK" && m.doubleSided; })) << "leaves";
  EXPECT_TRUE(some([](const M& m) { return m.extensions.contains("KHR_materials_transmission"); }))
      << "glass";
  EXPECT_TRUE(some([](const M& m) {
    return m.pbrMetallicRoughness.metallicFactor == 1 && m.pbrMetallicRoughness.roughnessFactor == 0;
  })) << "mirror";
  EXPECT_TRUE(some([](const M& m) { return m.emissiveFactor != std::vector<double>{0, 0, 0}; })) << "lamp";
  EXPECT_TRUE(std::ranges::any_of(read.meshes, [](const tinygltf::Mesh& mesh) {
    return std::ranges::any_of(mesh.primitives,
                               [](const tinygltf::Primitive& p) { return p.attributes.contains("COLOR_0"); });
  })) << "vertex colours";
  std::vector<std::string> kinds;
  for (const tinygltf::Light& l : read.lights) kinds.push_back(l.type);
  EXPECT_THAT(kinds, testing::UnorderedElementsAre("directional", "point"));
  EXPECT_GT(
      std::ranges::count_if(read.nodes, [](const tinygltf::Node& n) { return n.name.starts_with("Column"); }),
      1)
      << "instances";
}

TEST_F(Gallery, IsWrittenAsTextWithItsBufferBesideToo) {
  const fs::path path = *folder_ / "gallery.gltf";
  ASSERT_TRUE(writeModel(*model_, path).has_value());
  tinygltf::Model read;
  std::string error, warning;
  ASSERT_TRUE(tinygltf::TinyGLTF().LoadASCIIFromFile(&read, &error, &warning, path)) << error;
  EXPECT_EQ(read.buffers.front().uri, "gallery.bin");
  EXPECT_EQ(read.materials.size(), model_->materials.size());
}

TEST_F(Gallery, IsSmallEnoughToMakeAndShareAtFullSize) {
  ASSERT_TRUE(writeModel(makeGallery(), *folder_ / "full.glb").has_value());
  EXPECT_LT(fs::file_size(*folder_ / "full.glb"), 8u << 20);
}

TEST_F(Gallery, RefusesAnEndingThatIsNoGltf) {
  const Status status = writeModel(*model_, *folder_ / "gallery.obj");
  ASSERT_FALSE(status.has_value());
  EXPECT_THAT(status.error().describe(), testing::HasSubstr("gallery.obj"));
  EXPECT_FALSE(fs::exists(*folder_ / "gallery.obj"));
}

TEST_F(Gallery, HasItsNumberOfTriangles) {
  // Measured; a change of the scene changes it, a change of the machine must not.
  EXPECT_EQ(placed().size(), 148734u);
}

TEST_F(Gallery, HasSoundGeometry) {
  for (const Thing& thing : model_->things) {
    EXPECT_FALSE(thing.placements.empty()) << thing.name;
    for (const Part& part : thing.parts) {
      const Shape& s = part.shape;
      ASSERT_FALSE(s.indices.empty()) << thing.name;
      ASSERT_EQ(s.normals.size(), s.positions.size()) << thing.name;
      ASSERT_EQ(s.uv.size(), s.positions.size()) << thing.name;
      ASSERT_TRUE(s.colours.empty() || s.colours.size() == s.positions.size()) << thing.name;
      ASSERT_LT(*std::ranges::max_element(s.indices), s.positions.size()) << thing.name;
      for (std::size_t i = 0; i < s.positions.size(); ++i) {
        ASSERT_LT(glm::length(s.positions[i]), 100) << thing.name;  // false for NaN
        ASSERT_NEAR(glm::length(s.normals[i]), 1, 1e-3f) << thing.name;
      }
      std::size_t against = 0;
      for (std::size_t i = 0; i + 2 < s.indices.size(); i += 3) {
        const auto a = s.indices[i], b = s.indices[i + 1], c = s.indices[i + 2];
        const glm::vec3 face = glm::cross(s.positions[b] - s.positions[a], s.positions[c] - s.positions[a]);
        against += glm::dot(face, s.normals[a] + s.normals[b] + s.normals[c]) < 0 ? 1 : 0;
      }
      EXPECT_LE(against, s.indices.size() / 3 / 100)
          << thing.name << ": triangles that face against their normals";
    }
  }
}

TEST_F(Gallery, LetsTheSunInByTheDoorAndKeepsItOutElsewhere) {
  const auto triangles = placed();
  const glm::vec3 towards = -light(true).direction;
  EXPECT_TRUE(std::isinf(nearest(triangles, {6.2f, 0.75f, 0.01f}, towards))) << "floor before the door";
  EXPECT_TRUE(std::isinf(nearest(triangles, {9.5f, 1.0f, 0.01f}, towards))) << "terrace";
  EXPECT_TRUE(std::isinf(nearest(triangles, {-1.64f, -1.82f, 0.01f}, towards)))
      << "nave, by a southern window";
  EXPECT_LT(nearest(triangles, {-5.0f, 0.5f, 0.01f}, towards), 10) << "floor under closed coffers";
  EXPECT_LT(nearest(triangles, {5.0f, -4.0f, 0.01f}, towards), 10) << "aisle";
}

TEST_F(Gallery, TheLampLightsTheFloorBelowAndNotItsOwnShade) {
  const auto triangles = placed();
  const glm::vec3 lamp = light(false).position;
  EXPECT_NEAR(nearest(triangles, lamp, {0, 0, -1}), lamp.z, 1e-3f);
  EXPECT_LT(nearest(triangles, lamp, {0, 0, 1}), 0.3f);
}

TEST_F(Gallery, LeavesRoomToWalk) {
  // Along the nave's two sides and the aisles at eye height and at the knee: nothing within 30 cm.
  const auto triangles = placed();
  for (const float y : {-1.9f, 1.9f, -3.7f, 3.7f})
    for (float x = -5.5f; x <= 5.0f; x += 0.5f)
      for (const float z : {0.25f, 1.6f}) {
        const auto around = within(triangles, {x, y, z});
        for (const float side : {-1.0f, 1.0f})
          EXPECT_GT(nearest(around, {x, y, z}, {0, side, 0}), 0.3f) << x << ", " << y << ", " << z;
      }
}

TEST_F(Gallery, TheSamplesWalksKeepTheirDistance) {
  const auto triangles = placed();
  for (const char* name : {"walk", "aisles", "turning"}) {
    const auto text =
        readText(fs::path(ACENTRIC_SOURCE_FOLDER) / "projects/gallery/paths" / (std::string(name) + ".json"));
    ASSERT_TRUE(text.has_value()) << text.error().describe();
    const auto frames = nlohmann::json::parse(*text).at("frames");
    EXPECT_EQ(frames.size(), 60u);
    for (const auto& frame : frames) {
      const glm::vec3 eye(frame.at("eye").at(0), frame.at("eye").at(1), frame.at("eye").at(2));
      for (const float z : {0.3f, eye.z})
        for (int i = 0; i < 16; ++i) {
          const float angle = 0.3926991f * static_cast<float>(i);
          EXPECT_GT(nearest(triangles, {eye.x, eye.y, z}, {std::cos(angle), std::sin(angle), 0}), 0.2f)
              << name << " " << frame;
        }
    }
  }
}

}  // namespace
}  // namespace acentric::gallery
