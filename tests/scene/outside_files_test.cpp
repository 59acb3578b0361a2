/// A model reads only what lies in its own folder: a file from elsewhere would be published with it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tests/scene/scene_fixtures.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// PNG of one red pixel.
constexpr unsigned char kPng[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d,
                                  0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01,
                                  0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00,
                                  0x0c, 0x49, 0x44, 0x41, 0x54, 0x08, 0xd7, 0x63, 0xf8, 0xcf, 0xc0, 0x00,
                                  0x00, 0x03, 0x01, 0x01, 0x00, 0x18, 0xdd, 0x8d, 0xb0, 0x00, 0x00, 0x00,
                                  0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

class OutsideFiles : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder.path() / "model");
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
    write(folder.path() / "corners.bin", corners.data(), corners.size() * sizeof(float));
    write(folder.path() / "picture.png", kPng, sizeof kPng);
  }
  static void write(const fs::path& path, const void* data, std::size_t size) {
    std::ofstream(path, std::ios::binary).write(static_cast<const char*>(data), std::streamsize(size));
  }
  Result<Scene> withBuffer(const std::string& uri, bool allowed = false) {
    GltfBuilder builder;
    builder.triangle();
    (void)builder.write(model());
    builder.json["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
    return parsed(builder.json, allowed);
  }
  Result<Scene> withImage(const std::string& uri, bool allowed = false) {
    GltfBuilder builder;
    builder.triangle();
    builder.primitive()["attributes"]["TEXCOORD_0"] = builder.vec2({0, 0, 1, 0, 0, 1});
    builder.primitive()["material"] = 0;
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["images"] = {{{"uri", uri}}};
    (void)builder.write(model());
    return parsed(builder.json, allowed);
  }
  Result<Scene> parsed(const nlohmann::json& json, bool allowed) {
    EXPECT_TRUE(writeTextAtomically(model(), json.dump()));
    ImportOptions options;
    options.outsideFiles = allowed;
    return parseScene(model(), options);
  }
  fs::path model() const { return folder.path() / "model" / "model.gltf"; }
  std::vector<std::string> waysOut(const std::string& name) const {
    return {"../" + name,        "%2e%2e/" + name, "..%2F" + name, "..\\" + name,
            "sub/../../" + name, "link-" + name,   "up/" + name,   (folder.path() / name).string()};
  }
  void linkOut(const std::string& name) {
    fs::create_directories(folder.path() / "model" / "sub");
    fs::create_symlink("../" + name, folder.path() / "model" / ("link-" + name));
    fs::create_directory_symlink("..", folder.path() / "model" / "up");
  }

  TemporaryFolder folder{"outside_files"};
};

TEST_F(OutsideFiles, NoBufferIsReadWhateverTheWayToItAndTheMessageNamesItAndTheSwitch) {
  linkOut("corners.bin");
  for (const std::string& uri : waysOut("corners.bin")) {
    const auto scene = withBuffer(uri);
    ASSERT_FALSE(scene) << uri;
    EXPECT_EQ(scene.error().where, model().string());
    for (const std::string& words : {std::string("corners.bin"), std::string("outside the model's folder"),
                                     std::string("--outside-files")})
      EXPECT_THAT(scene.error().message, HasSubstr(words)) << uri;
  }
  EXPECT_FALSE(withBuffer("file://" + (folder.path() / "corners.bin").string()));
  const auto allowed = withBuffer("../corners.bin", true);
  ASSERT_TRUE(allowed) << allowed.error().describe();
  EXPECT_EQ(allowed->triangleCount(), 1u);
}

TEST_F(OutsideFiles, NoImageIsReadWhateverTheWayToItAndTheReportNamesItAndTheSwitch) {
  linkOut("picture.png");
  for (const std::string& uri : waysOut("picture.png")) {
    const auto scene = withImage(uri);
    ASSERT_TRUE(scene) << uri << ": " << scene.error().describe();
    EXPECT_TRUE(scene->images.empty()) << uri;
    EXPECT_TRUE(mentions(scene->report.ignored, "outside the model's folder")) << uri;
    EXPECT_TRUE(mentions(scene->report.ignored, "--outside-files")) << uri;
  }
  const auto allowed = withImage("../picture.png", true);
  ASSERT_TRUE(allowed) << allowed.error().describe();
  EXPECT_EQ(allowed->images.size(), 1u);
}

TEST_F(OutsideFiles, WhatLiesInTheFolderIsReadThoughLinksAndDotsLeadToIt) {
  fs::create_directories(folder.path() / "model" / "sub");
  fs::copy(folder.path() / "picture.png", folder.path() / "model" / "picture.png");
  fs::create_symlink("../picture.png", folder.path() / "model" / "sub" / "link.png");
  for (const char* uri : {"picture.png", "sub/../picture.png", "sub/link.png", "sub\\link.png"}) {
    const auto scene = withImage(uri);
    ASSERT_TRUE(scene) << uri;
    EXPECT_EQ(scene->images.size(), 1u) << uri;
  }
  // A model that is a link itself: its folder is where it leads.
  const fs::path linked = folder.path() / "linked.gltf";
  ASSERT_TRUE(withImage("picture.png"));
  fs::create_symlink(model(), linked);
  const auto scene = parseScene(linked, {});
  ASSERT_TRUE(scene) << scene.error().describe();
  EXPECT_EQ(scene->images.size(), 1u);
}

TEST_F(OutsideFiles, MaterialsAndTexturesOfOtherFormatsAreHeldToTheSame) {
  ASSERT_TRUE(writeTextAtomically(folder.path() / "outside.mtl", "newmtl red\nKd 1 0 0\n"));
  ASSERT_TRUE(writeTextAtomically(folder.path() / "model" / "inside.mtl",
                                  "newmtl red\nKd 1 0 0\nmap_Kd ../picture.png\n"));
  const fs::path obj = folder.path() / "model" / "model.obj";
  const auto with = [&](const std::string& library, bool allowed) {
    EXPECT_TRUE(writeTextAtomically(obj, "mtllib " + library +
                                             "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl "
                                             "red\nf 1/1 2/2 3/3\n"));
    ImportOptions options;
    options.outsideFiles = allowed;
    return parseScene(obj, options);
  };
  const auto material = with("../outside.mtl", false);
  ASSERT_TRUE(material) << material.error().describe();
  EXPECT_TRUE(mentions(material->report.ignored, "outside.mtl"));
  EXPECT_TRUE(mentions(material->report.ignored, "--outside-files"));
  for (const Material& m : material->materials) EXPECT_NE(m.baseColour, glm::vec4(1, 0, 0, 1));
  const auto texture = with("inside.mtl", false);
  ASSERT_TRUE(texture) << texture.error().describe();
  EXPECT_TRUE(texture->images.empty());
  EXPECT_TRUE(mentions(texture->report.ignored, "picture.png"));
  EXPECT_EQ(with("inside.mtl", true)->images.size(), 1u);
}

}  // namespace
}  // namespace acentric::test
