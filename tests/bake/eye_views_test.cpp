#include "engine/bake/eye_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/bake/region_sky.h"
#include "engine/geometry/conventions.h"
#include "tests/bake/layout_builder.h"
#include "tests/bake/scene_builder.h"

namespace acentric {
namespace {

using test::matte;
using test::SceneBuilder;

constexpr ElevationRange kAll{-kPi / 2, kPi / 2};

TEST(EyeView, SaysWhatARayWouldWhereItIsSure) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.box(white, {-6, -5, 0}, {6, 5, 3}, true);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-4, 4), size(0.05f, 0.5f);
  for (int n = 0; n < 25; ++n) {
    const glm::vec3 at(place(random), place(random), 1.5f + 0.3f * place(random));
    if (glm::length(at - glm::vec3(0.2f, 0.1f, 1.6f)) < 0.8f) continue;
    builder.box(white, at - size(random), at + size(random));
  }
  const auto scene = builder.rays();
  TaskRunner runner(1);
  RayCounts rays;
  const glm::dvec3 eye(0.2, 0.1, 1.6);
  const auto view = EyeView::trace(*scene, eye, 180, kAll, runner, rays, {});
  ASSERT_NE(view, nullptr);
  EXPECT_LT(rays.visibility, 6u * 181 * 181 * 2 / 5) << "the planes of the walls need no more";
  RayCounts all;
  ASSERT_NE(EyeView::trace(*scene, eye, 181, kAll, runner, all, {}), nullptr);
  EXPECT_EQ(all.visibility, 6u * 182 * 182) << "an edge that has no half";
  int sure = 0, wrong = 0, seen = 0;
  constexpr int kPoints = 20000;
  std::uniform_real_distribution<double> x(-5.9, 5.9), y(-4.9, 4.9), z(0.1, 2.9);
  for (int n = 0; n < kPoints; ++n) {
    const glm::dvec3 point(x(random), y(random), z(random)), way = point - eye;
    const double distance = glm::length(way);
    const bool truth =
        double(scene->occluderDistance({glm::vec3(eye), glm::vec3(way / distance)})) > distance * (1 - 1e-4);
    const EyeView::Sees sees = view->looksAt(point);
    const std::uint64_t before = rays.visibility;
    EXPECT_EQ(seesPoint(*scene, *view, point, 1e-4, rays),
              sees == EyeView::Sees::unsure ? truth : sees == EyeView::Sees::yes);
    EXPECT_EQ(rays.visibility - before, sees == EyeView::Sees::unsure ? 1u : 0u);
    if (sees == EyeView::Sees::unsure) continue;
    ++sure;
    seen += truth ? 1 : 0;
    wrong += (sees == EyeView::Sees::yes) != truth ? 1 : 0;
  }
  EXPECT_GT(sure, kPoints * 9 / 10);
  EXPECT_GT(seen, kPoints / 4);
  EXPECT_LT(wrong, kPoints / 400);
  // On the walls themselves, whichever way a face is cut.
  int lost = 0;  // in gaps finer than the map
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(x(random), y(random), z(random) - 1.5));
    const Hit hit = scene->trace({glm::vec3(eye), glm::vec3(direction)});
    lost += view->looksAt(eye + double(hit.distance) * direction) == EyeView::Sees::no ? 1 : 0;
  }
  EXPECT_LE(lost, 10);
}

/// Four rays across a straight edge depart from a plane as little as four on a slanted one.
TEST(EyeView, LosesNothingBesideAStraightEdge) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  constexpr float kCabinet = 6.6f, kWall = 7, kEdge = 0.017f;
  builder.quad(white, {kWall, -9, -9}, {kWall, 9, -9}, {kWall, 9, 9}, {kWall, -9, 9});
  builder.quad(white, {kCabinet, -9, kEdge}, {kCabinet, 9, kEdge}, {kCabinet, 9, 9}, {kCabinet, -9, 9});
  const auto scene = builder.rays();
  TaskRunner runner(1);
  RayCounts rays;
  const auto view = EyeView::trace(*scene, {0, 0, 0}, 180, kAll, runner, rays, {});
  ASSERT_NE(view, nullptr);
  const double shadow = double(kEdge * kWall / kCabinet);  // on the wall
  int unsure = 0;
  for (int n = 0; n < 1000; ++n) {
    const glm::dvec3 point(kWall, 5 * std::sin(n), shadow - 1e-3 - 0.2 * n / 1000);
    EXPECT_NE(view->looksAt(point), EyeView::Sees::no) << point.z;
    EXPECT_TRUE(seesPoint(*scene, *view, point, 1e-3, rays)) << point.z;
    unsure += view->looksAt(point) == EyeView::Sees::unsure ? 1 : 0;
  }
  EXPECT_GT(unsure, 30) << "some lie in the cells of the edge";
}

TEST(EyeView, IsUnsureWhereItDidNotLook) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 30);
  const auto scene = builder.rays();
  TaskRunner runner;
  RayCounts rays;
  const std::vector views{
      EyeView::trace(*scene, {0.5, 0, 2}, 90, {radians(-30), radians(20)}, runner, rays, {})};
  const auto sky = RegionSky::trace(*scene, views, {{0.5, 0, 2}}, runner, rays, {});
  EXPECT_EQ(sky->looksAlong({1, 0, 0.1}), EyeView::Sees::yes) << "the sky";
  EXPECT_EQ(sky->looksAlong({1, 0, -0.3}), EyeView::Sees::no) << "the floor";
  EXPECT_EQ(sky->looksAlong({1, 0, -0.08}), EyeView::Sees::yes) << "along the sky's edge too";
  EXPECT_EQ(sky->looksAlong({0.1, 0, 1}), EyeView::Sees::unsure);
  const auto& view = views.front();
  EXPECT_EQ(view->looksAt({0, 0, 0}), EyeView::Sees::unsure);
  EXPECT_TRUE(seesPoint(*scene, *view, {0, 0, 0}, 1e-3, rays));
  EXPECT_FALSE(seesPoint(*scene, *view, {0, 0, -1}, 1e-3, rays));
}

TEST(EyeViews, TraceEachEyeOnceUntilMemoryRunsShort) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 30);
  const auto scene = builder.rays();
  TaskRunner runner;
  RayCounts rays;
  BakeSettings settings;
  settings.samplesPerDegree = 2;
  MemoryBudget much;
  EyeViews generous(*scene, kAll, settings, much);
  const auto first = generous.at({0, 0, 1}, runner, rays, {});
  EXPECT_EQ(generous.at({0, 0, 1}, runner, rays, {}), first);
  generous.at({1, 0, 1}, runner, rays, {});
  EXPECT_EQ(generous.traced(), 2);
  EXPECT_EQ(generous.bytes(), 2 * first->bytes());

  MemoryBudget little(3 * 2 * first->bytes());
  EyeViews tight(*scene, kAll, settings, little);
  for (const double x : {0.0, 1.0, 2.0, 1.0, 0.0}) ASSERT_NE(tight.at({x, 0, 1}, runner, rays, {}), nullptr);
  EXPECT_EQ(tight.traced(), 4) << "the one at 0 was used longest ago when the third came";
  EXPECT_LE(tight.bytes(), 2 * first->bytes());
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(tight.at({9, 0, 1}, runner, rays, stop.get_token()), nullptr);
}

}  // namespace
}  // namespace acentric
