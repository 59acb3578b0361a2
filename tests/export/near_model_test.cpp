/// Near geometry with its light in textures: any place of it shows what the renderer shows there.

#include "engine/export/near_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/export/patch_model.h"
#include "engine/image/colour.h"
#include "engine/view/local_shading.h"
#include "tests/export/small_walk.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

class NearModel : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    TaskRunner runner(1);
    open_ = test::bakedProject(folder_ / "small.acentric.json", runner);
    auto loaded = loadWalk(open_, nullptr, runner);
    ASSERT_TRUE(loaded);
    walk_ = std::move(loaded->walk);
  }

  DrawModel modelOf(std::size_t region, int atlas = 1024) const {
    DrawModel model;
    model.origin = {walk_.layout->regions[region].polygon.centroid(), walk_.layout->eyeZ()};
    const NearModelCounts counts = addNear(walk_, region, *walk_.local[region], atlas, model);
    std::size_t triangles = 0, texels = 0;
    for (const DrawMesh& mesh : model.meshes) triangles += mesh.triangles.size();
    for (const DrawTexture& texture : model.textures) texels += texture.image.pixels.size();
    EXPECT_EQ(counts.triangles, triangles);
    EXPECT_EQ(counts.textures, model.textures.size());
    EXPECT_EQ(counts.texels, texels);
    return model;
  }

  OpenProject open_;
  WalkScene walk_;
};

/// By a linear filter, clamped.
glm::vec4 read(const ColourImage& image, const glm::vec2& uv) {
  const glm::vec2 at = uv * glm::vec2(image.width, image.height) - 0.5F, low = glm::floor(at);
  glm::vec4 sum(0);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const glm::vec2 weight = glm::abs(glm::vec2(1 - i, 1 - j) - (at - low));
      const Rgba8 p = image.at(std::clamp(int(low.x) + i, 0, image.width - 1),
                               std::clamp(int(low.y) + j, 0, image.height - 1));
      sum += weight.x * weight.y *
             glm::vec4(linearFromSrgb(float(p.r) / 255), linearFromSrgb(float(p.g) / 255),
                       linearFromSrgb(float(p.b) / 255), float(p.a) / 255);
    }
  return sum;
}

/// A place on a triangle of a model.
struct Hit {
  const DrawMesh* mesh = nullptr;
  glm::vec4 shown{0};
};

/// All triangles of the model whose corners, on the given side, are these.
std::vector<Hit> hitsOf(const DrawModel& model, const std::array<glm::vec3, 3>& corners, const glm::vec2& b,
                        bool back) {
  std::vector<Hit> hits;
  for (const DrawMesh& mesh : model.meshes)
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::uvec3 turned = back ? glm::uvec3(t.x, t.z, t.y) : t;
      bool same = true;
      for (int i = 0; i < 3; ++i)
        same = same && glm::distance(glm::dvec3(mesh.positions[turned[i]]) + model.origin,
                                     glm::dvec3(corners[std::size_t(i)])) < 1e-5;
      if (!same) continue;
      const glm::vec2 uv =
          (1 - b.x - b.y) * mesh.uv[turned.x] + b.x * mesh.uv[turned.y] + b.y * mesh.uv[turned.z];
      hits.push_back({&mesh, mesh.factor * read(model.textures[std::size_t(mesh.texture)].image, uv)});
    }
  return hits;
}

TEST_F(NearModel, ShowsEverywhereWhatTheRendererShows) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> at(0, 1);
  std::size_t sides = 0, masked = 0, blended = 0, mirrors = 0;
  for (std::size_t region = 0; region < walk_.layout->regions.size(); ++region) {
    const LocalGeometry& local = *walk_.local[region];
    const LocalShading shading(walk_, local);
    const DrawModel model = modelOf(region);
    std::vector<double> apart;
    for (const LocalTriangle& t : local.triangles) {
      std::array<glm::vec3, 3> corners;
      for (int i = 0; i < 3; ++i) corners[std::size_t(i)] = local.vertices[t.vertices[i]].position;
      const bool twice = shading.hasLightOnBack(t.mesh, t.triangle);
      for (const bool back : {false, true}) {
        if (back && !twice) continue;
        for (int round = 0; round < 12; ++round) {
          glm::vec2 b(at(random), at(random));
          if (b.x + b.y > 1) b = 1.0F - b;
          if (round < 3)
            b = round == 0 ? glm::vec2(0, b.y) : round == 1 ? glm::vec2(b.x, 0) : glm::vec2(b.x, 1 - b.x);
          const auto hits = hitsOf(model, corners, b, back);
          if (walk_.mirrors->planeOf(local, t) != FlatMirrors::kNoPlane) {
            EXPECT_TRUE(hits.empty());
            ++mirrors;
            continue;
          }
          ASSERT_EQ(hits.size(), 1U) << "each triangle once";
          const DrawMesh& mesh = *hits[0].mesh;
          const LocalMaterial& material = shading.materialOf(t.mesh);
          EXPECT_EQ(mesh.alpha, material.clear()  ? AlphaMode::blend
                                : material.masked ? AlphaMode::mask
                                                  : AlphaMode::opaque);
          EXPECT_EQ(mesh.doubleSided, !twice && material.material->doubleSided);
          EXPECT_TRUE(!material.masked || mesh.cutoff == material.material->alphaCutoff);
          sides += back ? 1 : 0, masked += material.masked ? 1 : 0, blended += material.clear() ? 1 : 0;
          LocalPoint point{t.mesh, t.triangle, {}, back};
          point.barycentric = (1 - b.x - b.y) * local.vertices[t.vertices[0]].barycentric +
                              b.x * local.vertices[t.vertices[1]].barycentric +
                              b.y * local.vertices[t.vertices[2]].barycentric;
          const glm::vec4 wanted = shading.shownAt(point, glm::vec3(model.origin));
          for (int c = 0; c < 3; ++c)
            apart.push_back(std::abs(255 * (srgbFromLinear(std::clamp(hits[0].shown[c], 0.0F, 1.0F)) -
                                            srgbFromLinear(std::clamp(wanted[c], 0.0F, 1.0F)))));
          if (material.masked || material.clear()) {
            const float alpha = wanted.a * (material.masked ? shading.alphaAt(point) : 1.0F);
            apart.push_back(255 * std::abs(double(hits[0].shown.a - alpha)));
          }
        }
      }
    }
    std::ranges::sort(apart);
    const auto share = [&](double part) { return apart[std::size_t(part * double(apart.size() - 1))]; };
    EXPECT_LT(share(0.5), 1) << "codes of 8 bits";
    EXPECT_LT(share(0.95), 4);
    EXPECT_LT(share(0.995), 20) << "kinks of light and texels between texels";
  }
  EXPECT_TRUE(sides > 0 && masked > 0 && blended > 0) << sides << " " << masked << " " << blended;
  EXPECT_GT(mirrors, 0U);
}

TEST_F(NearModel, FitsItsTexturesAndIsCoarserWhereItMust) {
  const DrawModel small = modelOf(0, kLeastAtlas), large = modelOf(0, 4096);
  std::size_t triangles[2] = {};
  for (const DrawModel* model : {&small, &large})
    for (const DrawMesh& mesh : model->meshes) {
      triangles[model == &large ? 1 : 0] += mesh.triangles.size();
      EXPECT_TRUE(mesh.colours.empty());
      EXPECT_EQ(mesh.part, "near");
      ASSERT_EQ(mesh.uv.size(), mesh.positions.size());
      for (const glm::vec2& uv : mesh.uv) EXPECT_TRUE(uv.x >= 0 && uv.y >= 0 && uv.x <= 1 && uv.y <= 1);
    }
  EXPECT_EQ(triangles[0], triangles[1]);
  EXPECT_GT(small.textures.size(), large.textures.size());
  for (const DrawTexture& texture : small.textures)
    EXPECT_LE(std::max(texture.image.width, texture.image.height), kLeastAtlas);
  bool blended = false;
  for (const DrawMesh& mesh : large.meshes) {
    EXPECT_FALSE(blended && mesh.alpha != AlphaMode::blend) << "blended ones come last";
    blended = blended || mesh.alpha == AlphaMode::blend;
  }
}

TEST(NearModelDistance, NoEyeIsNearer) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> at(-4, 4), up(0, 4);
  const ConvexPolygon polygon{{{-1, -0.5}, {1, -0.7}, {1.2, 0.8}, {-0.9, 1}}};
  double longest = 0;
  for (int round = 0; round < 200; ++round) {
    std::array<glm::vec3, 3> t;
    for (glm::vec3& corner : t) corner = {at(random), at(random), up(random)};
    if (round % 2 == 0) t[1] = t[0] + glm::vec3(0.3F, 0, 0), t[2] = t[0] + glm::vec3(0, 0.2F, 0.3F);
    const double claimed = eyeDistance(polygon, 1.6, t);
    double nearest = HUGE_VAL;
    for (int i = 0; i <= 12; ++i)
      for (int j = 0; i + j <= 12; ++j) {
        const glm::dvec3 p = t[0] + (float(i) * (t[1] - t[0]) + float(j) * (t[2] - t[0])) / 12.0F;
        for (int k = 0; k <= 10; ++k)
          for (int l = 0; l <= 10; ++l) {
            const glm::dvec2 upper = glm::mix(polygon.corners[0], polygon.corners[1], k / 10.0);
            const glm::dvec2 lower = glm::mix(polygon.corners[3], polygon.corners[2], k / 10.0);
            nearest = std::min(nearest, glm::distance(p, glm::dvec3(glm::mix(upper, lower, l / 10.0), 1.6)));
          }
      }
    EXPECT_LE(claimed, nearest + 1e-6);
    longest = std::max(longest, claimed);
    EXPECT_TRUE(round % 2 != 0 || claimed > 0.5 * nearest - 0.4) << "and it is not far off";
  }
  EXPECT_GT(longest, 2);
}

}  // namespace
}  // namespace acentric
