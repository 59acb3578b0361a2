#include "engine/bake/effect_costs.h"

#include <gtest/gtest.h>

#include "engine/bake/gathered_light.h"
#include "layout_builder.h"
#include "scene_builder.h"

namespace acentric {
namespace {

using test::matte;
using test::SceneBuilder;

Layout layoutOverRoom() {
  LayoutSpec spec;
  spec.configuration = Configuration::b;
  spec.cellSize = 1.5;
  spec.nearBand = 0.5;
  spec.outline.loops = {{{-1.5, -1.5}, {1.5, -1.5}, {1.5, 1.5}, {-1.5, 1.5}}};
  return buildLayout(spec).value();
}

BakeSettings coarseEffects() {
  BakeSettings settings;
  settings.samplesPerDegree = 4;
  settings.surfaceTexel = 0.1;
  return settings;
}

TEST(EffectCosts, AreSharesOfWhatIsOnAndNothingOfWhatIsOff) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {-4, -4, 0}, {4, 4, 3}, true)
      .point({0, 0, 2.5f}, 20)
      .size(0.1f)
      .sky(glm::vec3(1));
  const auto scene = builder.rays();
  BakeSettings settings = coarseEffects();
  settings.shadowRays = 64;
  const EffectCosts costs = measureEffectCosts(*scene, layoutOverRoom(), settings);
  EXPECT_GT(costs.pixels, 1000);
  for (int e = 0; e < kEffectCount; ++e) {
    EXPECT_GE(costs.of(Effect(e)), 0);
    EXPECT_LE(costs.of(Effect(e)), 1);
    if (!scene->plan().on(Effect(e))) {
      EXPECT_EQ(costs.of(Effect(e)), 0) << nameOf(Effect(e));
    }
  }
  EXPECT_GT(costs.of(Effect::softShadows), 0.3) << "64 rays at every pixel are most of the work";
  EXPECT_GT(costs.of(Effect::ambientOcclusion), 0);
}

TEST(EffectCosts, LeaveNoGatheredLightBehindAndStopWhenAsked) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {-4, -4, 0}, {4, 4, 3}, true).sky(glm::vec3(1));
  const auto scene = builder.rays();
  const auto before = scene->gatheredLight(coarseEffects());
  EXPECT_GT(measureEffectCosts(*scene, layoutOverRoom(), coarseEffects()).pixels, 0);
  const Hit hit = scene->trace({{0, 0, 1}, {0, 0, -1}});
  RayCounts rays;
  before->at(hit, false, rays);
  EXPECT_GT(rays.ambient, 0u) << "not gathered before";
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(measureEffectCosts(*scene, layoutOverRoom(), coarseEffects(), stop.get_token()).pixels, 0);
}

}  // namespace
}  // namespace acentric
