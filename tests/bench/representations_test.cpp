#include "engine/bench/representations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/bench/bake_to_size.h"
#include "engine/bench/panorama_places.h"
#include "engine/pipeline/trial_folder.h"
#include "tests/pipeline/small_project.h"

namespace acentric {
namespace {

int unlit(test::SceneBuilder& builder, glm::vec3 colour) {
  Material m = test::matte(colour);
  m.unlit = true;
  return builder.material(m);
}

/// A room without anything in it. Nothing is lit: colours are exact.
RayScenePtr emptyRoom() {
  test::SceneBuilder builder;
  builder.box(unlit(builder, {0.4f, 0.35f, 0.3f}), {-3, -3, 0}, {3, 3, 3}, true);
  return builder.rays();
}
/// The same with columns.
RayScenePtr roomWithColumns() {
  test::SceneBuilder builder;
  builder.box(unlit(builder, {0.4f, 0.35f, 0.3f}), {-3, -3, 0}, {3, 3, 3}, true);
  const int red = unlit(builder, {0.6f, 0.2f, 0.1f});
  for (const glm::vec2 at : {glm::vec2(1.5f, 0.3f), {-1.6f, 1.2f}, {0.2f, -1.8f}, {-0.4f, 1.9f}})
    builder.box(red, {at.x - 0.2f, at.y - 0.2f, 0}, {at.x + 0.2f, at.y + 0.2f, 3});
  return builder.rays();
}

double medianHoles(const RepresentationResult& result) {
  std::vector<double> holes;
  for (const Comparison& c : result.sets.front().comparisons) holes.push_back(c.holeShare);
  std::ranges::sort(holes);
  return holes[holes.size() / 2];
}

RepresentationBenchOptions few() {
  RepresentationBenchOptions options;
  options.poses = 12;
  options.width = 96, options.height = 54;
  return options;
}

TEST(BenchRepresentations, OnePanoramaShowsAnEmptyRoom) {
  const auto folder = TrialFolder::make("/tmp");
  ASSERT_TRUE(folder);
  const OpenProject open = test::openWith(emptyRoom(), test::smallProject(1, 3));
  TaskRunner runner(0);
  const Progress quiet;
  const Workplace at{open, folder->path(), runner, quiet, {}};
  auto rooms = roomPanoramas(at);
  ASSERT_TRUE(rooms) << rooms.error().describe();
  ASSERT_EQ(rooms->groups.size(), 1u);
  const glm::dvec2 centre = rooms->groups.front().centre;
  EXPECT_LT(glm::length(centre), 0.2);
  const auto made = makePanoramas(at, "rooms", "", std::move(*rooms), false, {});
  ASSERT_TRUE(made) << made.error().describe();
  EXPECT_EQ(made->cost.cameras, 6);
  EXPECT_DOUBLE_EQ(made->cost.samplesPerDegree, 3);
  FrameMemory memory;
  for (const auto& [away, most] : {std::pair{0.0, 0.0005}, std::pair{0.9, 0.01}})
    for (const double yaw : {0.0, 2.0, 4.0}) {
      PerspectiveView view;
      view.eye = glm::dvec3(centre + glm::dvec2(away, 0), open.layout->eyeZ());
      view.yawRadians = yaw;
      view.width = 160, view.height = 90;
      const auto frame = made->view->render(view, runner, memory);
      ASSERT_TRUE(frame) << frame.error().describe();
      const TruthFrame truth = renderTruth(*open.rays, view, open.project.bake, 1, 1, runner);
      EXPECT_LE(holeShareOf(*frame, truth.rayDistance), most) << away << " m away, yaw " << yaw;
    }
}

TEST(BenchRepresentations, AllAreMeasuredAtAsManyBytes) {
  const auto folder = TrialFolder::make("/tmp");
  ASSERT_TRUE(folder);
  Project project = test::smallProject(1.2, 3);
  project.scene = "columns.glb";  // never read: its scene is there
  const OpenProject open = test::openWith(roomWithColumns(), project);
  TaskRunner runner(0);
  RepresentationBenchOptions options = few();
  options.only = {"rings-60", "rings-90", "mesh", "rooms", "grid", "greedy", "boxes"};
  const auto views = randomViews(open, options);
  ASSERT_TRUE(views);
  const ViewSet path{"path", {views->views[0], views->views[1]}};
  std::vector<BakeForecast> told;
  options.tell = [&](const BakeForecast& forecast) {
    EXPECT_TRUE(std::filesystem::is_empty(folder->path()) || !told.empty()) << "before the first bake";
    told.push_back(forecast);
  };
  const auto bench = benchRepresentations(open, {path}, folder->path(), options, runner);
  ASSERT_TRUE(bench) << bench.error().describe();
  ASSERT_EQ(bench->sets.size(), 2u);
  EXPECT_EQ(bench->sets[1].views.size(), 2u);
  // The rings of 60 degrees are the project's own.
  ASSERT_EQ(bench->results.size(), options.only.size());
  const double own = double(bench->results.front().cost.bytes());
  for (const RepresentationResult& result : bench->results) {
    SCOPED_TRACE(result.name);
    ASSERT_EQ(result.sets.size(), 2u);
    EXPECT_EQ(result.sets[0].comparisons.size(), 12u);
    EXPECT_EQ(result.sets[1].comparisons.size(), 2u);
    for (const Comparison& c : result.sets[0].comparisons) EXPECT_GT(c.psnr, 8);
    EXPECT_GT(result.cost.bytes(), 0u);
    if (result.name == "mesh") {
      EXPECT_EQ(medianHoles(result), 0) << "there is little to simplify";
      EXPECT_GT(result.sets[0].comparisons[0].psnr, 30);
    } else {
      EXPECT_NEAR(double(result.cost.bytes()) / own, 1, 0.1);
      EXPECT_GT(result.cost.samples, 1000u);
      EXPECT_FALSE(result.cost.reused);
    }
  }
  EXPECT_LT(medianHoles(bench->results.front()), 0.01);
  int cameras = 0;
  double packed = 0, baked = 0;
  for (const RepresentationResult& result : bench->results) {
    cameras += result.cost.cameras, packed += double(result.cost.captureBytes);
    baked += result.cost.bakeSeconds;
  }
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].bakes, 6) << "the mesh has no captures";
  EXPECT_EQ(told[0].cameras, cameras);
  EXPECT_GT(told[0].packedBytes, packed / 2);
  EXPECT_LT(told[0].packedBytes, packed * 2);
  std::printf("[ bench    ] foretold: %.2f of the seconds that it took\n", told[0].seconds() / baked);

  const auto again = benchRepresentations(open, {}, folder->path(), options, runner);
  ASSERT_TRUE(again) << again.error().describe();
  ASSERT_EQ(told.size(), 2u);
  EXPECT_TRUE(told[1].nothing()) << describe(told[1]);
  EXPECT_EQ(told[1].probeSeconds, 0);
  for (std::size_t n = 0; n < again->results.size(); ++n) {
    SCOPED_TRACE(again->results[n].name);
    EXPECT_TRUE(again->results[n].cost.reused);
    EXPECT_EQ(again->results[n].cost.bytes(), bench->results[n].cost.bytes());
    EXPECT_EQ(again->results[n].cost.bakeSeconds, bench->results[n].cost.bakeSeconds);
    for (std::size_t v = 0; v < 12; ++v)
      EXPECT_EQ(again->results[n].sets[0].comparisons[v].psnr, bench->results[n].sets[0].comparisons[v].psnr);
  }
}

TEST(BenchRepresentations, LaysRingsAsLargeAnew) {
  LayoutSpec spec;
  spec.configuration = Configuration::b;
  spec.cellSize = 2;
  spec.added = {{9, 9, 0}};
  EXPECT_NEAR(relaid(spec, Configuration::b).cellSize, 2, 1e-12);
  EXPECT_NEAR(relaid(spec, Configuration::e).cellSize, 2 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(relaid(spec, Configuration::g).cellSize, 2 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(relaid(spec, Configuration::a).cellSize, 4 * std::sin(kPi / 8), 1e-12);
  EXPECT_TRUE(relaid(spec, Configuration::a).added.empty());
}

TEST(BenchRepresentations, FindsTheResolutionOfSoManyBytes) {
  int wholes = 0;
  const auto rough = [](double s) -> Result<double> { return 120 * s * s; };
  const auto whole = [&](double s) -> Result<double> { return ++wholes, 500 + 100 * s * s; };
  const auto found = fitResolution(1, 10000, 0.02, rough, whole);
  ASSERT_TRUE(found);
  EXPECT_NEAR(500 + 100 * *found * *found, 10000, 200);
  EXPECT_LE(wholes, 3);
  const auto least = fitResolution(1, 1, 0.02, rough, whole);
  ASSERT_TRUE(least);
  EXPECT_EQ(*least, kLeastSamplesPerDegree) << "no less is baked, whatever it takes";
}

TEST(BenchRepresentations, SaysWhatIsWrong) {
  const OpenProject open = test::openWith(emptyRoom(), test::smallProject(1, 2));
  TaskRunner runner(0);
  RepresentationBenchOptions options = few();
  options.only = {"hexagons"};
  const auto unknown = benchRepresentations(open, {}, "/nowhere", options, runner);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("grid"), std::string::npos);
  Project none = test::smallProject(1, 2);
  none.layout().outline = {};
  const auto refused = benchRepresentations(test::openWith(emptyRoom(), none), {}, "/nowhere", few(), runner);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("outline"), std::string::npos);
}

}  // namespace
}  // namespace acentric
