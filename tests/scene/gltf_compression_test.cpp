#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>
#include <cstring>

#include "tests/scene/scene_fixtures.h"

namespace acentric::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

/// A bumpy sheet of quads, as arrays.
struct Sheet {
  static constexpr int kQuads = 12;
  std::vector<float> positions;
  std::vector<std::uint16_t> indices;
  Sheet() {
    const auto at = [](int x, int y) { return std::uint16_t(y * (kQuads + 1) + x); };
    for (int y = 0; y <= kQuads; ++y)
      for (int x = 0; x <= kQuads; ++x)
        positions.insert(positions.end(),
                         {float(x) / kQuads, float(y) / kQuads, 0.1f * std::sin(float(x * y))});
    for (int y = 0; y < kQuads; ++y)
      for (int x = 0; x < kQuads; ++x)
        indices.insert(indices.end(),
                       {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y), at(x + 1, y + 1), at(x, y + 1)});
  }
  std::size_t vertices() const { return positions.size() / 3; }
};

/// One mesh of positions and indices, whose data is still to be said.
Json skeleton(const Sheet& sheet) {
  return {{"asset", {{"version", "2.0"}}},
          {"scene", 0},
          {"scenes", {{{"nodes", {0}}}}},
          {"nodes", {{{"mesh", 0}}}},
          {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
          {"accessors",
           {{{"componentType", 5126}, {"count", sheet.vertices()}, {"type", "VEC3"}},
            {{"componentType", 5123}, {"count", sheet.indices.size()}, {"type", "SCALAR"}}}}};
}

std::string uriOf(const std::vector<unsigned char>& bytes) {
  return "data:application/octet-stream;base64," + base64(bytes);
}

template <class T>
std::vector<unsigned char> bytesOf(const std::vector<T>& values) {
  std::vector<unsigned char> out(values.size() * sizeof(T));
  std::memcpy(out.data(), values.data(), out.size());
  return out;
}

class GltfCompressionTest : public testing::Test {
 protected:
  enum class Fallback { none, standIn, whole };

  Json plain() const {
    Json json = skeleton(sheet);
    std::vector<unsigned char> bytes = bytesOf(sheet.positions), indices = bytesOf(sheet.indices);
    json["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", bytes.size()}},
                           {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", indices.size()}}};
    bytes.insert(bytes.end(), indices.begin(), indices.end());
    json["accessors"][0]["bufferView"] = 0, json["accessors"][1]["bufferView"] = 1;
    json["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uriOf(bytes)}}};
    return json;
  }

  /// Compressed views in buffer 0, what they stand for in buffer 1.
  Json meshopt(Fallback fallback) {
    std::vector<unsigned char> rows(meshopt_encodeVertexBufferBound(sheet.vertices(), 12));
    rows.resize(
        meshopt_encodeVertexBuffer(rows.data(), rows.size(), sheet.positions.data(), sheet.vertices(), 12));
    std::vector<unsigned char> triangles(
        meshopt_encodeIndexBufferBound(sheet.indices.size(), sheet.vertices()));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), sheet.indices.data(),
                                               sheet.indices.size()));
    Json json = plain();
    Json whole = json["buffers"][0];
    encoded = rows;
    encoded.insert(encoded.end(), triangles.begin(), triangles.end());
    json["buffers"][0] = {{"byteLength", encoded.size()}, {"uri", uriOf(encoded)}};
    if (fallback != Fallback::whole) whole.erase("uri");
    if (fallback == Fallback::standIn) whole["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
    json["buffers"].push_back(whole);
    const auto compress = [&](int view, Json extension) {
      json["bufferViews"][view]["buffer"] = 1;
      json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"] = std::move(extension);
    };
    compress(0, {{"buffer", 0},
                 {"byteOffset", 0},
                 {"byteLength", rows.size()},
                 {"byteStride", 12},
                 {"count", sheet.vertices()},
                 {"mode", "ATTRIBUTES"}});
    compress(1, {{"buffer", 0},
                 {"byteOffset", rows.size()},
                 {"byteLength", triangles.size()},
                 {"byteStride", 2},
                 {"count", sheet.indices.size()},
                 {"mode", "TRIANGLES"}});
    json["extensionsUsed"] = {"EXT_meshopt_compression"};
    if (fallback != Fallback::whole) json["extensionsRequired"] = {"EXT_meshopt_compression"};
    return json;
  }

  Json draco(bool fallback) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(int(sheet.indices.size() / 3));
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (std::size_t t = 0; t < sheet.indices.size() / 3; ++t) {
      const auto corner = [&](std::size_t k) { return &sheet.positions[3u * sheet.indices[3 * t + k]]; };
      builder.SetAttributeValuesForFace(position, draco::FaceIndex(std::uint32_t(t)), corner(0), corner(1),
                                        corner(2));
    }
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    encoded.assign(buffer.data(), buffer.data() + buffer.size());
    Json json = fallback ? plain() : skeleton(sheet);
    json["buffers"].push_back({{"byteLength", encoded.size()}, {"uri", uriOf(encoded)}});
    json["bufferViews"].push_back({{"buffer", json["buffers"].size() - 1}, {"byteLength", encoded.size()}});
    json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", json["bufferViews"].size() - 1},
        {"attributes", {{"POSITION", mesh->attribute(position)->unique_id()}}}};
    json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    if (!fallback) json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return json;
  }

  Result<Scene> parsed(const Json& json) {
    const auto path = folder.path() / "model.gltf";
    EXPECT_TRUE(writeTextAtomically(path, json.dump()));
    return parseScene(path, {});
  }
  Result<Scene> parsedBinary(Json json) {
    json["buffers"][0].erase("uri");
    std::string text = json.dump();
    while (text.size() % 4) text += ' ';
    std::vector<unsigned char> chunk = encoded;
    while (chunk.size() % 4) chunk.push_back(0);
    std::string file = "glTF";
    const auto word = [&](std::size_t value) {
      const auto bits = std::uint32_t(value);
      file.append(reinterpret_cast<const char*>(&bits), 4);
    };
    word(2), word(12 + 8 + text.size() + 8 + chunk.size());
    word(text.size()), file += "JSON" + text;
    word(chunk.size()), file += std::string("BIN\0", 4) + std::string(chunk.begin(), chunk.end());
    const auto path = folder.path() / "model.glb";
    EXPECT_TRUE(writeTextAtomically(path, file));
    return parseScene(path, {});
  }
  /// The triangles' corners, in a fixed order.
  static std::vector<std::array<glm::vec3, 3>> trianglesOf(const Scene& scene) {
    std::vector<std::array<glm::vec3, 3>> out;
    const auto before = [](const glm::vec3& a, const glm::vec3& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    for (const Mesh& mesh : scene.meshes)
      for (const glm::uvec3& t : mesh.triangles) {
        std::array<glm::vec3, 3> corners{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
        std::ranges::rotate(corners, std::ranges::min_element(corners, before));
        out.push_back(corners);
      }
    std::ranges::sort(out, [&](const auto& a, const auto& b) {
      return std::ranges::lexicographical_compare(a, b, before);
    });
    return out;
  }
  void expectTheSheet(const Result<Scene>& scene, float tolerance) {
    ASSERT_TRUE(scene) << scene.error().describe();
    expectSound(*scene);
    const auto expected = trianglesOf(parsed(plain()).value());
    ASSERT_EQ(scene->triangleCount(), expected.size());
    if (tolerance == 0) {
      EXPECT_EQ(trianglesOf(*scene), expected);
      return;
    }
    double area = 0, expectedArea = 0;
    const auto areaOf = [](const auto& t) { return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0])); };
    for (const auto& t : trianglesOf(*scene)) area += double(areaOf(t));
    for (const auto& t : expected) expectedArea += double(areaOf(t));
    EXPECT_NEAR(area, expectedArea, double(tolerance) * expectedArea);
    EXPECT_LT(glm::distance(scene->bounds.min, parsed(plain())->bounds.min), tolerance);
    EXPECT_LT(glm::distance(scene->bounds.max, parsed(plain())->bounds.max), tolerance);
  }

  TemporaryFolder folder{"gltf_compression"};
  Sheet sheet;
  std::vector<unsigned char> encoded;
};

TEST_F(GltfCompressionTest, MeshoptGivesTheVeryTrianglesWithAndWithoutAFallback) {
  for (const Fallback fallback : {Fallback::none, Fallback::standIn, Fallback::whole}) {
    expectTheSheet(parsed(meshopt(fallback)), 0);
    expectTheSheet(parsedBinary(meshopt(fallback)), 0);
  }
}

TEST_F(GltfCompressionTest, DracoGivesTheTrianglesToWithinItsQuantizationWithAndWithoutAFallback) {
  for (const bool fallback : {false, true}) expectTheSheet(parsed(draco(fallback)), 1e-3f);
  expectTheSheet(parsedBinary(draco(false)), 1e-3f);
}

TEST_F(GltfCompressionTest, MeshoptFiltersGiveUnitNormalsAndPositionsFromExponents) {
  Json json = meshopt(Fallback::none);
  // Exponential: value = mantissa * 2^exponent, here eighths.
  std::vector<std::uint32_t> rows;
  for (const float p : sheet.positions)
    rows.push_back(std::uint32_t(-3) << 24 | (std::uint32_t(std::lround(8 * p)) & 0xffffff));
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(sheet.vertices(), 12));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), rows.data(), sheet.vertices(), 12));
  json["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", uriOf(bytes)}});
  json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 2},          {"byteLength", bytes.size()}, {"byteStride", 12}, {"count", sheet.vertices()},
      {"mode", "ATTRIBUTES"}, {"filter", "EXPONENTIAL"}};
  const auto scene = parsed(json);
  ASSERT_TRUE(scene) << scene.error().describe();
  for (const glm::vec3& p : scene->meshes[0].positions)
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(8 * p[axis], std::round(8 * p[axis]));
  EXPECT_EQ(scene->bounds.max.x, 1);
}

TEST_F(GltfCompressionTest, DamageIsRefusedByName) {
  const auto refusal = [&](const Json& json) {
    const auto scene = parsed(json);
    EXPECT_FALSE(scene);
    return scene ? std::string() : scene.error().message;
  };
  const auto meshoptWith = [&](const char* key, Json value) {
    Json json = meshopt(Fallback::none);
    json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = std::move(value);
    return refusal(json);
  };
  EXPECT_THAT(meshoptWith("count", std::size_t(1) << 40), HasSubstr("cannot hold"));
  EXPECT_THAT(meshoptWith("count", 2 * sheet.vertices()), HasSubstr("damaged"));
  EXPECT_THAT(meshoptWith("byteStride", 13), HasSubstr("rows of 13 bytes"));
  EXPECT_THAT(meshoptWith("buffer", 9), HasSubstr("buffer 9"));
  EXPECT_THAT(meshoptWith("byteOffset", std::size_t(1) << 50), HasSubstr("past the end"));
  EXPECT_THAT(meshoptWith("byteLength", -4), HasSubstr("byteLength"));
  EXPECT_THAT(meshoptWith("mode", "SPLATS"), HasSubstr("'SPLATS'"));
  EXPECT_THAT(meshoptWith("filter", "QUATERNION"), HasSubstr("'QUATERNION'"));
  const auto dracoWith = [&](const auto& change) {
    Json json = draco(false);
    change(json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"], json);
    return refusal(json);
  };
  EXPECT_THAT(dracoWith([](Json& d, Json&) { d["bufferView"] = 7; }), HasSubstr("buffer view 7"));
  EXPECT_THAT(dracoWith([](Json& d, Json&) { d["attributes"]["POSITION"] = 7; }), HasSubstr("attribute"));
  EXPECT_THAT(dracoWith([](Json& d, Json&) { d.erase("attributes"); }), HasSubstr("no attributes"));
  EXPECT_THAT(dracoWith([&](Json&, Json& json) {
                std::vector<unsigned char> cut(encoded.begin(), encoded.begin() + encoded.size() / 2);
                json["buffers"][0] = {{"byteLength", cut.size()}, {"uri", uriOf(cut)}};
                json["bufferViews"][0]["byteLength"] = cut.size();
              }),
              HasSubstr("KHR_draco_mesh_compression: its data is damaged"));
}

TEST_F(GltfCompressionTest, EveryFlippedByteOfWhatIsEncodedIsReadOrRefused) {
  std::size_t refused = 0;
  const auto flip = [&](Json json) {
    const std::vector<unsigned char> sound = encoded;
    for (std::size_t i = 0; i < sound.size(); i += 7) {
      std::vector<unsigned char> broken = sound;
      broken[i] ^= static_cast<unsigned char>(0x55u + i);
      json["buffers"][0]["uri"] = uriOf(broken);
      refused += !parsed(json).has_value();
    }
  };
  flip(meshopt(Fallback::none));
  flip(draco(false));
  EXPECT_GT(refused, 5u);
}

TEST_F(GltfCompressionTest, RequiredExtensionsThatAreMissingSayWhatWouldBeLostAndHowToDoWithout) {
  Json json = plain();
  json["extensionsUsed"] = json["extensionsRequired"] = {"MSFT_texture_dds"};
  const auto scene = parsed(json);
  ASSERT_FALSE(scene);
  for (const char* words : {"MSFT_texture_dds", "textures that are DDS pictures would be lost", "convert"})
    EXPECT_THAT(scene.error().message, HasSubstr(words));
  json["extensionsRequired"] = {"VENDOR_never_heard_of"};
  EXPECT_THAT(parsed(json).error().message, HasSubstr("VENDOR_never_heard_of"));
  json["extensionsRequired"] = {"EXT_mesh_features"};
  EXPECT_TRUE(parsed(json)) << "nothing that is seen is lost";
  json.erase("extensionsRequired");
  json["extensionsUsed"] = {"KHR_materials_clearcoat"};
  EXPECT_TRUE(mentions(parsed(json)->report.ignored, "KHR_materials_clearcoat: the shine of clear coats"));
}

TEST_F(GltfCompressionTest, BasisUniversalTexturesLeaveTheColourFactorAndAWord) {
  Json json = plain();
  json["extensionsUsed"] = json["extensionsRequired"] = {"KHR_texture_basisu"};
  json["images"] = {{{"uri", uriOf({1, 2, 3})}, {"mimeType", "image/ktx2"}}};
  json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
  json["materials"] = {{{"pbrMetallicRoughness",
                         {{"baseColorFactor", {0.5, 0.25, 1, 1}}, {"baseColorTexture", {{"index", 0}}}}}}};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  const auto scene = parsed(json);
  ASSERT_TRUE(scene) << scene.error().describe();
  EXPECT_TRUE(mentions(scene->report.ignored, "KHR_texture_basisu"));
  EXPECT_TRUE(mentions(scene->report.ignored, "convert"));
  EXPECT_FALSE(scene->materials[0].baseColourTexture.used());
  EXPECT_EQ(scene->materials[0].baseColour, glm::vec4(0.5f, 0.25f, 1, 1));
}

}  // namespace
}  // namespace acentric::test
