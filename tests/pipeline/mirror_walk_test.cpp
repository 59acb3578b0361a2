/// Mirrors from the scene to the frame: baked, walked past, and compared with the ray-traced truth.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "engine/bake/bake.h"
#include "engine/bake/truth.h"
#include "engine/pipeline/walk_source.h"
#include "engine/scene/flat_mirrors.h"
#include "engine/scene/local_geometry.h"
#include "engine/view/render.h"
#include "tests/bake/memory_sink.h"
#include "tests/bake/scene_builder.h"
#include "tests/pipeline/small_project.h"

namespace acentric {
namespace {

/// Two mirrors that meet in a corner of a hall of coloured blocks. Nothing is lit: colours are exact.
RayScenePtr hallOfMirrors() {
  test::SceneBuilder builder;
  const auto unlit = [&](glm::vec3 colour) {
    Material m = test::matte(colour);
    m.unlit = true;
    return builder.material(m);
  };
  builder.box(unlit({0.35f, 0.3f, 0.25f}), {-8, -8, 0}, {8, 8, 4}, true);
  for (int i = 0; i < 28; ++i) {
    const float at = -7.5f + float(i % 14) * 1.05f, height = 0.8f + 0.25f * float(i * 5 % 9);
    const int colour = unlit({i % 3 == 0 ? 0.8f : 0.1f, i % 2 == 0 ? 0.7f : 0.15f, 0.9f - 0.03f * float(i)});
    if (i < 14)
      builder.box(colour, {-7.9f, at, 0}, {-7.2f, at + 0.7f, height});
    else
      builder.box(colour, {at, -7.9f, 0}, {at + 0.7f, -7.2f, height});
  }
  Material silver;
  silver.baseColour = {0.9f, 0.9f, 0.9f, 1};
  silver.roughness = 0;
  builder.quad(builder.material(silver), {5, -2.5f, 0.3f}, {5, -2.5f, 2.9f}, {5, 5, 2.9f}, {5, 5, 0.3f});
  silver.baseColour = {0.7f, 0.9f, 0.9f, 1};
  builder.quad(builder.material(silver), {-2.5f, 5, 0.3f}, {5, 5, 0.3f}, {5, 5, 2.9f}, {-2.5f, 5, 2.9f});
  return builder.rays();
}

WalkScene walkOf(const Layout& layout, const std::vector<ContentKey>& keys, const test::MemorySink& memory,
                 bool reflections) {
  WalkScene walk;
  walk.layout = std::make_shared<const Layout>(layout);
  for (const ContentKey& key : keys) {
    const Capture* found = memory.find(key);
    walk.captures.push_back(nullptr);
    if (found == nullptr) continue;
    Capture capture = *found;
    if (!reflections) capture.mirror.clear(), capture.reflections = {};
    walk.captures.back() = std::make_shared<const DisplayCapture>(prepareForDisplay(capture, 1));
  }
  return walk;
}

/// Bakes the cameras of the regions that the eyes stand in.
void bakeFor(const RayScene& scene, const Layout& layout, const std::vector<glm::dvec2>& eyes,
             const BakeSettings& settings, test::MemorySink& memory, TaskRunner& runner) {
  std::set<int> cameras;
  for (const glm::dvec2& eye : eyes)
    for (const Cover& cover : layout.regions[std::size_t(*layout.regionAt(eye))].covers)
      for (const Piece& piece : cover.pieces) cameras.insert(piece.camera);
  const std::vector<int> which(cameras.begin(), cameras.end());
  const auto report = bake(scene, layout, which, settings, memory, runner);
  ASSERT_TRUE(report) << report.error().describe();
  EXPECT_GT(report->counts.reflections, 1000u);
}

PerspectiveView viewFrom(const Layout& layout, const glm::dvec2& eye, double yawDegrees) {
  PerspectiveView view;
  view.eye = glm::dvec3(eye, layout.eyeZ());
  view.yawRadians = radians(yawDegrees);
  view.fovRadians = radians(75);
  view.width = 200, view.height = 125;
  return view;
}

/// Which pixels look into a plane mirror.
std::vector<char> mirrorPixels(const RayScene& scene, const PerspectiveView& view) {
  const FlatMirrors mirrors(scene.scene(), scene.plan());
  std::vector<char> inMirror;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const Ray ray{glm::vec3(view.eye), glm::vec3(glm::normalize(view.rayThrough(x + 0.5, y + 0.5)))};
      const Hit hit = scene.trace(ray);
      inMirror.push_back(hit.found() && mirrors.at(hit.mesh, hit.triangle, -ray.direction) != 0 ? 1 : 0);
    }
  return inMirror;
}

double psnrWhere(const std::vector<char>& where, const ColourImage& a, const ColourImage& b) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < where.size(); ++i) {
    if (where[i] == 0) continue;
    const glm::vec3 off = glm::vec3(a.pixels[i]) - glm::vec3(b.pixels[i]);
    sum += double(glm::dot(off, off)) / 3;
    ++count;
  }
  EXPECT_GT(count, where.size() / 10);
  return 10 * std::log10(255.0 * 255.0 * double(count) / sum);
}

TEST(MirrorWalk, ShowsReflectionsWhereTheEyeSeesThem) {
  const RayScenePtr scene = hallOfMirrors();
  for (const Configuration configuration : {Configuration::b, Configuration::d}) {
    LayoutSpec spec;
    spec.configuration = configuration;
    spec.cellSize = 1.6;
    spec.nearBand = 0.5;
    spec.outline.loops.push_back({{-2.2, -2.2}, {2.2, -2.2}, {2.2, 2.2}, {-2.2, 2.2}});
    const auto layout = buildLayout(spec);
    ASSERT_TRUE(layout) << layout.error().describe();
    const std::vector eyes = {glm::dvec2(0.3, 0.2), glm::dvec2(0.7, -1.1)};
    BakeSettings settings;
    settings.samplesPerDegree = 4;
    TaskRunner runner(0);
    test::MemorySink memory;
    bakeFor(*scene, *layout, eyes, settings, memory, runner);
    const auto keys = captureKeys(scene->scene(), scene->plan(), settings, *layout);
    const WalkScene moving = walkOf(*layout, keys, memory, true),
                    still = walkOf(*layout, keys, memory, false);
    for (const glm::dvec2& eye : eyes) {
      const PerspectiveView view = viewFrom(*layout, eye, 45);
      const TruthFrame truth = renderTruth(*scene, view, settings, 1, 1, runner);
      const auto inMirror = mirrorPixels(*scene, view);
      const auto psnrOf = [&](const WalkScene& walk) {
        const auto frame = renderFrame(walk, view, {}, runner);
        EXPECT_TRUE(frame);
        return frame ? psnrWhere(inMirror, frame->colour, truth.colour) : 0;
      };
      const double with = psnrOf(moving), without = psnrOf(still);
      RecordProperty(fmt::format("psnrInMirrors_{}_{}", nameOf(configuration), &eye - eyes.data()),
                     fmt::format("{:.1f} dB instead of {:.1f}", with, without));
      EXPECT_GT(with, 25) << nameOf(configuration) << " from " << eye.x << " " << eye.y;
      EXPECT_GT(with, without + 6) << nameOf(configuration) << " from " << eye.x << " " << eye.y;
    }
  }
}

TEST(MirrorWalk, KnowsTheMirrorsOfItsScene) {
  const OpenProject open = test::openWith(hallOfMirrors(), test::smallProject(1, 2));
  ASSERT_NE(open.mirrors, nullptr);
  const auto start = startWalk(open, nullptr);
  ASSERT_TRUE(start) << start.error().describe();
  EXPECT_EQ(start->walk.walk.mirrors, open.mirrors);
}

TEST(MirrorWalk, GoesOnWhereAMirrorComesIntoTheNearBand) {
  const RayScenePtr scene = hallOfMirrors();
  LayoutSpec spec;
  spec.configuration = Configuration::e;
  spec.cellSize = 1.6;
  spec.nearBand = 3.4;
  spec.outline.loops.push_back({{-2.2, -2.2}, {2.2, -2.2}, {2.2, 2.2}, {-2.2, 2.2}});
  const auto layout = buildLayout(spec);
  ASSERT_TRUE(layout) << layout.error().describe();
  const auto regionAt = [&](double x) { return *layout->regionAt({x, 0.3}); };
  const auto isNear = [&](double x) {
    return layout->regions[std::size_t(regionAt(x))].grown.contains({5, 0.3});
  };
  double beyond = -1.5, within = 1.5;  // towards the mirror
  ASSERT_TRUE(!isNear(beyond) && isNear(within));
  while (within - beyond > 1e-6) {
    const double middle = 0.5 * (beyond + within);
    (isNear(middle) ? within : beyond) = middle;
  }
  BakeSettings settings;
  settings.samplesPerDegree = 4;
  TaskRunner runner(0);
  test::MemorySink memory;
  bakeFor(*scene, *layout, {{beyond, 0.3}, {within, 0.3}}, settings, memory, runner);
  const auto keys = captureKeys(scene->scene(), scene->plan(), settings, *layout);
  WalkScene walk = walkOf(*layout, keys, memory, true);
  walk.scene = scene->sharedScene();
  walk.plan = scene->plan();
  walk.mirrors = flatMirrorsOf(*walk.scene, walk.plan);
  walk.local.resize(layout->regions.size());
  for (const double x : {beyond, within}) {
    const Region& region = layout->regions[std::size_t(regionAt(x))];
    walk.local[std::size_t(regionAt(x))] =
        std::make_shared<const LocalGeometry>(clipToPolygon(*walk.scene, region.grown));
  }
  const auto frameAt = [&](double x) {
    auto frame = renderFrame(walk, viewFrom(*layout, {x, 0.3}, 20), {}, runner);
    EXPECT_TRUE(frame);
    return frame ? std::move(*frame) : Frame{};
  };
  const PerspectiveView view = viewFrom(*layout, {within, 0.3}, 20);
  const TruthFrame truth = renderTruth(*scene, view, settings, 1, 1, runner);
  const auto inMirror = mirrorPixels(*scene, view);
  const Frame before = frameAt(beyond), after = frameAt(within);
  walk.mirrors = nullptr;
  const Frame poster = frameAt(within);
  std::size_t local = 0;
  for (std::size_t p = 0; p < inMirror.size(); ++p) {
    local += inMirror[p] != 0 && after.source.pixels[p] == kSourceLocal;
    EXPECT_FALSE(inMirror[p] != 0 && before.source.pixels[p] == kSourceLocal);
  }
  EXPECT_GT(local, inMirror.size() / 10);
  const double fromBeyond = psnrWhere(inMirror, before.colour, truth.colour),
               fromWithin = psnrWhere(inMirror, after.colour, truth.colour),
               asPoster = psnrWhere(inMirror, poster.colour, truth.colour),
               across = psnrWhere(inMirror, before.colour, after.colour);
  RecordProperty("psnrInMirrors", fmt::format("{:.1f} dB beyond, {:.1f} within ({:.1f} as a poster); {:.1f} "
                                              "from one to the other",
                                              fromBeyond, fromWithin, asPoster, across));
  EXPECT_GT(fromWithin, 25);
  EXPECT_GT(fromWithin, fromBeyond - 1);
  EXPECT_GT(fromWithin, asPoster + 6);
  EXPECT_GT(across, 25);
}

}  // namespace
}  // namespace acentric
