/// Patches as textured triangles, against the analytic scene that they were captured of.

#include "engine/export/patch_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/geometry/conventions.h"
#include "engine/image/colour.h"
#include "engine/view/view_settings.h"
#include "tests/view/capture_fixtures.h"
#include "tests/view/mirror_scene.h"

namespace acentric {
namespace {

const glm::dvec3 kCentre(0.3, -0.2, 1.6);

DisplayCapture captureOf(const test::AnalyticScene& scene, int columns = 120, int rows = 240) {
  return prepareForDisplay(test::capture(scene, test::cameraAt(kCentre, 40, columns, rows), nullptr, 2), 1);
}

DrawModel modelOf(const DisplayCapture& capture, RoleMeshes meshes = RoleMeshes::together, int atlas = 1024,
                  std::uint8_t roles = 0xff) {
  DrawModel model;
  model.origin = kCentre;
  const ShownCapture shown{&capture, roles};
  const PatchModelCounts counts = addPatches({&shown, 1}, meshes, atlas, model);
  std::size_t triangles = 0;
  for (const DrawMesh& mesh : model.meshes) triangles += mesh.triangles.size();
  EXPECT_EQ(counts.triangles, triangles);
  EXPECT_EQ(counts.textures, model.textures.size());
  return model;
}

/// Columns and rows of the capture, of a place relative to its centre.
glm::dvec2 seenAt(const ColumnCamera& camera, const glm::dvec3& place) {
  const double azimuth =
      std::remainder(std::atan2(place.y, place.x) - camera.azimuthAt(0.5 * camera.columns), kTwoPi);
  const double elevation = std::atan2(place.z, std::hypot(place.x, place.y));
  return {0.5 * camera.columns + azimuth / camera.columnPitch(),
          (camera.topElevation - elevation) / camera.rowPitch()};
}

glm::dvec2 texelAt(const DrawModel& model, const DrawMesh& mesh, const glm::vec2& uv) {
  const ColourImage& image = model.textures[std::size_t(mesh.texture)].image;
  return glm::dvec2(uv) * glm::dvec2(image.width, image.height);
}

/// body(mesh, triangle, where the texture lies in the capture at its first corner).
template <class Body>
void forTriangles(const DrawModel& model, const ColumnCamera& camera, const Body& body) {
  for (const DrawMesh& mesh : model.meshes)
    for (const glm::uvec3& triangle : mesh.triangles)
      body(
          mesh, triangle,
          seenAt(camera, glm::dvec3(mesh.positions[triangle.x])) - texelAt(model, mesh, mesh.uv[triangle.x]));
}

TEST(PatchModel, TexturesLieWithinAQuarterOfASampleOfWhatTheCaptureSaw) {
  const DisplayCapture capture = captureOf(test::randomPatches(3, 60, 1.5));
  const DrawModel model = modelOf(capture);
  double worst = 0;
  std::size_t triangles = 0;
  forTriangles(model, capture.camera, [&](const DrawMesh& mesh, const glm::uvec3& t, const glm::dvec2& from) {
    ++triangles;
    for (const glm::dvec3& share : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0.5, 0.5, 0),
                                    glm::dvec3(0, 0.5, 0.5), glm::dvec3(0.5, 0, 0.5), glm::dvec3(1.0 / 3)}) {
      const auto mixed = [&](const auto& values) {
        using Vector = std::decay_t<decltype(values[0])>;
        return values[t.x] * float(share.x) + values[t.y] * float(share.y) +
               Vector(values[t.z] * float(share.z));
      };
      const glm::dvec2 apart = glm::abs(seenAt(capture.camera, glm::dvec3(mixed(mesh.positions))) - from -
                                        texelAt(model, mesh, mixed(mesh.uv)));
      worst = std::max({worst, apart.x, apart.y});
    }
  });
  EXPECT_GT(triangles, 500u);
  EXPECT_LE(worst, 1.2 * kTextureError) << "sides are held to it, and the middle is within them";
  EXPECT_GT(worst, 0.01);
}

TEST(PatchModel, EachTexelHasTheColourOfWhatTheRayThereMeets) {
  const test::AnalyticScene scene = test::randomPatches(5, 40, 1.5);
  const DisplayCapture capture = captureOf(scene);
  const DrawModel model = modelOf(capture);
  std::set<std::pair<int, int>> pixels;
  forTriangles(model, capture.camera, [&](const DrawMesh& mesh, const glm::uvec3& t, const glm::dvec2& from) {
    const glm::dvec2 middle = texelAt(model, mesh, (mesh.uv[t.x] + mesh.uv[t.y] + mesh.uv[t.z]) * (1.0F / 3));
    const glm::ivec2 texel(glm::floor(middle));
    const ColourImage& image = model.textures[std::size_t(mesh.texture)].image;
    const Rgba8 colour = image.at(texel.x, texel.y);
    if (colour.a < 255) return;
    const glm::ivec2 pixel(glm::round(glm::dvec2(texel) + from));
    const glm::dvec2 c = capture.camera.directionAt(pixel.x + 0.5);
    const auto met = scene.along(kCentre, {c, capture.camera.tangentAt(pixel.y + 0.5)}, 0);
    EXPECT_TRUE(std::ranges::any_of(met,
                                    [&](const auto& crossing) {
                                      return encodeForDisplay(glm::vec3(crossing.colour), 1) ==
                                             Rgba8(colour.r, colour.g, colour.b, 255);
                                    }))
        << pixel.x << " " << pixel.y;
    pixels.insert({pixel.x, pixel.y});
  });
  EXPECT_GT(pixels.size(), 300u);
}

TEST(PatchModel, PatchesLargerThanATextureAreCut) {
  test::AnalyticScene floor;
  floor.silhouettes = true;
  const DisplayCapture capture = captureOf(floor, 120, 480);
  const DrawModel small = modelOf(capture, RoleMeshes::together, kLeastAtlas), large = modelOf(capture);
  EXPECT_GT(small.textures.size(), large.textures.size());
  for (const DrawTexture& texture : small.textures)
    EXPECT_LE(std::max(texture.image.width, texture.image.height), kLeastAtlas);
  // All of the floor that was seen is there, in both: the same area of the capture.
  const auto shown = [](const DrawModel& model) {
    std::size_t covered = 0;
    for (const DrawTexture& texture : model.textures)
      covered +=
          std::size_t(std::ranges::count_if(texture.image.pixels, [](const Rgba8& p) { return p.a == 255; }));
    return covered;
  };
  EXPECT_GE(shown(small), capture.samples.size());
  EXPECT_GE(shown(large), capture.samples.size());
}

TEST(PatchModel, ShowsOnlyWhatTheRolesNeedTogetherOrApart) {
  Capture made =
      test::capture(test::randomPatches(7, 30, 1.5), test::cameraAt(kCentre, 40, 120, 240), nullptr, 2);
  for (std::size_t s = 0; s < made.roles.size(); ++s) made.roles[s] = made.row[s] < 120 ? 1 : 6;
  const DisplayCapture capture = prepareForDisplay(made, 1);
  const auto meshesOf = [&](RoleMeshes meshes, std::uint8_t roles) {
    std::set<int> found;
    for (const DrawMesh& mesh : modelOf(capture, meshes, 1024, roles).meshes) found.insert(mesh.roles);
    return found;
  };
  EXPECT_EQ(meshesOf(RoleMeshes::together, 1), (std::set<int>{0xff}));
  EXPECT_EQ(meshesOf(RoleMeshes::apart, 1), (std::set<int>{1}));
  EXPECT_EQ(meshesOf(RoleMeshes::apart, 4), (std::set<int>{6}));
  EXPECT_EQ(meshesOf(RoleMeshes::apart, 0xff), (std::set<int>{1, 6}));
  EXPECT_TRUE(modelOf(capture, RoleMeshes::together, 1024, 8).meshes.empty());
  const DrawModel upper = modelOf(capture, RoleMeshes::together, 1024, 1);
  forTriangles(upper, capture.camera, [&](const DrawMesh& mesh, const glm::uvec3& t, const glm::dvec2&) {
    for (const std::uint32_t corner : {t.x, t.y, t.z})
      ASSERT_LE(seenAt(capture.camera, glm::dvec3(mesh.positions[corner])).y, 121.51);
  });
}

TEST(PatchModel, MirrorsAreOpenAndShowWhatLiesBehindThem) {
  test::MirrorScene scene{test::randomPatches(12, 50, 2), {}};
  scene.mirrors.push_back({0, 4, {-3, 0.2}, {4, 3}, {0.9f, 0.8f, 0.7f}, 1});
  const DisplayCapture capture =
      prepareForDisplay(test::capture(scene, test::cameraAt(kCentre, 10, 120, 240), nullptr), 1);
  ASSERT_TRUE(capture.reflections);
  double farthest = 0;
  forTriangles(modelOf(capture), capture.camera,
               [&](const DrawMesh& mesh, const glm::uvec3& t, const glm::dvec2&) {
                 const glm::dvec3 at = kCentre + glm::dvec3(mesh.positions[t.x]);
                 const bool inMirror =
                     std::abs(at.x - 4) < 1e-3 && at.y > -2.9 && at.y < 3.9 && at.z > 0.3 && at.z < 2.9;
                 EXPECT_FALSE(inMirror && std::abs(kCentre.x + mesh.positions[t.y].x - 4) < 1e-3 &&
                              std::abs(kCentre.x + mesh.positions[t.z].x - 4) < 1e-3)
                     << at.y << " " << at.z;
                 farthest = std::max(farthest, at.x);
               });
  EXPECT_GT(farthest, 6) << "what the mirror shows";
}

TEST(PatchModel, WhatAMirrorHangsOnDoesNotCoverWhatItShows) {
  for (const double behind : {0.03, 0.5}) {
    test::AnalyticScene scene;
    scene.silhouettes = true;
    scene.boxes.push_back({{4, -1, 0.5}, {4.001, 1, 2.5}, {0.9f, 0.9f, 0.9f, 1}});
    scene.boxes.push_back({{4 + behind, -1.2, 0.3}, {4.6, 1.2, 2.7}, {0, 0, 0, 1}});
    DisplayCapture capture = captureOf(scene);  // of two layers
    const auto shown = [&] {
      DrawModel model;
      const ShownCapture each{&capture, 0xff};
      return addPatches({&each, 1}, RoleMeshes::together, 1024, model).samples;
    };
    const std::size_t all = shown();
    auto patches = std::make_shared<DisplayPatches>(*capture.patches);
    std::size_t open = 0, hidden = 0;  // texels of the mirror, and those that are not of its patches' borders
    for (DisplayPatch& patch : patches->patches) {
      if (std::abs(double(patch.normal.x) - 1 / (4 - kCentre.x)) > 1e-4) continue;
      patch.mirror = 1;
      for (int c = 0; c < patch.columns + 2; ++c)
        for (int r = 0; r < patch.rows + 2; ++r) {
          const auto texel =
              patch.firstTexel + std::size_t(c) * (std::size_t(patch.rows) + 2) + std::size_t(r);
          if ((patches->cover[texel] & kTexelParts) == 0) continue;
          ++open;
          hidden += c > 0 && r > 0 && c <= patch.columns && r <= patch.rows ? 1 : 0;
        }
    }
    capture.patches = patches;
    ASSERT_GT(hidden, 300u);
    const std::size_t gone = all - shown();
    if (behind < 0.1) {
      EXPECT_GE(gone, open + hidden) << "the board is behind the mirror in all of it";
      EXPECT_LE(gone, 2 * open + hidden / 4);
    } else {
      EXPECT_EQ(gone, open) << "the mirror itself is open";
    }
    EXPECT_GT(shown(), 1000u) << "around it there is what was";
  }
}

TEST(PatchModel, OfACaptureOfTheSkyThereIsNothing) {
  test::AnalyticScene sky;
  sky.floor = false, sky.silhouettes = true;
  const DisplayCapture capture = captureOf(sky);
  ASSERT_TRUE(capture.hasPatches());
  const DrawModel model = modelOf(capture);
  EXPECT_TRUE(model.meshes.empty());
  EXPECT_TRUE(model.textures.empty());
}

}  // namespace
}  // namespace acentric
