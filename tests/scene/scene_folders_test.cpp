/// Every file of the shared folders through the importer process, and the large scenes' known figures.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "engine/scene/effect_plan.h"
#include "tests/scene/scene_fixtures.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;

struct FolderResult {
  int imported = 0;
  std::set<std::string> refused;  ///< file names
};

/// Imports every model below `root`: each comes in or is refused in one line that names it, in time, and
/// leaves nothing but whole cache entries.
FolderResult importFolder(const fs::path& root) {
  const std::set<std::string> models{".gltf", ".glb", ".obj", ".ply", ".off",     ".stl", ".dae", ".3ds",
                                     ".ase",  ".lwo", ".x",   ".smd", ".md5mesh", ".raw", ".xml", ".fbx"};
  const TemporaryFolder cache("scene_folders");
  ImportHost host;
  host.importer = ACENTRIC_IMPORTER;
  host.cacheFolder = cache.path();
  host.timeLimitSeconds = 10;
  host.memoryLimitBytes = std::size_t(4) << 30;
  FolderResult result;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root))
    if (entry.is_regular_file() && models.contains(entry.path().extension().string()))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const auto scene = importScene(file, {}, host);
    if (scene) {
      ++result.imported;
      expectSound(**scene);
      EXPECT_TRUE(planEffects(**scene)[Effect::softShadows].calledFor == false);
    } else {
      result.refused.insert(file.filename().string());
      EXPECT_EQ(scene.error().where, file.string());
      EXPECT_FALSE(scene.error().message.empty());
      EXPECT_EQ(scene.error().describe().find('\n'), std::string::npos) << scene.error().describe();
      EXPECT_NE(scene.error().kind, ErrorKind::timeout) << file;
      EXPECT_NE(scene.error().kind, ErrorKind::internal) << scene.error().describe();
    }
  }
  for (const auto& entry : fs::directory_iterator(cache.path())) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(kTemporaryPrefix)) << entry.path();
    EXPECT_TRUE(readSceneFile(entry.path())) << entry.path();
  }
  return result;
}

TEST(SceneFolders, EveryEffectFileIsImportedOrRefused) {
  ACENTRIC_NEEDS_SCENES();
  const FolderResult result = importFolder(scenesFolder() / "gltf_effects");
  // Nothing but points or lines, empty, or beyond glTF 2.0: nothing else is refused.
  const std::set<std::string> expected{
      "00_empty_scene.gltf",        "00_no_nodes.gltf",           "00_no_scenes.gltf",
      "Compatibility_04.gltf",      "Compatibility_05.gltf",      "Mesh_PrimitiveMode_00.gltf",
      "Mesh_PrimitiveMode_01.gltf", "Mesh_PrimitiveMode_02.gltf", "Mesh_PrimitiveMode_03.gltf",
      "Mesh_PrimitiveMode_07.gltf", "Mesh_PrimitiveMode_08.gltf", "Mesh_PrimitiveMode_09.gltf",
      "Mesh_PrimitiveMode_10.gltf"};
  EXPECT_EQ(result.refused, expected);
  EXPECT_GT(result.imported, 70);
}

TEST(SceneFolders, EveryMalformedFileIsImportedOrRefused) {
  ACENTRIC_NEEDS_SCENES();
  const FolderResult result = importFolder(scenesFolder() / "malformed");
  for (const char* broken :
       {"OutOfMemory.off", "crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply", "RecursiveNodes.gltf",
        "AllIndicesOutOfRange.gltf", "BoxWithInfinites.glb", "empty.obj", "NoScene.gltf"})
    EXPECT_TRUE(result.refused.contains(broken)) << broken;
  EXPECT_GT(result.imported, 40);
}

struct KnownScene {
  const char* file;
  std::size_t triangles;  ///< in the file, degenerate ones counted
  std::size_t fewestDropped, mostDropped;
  glm::vec3 min, max;  ///< metres, Z up
  float tolerance;
};

class KnownScenes : public testing::TestWithParam<KnownScene> {};

TEST_P(KnownScenes, HaveTheCataloguesFigures) {
  ACENTRIC_NEEDS_SCENES();
  const KnownScene& known = GetParam();
  const TemporaryFolder cache("known_scenes");
  ImportHost host;
  host.importer = ACENTRIC_IMPORTER;
  host.cacheFolder = cache.path();
  const auto seconds = [](auto start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  auto start = std::chrono::steady_clock::now();
  const auto first = importScene(scenesFolder() / known.file, {}, host);
  const double firstSeconds = seconds(start);
  ASSERT_TRUE(first) << first.error().describe();
  start = std::chrono::steady_clock::now();
  const auto second = importScene(scenesFolder() / known.file, {}, host);
  const double secondSeconds = seconds(start);
  ASSERT_TRUE(second) << second.error().describe();
  RecordProperty("firstOpenSeconds", std::to_string(firstSeconds));
  RecordProperty("secondOpenSeconds", std::to_string(secondSeconds));
  const Scene& scene = **first;
  expectSound(scene);
  EXPECT_EQ((*second)->key, scene.key);
  EXPECT_LE(scene.triangleCount(), known.triangles - known.fewestDropped);
  EXPECT_GE(scene.triangleCount(), known.triangles - known.mostDropped);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(scene.bounds.min[axis], known.min[axis], known.tolerance) << axis;
    EXPECT_NEAR(scene.bounds.max[axis], known.max[axis], known.tolerance) << axis;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , KnownScenes,
    testing::Values(
        KnownScene{
            "virtual_gallery/scene.gltf", 27126, 0, 0, {-9.34f, -19.18f, 0}, {17.71f, 5.50f, 5.65f}, 0.011f},
        KnownScene{
            "calle_coreana/scene.gltf", 39505, 0, 0, {-51.6f, -86.3f, -3.0f}, {63.5f, 48.8f, 30.7f}, 0.06f},
        KnownScene{"sponza_geometry/sponza_s_lod4.glb",
                   187364,
                   0,
                   2,
                   {-16.25f, -10.40f, -1.13f},
                   {20.0f, 9.40f, 18.76f},
                   0.011f},
        KnownScene{"country_kitchen/country_kitchen.glb",
                   1021813,
                   100,
                   400,
                   {-3.14f, -5.47f, -0.02f},
                   {3.78f, 3.18f, 3.36f},
                   0.011f}),
    [](const auto& known) { return fs::path(known.param.file).parent_path().string(); });

TEST(SceneFolders, TheEffectPlansOfTheLargeScenesNameWhatIsInThem) {
  ACENTRIC_NEEDS_SCENES();
  const auto sponza = parseScene(scenesFolder() / "sponza_geometry/sponza_s_lod4.glb", {});
  ASSERT_TRUE(sponza) << sponza.error().describe();
  const EffectPlan bare = planEffects(*sponza);
  for (const Effect effect : {Effect::textures, Effect::vertexColours, Effect::alphaTest, Effect::alphaBlend,
                              Effect::emission, Effect::mirrorReflection, Effect::transmission,
                              Effect::normalMaps, Effect::unlit, Effect::pointLights})
    EXPECT_FALSE(bare[effect].calledFor) << nameOf(effect) << ": " << bare[effect].reason;
  const auto gallery = parseScene(scenesFolder() / "virtual_gallery/scene.gltf", {});
  ASSERT_TRUE(gallery) << gallery.error().describe();
  const EffectPlan rich = planEffects(*gallery);
  for (const Effect effect : {Effect::textures, Effect::alphaBlend, Effect::emission, Effect::normalMaps})
    EXPECT_TRUE(rich[effect].calledFor) << nameOf(effect) << ": " << rich[effect].reason;
}

}  // namespace
}  // namespace acentric::test
