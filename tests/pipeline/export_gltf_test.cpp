/// A walk as glTF: what another program draws from it is what we draw.

#include "engine/pipeline/export_gltf.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "engine/bake/truth.h"
#include "engine/base/file.h"
#include "engine/export/texture_atlas.h"
#include "engine/measure/compare.h"
#include "engine/view/render.h"
#include "tests/pipeline/small_project.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

class ExportGltf : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    test::SceneBuilder builder;
    ColourImage checker(16, 16);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        checker.at(x, y) = (x + y) % 2 == 0 ? Rgba8(220, 120, 60, 255) : Rgba8(60, 90, 160, 255);
    Material painted = test::matte();
    painted.baseColourTexture = builder.texture(checker);
    const int walls = builder.material(painted);
    const int plain = builder.material(test::matte({0.7F, 0.7F, 0.6F}));
    builder.box(walls, {-4, -4, 0}, {4, 4, 3}, true)
        .box(plain, {1.2F, -0.4F, 0}, {1.6F, 0.4F, 1.9F})
        .box(plain, {-2.5F, 1.5F, 0}, {-2, 2, 2.2F})
        .point({0, 0, 2.5F}, 50);
    Project project = test::smallProject(0.5, 6);
    project.bake.ambientRays = 8;
    open_ = test::openWith(builder.rays(), project, folder_ / "room.acentric.json");
    open_.project.exposure = 0.4F;
  }
  static std::filesystem::path bakedFolder() {
    return std::filesystem::temp_directory_path() / ("acentric-baked-for-gltf-" + std::to_string(::getpid()));
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(bakedFolder()); }
  /// Once for all tests: each gets a copy of the captures.
  void bake() {
    const std::filesystem::path own = captureFolderFor(open_.file), baked = bakedFolder();
    const bool first = !std::filesystem::exists(baked);
    if (first) {
      TaskRunner runner(1);
      ASSERT_TRUE(bakeProject(open_, {}, runner));
    }
    std::filesystem::copy(first ? own : baked, first ? baked : own, std::filesystem::copy_options::recursive);
  }
  Result<ExportGltfReport> write(const ExportGltfOptions& options = {}) {
    TaskRunner runner(1);
    return exportGltf({&open_, 1}, folder_ / "gltf", options, runner);
  }
  nlohmann::json index() const {
    return nlohmann::json::parse(readText(folder_ / "gltf" / kGltfIndex, 1 << 20).value());
  }
  /// What another program reads from a region's file.
  ScenePtr readBack(std::size_t region) const {
    const std::string file = index().at("storeys").at(0).at("regions").at(region).at("file");
    ImportHost host;
    host.importer = ACENTRIC_IMPORTER;
    host.cacheFolder = folder_ / "cache";
    const auto scene = importScene(folder_ / "gltf" / file, {}, host);
    EXPECT_TRUE(scene) << scene.error().describe();
    return scene ? *scene : nullptr;
  }
  TruthFrame drawn(const ScenePtr& scene, PerspectiveView view) const {
    TaskRunner runner(1);
    const auto rays = RayScene::build(scene, planEffects(*scene));
    EXPECT_TRUE(rays);
    view.eye -= scene->origin;
    return renderTruth(**rays, view, open_.project.bake, 1, 4, runner);
  }
  PerspectiveView viewFrom(std::size_t region, double yaw) const {
    PerspectiveView view;
    view.eye = {open_.layout->regions[region].polygon.centroid() + glm::dvec2(0.2, -0.1),
                open_.layout->eyeZ()};
    view.yawRadians = yaw;
    view.width = 240;
    view.height = 180;
    return view;
  }

  OpenProject open_;
};

TEST_F(ExportGltf, IsDrawnByOthersAsTheWalkIs) {
  bake();
  const auto done = write();
  ASSERT_TRUE(done) << done.error().describe();
  const auto written = index();
  EXPECT_EQ(written.at("format"), kGltfFormat);
  const auto& regions = written.at("storeys").at(0).at("regions");
  ASSERT_EQ(regions.size(), open_.layout->regions.size());

  TaskRunner runner(1);
  const auto walk = loadWalk(open_, nullptr, runner);
  ASSERT_TRUE(walk);
  for (const std::size_t region : {std::size_t(0), regions.size() - 1}) {
    const std::filesystem::path file = folder_ / "gltf" / std::string(regions[region].at("file"));
    EXPECT_EQ(std::filesystem::file_size(file), regions[region].at("bytes"));
    const ScenePtr scene = readBack(region);
    ASSERT_NE(scene, nullptr);
    EXPECT_TRUE(scene->report.dropped.empty()) << testing::PrintToString(scene->report.dropped);
    for (const double yaw : {0.3, 2.0, 4.1}) {
      const PerspectiveView view = viewFrom(region, yaw);
      const Frame frame = renderFrame(walk->walk, view, {}, runner).value();
      const TruthFrame theirs = drawn(scene, view);
      EXPECT_GT(psnrOf(frame.colour, theirs.colour), 24) << "region " << region << " yaw " << yaw;
      EXPECT_GT(ssimOf(frame.colour, theirs.colour), 0.9) << "region " << region << " yaw " << yaw;
    }
  }
}

TEST_F(ExportGltf, IsAsGoodWhereItIsLean) {
  bake();
  ExportGltfOptions options;
  options.onlyRegion = 0;
  const auto plain = write(options);
  ASSERT_TRUE(plain) << plain.error().describe();
  const ScenePtr whole = readBack(0);
  options.region.meshopt = options.region.webp = true;
  const auto lean = write(options);
  ASSERT_TRUE(lean) << lean.error().describe();
  EXPECT_LT(3 * lean->sum().bytes, plain->sum().bytes);
  const ScenePtr packed = readBack(0);
  ASSERT_TRUE(whole && packed);
  EXPECT_EQ(packed->triangleCount(), whole->triangleCount());
  for (const Bounds* box : {&plain->regions[0].bounds, &lean->regions[0].bounds}) {
    EXPECT_LT(box->min.z, -3) << "Z is up: the sky is around the room";
    EXPECT_GT(box->max.z, 3);
  }
  for (const double yaw : {0.3, 4.1}) {
    const PerspectiveView view = viewFrom(0, yaw);
    EXPECT_GT(psnrOf(drawn(packed, view).colour, drawn(whole, view).colour), 32) << "yaw " << yaw;
  }
  options.region.colourQuality = 101;
  EXPECT_FALSE(write(options));
  options.region.colourQuality = 90, options.region.atlasPixels = 16384;
  EXPECT_FALSE(write(options)) << "WebP is smaller";
}

TEST_F(ExportGltf, OpensInAssimpWithAllItsTriangles) {
  bake();
  const auto done = write();
  ASSERT_TRUE(done) << done.error().describe();
  const auto regions = index().at("storeys").at(0).at("regions");
  for (const auto& region : regions) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile((folder_ / "gltf" / std::string(region.at("file"))).string(),
                                             aiProcess_ValidateDataStructure);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    EXPECT_EQ(scene->mFlags & AI_SCENE_FLAGS_VALIDATION_WARNING, 0U);
    std::set<std::string> nodes;
    std::size_t triangles = 0;
    for (const aiNode* node : std::span(scene->mRootNode->mChildren, scene->mRootNode->mNumChildren)) {
      nodes.insert(node->mName.C_Str());
      if (node->mName == aiString("sky")) continue;
      for (const unsigned mesh : std::span(node->mMeshes, node->mNumMeshes))
        triangles += scene->mMeshes[mesh]->mNumFaces;
    }
    EXPECT_TRUE(nodes.contains("captures")) << testing::PrintToString(nodes);
    EXPECT_EQ(triangles, region.at("triangles").get<std::size_t>());
    EXPECT_GT(scene->mNumTextures, 0U);
  }
}

TEST_F(ExportGltf, OneHandTakesFewerCameras) {
  bake();
  ExportGltfOptions options;
  options.onlyRegion = 0;
  const auto both = write(options);
  options.region.bothHands = false;
  const auto one = write(options);
  ASSERT_TRUE(both && one);
  EXPECT_EQ(one->regions.size(), 1U);
  EXPECT_GT(both->sum().triangles, one->sum().triangles);
  EXPECT_GT(both->sum().cameras, one->sum().cameras);
  EXPECT_EQ(index().at("storeys").at(0).at("regions").size(), 1U) << "the later one took its place";
}

TEST_F(ExportGltf, IsATilesetOfItsRegionsIfAsked) {
  bake();
  ExportGltfOptions options;
  options.tiles = true, options.region.meshopt = options.region.webp = true;
  const auto done = write(options);
  ASSERT_TRUE(done) << done.error().describe();
  const auto json = nlohmann::json::parse(readText(folder_ / "gltf" / kTilesetIndex, 1 << 20).value());
  const auto& tiles = json.at("root").at("children");
  ASSERT_EQ(tiles.size(), open_.layout->regions.size());
  for (std::size_t r = 0; r < tiles.size(); ++r) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "gltf" / std::string(tiles[r].at("content").at("uri"))));
    EXPECT_EQ(tiles[r].at("extras").at("region"), r);
    const glm::dvec2 middle = open_.layout->regions[r].polygon.centroid();
    const auto& viewer = tiles[r].at("viewerRequestVolume").at("box");
    EXPECT_NEAR(viewer[0], middle.x, 1.5);
    EXPECT_NEAR(viewer[1], middle.y, 1.5) << "Z is up, and not turned as glTF is";
    EXPECT_NEAR(viewer[2], open_.layout->eyeZ(), 1e-9);
  }
  EXPECT_EQ(json.at("extras").at("storeys").at(0).at("eyeHeight"),
            open_.layout->eyeZ() - open_.layout->spec.floorHeight);
  EXPECT_TRUE(checkGltfTarget(folder_ / "gltf", true)) << "a later one takes its place";
  EXPECT_FALSE(checkGltfTarget(folder_ / "gltf", false));
  options.onlyRegion = 1000;
  const auto refused = write(options);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("no region 1000"));
}

TEST_F(ExportGltf, RefusesWhatIsNotBakedAndFoldersThatHoldOtherThings) {
  const auto refused = write();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("acentric bake"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "gltf"));
  ExportGltfOptions options;
  options.allowMissing = true;
  const auto empty = write(options);
  ASSERT_TRUE(empty) << empty.error().describe();
  EXPECT_EQ(empty->sum().missing, empty->sum().cameras);
  std::filesystem::create_directories(folder_ / "holiday");
  ASSERT_TRUE(writeTextAtomically(folder_ / "holiday" / "walk.json", "{}"));
  EXPECT_FALSE(checkGltfTarget(folder_ / "holiday", false));
}

TEST(TextureAtlas, HoldsEveryPictureOnceWithItsBorder) {
  std::vector<glm::ivec2> sizes;
  for (int i = 0; i < 500; ++i) sizes.emplace_back(1 + i * 7 % 64, 1 + i * 13 % 64);
  const AtlasPlan plan = planAtlas(sizes, 256);
  EXPECT_GT(plan.pages.size(), 1U);
  std::vector<std::vector<int>> owner;
  for (const glm::ivec2& page : plan.pages) {
    EXPECT_LE(std::max(page.x, page.y), 256);
    owner.emplace_back(std::size_t(page.x * page.y), -1);
  }
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const AtlasPlace& place = plan.places[i];
    const glm::ivec2 page = plan.pages[std::size_t(place.page)];
    for (int y = -kAtlasBorder; y < sizes[i].y + kAtlasBorder; ++y)
      for (int x = -kAtlasBorder; x < sizes[i].x + kAtlasBorder; ++x) {
        const glm::ivec2 at = place.at + glm::ivec2(x, y);
        ASSERT_TRUE(at.x >= 0 && at.y >= 0 && at.x < page.x && at.y < page.y);
        int& who = owner[std::size_t(place.page)][std::size_t(at.y * page.x + at.x)];
        ASSERT_EQ(who, -1);
        who = int(i);
      }
  }
}

}  // namespace
}  // namespace acentric
