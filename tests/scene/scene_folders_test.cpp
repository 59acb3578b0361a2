/// Every file of the shared folders through the importer process, and the large scenes' known figures.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ostream>
#include <set>

#include "engine/base/file.h"
#include "engine/scene/effect_plan.h"
#include "tests/scene/scene_fixtures.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;

/// Processor seconds that a file may take. Sanitizers slow the importer down and take the place of its memory
/// limit, which stops the greediest files early.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kMostSeconds = 60;
#else
constexpr double kMostSeconds = 10;
#endif

/// Processor seconds of all child processes so far. A loaded machine stretches the wall clock, not this.
double childSeconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::vector<fs::path> modelsIn(const fs::path& root) {
  const std::set<std::string> extensions{".gltf", ".glb", ".obj", ".ply", ".off",     ".stl", ".dae", ".3ds",
                                         ".ase",  ".lwo", ".x",   ".smd", ".md5mesh", ".raw", ".xml", ".fbx"};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root))
    if (entry.is_regular_file() && extensions.contains(entry.path().extension().string()))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

struct KnownFolder {
  const char* folder;
  std::size_t fewestImported;
  std::set<std::string> refused;  ///< at least these; where `only`, nothing else
  bool only;
};

void PrintTo(const KnownFolder& known, std::ostream* out) { *out << known.folder; }

class SceneFolders : public testing::TestWithParam<KnownFolder> {};

TEST_P(SceneFolders, EveryModelIsImportedOrRefusedInOneLineThatNamesIt) {
  ACENTRIC_NEEDS_SCENES();
  const TemporaryFolder cache("scene_folders");
  ImportHost host;
  host.importer = ACENTRIC_IMPORTER;
  host.cacheFolder = cache.path();
  host.memoryLimitBytes = std::size_t(4) << 30;
  std::size_t imported = 0;
  std::set<std::string> refused;
  for (const fs::path& file : modelsIn(scenesFolder() / GetParam().folder)) {
    const double before = childSeconds();
    const auto scene = importScene(file, {}, host);
    EXPECT_LT(childSeconds() - before, kMostSeconds) << file;
    if (scene) {
      ++imported;
      expectSound(**scene);
      continue;
    }
    const Error& error = scene.error();
    refused.insert(file.filename().string());
    EXPECT_EQ(error.where, file.string());
    EXPECT_FALSE(error.message.empty());
    EXPECT_EQ(error.describe().find('\n'), std::string::npos) << error.describe();
    EXPECT_TRUE(error.kind != ErrorKind::timeout && error.kind != ErrorKind::internal) << error.describe();
  }
  EXPECT_GE(imported, GetParam().fewestImported);
  if (GetParam().only) {
    EXPECT_EQ(refused, GetParam().refused);
  } else {
    EXPECT_THAT(refused, testing::IsSupersetOf(GetParam().refused));
  }
  for (const auto& entry : fs::directory_iterator(cache.path())) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(kTemporaryPrefix)) << entry.path();
    if (entry.path().extension() == ".last") {  // what a path was last imported to
      const auto name = readText(entry.path(), 4096);
      EXPECT_TRUE(name && fs::exists(cache.path() / *name)) << entry.path();
    } else {
      EXPECT_TRUE(readSceneFile(entry.path())) << entry.path();
    }
  }
}

std::string lastWord(const char* folder) { return fs::path(folder).filename().string(); }

INSTANTIATE_TEST_SUITE_P(
    , SceneFolders,
    testing::Values(
        // Refused: points and lines only, a later version, an extension that is not supported.
        KnownFolder{"gltf_effects/asset_generator",
                    60,
                    {"Compatibility_04.gltf", "Compatibility_05.gltf", "Mesh_PrimitiveMode_00.gltf",
                     "Mesh_PrimitiveMode_01.gltf", "Mesh_PrimitiveMode_02.gltf", "Mesh_PrimitiveMode_03.gltf",
                     "Mesh_PrimitiveMode_07.gltf", "Mesh_PrimitiveMode_08.gltf", "Mesh_PrimitiveMode_09.gltf",
                     "Mesh_PrimitiveMode_10.gltf"},
                    true},
        KnownFolder{"gltf_effects/blender_io",
                    20,
                    {"00_empty_scene.gltf", "00_no_nodes.gltf", "00_no_scenes.gltf"},
                    true},
        KnownFolder{"gltf_effects/playcanvas", 7, {}, true},
        KnownFolder{"malformed/assimp_gltf2",
                    5,
                    {"RecursiveNodes.gltf", "AllIndicesOutOfRange.gltf", "BoxWithInfinites.glb",
                     "NoScene.gltf", "SceneWithoutNodes.gltf", "BoxTextured.gltf"},
                    false},
        KnownFolder{
            "malformed/assimp_invalid",
            0,
            {"OutOfMemory.off", "crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply", "empty.obj", "empty.x"},
            false},
        KnownFolder{"malformed/assimp_obj", 10, {"point_cloud.obj", "testline.obj", "testpoints.obj"}, false},
        KnownFolder{"malformed/tinyobjloader", 30, {"line-prim.obj", "points-prim.obj"}, false}),
    [](const auto& known) { return lastWord(known.param.folder); });

struct KnownScene {
  const char* file;
  std::size_t triangles;  ///< in the file, degenerate ones counted
  std::size_t fewestDropped, mostDropped;
  glm::vec3 min, max;  ///< metres, Z up
  float tolerance;
};

void PrintTo(const KnownScene& known, std::ostream* out) { *out << known.file; }

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

TEST(KnownEffects, TheEffectPlansOfTheLargeScenesNameWhatIsInThem) {
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
