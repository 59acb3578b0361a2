#include "engine/bake/bake.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <set>
#include <thread>

#include "layout_builder.h"
#include "memory_sink.h"
#include "scene_builder.h"

namespace acentric {
namespace {

using test::cameraAt;
using test::layoutOf;
using test::matte;
using test::MemorySink;
using test::SceneBuilder;
using test::square;

SceneBuilder smallRoom() {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {-6, -5, 0}, {6, 5, 3}, true).point({0, 0, 2.5f}, 100);
  return builder;
}

Layout fiveCameras() {
  std::vector<LayoutCamera> cameras;
  for (int i = 0; i < 5; ++i) cameras.push_back(cameraAt({0.1 * i, 0}, {square(1)}));
  return layoutOf(std::move(cameras));
}

BakeSettings coarse() {
  BakeSettings settings;
  settings.samplesPerDegree = 0.5;
  return settings;
}

TEST(Bake, PutsEveryCameraUnderItsKeyAndNeverBakesItAgain) {
  const auto scene = smallRoom().rays();
  const Layout layout = fiveCameras();
  MemorySink sink;
  TaskRunner runner(1);
  std::vector<ProgressState> seen;
  const auto first = bake(*scene, layout, {0, 1, 2, 3, 4}, coarse(), sink, runner,
                          [&](const ProgressState& p) { seen.push_back(p); });
  ASSERT_TRUE(first.has_value()) << first.error().describe();
  EXPECT_EQ(first->baked, 5);
  EXPECT_EQ(first->reused, 0);
  EXPECT_EQ(sink.size(), 5u);
  EXPECT_GT(first->counts.rays.primary, 0u);
  for (const ContentKey& key : captureKeys(scene->scene(), scene->plan(), coarse(), layout))
    EXPECT_TRUE(sink.has(key));
  const auto third = std::ranges::find(seen, "baking camera 2 (3 of 5)", &ProgressState::stage);
  ASSERT_NE(third, seen.end());
  EXPECT_EQ(third->total, 5);
  EXPECT_EQ(third->done, 2);
  EXPECT_TRUE(std::ranges::is_sorted(seen, {}, &ProgressState::done));
  EXPECT_GT(std::ranges::count_if(seen, [](const auto& p) { return p.done > 2 && p.done < 3; }), 3)
      << "columns count too";
  EXPECT_EQ(seen.back().done, 5);

  const auto again = bake(*scene, layout, {0, 1, 2, 3, 4}, coarse(), sink, runner);
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->baked, 0);
  EXPECT_EQ(again->reused, 5);
  EXPECT_EQ(again->counts.rays.primary, 0u);
}

/// A surface that crosses the border of the near band: local polygons end there, and the first sample beyond
/// may lie nearly a sample's spacing away.
TEST(Bake, KeepsOneSampleWithinTheNearBandOfSurfacesThatGoOnBeyond) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  constexpr float kWall = 1.5f, kFloor = 0;
  builder.quad(white, {-20, kWall, 0}, {20, kWall, 0}, {20, kWall, 3}, {-20, kWall, 3});
  builder.floor(white, 20, kFloor);
  const auto scene = builder.rays();
  constexpr double kBorder = 2;
  Role role;
  role.polygon = square(0.5);
  role.grown = square(kBorder);
  LayoutCamera camera;
  camera.roles = {role};
  camera.lowAzimuth = radians(10);
  camera.fovRadians = radians(60);
  for (const bool pruning : {true, false}) {
    BakeSettings settings = coarse();
    settings.pruning = pruning;
    settings.maxLayers = pruning ? 8 : 1;
    settings.silhouettes = false;  // they reach one pixel farther
    const ColumnCamera columns = columnCameraFor(camera, 1.6, 1, scene->scene().bounds, settings);
    TaskRunner runner;
    CaptureCounts counts;
    const auto capture = CameraBaker(*scene, settings).bake(camera, columns, runner, counts);
    ASSERT_TRUE(capture) << capture.error().describe();
    int within = 0, wallWithin = 0;
    for (int column = 0; column < columns.columns; ++column) {
      const glm::dvec2 direction = columns.directionAt(column + 0.5);
      const double exit = exitDistance(camera, role, direction);
      int floorWithin = 0;
      for (std::size_t n = capture->columnStart[std::size_t(column)];
           n < capture->columnStart[std::size_t(column) + 1]; ++n) {
        const double distance = 1 / double(capture->inverseDistance[n]);
        if (distance > exit * (1 - 1e-4)) continue;
        ++within;
        EXPECT_GT(distance, exit * (1 - kBorderOverlap));
        const bool onWall = std::abs(distance * direction.y - double(kWall)) < 0.02;
        (onWall ? wallWithin : floorWithin) += 1;
      }
      EXPECT_LE(floorWithin, 1) << column;
    }
    EXPECT_GT(wallWithin, 10) << "one column of the wall";
    EXPECT_GT(within, wallWithin + columns.columns / 4) << "and the floor's last row in many columns";
  }
}

TEST(Bake, AMovedCameraIsTheOnlyOneBakedAgain) {
  const auto scene = smallRoom().rays();
  Layout layout = fiveCameras();
  MemorySink sink;
  TaskRunner runner;
  ASSERT_TRUE(bake(*scene, layout, {0, 1, 2, 3, 4}, coarse(), sink, runner).has_value());
  layout.cameras[3].position.y += 0.25;
  const auto again = bake(*scene, layout, {0, 1, 2, 3, 4}, coarse(), sink, runner);
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->baked, 1);
  ASSERT_EQ(again->cameras.size(), 5u);
  EXPECT_FALSE(again->cameras[3].reused);
}

TEST(Bake, WhenStoppedWhatIsFinishedIsKept) {
  const auto scene = smallRoom().rays();
  MemorySink sink;
  TaskRunner runner;
  std::stop_source stop;
  const auto outcome = bake(
      *scene, fiveCameras(), {0, 1, 2, 3, 4}, coarse(), sink, runner,
      [&](const ProgressState& state) {
        if (state.stage == "baking camera 3 (4 of 5)") stop.request_stop();
      },
      stop.get_token());
  ASSERT_FALSE(outcome.has_value());
  EXPECT_EQ(outcome.error().kind, ErrorKind::cancelled);
  EXPECT_EQ(sink.size(), 3u);
}

TEST(Bake, TellsHowFarEachCameraIs) {
  const auto scene = smallRoom().rays();
  MemorySink sink;
  sink.room = 3;
  TaskRunner runner(1);
  std::map<int, std::vector<CameraNews>> told;
  const auto watch = [&](const CameraNews& news) { told[news.camera].push_back(news); };
  const auto bakeThese = [&](const std::vector<int>& which) {
    told.clear();
    return bake(*scene, fiveCameras(), which, coarse(), sink, runner, {}, {}, MemoryBudget::kUsual, watch);
  };
  ASSERT_TRUE(bakeThese({1, 4}));
  ASSERT_EQ(told.size(), 2u);
  for (const auto& [camera, all] : told) {
    EXPECT_EQ(all.front().stage, CameraStage::tracing);
    EXPECT_EQ(all.front().columnsDone, 0);
    const auto traced = std::ranges::find(all, CameraStage::writing, &CameraNews::stage);
    ASSERT_NE(traced, all.end());
    EXPECT_TRUE(std::ranges::is_sorted(all.begin(), traced, {}, &CameraNews::columnsDone));
    EXPECT_EQ(std::prev(traced)->columnsDone, traced->columns);
    EXPECT_GT(traced->rays, 0u);
    EXPECT_GT(traced->seconds, 0);
    EXPECT_EQ(all.back().stage, CameraStage::done);
  }
  ASSERT_FALSE(bakeThese({1, 0, 2}));
  EXPECT_EQ(told[1].back().stage, CameraStage::reused);
  EXPECT_EQ(told[0].back().stage, CameraStage::done);
  EXPECT_EQ(told[2].back().stage, CameraStage::failed);
  EXPECT_EQ(told[2].back().error, "sink: the disk is full");
}

/// What a capture of each camera takes, and the views of its eyes.
struct Needs {
  std::size_t samples = 0, views = 0;
};
Needs largestNeeds(const RayScene& scene, const Layout& layout, const BakeSettings& settings) {
  Needs needs;
  TaskRunner runner;
  for (const LayoutCamera& camera : layout.cameras) {
    CaptureCounts counts;
    const ColumnCamera columns =
        columnCameraFor(camera, layout.eyeZ(), layout.spec.nearBand, scene.scene().bounds, settings);
    const auto capture = CameraBaker(scene, settings).bake(camera, columns, runner, counts);
    EXPECT_TRUE(capture);
    needs.samples = std::max(needs.samples, capture->bytes());
    const std::size_t texels = 90;  // to an edge of a map
    needs.views = std::max(needs.views, std::size_t(counts.eyeViews) * 6 * (texels + 1) * (texels + 1) * 4);
  }
  return needs;
}

TEST(Bake, HoldsNoMoreThanItsLimitAndNeverWaitsForever) {
  const auto scene = smallRoom().rays();
  const Layout layout = fiveCameras();
  BakeSettings settings = coarse();
  settings.samplesPerDegree = 2;
  settings.testEyes = 2;
  const Needs needs = largestNeeds(*scene, layout, settings);
  ASSERT_GT(needs.samples, 100'000u);
  TaskRunner runner(1);
  // Nothing is written before so many cameras are begun, or long enough after.
  const auto peakWithin = [&](std::size_t limit, double begun, int mostMilliseconds) {
    MemorySink sink;
    std::atomic<double> done = 0;
    sink.onPut = [&] {
      for (int n = 0; n < mostMilliseconds && done < begun; ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    const auto report = bake(
        *scene, layout, {0, 1, 2, 3, 4}, settings, sink, runner,
        [&](const ProgressState& state) { done = state.done; }, {}, limit);
    EXPECT_TRUE(report.has_value());
    EXPECT_EQ(sink.size(), 5u);
    return report ? report->peakBytes : 0;
  };
  // All but the last wait when nothing is in the way.
  EXPECT_GT(peakWithin(std::size_t(1) << 30, 4.5, 60'000), 10 * needs.samples);
  // Room for one that is written while the next is traced.
  const std::size_t roomy = 3 * (needs.views + 5 * needs.samples);
  EXPECT_LE(peakWithin(roomy, 5, 60), roomy);
  const std::size_t tight = 3 * needs.views + 5 * needs.samples;
  EXPECT_LE(peakWithin(tight, 5, 60), tight);
  // Room for less than one: each alone, with what was traced of the next before there was no room.
  EXPECT_LE(peakWithin(1, 5, 60), needs.views + 4 * needs.samples);
}

TEST(Bake, AnErrorOfTheSinkEndsTheBakeAndComesBack) {
  const auto scene = smallRoom().rays();
  MemorySink sink;
  sink.room = 2;
  TaskRunner runner;
  const auto outcome = bake(*scene, fiveCameras(), {0, 1, 2, 3, 4}, coarse(), sink, runner);
  ASSERT_FALSE(outcome.has_value());
  EXPECT_EQ(outcome.error().kind, ErrorKind::outOfSpace);
  EXPECT_EQ(outcome.error().describe(), "sink: the disk is full");
  EXPECT_EQ(sink.size(), 2u);
}

TEST(Bake, ASinkThatThrowsBecomesAnError) {
  const auto scene = smallRoom().rays();
  MemorySink sink;
  sink.onPut = [] { throw std::runtime_error("unplugged"); };
  TaskRunner runner;
  const auto outcome = bake(*scene, fiveCameras(), {0}, coarse(), sink, runner);
  ASSERT_FALSE(outcome.has_value());
  EXPECT_NE(outcome.error().message.find("unplugged"), std::string::npos);
}

TEST(Bake, RefusesACameraThatDoesNotExist) {
  const auto scene = smallRoom().rays();
  MemorySink sink;
  TaskRunner runner;
  const auto outcome = bake(*scene, fiveCameras(), {0, 9}, coarse(), sink, runner);
  ASSERT_FALSE(outcome.has_value());
  EXPECT_EQ(outcome.error().kind, ErrorKind::notFound);
  EXPECT_EQ(sink.size(), 0u);
}

/// Keys of one camera in a small room under a sky.
class CaptureKeyTest : public testing::Test {
 protected:
  CaptureKeyTest() { builder.sky(glm::vec3(1)), scene = builder.scene(); }
  /// The usual settings but for one.
  template <class Value>
  static BakeSettings with(Value BakeSettings::*setting, Value value) {
    BakeSettings settings;
    settings.*setting = value;
    return settings;
  }
  SceneBuilder builder = smallRoom();
  ScenePtr scene;
  const LayoutCamera camera = cameraAt({0, 0}, {square(1)});
};

TEST_F(CaptureKeyTest, HasPartsThatTellWhatChanged) {
  const auto partsFor = [](const Scene& s, const BakeSettings& b, const LayoutCamera& c) {
    const EffectPlan plan = planEffects(s);
    const ColumnCamera columns = columnCameraFor(c, 1.6, 1, s.bounds, b);
    const KeyParts parts = captureKeyParts(s, plan, b, c, columns);
    EXPECT_EQ(keyOf(parts), captureKey(s, plan, b, c, columns));
    return parts;
  };
  const KeyParts parts = partsFor(*scene, {}, camera);
  const auto changed = [&](const KeyParts& other) {
    std::set<std::string> names;
    EXPECT_EQ(other.size(), parts.size());
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (other[p] != parts[p]) names.insert(parts[p].name);
    return names;
  };
  using Names = std::set<std::string>;
  EXPECT_EQ(changed(partsFor(*scene, {}, camera)), Names{});
  EXPECT_EQ(changed(partsFor(*scene, with(&BakeSettings::maxLayers, 5), camera)), Names{"settings"});
  LayoutCamera other = camera;
  other.roles.push_back(camera.roles.front());
  EXPECT_EQ(changed(partsFor(*scene, {}, other)), Names{"regions"});
  other = camera;
  other.position.x = 0.5;
  EXPECT_EQ(changed(partsFor(*scene, {}, other)), (Names{"place", "image"}));
  other = camera;
  other.density = 1.5;
  EXPECT_EQ(changed(partsFor(*scene, {}, other)), Names{"image"});
  Scene brighter = *scene;
  brighter.sky.zenith.r = 2;
  brighter.parts = partsOf(brighter);
  brighter.key = keyOf(brighter.parts);
  EXPECT_THAT(changed(partsFor(brighter, {}, camera)), testing::IsSupersetOf({"scene", "lights"}));
}

TEST_F(CaptureKeyTest, ChangesWithEverythingThatChangesPixelsAndWithNothingElse) {
  const EffectPlan plan = planEffects(*scene);
  const auto keyFor = [](const Scene& s, const EffectPlan& p, const BakeSettings& b, const LayoutCamera& c) {
    return captureKey(s, p, b, c, columnCameraFor(c, 1.6, 1, s.bounds, b));
  };
  const ContentKey key = keyFor(*scene, plan, {}, camera);
  EXPECT_EQ(keyFor(*builder.scene(), planEffects(*builder.scene()), {}, camera), key)
      << "made twice, the same";

  std::set<ContentKey> keys{key};
  const auto changes = [&](const char* what, const ContentKey& other) {
    EXPECT_TRUE(keys.insert(other).second) << what;
  };
  const auto keyWith = [&](const BakeSettings& settings) { return keyFor(*scene, plan, settings, camera); };
  changes("samples per degree", keyWith(with(&BakeSettings::samplesPerDegree, 9.0)));
  changes("ambient rays", keyWith(with(&BakeSettings::ambientRays, 13)));
  changes("ambient radius", keyWith(with(&BakeSettings::ambientRadius, 3.0)));
  changes("layers", keyWith(with(&BakeSettings::maxLayers, 5)));
  changes("test eyes", keyWith(with(&BakeSettings::testEyes, 5)));
  changes("what pruning may lose", keyWith(with(&BakeSettings::pruningLoss, 0.01)));
  changes("how true colours are", keyWith(with(&BakeSettings::colourQuality, 50)));
  changes("places of gathered light", keyWith(with(&BakeSettings::surfaceTexel, 0.5)));
  BakeSettings settings = with(&BakeSettings::pruning, false);
  const ContentKey unpruned = keyWith(settings);
  changes("pruning", unpruned);
  settings.testEyes = 6, settings.pruningLoss = 0;
  EXPECT_EQ(keyWith(settings), unpruned) << "no eye is asked without pruning";
  changes("an effect", keyFor(*scene, planEffects(*scene, {{Effect::hardShadows, false}}), {}, camera));
  LayoutCamera other = camera;
  other.position.x = 0.5;
  changes("position", keyFor(*scene, plan, {}, other));
  other = camera;
  other.lowAzimuth += 0.1;
  changes("direction", keyFor(*scene, plan, {}, other));
  other = camera;
  other.roles[0].grown = square(1.5);
  changes("near band", keyFor(*scene, plan, {}, other));
  other = camera;
  other.roles[0].polygon = square(0.5);
  changes("where the eye stands", keyFor(*scene, plan, {}, other));
  other = camera;
  other.roles[0].clip = Clip{{{{0, 0}, {1, 0}}, true}};
  changes("part of the sector", keyFor(*scene, plan, {}, other));
  other = camera;
  other.roles.push_back(other.roles[0]);
  changes("another role", keyFor(*scene, plan, {}, other));
  SceneBuilder brighter = builder;
  brighter.point({1, 1, 2}, 5);
  changes("scene", keyFor(*brighter.scene(), plan, {}, camera));

  EXPECT_EQ(keyWith(with(&BakeSettings::bounces, 3)), key) << "they are off";
  EXPECT_EQ(keyWith(with(&BakeSettings::shadowRays, 3)), key) << "no light is soft";
  other = camera;
  other.id.i = 77;
  EXPECT_EQ(keyFor(*scene, plan, {}, other), key) << "numbering is not a pixel";
}

TEST(ColumnCameraFor, CoversTheSceneAcrossTheNearBand) {
  const LayoutCamera camera = cameraAt({1, 2}, {});
  BakeSettings settings;
  settings.samplesPerDegree = 4;
  settings.eyeRange = 0.1;
  Bounds bounds;
  bounds.add({-5, -5, 0});
  bounds.add({5, 5, 3});
  const ColumnCamera c = columnCameraFor(camera, 1.6, 1, bounds, settings);
  EXPECT_TRUE(c.check().has_value());
  EXPECT_EQ(c.centreOfProjection, glm::dvec3(1, 2, 1.6));
  EXPECT_NEAR(c.topElevation, std::atan(1.5), 1e-6);
  EXPECT_NEAR(c.bottomElevation, -std::atan(1.7), 1e-6);
  EXPECT_EQ(c.columns, 240);
  EXPECT_EQ(c.rows, int(std::ceil(degrees(c.topElevation - c.bottomElevation) * 4)));

  bounds.add({0, 0, 1000});
  EXPECT_NEAR(columnCameraFor(camera, 1.6, 1, bounds, settings).topElevation, radians(85), 1e-9);
  EXPECT_TRUE(columnCameraFor(camera, 1.6, 0, bounds, settings).check().has_value());
  const ColumnCamera flat = columnCameraFor(camera, 1.6, 1, {}, settings);
  EXPECT_EQ(flat.rows, 4) << "an empty scene has next to no height";
  Bounds floorAlone;
  floorAlone.add({-5, -5, 0});
  floorAlone.add({5, 5, 0});
  const ColumnCamera low = columnCameraFor(camera, 1.6, 1, floorAlone, settings);
  EXPECT_LT(low.topElevation, radians(1)) << "nothing is above the horizon";
  EXPECT_GT(low.topElevation, 0);
}

TEST(BakeSettings, RefusesEveryValueOutOfItsRange) {
  EXPECT_TRUE(BakeSettings{}.check().has_value());
  const auto refused = [](auto change) {
    BakeSettings settings;
    change(settings);
    const Status status = settings.check();
    return !status && status.error().kind == ErrorKind::invalidArgument;
  };
  EXPECT_TRUE(refused([](auto& s) { s.samplesPerDegree = 0.4; }));
  EXPECT_TRUE(refused([](auto& s) { s.samplesPerDegree = std::nan(""); }));
  EXPECT_TRUE(refused([](auto& s) { s.ambientRays = -1; }));
  EXPECT_TRUE(refused([](auto& s) { s.ambientRadius = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.surfaceTexel = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.maxLayers = 65; }));
  EXPECT_TRUE(refused([](auto& s) { s.pruningLoss = 1e-6; }));
  EXPECT_TRUE(refused([](auto& s) { s.pruningLoss = 1.1; }));
  EXPECT_FALSE(refused([](auto& s) { s.pruningLoss = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.colourQuality = -1; }));
  EXPECT_TRUE(refused([](auto& s) { s.colourQuality = 101; }));
  EXPECT_FALSE(refused([](auto& s) { s.colourQuality = 100; }));
}

TEST(BakeSettings, OfLowerQualityAreSoundAndNeverCostMore) {
  BakeSettings finest, coarsest;
  finest.samplesPerDegree = 64, finest.ambientRays = finest.shadowRays = 1024, finest.bounces = 8;
  finest.maxLayers = finest.testEyes = 64, finest.surfaceTexel = kLargestBakeLength;
  coarsest.samplesPerDegree = 0.5, coarsest.ambientRays = 0, coarsest.shadowRays = 1, coarsest.bounces = 1;
  coarsest.maxLayers = coarsest.testEyes = 1, coarsest.surfaceTexel = kLeastBakeLength;
  coarsest.pruning = false;
  for (const BakeSettings& full : {BakeSettings{}, finest, coarsest}) {
    EXPECT_EQ(full.at(Quality::full), full);
    const BakeSettings draft = full.at(Quality::draft), preview = full.at(Quality::preview);
    for (const auto& [lower, higher] : {std::pair{draft, full}, std::pair{preview, draft}}) {
      EXPECT_TRUE(lower.check());
      EXPECT_LE(lower.samplesPerDegree, higher.samplesPerDegree);
      EXPECT_LE(lower.ambientRays, higher.ambientRays);
      EXPECT_LE(lower.shadowRays, higher.shadowRays);
      EXPECT_LE(lower.bounces, higher.bounces);
      EXPECT_LE(lower.maxLayers, higher.maxLayers);
      EXPECT_LE(lower.testEyes, higher.testEyes);
      EXPECT_GE(lower.surfaceTexel, higher.surfaceTexel);
      EXPECT_LE(lower.pruning, higher.pruning);
    }
  }
  EXPECT_EQ(BakeSettings{}.at(Quality::preview).samplesPerDegree, 2);
}

}  // namespace
}  // namespace acentric
