#pragma once
/// A small project baked into memory, ready to be drawn.

#include <gtest/gtest.h>

#include <numeric>

#include "engine/bake/bake.h"
#include "engine/scene/local_geometry.h"
#include "engine/view/render.h"
#include "tests/bake/memory_sink.h"
#include "tests/pipeline/small_project.h"

namespace acentric::test {

struct BakedRoom {
  BakedRoom(RayScenePtr rays, const Project& project) : open(openWith(std::move(rays), project)) {
    MemorySink memory;
    TaskRunner runner(1);
    std::vector<int> all(open.layout->cameras.size());
    std::iota(all.begin(), all.end(), 0);
    const auto baked = bake(*open.rays, *open.layout, all, open.project.bake, memory, runner);
    EXPECT_TRUE(baked) << baked.error().describe();
    if (!baked) return;
    walk.scene = open.scene;
    walk.layout = open.layout;
    walk.plan = open.plan;
    for (const Region& region : open.layout->regions)
      walk.local.push_back(std::make_shared<const LocalGeometry>(clipToPolygon(*open.scene, region.grown)));
    for (const ContentKey& key : open.keys)
      walk.captures.push_back(
          std::make_shared<const DisplayCapture>(prepareForDisplay(*memory.find(key), 1)));
  }

  OpenProject open;
  WalkScene walk;
};

/// Did no sample fall on the pixel?
inline bool isOpen(PixelSource source) { return source == kSourceHole || source == kSourceInvented; }

}  // namespace acentric::test
