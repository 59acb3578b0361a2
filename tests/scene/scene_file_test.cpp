#include "engine/scene/scene_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <functional>
#include <random>

#include "tests/scene/scene_fixtures.h"

namespace acentric::test {
namespace {

Scene sampleScene() {
  Scene scene;
  scene.name = "sample";
  scene.origin = {1, 2, 3};
  Material material;
  material.name = "glass";
  material.baseColour = {0.1f, 0.2f, 0.3f, 0.4f};
  material.baseColourTexture = {0, 1, glm::mat3x2(1, 2, 3, 4, 5, 6)};
  material.alphaMode = AlphaMode::blend;
  material.transmission = 0.5f;
  material.doubleSided = true;
  scene.materials = {material};
  Mesh mesh;
  mesh.name = "pane";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.tangents.assign(4, {1, 0, 0, -1});
  mesh.uv[0].assign(4, {0.5f, 0.25f});
  mesh.uv[1].assign(4, {0.75f, 0.5f});
  mesh.colours.assign(4, {1, 2, 3, 4});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes = {mesh};
  scene.textures = {{"wood", 0, Wrap::clamp, Wrap::mirror, true}};
  scene.images = {std::make_shared<const ColourImage>(ColourImage(3, 2, {9, 8, 7, 6}))};
  Light light;
  light.name = "lamp";
  light.kind = LightKind::spot;
  light.intensity = 12;
  scene.lights = {light};
  scene.sky.zenith = {0, 0, 1};
  scene.bounds = boundsOf(scene);
  scene.report.found = {"2 triangles in 1 mesh"};
  scene.report.guessed = {"up axis: Y"};
  scene.parts = partsOf(scene);
  scene.key = keyOf(scene.parts);
  return scene;
}

TEST(SceneFile, ARoundTripKeepsEverything) {
  const TemporaryFolder folder("scene_file");
  const Scene scene = sampleScene();
  ASSERT_TRUE(writeSceneFile(scene, folder.path() / "s.acscene"));
  const auto back = readSceneFile(folder.path() / "s.acscene");
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(back->key, scene.key);
  EXPECT_EQ(back->parts, scene.parts);
  EXPECT_EQ(keyOf(*back), scene.key);  // whatever can change a pixel
  EXPECT_EQ(back->name, scene.name);
  EXPECT_EQ(back->materials[0].name, "glass");
  EXPECT_EQ(back->meshes[0].name, "pane");
  EXPECT_EQ(back->textures[0].name, "wood");
  EXPECT_EQ(back->lights[0].name, "lamp");
  EXPECT_EQ(back->bounds.max, scene.bounds.max);
  EXPECT_EQ(back->report.found, scene.report.found);
  EXPECT_EQ(back->report.guessed, scene.report.guessed);
}

TEST(SceneFile, TheGeometryIsMappedAndCanBeReadBeyondItsEnds) {
  const TemporaryFolder folder("scene_file");
  const auto path = folder.path() / "s.acscene";
  Scene scene = sampleScene();
  scene.prototypes = {scene.meshes[0]};
  scene.instances = {{0, glm::mat4x3(1)}};
  ASSERT_TRUE(writeSceneFile(scene, path));
  const auto back = readSceneFile(path);
  ASSERT_TRUE(back) << back.error().describe();
  std::filesystem::remove(path);  // the pages stay
  const auto expectMapped = [](const auto& array) {
    EXPECT_TRUE(array.isMapped());
    const auto* const data = reinterpret_cast<const std::byte*>(array.data());
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(data) % 16, 0u);
    const std::span behind(data + std::as_bytes(std::span(array)).size(), MeshArray<int>::kPadding);
    EXPECT_TRUE(std::ranges::all_of(behind, [](std::byte b) { return b == std::byte(0); }));
  };
  for (const Mesh& mesh : {std::cref(back->meshes[0]), std::cref(back->prototypes[0])}) {
    expectMapped(mesh.positions);
    expectMapped(mesh.normals);
    expectMapped(mesh.tangents);
    expectMapped(mesh.uv[0]);
    expectMapped(mesh.uv[1]);
    expectMapped(mesh.colours);
    expectMapped(mesh.triangles);
    EXPECT_EQ(mesh.positions, scene.meshes[0].positions);
    EXPECT_EQ(mesh.triangles, scene.meshes[0].triangles);
  }
}

/// A count that no geometry is there for must not be believed, whatever the checksum says.
TEST(SceneFile, ArraysLongerThanTheGeometryAreRefused) {
  const TemporaryFolder folder("scene_file");
  const auto path = folder.path() / "s.acscene";
  Scene scene = sampleScene();
  scene.meshes[0].colours.clear();
  ASSERT_TRUE(writeSceneFile(scene, path));
  const auto short_ = readFile(path);
  scene.meshes[0].colours.assign(4, {1, 2, 3, 4});
  ASSERT_TRUE(writeSceneFile(scene, path));
  const auto long_ = readFile(path);
  ASSERT_TRUE(short_ && long_);
  // The scene of the one with the geometry of the other: sizes and checksum made to fit.
  const auto number = [](const std::vector<std::byte>& bytes, std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  constexpr std::size_t kDependencies = 16, kPacked = 24, kGeometry = 40, kChecksum = 48, kHeader = 64;
  const auto joined = [&](const std::vector<std::byte>& scenes, const std::vector<std::byte>& geometries) {
    std::vector<std::byte> out(scenes.begin(), scenes.end() - std::ptrdiff_t(number(scenes, kGeometry)));
    const std::uint64_t bytes = number(geometries, kGeometry);
    out.insert(out.end(), geometries.end() - std::ptrdiff_t(bytes), geometries.end());
    std::memcpy(out.data() + kGeometry, &bytes, sizeof bytes);
    Hasher hasher;
    hasher.bytes(out.data() + kHeader, out.size() - kHeader);
    const ContentKey sum = hasher.value(kSceneFileVersion)
                               .value(number(out, kDependencies))
                               .value(number(out, kPacked))
                               .value(number(out, kPacked + 8))
                               .value(bytes)
                               .finish();
    std::memcpy(out.data() + kChecksum, &sum, sizeof sum);
    EXPECT_TRUE(writeFileAtomically(path, out));
    return readSceneFile(path);
  };
  EXPECT_TRUE(joined(*long_, *long_));
  for (const auto& refused : {joined(*long_, *short_), joined(*short_, *long_)}) {
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::malformed);
    EXPECT_EQ(refused.error().message, "has broken contents");
  }
}

TEST(SceneFile, EveryTruncationAndEveryFlippedByteIsRefused) {
  const TemporaryFolder folder("scene_file");
  const auto path = folder.path() / "s.acscene";
  ASSERT_TRUE(writeSceneFile(SceneFile{sampleScene(), {{"a.png", true, 1, 2, 3, {4, 5}}}}, path));
  const auto whole = readFile(path);
  ASSERT_TRUE(whole);
  const auto refuses = [&](const std::vector<std::byte>& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    const auto scene = readSceneFile(path);
    return !scene &&
           (scene.error().kind == ErrorKind::malformed || scene.error().kind == ErrorKind::unsupported);
  };
  std::mt19937 random(3);
  for (std::size_t i = 0; i < whole->size(); i += i < 80 ? 1 : 1 + random() % 7) {
    EXPECT_TRUE(refuses({whole->begin(), whole->begin() + std::ptrdiff_t(i)})) << "cut at " << i;
    auto flipped = *whole;
    flipped[i] ^= std::byte(1u << random() % 8);
    EXPECT_TRUE(refuses(flipped)) << "byte " << i;
  }
  auto longer = *whole;
  longer.push_back(std::byte(0));
  EXPECT_TRUE(refuses(longer));
}

TEST(SceneFile, BrokenPromisesWithAnIntactChecksumAreRefused) {
  const TemporaryFolder folder("scene_file");
  const auto path = folder.path() / "s.acscene";
  const auto refused = [&](auto breakIt) {
    Scene scene = sampleScene();
    breakIt(scene);
    EXPECT_TRUE(writeSceneFile(scene, path));
    const auto back = readSceneFile(path);
    return !back && back.error().kind == ErrorKind::malformed;
  };
  EXPECT_TRUE(refused([](Scene& s) { s.meshes[0].triangles[1].z = 4; }));
  EXPECT_TRUE(refused([](Scene& s) { s.meshes[0].material = 1; }));
  EXPECT_TRUE(refused([](Scene& s) { s.meshes[0].uv[1].pop_back(); }));
  EXPECT_TRUE(refused([](Scene& s) { s.textures[0].image = 1; }));
  EXPECT_TRUE(refused([](Scene& s) { s.materials[0].baseColourTexture.texture = 5; }));
  EXPECT_TRUE(refused([](Scene& s) { s.materials[0].baseColourTexture.uvSet = 2; }));
  EXPECT_TRUE(refused([](Scene& s) { s.images[0] = nullptr; }));
  EXPECT_FALSE(refused([](Scene&) {}));
}

TEST(SceneKey, ChangesWithEveryVisibleProperty) {
  const ContentKey plain = keyOf(sampleScene());
  const auto changed = [&](auto change) {
    Scene scene = sampleScene();
    change(scene);
    return keyOf(scene) != plain;
  };
  EXPECT_TRUE(changed([](Scene& s) { s.materials[0].baseColour.a = 0.5f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[0].baseColourTexture.transform[2].y = 7; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[0].alphaMode = AlphaMode::mask; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[0].unlit = true; }));
  EXPECT_TRUE(changed([](Scene& s) { s.meshes[0].positions[2].z = 1e-6f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.meshes[0].colours[0].r = 9; }));
  EXPECT_TRUE(changed([](Scene& s) { s.textures[0].nearest = false; }));
  EXPECT_TRUE(changed([](Scene& s) {
    s.images[0] = std::make_shared<const ColourImage>(ColourImage(2, 3, {9, 8, 7, 6}));
  }));
  EXPECT_TRUE(changed([](Scene& s) { s.lights[0].outerCone = 0.1f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.lights[0].radius = 0.1f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.lights[0].angularRadius = 0.1f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.sky.ground.r = 0.1f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.origin.x = 0; }));
  const SceneParts parts = partsOf(sampleScene());
  const auto partsAfter = [&](auto change) {
    Scene scene = sampleScene();
    change(scene);
    return partsOf(scene);
  };
  SceneParts moved = partsAfter([](Scene& s) { s.meshes[0].positions[2].z = 1; });
  EXPECT_NE(moved.geometry, parts.geometry);
  moved.geometry = parts.geometry;
  EXPECT_EQ(moved, parts) << "only the geometry";
  SceneParts painted = partsAfter([](Scene& s) { s.textures[0].nearest = false; });
  EXPECT_NE(painted.materials, parts.materials);
  painted.materials = parts.materials;
  EXPECT_EQ(painted, parts) << "only the materials";
  SceneParts lit = partsAfter([](Scene& s) { s.sky.ground.r = 0.1f; });
  EXPECT_NE(lit.lights, parts.lights);
  lit.lights = parts.lights;
  EXPECT_EQ(lit, parts) << "only the lights";
  EXPECT_FALSE(
      changed([](Scene& s) { s.name = "other", s.materials[0].name = "other", s.report.found.clear(); }));
}

}  // namespace
}  // namespace acentric::test
