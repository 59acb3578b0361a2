// The town in a forest: as many triangles as are asked for, the same bytes every time, the same street
// whatever their number, and a file that is read as it was made.

#include "projects/forest/generator/forest.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "engine/base/file.h"
#include "engine/scene/import.h"
#include "engine/scene/instances.h"

namespace acentric::forest {
namespace {

namespace fs = std::filesystem;
using gallery::Model;
using gallery::ModelCoding;
using gallery::Part;
using gallery::Shape;
using gallery::Thing;

constexpr float kCoarse = 0.1f;  // of the pictures' size: geometry does not depend on it

std::uint64_t trianglesOf(const Thing& thing) {
  std::uint64_t count = 0;
  for (const Part& part : thing.parts) count += part.shape.indices.size() / 3;
  return count;
}
std::uint64_t trianglesOf(const Model& model) {
  std::uint64_t count = 0;
  for (const Thing& thing : model.things) count += trianglesOf(thing) * thing.placements.size();
  return count;
}
const Thing* named(const Model& model, const std::string& name) {
  const auto found = std::ranges::find(model.things, name, &Thing::name);
  return found == model.things.end() ? nullptr : &*found;
}

class Forest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new fs::path(fs::path(testing::TempDir()) / ("forest-" + std::to_string(getpid())));
    fs::create_directories(*folder_);
    small_ = new Model(makeForest({kFewestTriangles, 1, kCoarse}));
    large_ = new Model(makeForest({500'000'000, 1, kCoarse}));
  }
  static void TearDownTestSuite() {
    fs::remove_all(*folder_);
    delete folder_;
    delete small_;
    delete large_;
  }
  static fs::path written(const Model& model, const char* name, ModelCoding coding = ModelCoding::compact) {
    const Status status = writeModel(model, *folder_ / name, coding);
    EXPECT_TRUE(status) << status.error().describe();
    return *folder_ / name;
  }

  static inline fs::path* folder_ = nullptr;
  static inline Model *small_ = nullptr, *large_ = nullptr;
};

TEST_F(Forest, HasAboutTheTrianglesAskedFor) {
  for (const std::uint64_t wanted :
       {kFewestTriangles, std::uint64_t(1'000'000), std::uint64_t(10'000'000), std::uint64_t(100'000'000),
        std::uint64_t(1'000'000'000), kMostTriangles})
    EXPECT_NEAR(double(trianglesOf(makeForest({wanted, 1, kCoarse}))), double(wanted), 0.05 * double(wanted))
        << wanted;
}

TEST_F(Forest, IsTheSameBytesEveryTimeAndAnotherForestForAnotherSeed) {
  const auto first = readFile(written(*small_, "first.glb")),
             again = readFile(written(makeForest({kFewestTriangles, 1, kCoarse}), "again.glb")),
             other = readFile(written(makeForest({kFewestTriangles, 2, kCoarse}), "other.glb"));
  ASSERT_TRUE(first && again && other);
  EXPECT_TRUE(*first == *again);
  EXPECT_FALSE(*first == *other);
}

TEST_F(Forest, HasTheSameStreetAndHousesWhateverItsTriangles) {
  // Strips of the street, by where they lie.
  const auto near = [](const Model& model, const char* name) {
    std::vector<glm::vec3> out;
    for (const glm::vec3& p : named(model, name)->parts.front().shape.positions)
      if (std::abs(p.y) < 200) out.push_back(p);
    return out;
  };
  for (const char* name : {"Street", "Kerbs"}) {
    EXPECT_GT(near(*small_, name).size(), 100u) << name;
    EXPECT_EQ(near(*small_, name), near(*large_, name)) << name;
  }
  for (const glm::vec3& p : near(*small_, "Street"))
    if (std::abs(p.y) < 100) {
      EXPECT_EQ(p.z, 0);
    }
  int houses = 0;
  for (std::size_t t = 0; t < small_->things.size(); ++t) {
    const Thing& thing = small_->things[t];
    if (thing.name != "House" && thing.name != "Fence" && thing.name != "Lamp") continue;
    EXPECT_EQ(thing.placements, large_->things[t].placements) << thing.name;
    for (std::size_t p = 0; p < thing.parts.size(); ++p)
      EXPECT_EQ(thing.parts[p].shape.positions, large_->things[t].parts[p].shape.positions) << thing.name;
    houses += thing.name == "House" ? int(thing.placements.size()) : 0;
  }
  EXPECT_EQ(houses, 16);
  // The trees that stand in the street's verge come first.
  for (const char* name : {"Birch", "Lime", "Apple tree"}) {
    const Thing *few = named(*small_, name), *many = named(*large_, name);
    ASSERT_TRUE(few && many) << name;
    EXPECT_EQ(few->placements.front(), many->placements.front()) << name;
  }
}

TEST_F(Forest, LeavesTheStreetFree) {
  for (const Thing& thing : large_->things) {
    if (thing.name == "Ground" || thing.name == "Street" || thing.name == "Kerbs") continue;
    for (const glm::mat4& placement : thing.placements) {
      if (glm::length(glm::vec2(placement[3]) - glm::vec2(streetAt(placement[3].y), placement[3].y)) > 25)
        continue;
      for (const Part& part : thing.parts)
        for (const glm::vec3& p : part.shape.positions) {
          const glm::vec3 at(placement * glm::vec4(p, 1));
          if (at.z < 2 && std::abs(at.y) < 20) {
            ASSERT_GT(std::abs(at.x), 3) << thing.name << " at " << at.x << ", " << at.y << ", " << at.z;
          }
        }
    }
  }
}

TEST_F(Forest, HasManySpeciesOfTreesOfTensOfThousandsOfTriangles) {
  std::set<std::string> trees;
  std::size_t models = 0;
  for (const Thing& thing : large_->things) {
    const bool tree = std::ranges::any_of(thing.parts, [&](const Part& part) {
      return large_->materials[std::size_t(part.material)].alphaCutoff.has_value();
    });
    if (!tree || thing.name == "Fern") continue;
    trees.insert(thing.name), ++models;
    EXPECT_GT(trianglesOf(thing), 8'000u) << thing.name;
    EXPECT_LT(trianglesOf(thing), 150'000u) << thing.name;
    EXPECT_GT(thing.placements.size(), 20u) << thing.name;
  }
  EXPECT_EQ(trees, (std::set<std::string>{"Oak", "Lime", "Birch", "Spruce", "Pine", "Apple tree", "Hazel"}));
  EXPECT_EQ(models, 10u) << "some species in two shapes";
}

TEST_F(Forest, HasSoundGeometry) {
  for (const Model* model : {small_, large_})
    for (const Thing& thing : model->things) {
      EXPECT_FALSE(thing.placements.empty()) << thing.name;
      for (const Part& part : thing.parts) {
        const Shape& s = part.shape;
        ASSERT_FALSE(s.indices.empty()) << thing.name;
        ASSERT_EQ(s.normals.size(), s.positions.size()) << thing.name;
        ASSERT_EQ(s.uv.size(), s.positions.size()) << thing.name;
        ASSERT_LT(*std::ranges::max_element(s.indices), s.positions.size()) << thing.name;
        for (std::size_t i = 0; i < s.positions.size(); ++i) {
          ASSERT_LT(glm::length(s.positions[i]), 2000) << thing.name;  // false for NaN
          ASSERT_NEAR(glm::length(s.normals[i]), 1, 1e-3f) << thing.name;
        }
      }
    }
}

TEST_F(Forest, IsAFileOfAFewMegabytes) {
  EXPECT_LT(fs::file_size(written(makeForest({500'000'000, 1}), "full.glb")), 8u << 20);
  EXPECT_LT(fs::file_size(written(makeForest({kFewestTriangles, 1}), "few.glb")), 2u << 20);
}

TEST_F(Forest, OpensWithItsInstances) {
  const auto scene = parseScene(written(*large_, "large.glb"), {});
  ASSERT_TRUE(scene) << scene.error().describe();
  EXPECT_NEAR(double(scene->shownTriangleCount()), 5e8, 0.05 * 5e8);
  EXPECT_LT(scene->uniqueTriangleCount(), 3'000'000u);
  EXPECT_GT(scene->instances.size(), 20'000u);
  EXPECT_TRUE(scene->report.ignored.empty()) << scene->report.ignored.front();
}

TEST_F(Forest, IsReadAlikeCompactAndPlain) {
  const auto compact = parseScene(written(*small_, "compact.glb"), {}),
             plain = parseScene(written(*small_, "plain.glb", ModelCoding::plain), {});
  ASSERT_TRUE(compact) << compact.error().describe();
  ASSERT_TRUE(plain) << plain.error().describe();
  EXPECT_LT(fs::file_size(*folder_ / "compact.glb"), fs::file_size(*folder_ / "plain.glb") / 2);
  ASSERT_EQ(compact->meshes.size(), plain->meshes.size());
  const auto measured = [](const Mesh& mesh) {
    struct {
      Bounds bounds;
      double area = 0;
      glm::dvec3 facing{0};
    } out;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 p(mesh.positions[t.x]), q(mesh.positions[t.y]), r(mesh.positions[t.z]);
      const double own = 0.5 * glm::length(glm::cross(q - p, r - p));
      out.area += own;
      out.facing += own / 3 * glm::dvec3(mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z]);
      for (const std::uint32_t v : {t.x, t.y, t.z}) out.bounds.add(mesh.positions[v]);
    }
    return out;
  };
  // Instances of one node come part by part, nodes one after the other: each mesh is the nearest of its kind.
  std::vector<decltype(measured(Mesh()))> rest;
  std::vector<const Mesh*> meshes;
  for (const Mesh& mesh : compact->meshes) rest.push_back(measured(mesh)), meshes.push_back(&mesh);
  for (const Mesh& mesh : plain->meshes) {
    const auto wanted = measured(mesh);
    std::size_t best = meshes.size();
    float least = std::numeric_limits<float>::max();
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      if (meshes[m]->material != mesh.material) continue;
      const float away = glm::distance(rest[m].bounds.min, wanted.bounds.min) +
                         glm::distance(rest[m].bounds.max, wanted.bounds.max);
      if (away < least) least = away, best = m;
    }
    ASSERT_LT(best, meshes.size()) << mesh.name;
    // Positions are rounded, and scales by half of 1/256.
    EXPECT_LT(least, 0.02f + 6e-3f * glm::length(wanted.bounds.size())) << mesh.name;
    EXPECT_NEAR(rest[best].area, wanted.area, 0.02 * wanted.area + 1e-3) << mesh.name;
    EXPECT_LT(glm::length(rest[best].facing - wanted.facing), 0.03 * wanted.area + 1e-3) << mesh.name;
    EXPECT_EQ(meshes[best]->uv[0].empty(), mesh.uv[0].empty()) << mesh.name;
    EXPECT_EQ(meshes[best]->colours.empty(), mesh.colours.empty()) << mesh.name;
    meshes.erase(meshes.begin() + std::ptrdiff_t(best)), rest.erase(rest.begin() + std::ptrdiff_t(best));
  }
}

}  // namespace
}  // namespace acentric::forest
