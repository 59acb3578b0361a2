/// Walks as 3D Tiles hold what the specification asks for, and lead to the region that the viewer is in.

#include "engine/export/tileset.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "engine/base/file.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

using Json = nlohmann::json;

class Tileset : public FolderTest {
 protected:
  /// A square of regions, `side` of them a side, two metres each.
  static std::vector<RegionTile> regions(int side) {
    std::vector<RegionTile> tiles;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        RegionTile tile;
        tile.file = fmt::format("regions/0-{}.glb", tiles.size());
        const glm::dvec2 at(2 * x, 2 * y);
        tile.polygon.corners = {at, at + glm::dvec2(2, 0), at + glm::dvec2(2, 2), at + glm::dvec2(0, 2)};
        tile.eyeZ = 1.6, tile.eyeHeight = 1.6;
        tile.bounds.add({-5, -6, -1});
        tile.bounds.add({2 * side + float(x), 2 * side + 3, 4});
        tile.extras = {{"region", tiles.size()}};
        tiles.push_back(tile);
      }
    return tiles;
  }
  Json read(const std::string& file) const {
    const auto text = readText(folder_ / file);
    EXPECT_TRUE(text) << text.error().describe();
    return Json::parse(*text);
  }

  static glm::dvec3 vectorAt(const Json& box, std::size_t i) {
    return {box.at(3 * i), box.at(3 * i + 1), box.at(3 * i + 2)};
  }
  static bool inside(const Json& volume, const glm::dvec3& point, double slack = 0) {
    const Json& box = volume.at("box");
    EXPECT_EQ(box.size(), 12U);
    for (std::size_t axis = 1; axis <= 3; ++axis) {
      const glm::dvec3 half = vectorAt(box, axis), way = point - vectorAt(box, 0);
      if (std::abs(glm::dot(way, half)) > glm::dot(half, half) + slack * glm::length(half)) return false;
    }
    return true;
  }
  static void expectWithin(const Json& inner, const Json& outer) {
    const Json& box = inner.at("box");
    for (int corner = 0; corner < 8; ++corner) {
      glm::dvec3 at = vectorAt(box, 0);
      for (int axis = 0; axis < 3; ++axis)
        at += (corner >> axis & 1 ? 1.0 : -1.0) * vectorAt(box, std::size_t(axis) + 1);
      EXPECT_TRUE(inside(outer, at, 1e-9)) << inner << " within " << outer;
    }
  }

  /// What a viewer reads that honours request volumes: the rules of the specification, held on the way.
  void visit(const std::string& file, const glm::dvec3& eye, std::vector<std::string>& shown) {
    ++tilesets_;
    const Json json = read(file);
    EXPECT_EQ(json.at("asset").at("version"), "1.1");
    const double error = json.at("geometricError");
    const std::function<void(const Json&, const Json*, double)> tile = [&](const Json& it, const Json* parent,
                                                                           double above) {
      ++tiles_;
      EXPECT_GE(it.at("geometricError").get<double>(), 0);
      EXPECT_LE(it.at("geometricError").get<double>(), above);
      EXPECT_TRUE(it.contains("boundingVolume"));
      EXPECT_FALSE(it.contains("transform"));
      if (parent == nullptr)
        EXPECT_EQ(it.at("refine"), "ADD");
      else
        for (const char* kind : {"boundingVolume", "viewerRequestVolume"})
          expectWithin(it.at(kind), parent->at(kind));
      if (!inside(it.at("viewerRequestVolume"), eye)) return;
      if (it.contains("content")) {
        const std::string uri = it.at("content").at("uri");
        EXPECT_FALSE(it.contains("children"));
        if (uri.ends_with(".json"))
          visit(uri, eye, shown);
        else
          shown.push_back(uri);
      }
      if (!it.contains("children")) return;
      EXPECT_FALSE(it.at("children").empty());
      EXPECT_LE(it.at("children").size(), kMostTiles);
      for (const Json& child : it.at("children")) tile(child, &it, it.at("geometricError"));
    };
    tile(json.at("root"), nullptr, error);
  }
  std::vector<std::string> shownAt(const glm::dvec3& eye) {
    tilesets_ = tiles_ = 0;
    std::vector<std::string> shown;
    visit(kTilesetIndex, eye, shown);
    return shown;
  }

  std::size_t tilesets_ = 0, tiles_ = 0;
};

TEST_F(Tileset, ShowsTheRegionThatTheViewerIsIn) {
  ASSERT_TRUE(writeTileset(regions(3), "test", {{"units", "metre"}}, folder_));
  EXPECT_THAT(shownAt({3, 1, 1.6}), testing::ElementsAre("regions/0-1.glb"));
  EXPECT_THAT(shownAt({5, 5, 1.3}), testing::ElementsAre("regions/0-8.glb"));
  EXPECT_THAT(shownAt({2.1, 1, 1.6}), testing::ElementsAre("regions/0-0.glb", "regions/0-1.glb"))
      << "what comes next is fetched at the border";
  EXPECT_TRUE(shownAt({3, 1, 4}).empty()) << "on another storey";
  EXPECT_TRUE(shownAt({-3, 1, 1.6}).empty());
  const Json json = read(kTilesetIndex);
  EXPECT_EQ(json.at("asset").at("extras").at("format"), kTilesetFormat);
  EXPECT_EQ(json.at("extras").at("units"), "metre");
  EXPECT_EQ(json.at("root").at("children").at(4).at("extras").at("region"), 4);
}

TEST_F(Tileset, OfManyRegionsIsATree) {
  constexpr int kSide = 70;
  ASSERT_TRUE(writeTileset(regions(kSide), "test", {}, folder_));
  for (const int region : {0, 69, 2485, 4899}) {
    const glm::dvec3 eye(2 * (region % kSide) + 1, 2 * (region / kSide) + 1, 1.6);
    EXPECT_THAT(shownAt(eye), testing::ElementsAre(fmt::format("regions/0-{}.glb", region)));
    EXPECT_LE(tilesets_, 6U) << "files that a viewer reads";
    EXPECT_LE(tiles_, 6 * (kMostTiles + 1));
  }
  std::map<std::string, int> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename();
    const std::string text = readText(entry.path()).value();
    for (std::size_t at = 0; (at = text.find("regions/0-", at)) != std::string::npos; ++at)
      ++files[text.substr(at, text.find('"', at) - at)];
    EXPECT_LT(text.size(), 60'000U) << name;
  }
  EXPECT_EQ(files.size(), std::size_t(kSide) * kSide);
  for (const auto& [file, count] : files) EXPECT_EQ(count, 1) << file;
}

TEST_F(Tileset, TheViewerStandsInTheLeastRectangleAroundItsPolygon) {
  RegionTile tile;
  tile.eyeZ = 2, tile.eyeHeight = 1.5;
  const glm::dvec2 along(std::cos(0.3), std::sin(0.3)), across(-along.y, along.x), at(7, -2);
  tile.polygon.corners = {at, at + 3.0 * along, at + 3.0 * along + across, at + across};
  const TileBox box = requestBox(tile);
  EXPECT_NEAR(glm::distance(box.centre, glm::dvec3(at + 1.5 * along + 0.5 * across, 2)), 0, 1e-12);
  const double sides[] = {glm::length(box.halves[0]), glm::length(box.halves[1])};
  EXPECT_NEAR(std::max(sides[0], sides[1]), 1.5 + kRequestMargin, 1e-12);
  EXPECT_NEAR(std::min(sides[0], sides[1]), 0.5 + kRequestMargin, 1e-12);
  EXPECT_NEAR(box.halves[2].z, 0.75, 1e-12);
}

}  // namespace
}  // namespace acentric
