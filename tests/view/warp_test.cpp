#include "engine/view/warp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <ranges>

#include "engine/geometry/conventions.h"
#include "engine/view/kernels.h"
#include "engine/view/open_tiles.h"
#include "engine/view/picture_axes.h"
#include "engine/view/splat_painter.h"
#include "tests/support/print_configuration.h"
#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

using test::AnalyticBox;
using test::AnalyticScene;

using test::cameraAt;
using test::frameOf;
using test::OneCapture;
using test::oneCapture;
using test::paint;
using test::plainSettings;
using test::RandomViews;
using test::shareOfDifferentPixels;

class ListPriority : public testing::TestWithParam<Configuration> {};

TEST_P(ListPriority, PaintsWhatADepthBufferShows) {
  const auto layout = test::layoutAroundOrigin(GetParam());
  ASSERT_NE(layout, nullptr);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(3, 60, 3.4), layout, region, 4);
  RandomViews views(11);
  double sum = 0, worst = 0;
  constexpr int kViews = 40;
  for (int i = 0; i < kViews; ++i) {
    const PerspectiveView view = views.next(*layout, region, 60);
    const Frame list = frameOf(scene, view, plainSettings(Renderer::list));
    const Frame nearest = frameOf(scene, view, plainSettings(Renderer::zbuffer));
    EXPECT_EQ(list.holeCount(), nearest.holeCount());
    const double share = test::differingShare(list.colour, nearest.colour);
    sum += share;
    worst = std::max(worst, share);
  }
  RecordProperty("meanDifferingPercent", std::to_string(100 * sum / kViews));
  RecordProperty("worstDifferingPercent", std::to_string(100 * worst));
  EXPECT_LT(sum / kViews, 0.005);
  EXPECT_LT(worst, 0.02);
}

TEST_P(ListPriority, IsTheSameForAnyThreadCountAndKernel) {
  const auto layout = test::layoutAroundOrigin(GetParam());
  ASSERT_NE(layout, nullptr);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(6, 40, 3.4), layout, region, 3, 3);
  RandomViews views(13);
  for (double fov : {20.0, 60.0, 140.0, 60.0}) {
    const PerspectiveView view = views.next(*layout, region, fov);
    ViewSettings settings;
    settings.reconstruction = fov == 60 ? Reconstruction::filtered : Reconstruction::splat;
    settings.renderer = Renderer::scalar;
    const Frame truth = frameOf(scene, view, settings, 0);
    settings.renderer = Renderer::list;
    for (int workers : {0, 1, 3}) {
      const Frame frame = frameOf(scene, view, settings, workers);
      EXPECT_EQ(frame.colour.pixels, truth.colour.pixels) << fov << " degrees, " << workers << " workers";
      EXPECT_EQ(frame.source.pixels, truth.source.pixels);
      EXPECT_EQ(frame.stats.samplesDrawn, truth.stats.samplesDrawn);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Configurations, ListPriority, testing::Values(Configuration::b, Configuration::e),
                         [](const auto& parameter) { return std::string(nameOf(parameter.param)); });

TEST(ProjectSamples, GivesTheSameBitsWhateverTheProcessor) {
  std::mt19937 random(21);
  int wholes = 0, others = 0;
  const auto uniform = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  std::vector<float> tangents(300);
  for (float& t : tangents) t = uniform(-2, 2);
  for (int round = 0; round < 6000; ++round) {
    ProjectColumn column{};
    for (int i = 0; i < 3; ++i)
      column.a[i] = uniform(-300, 300), column.z[i] = uniform(-300, 300), column.b[i] = uniform(-300, 300);
    for (float* p : {column.a, column.z, column.b}) p[2] /= 300;
    column.maxInverseDistance = round % 3 == 0 ? 0.5f : std::numeric_limits<float>::infinity();
    column.footprint = round % 5 == 0 ? 0 : uniform(0, 20);
    column.maxSide = 16;
    column.slanted = round % 2 == 0;
    for (float& a : column.across) a = uniform(-3, 3);
    column.across[2] /= 300;
    column.acrossStep = uniform(0, 0.02f), column.downStep = uniform(0, 0.02f), column.perSpread = 4.4f;
    column.roles = round % 4 == 0 ? 0xffu : std::uint32_t(random() % 256);
    column.centreX = 320, column.centreY = 200, column.inverseFocal = 1 / uniform(100, 500);
    column.x0 = 0, column.y0 = 50, column.x1 = 640, column.y1 = 300;
    column.slot = 1 + random() % kMaxSlots;
    column.places = round % 8 == 0;
    column.partTest = static_cast<PartTest>(round % 3);
    for (float* p : {column.direction, column.baseline, column.low, column.high})
      p[0] = uniform(-1, 1), p[1] = uniform(-1, 1);
    const int count = 1 + round % 70;
    std::vector<PackedSample> samples;
    const std::size_t rowStep = 1 + random() % 6;
    for (int i = 0; i < count; ++i) {
      const auto slantCode = [&] { return static_cast<std::int8_t>(static_cast<int>(random() % 251) - 125); };
      const Slant slant{slantCode(), slantCode()};
      const std::size_t next = samples.empty() ? random() % 50 : samples.back().row + random() % rowStep;
      const float specials[] = {0, 1e30f, std::numeric_limits<float>::infinity(), std::nanf(""), 1e-40f};
      const auto roles = static_cast<std::uint8_t>(random());
      samples.push_back(packSample(random() % 8 == 0 ? specials[random() % 5] : uniform(0, 1), roles,
                                   static_cast<std::uint16_t>(std::min(next, tangents.size() - 1)), slant));
    }
    std::vector<SampleRun> runs{{0, std::uint32_t(count)}};
    if (count > 20) runs = {{1, 18}, {19, std::uint32_t(count)}};
    std::vector<Rgba8> colour;
    for (int i = 0; i < count; ++i)
      colour.push_back(
          colourOf((random() & 0xffffffu) | (i % 5 == 0 ? random() & 0xff000000u : 0xff000000u)));
    const auto project = [&](const Kernels& kernels, SplatMemory& memory) {
      const SplatArrays& splats = memory.room(samples.size());
      return kernels.project(
          column, {tangents.data(), samples.data(), reinterpret_cast<const unsigned char*>(colour.data())},
          runs.data(), int(runs.size()), splats);
    };
    SplatMemory expectedMemory;
    const int expected = project(supportedKernels().front(), expectedMemory);
    const SplatArrays& e = expectedMemory.room(0);
    for (int i = 0; i < expected; ++i) {
      const Splat a = splatAt(e, i);
      ASSERT_NE(rolesOf(samples[a.index]) & column.roles, 0u);
      ASSERT_TRUE(count <= 20 || (a.index != 0 && a.index != 18)) << "in no run";
      for (int side : {a.width, a.height}) {
        EXPECT_GE(side, 1);
        EXPECT_LE(side, 17);  // a rectangle is as long as it is: it may hold one centre more
      }
      EXPECT_EQ(static_cast<std::uint32_t>(a.pixel),
                (wordOf(colour[a.index]) & 0xffffffu) | column.slot << 24);
      const bool whole = a.width <= 2 && a.height <= 2 && a.x >= column.x0 && a.y >= column.y0 &&
                         a.x + a.width <= column.x1 && a.y + a.height <= column.y1 &&
                         colour[a.index].a == 255;
      ASSERT_EQ(e.steps[i] != 0, whole);
      wholes += whole;
      others += !whole;
    }
    for (const Kernels& kernels : supportedKernels().subspan(1)) {
      SplatMemory memory;
      ASSERT_EQ(project(kernels, memory), expected) << kernels.name;
      const SplatArrays& got = memory.room(0);
      const auto same = [&](const auto* a, const auto* b) { return std::equal(a, a + expected, b); };
      EXPECT_TRUE(same(got.pixels, e.pixels) && same(got.steps, e.steps) && same(got.firsts, e.firsts) &&
                  same(got.corners, e.corners) && same(got.sizes, e.sizes) && same(got.indices, e.indices))
          << kernels.name << ", round " << round;
    }
  }
  EXPECT_GT(wholes, 300);
  EXPECT_GT(others, 300);
}

TEST(PaintSplats, PaintsByCornersWhatItPaintsPixelByPixel) {
  constexpr int kWidth = 40, kHeight = 30, kCount = 500;
  std::mt19937 random(8);
  for (const bool places : {false, true})
    for (const PaintMode mode : {PaintMode::over, PaintMode::overBlended, PaintMode::nearest,
                                 PaintMode::blendOnNearest, PaintMode::reflect})
      for (const std::uint32_t openBelow : {0u, 4u}) {
        if (mode == PaintMode::reflect && openBelow != 0) continue;
        Canvas before;
        before.x0 = 100, before.width = kWidth, before.height = kHeight, before.places = places;
        for (int i = 0; i < kWidth * kHeight; ++i) {
          before.pixels.push_back(canvasPixel(std::uint32_t(random() % 6) << 24, float(random() % 100)));
          before.mirrors.push_back(static_cast<std::uint8_t>(random() % 3));
        }
        before.stamps.resize(before.pixels.size());
        before.blended.resize(before.pixels.size());
        before.mirrorPixels = before.pixels;

        // Samples straight ahead of a camera that is the eye, one column each.
        ProjectColumn column{};
        column.z[1] = -20, column.a[2] = 1;
        column.maxInverseDistance = 1000, column.maxSide = 4, column.slanted = true, column.roles = 1;
        column.x0 = 100, column.x1 = 100 + kWidth, column.y1 = kHeight;
        column.slot = 5, column.places = places;
        column.downStep = 0.03f, column.perSpread = 4.4f;
        std::vector<float> tangents;
        for (int i = 0; i < 64; ++i) tangents.push_back(float(2 - i) / 40);
        Canvas corners = before, pixels = before;
        std::uint64_t counts[2] = {};
        int wholes = 0;
        for (int round = 0; round < kCount; ++round) {
          column.a[0] = 98 + float(random() % 4400) / 100;
          column.across[0] = 0.3f + float(random() % 100) / 100;
          std::vector<PackedSample> samples;
          std::vector<Rgba8> colour;
          std::vector<std::uint8_t> mirror;
          for (std::uint16_t row = 0; row < 64; row = static_cast<std::uint16_t>(row + random() % 3)) {
            samples.push_back(packSample(float(random() % 50), 1, row, {}));
            const bool clear = mode != PaintMode::over && random() % 8 == 0;
            colour.push_back(
                colourOf(std::uint32_t(random() & 0xffffffu) | (clear ? 0x80000000u : 0xff000000u)));
            mirror.push_back(static_cast<std::uint8_t>(random() % 3));
          }
          SplatMemory memory;
          SplatArrays splats = memory.room(samples.size());
          const SampleRun all{0, std::uint32_t(samples.size())};
          const int count = projectSamplesScalar(
              column,
              {tangents.data(), samples.data(), reinterpret_cast<const unsigned char*>(colour.data())}, &all,
              1, splats);
          wholes += int(count - std::count(splats.steps, splats.steps + count, 0u));
          const bool reversed = round % 2 == 0, pixelByPixel = round % 4 < 2;
          const auto paint = [&](Canvas& canvas) {
            const PaintTarget target{&canvas,  colour.data(), samples.data(), mirror.data(), column.slot,
                                     7,        25.0f,         {0, 100},       100,           120,
                                     openBelow};
            return paintSplats(target, mode, splats, 0, count, reversed, pixelByPixel);
          };
          counts[0] += paint(corners);
          std::fill(splats.steps, splats.steps + count, 0u);
          counts[1] += paint(pixels);
        }
        corners.settleMirrors();
        pixels.settleMirrors();
        ASSERT_GT(wholes, 1000);
        EXPECT_GT(counts[0], mode == PaintMode::blendOnNearest ? 10u : 100u);
        EXPECT_EQ(counts[0], counts[1]);
        EXPECT_NE(corners.pixels, before.pixels);
        EXPECT_EQ(corners.pixels, pixels.pixels) << int(mode) << places << openBelow;
        EXPECT_EQ(corners.mirrors, pixels.mirrors) << int(mode) << places << openBelow;
      }
}

TEST(FindBlocks, LeavesOutNoneThatReachesAnOpenPixelAndIsTheSameWhateverTheProcessor) {
  std::mt19937 random(5);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  constexpr int kBlocks = 37, kPerBlock = 6, kRows = kBlocks * kPerBlock;
  const std::vector<Rgba8> colour(kRows);
  std::vector<float> tangents(kRows);
  for (int row = 0; row < kRows; ++row) tangents[std::size_t(row)] = float(std::tan(1.3 - row * 2.6 / kRows));
  int reached = 0, found = 0, hidden = 0;
  for (int round = 0; round < 1500; ++round) {
    PerspectiveView view;
    view.width = 640, view.height = 360;
    view.yawRadians = uniform(0, kTwoPi), view.pitchRadians = uniform(-1.5, 1.5);
    view.fovRadians = radians(uniform(20, 130));
    const PictureAxes axes(view);
    const PixelRect rect{160, 0, 400, 360};
    constexpr int kMaxSide = 16;
    const glm::dvec3 baseline(uniform(-3, 3), uniform(-3, 3), round % 3 == 0 ? 0 : uniform(-1, 1));
    const glm::dvec2 direction =
        directionOf(round % 4 == 0 ? uniform(0, kTwoPi) : view.yawRadians + uniform(-1, 1));
    ProjectColumn column{};
    axes.project(glm::dvec3(direction, 0), column.a);
    axes.project(glm::dvec3(0, 0, 1), column.z);
    axes.project(baseline, column.b);
    column.footprint = float(view.focalPixels() * uniform(0, 0.01));
    column.maxSide = kMaxSide;
    column.roles = 2;
    column.centreX = 320, column.centreY = 180, column.inverseFocal = float(1 / view.focalPixels());
    column.x0 = rect.x0, column.y0 = rect.y0, column.x1 = rect.x1, column.y1 = rect.y1;
    column.maxInverseDistance = round % 2 == 0 ? std::numeric_limits<float>::infinity() : 0.7f;
    column.minInverseDistance = round % 5 == 0 ? 0.1f : 0;
    column.slanted = round % 7 == 0;
    column.acrossStep = column.downStep = 0.01f, column.perSpread = 4.4f;

    std::vector<PackedSample> samples;
    SampleBlocks blocks;
    for (std::size_t b = 0; b < kBlocks; ++b) {
      const double near = uniform(0, 2), spread = b % 3 == 0 ? uniform(0, 2) : 0.02;
      for (std::size_t i = b * kPerBlock; i < (b + 1) * kPerBlock; ++i)
        samples.push_back(packSample(float(near + uniform(0, spread)),
                                     b % 11 == 0 ? 1 : std::uint8_t(1 + random() % 3), std::uint16_t(i), {}));
      const auto own = std::span(samples).last(kPerBlock);
      const auto [least, most] = std::ranges::minmax(own | std::views::transform(inverseDistanceOf));
      blocks.leastInverse.push_back(least), blocks.mostInverse.push_back(most);
      blocks.highTangent.push_back(tangents[b * kPerBlock]);
      blocks.lowTangent.push_back(tangents[(b + 1) * kPerBlock - 1]);
      blocks.roles.push_back(b % 11 == 0 ? 1 : 3);
    }
    for (auto* v : {&blocks.leastInverse, &blocks.mostInverse, &blocks.highTangent, &blocks.lowTangent})
      v->resize(v->size() + kSampleRoom);
    blocks.roles.resize(blocks.roles.size() + kSampleRoom, 3);

    CoverImage cover(view.width, view.height, 0);
    for (int n = 0; n < 60; ++n)
      cover.at(int(random() % unsigned(view.width)), int(random() % unsigned(view.height))) = kUncovered;
    const OpenTiles open(rect, &cover, 0);
    BlockTest test{};
    const FrustumPlanes planes = frustumPlanes(view, rect, splatMargin(kMaxSide));
    for (std::size_t i = 0; i < 5; ++i) {
      test.a[i] = float(glm::dot(glm::dvec2(planes.normals[i]), direction) + 1e-5);
      test.z[i] = float(planes.normals[i].z), test.b[i] = float(glm::dot(planes.normals[i], baseline));
    }
    test.slack = 1e-5f;
    if (round % 2 == 1) open.tell(test);

    const auto blocksOf = [&](const Kernels& kernels) {
      std::vector<std::uint16_t> out(kBlocks);
      out.resize(std::size_t(
          kernels.findBlocks(column, test,
                             {blocks.leastInverse.data(), blocks.mostInverse.data(), blocks.lowTangent.data(),
                              blocks.highTangent.data(), blocks.roles.data()},
                             kBlocks, out.data())));
      return out;
    };
    const std::vector<std::uint16_t> got = blocksOf(supportedKernels().front());
    for (const Kernels& kernels : supportedKernels()) EXPECT_EQ(blocksOf(kernels), got) << kernels.name;
    found += int(got.size());
    const SampleRun all{0, kRows};
    SplatMemory memory;
    const SplatArrays& splats = memory.room(kRows);
    const int count = projectSamplesScalar(
        column, {tangents.data(), samples.data(), reinterpret_cast<const unsigned char*>(colour.data())},
        &all, 1, splats);
    for (int i = 0; i < count; ++i) {
      const Splat splat = splatAt(splats, i);
      bool reaches = test.openTiles == nullptr;
      for (int x = std::max(splat.x, rect.x0); !reaches && x < std::min(splat.x + splat.width, rect.x1); ++x)
        for (int y = std::max(splat.y, 0); y < std::min(splat.y + splat.height, rect.y1); ++y)
          reaches = reaches || cover.at(x, y) == kUncovered;
      const bool kept = std::ranges::binary_search(got, std::uint16_t(splat.index / kPerBlock));
      reached += reaches;
      hidden += !kept;
      ASSERT_TRUE(kept || !reaches) << "round " << round << ", block " << splat.index / kPerBlock;
    }
  }
  EXPECT_GT(reached, 4000);
  EXPECT_GT(hidden, 1500) << "samples on the picture, but on no open pixel";
  EXPECT_LT(found, 1500 * kBlocks / 3);
}

TEST(Warp, PutsASampleWhereItsPointLies) {
  // One sample, any eye: the splat's centre is the projection of P + (c + t z) / w.
  std::mt19937 random(31);
  std::uniform_real_distribution<double> unit(-1, 1);
  int seen = 0;
  for (int round = 0; round < 300; ++round) {
    const ColumnCamera camera =
        cameraAt({unit(random), unit(random), 1.6 + unit(random)}, 180 * unit(random), 1, 1);
    const float w = static_cast<float>(std::abs(unit(random)));
    Capture capture{{{0, 1}, {0}, {w}, {packColour({1, 1, 1, 1})}, {1}, {}}, camera, 0, {}, {}};
    PerspectiveView view;
    view.eye = {unit(random), unit(random), 1.6 + unit(random)};
    view.yawRadians = camera.azimuthAt(0.5) + 0.8 * unit(random);
    view.pitchRadians = 0.5 * unit(random);
    view.fovRadians = radians(90);
    OneCapture one;
    one.scene.captures.push_back(std::make_shared<const DisplayCapture>(prepareForDisplay(capture, 1)));
    PieceDraw piece;
    piece.baseline = glm::vec3(camera.centreOfProjection - view.eye);
    piece.maxInverseDistance = {std::numeric_limits<float>::infinity()};
    piece.runs = {{0, 1, true}};
    one.plan.pieces.push_back(piece);
    ViewSettings settings = plainSettings();
    settings.reconstruction = Reconstruction::point;
    const Canvas canvas = paint(one.scene, view, settings, one.plan);

    const glm::dvec3 towards(camera.directionAt(0.5), camera.tangentAt(0.5));
    const glm::dvec3 q =
        view.viewFromWorld() * (towards + static_cast<double>(w) * (camera.centreOfProjection - view.eye));
    const double u = 0.5 * view.width + view.focalPixels() * q.x / q.z,
                 v = 0.5 * view.height + view.focalPixels() * q.y / q.z;
    const bool inside = q.z > 0 && u > 0.5 && u < view.width - 0.5 && v > 0.5 && v < view.height - 0.5;
    std::size_t painted = 0;
    for (int x = 0; x < view.width; ++x)
      for (int y = 0; y < view.height; ++y)
        if (slotOf(canvas.column(x)[y]) != 0) {
          ++painted;
          EXPECT_NEAR(x + 0.5, u, 0.51);
          EXPECT_NEAR(y + 0.5, v, 0.51);
          EXPECT_NEAR(inverseZDepthOf(canvas.column(x)[y]), w / q.z, 1e-4 * (1 + w / q.z));
        }
    if (inside) {
      EXPECT_EQ(painted, 1u);
    }
    seen += inside;
  }
  EXPECT_GT(seen, 100);
}

TEST(Warp, DrawsTheLayersOfAPixelFromFarToNear) {
  const AnalyticScene analytic = test::randomBoxes(14, 90, 1.5);
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  for (const glm::dvec3 offset : {glm::dvec3(0.02, 0.03, 0), glm::dvec3(0, 0, 0), glm::dvec3(0.8, -0.3, 0.3),
                                  glm::dvec3(-0.8, 0.4, -0.4)}) {
    PerspectiveView view;
    view.eye = camera.centreOfProjection + offset;
    view.width = 320, view.height = 240;
    const OneCapture one = oneCapture(analytic, camera, view, 6);
    ASSERT_TRUE(one.scene.captures[0]->layered);
    EXPECT_LT(shareOfDifferentPixels(paint(one.scene, view, plainSettings(), one.plan),
                                     paint(one.scene, view, plainSettings(), one.plan, true)),
              0.01)
        << offset.x;
  }
}

TEST(Warp, BlendsEachPaneOnceOverWhatLiesBehind) {
  // A pane of half-transparent white before a black wall: the pane's pixels are all of the one mixed colour.
  AnalyticScene analytic;
  analytic.floor = false;
  analytic.boxes.push_back({{6, -20, -20}, {7, 20, 20}, {0, 0, 0, 1}});
  analytic.boxes.push_back({{3, -0.8, 0.8}, {3.01, 0.8, 2.4}, {0.7f, 0.7f, 0.7f, 0.5f}});
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  for (const glm::dvec3 offset : {glm::dvec3(0), glm::dvec3(0.4, 0.5, 0.1)}) {
    PerspectiveView view;
    view.eye = camera.centreOfProjection + offset;
    view.width = 320, view.height = 240;
    const OneCapture one = oneCapture(analytic, camera, view, 2);
    ASSERT_TRUE(one.scene.captures[0]->blended);
    const Rgba8 tinted =
        blendOver(encodeForDisplay(glm::vec3(unpackColour(packColour({0.7f, 0.7f, 0.7f, 0.5f}))), 1, 0.5f),
                  Rgba8(0, 0, 0, 255));
    for (bool depthTest : {false, true}) {
      const Canvas canvas = paint(one.scene, view, plainSettings(), one.plan, depthTest);
      std::size_t mixed = 0, other = 0;
      for (int x = 0; x < view.width; ++x)
        for (int y = 0; y < view.height; ++y) {
          const glm::dvec3 ray = view.rayThrough(x + 0.5, y + 0.5);
          const double t = (3 - view.eye.x) / ray.x;
          const glm::dvec3 at = view.eye + t * ray;
          if (std::abs(at.y) > 0.75 || at.z < 0.85 || at.z > 2.35) continue;  // well within the pane
          const Rgba8 pixel = colourOf(static_cast<std::uint32_t>(canvas.column(x)[y]) | 0xff000000u);
          (pixel == tinted ? mixed : other) += 1;
        }
      EXPECT_GT(mixed, 1000u);
      EXPECT_LT(static_cast<double>(other), 0.02 * static_cast<double>(mixed))
          << depthTest << " " << offset.x;
    }
  }
}

TEST(Warp, BlendsEachOfTwoPanesThatNearlyTouch) {
  // 12 cm apart at 3 m: nearer to each other than neighbouring samples of one slanted pane may be.
  AnalyticScene analytic;
  analytic.floor = false;
  analytic.boxes.push_back({{6, -20, -20}, {7, 20, 20}, {0, 0, 0, 1}});
  for (double x : {3.0, 3.12})
    analytic.boxes.push_back({{x, -0.8, 0.8}, {x + 0.01, 0.8, 2.4}, {0.7f, 0.7f, 0.7f, 0.5f}});
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  PerspectiveView view;
  view.eye = camera.centreOfProjection + glm::dvec3(0.3, 0.2, 0.05);
  view.width = 320, view.height = 240;
  const OneCapture one = oneCapture(analytic, camera, view, 3);
  const Rgba8 pane = encodeForDisplay(glm::vec3(unpackColour(packColour({0.7f, 0.7f, 0.7f, 0.5f}))), 1, 0.5f);
  const Rgba8 tinted = blendOver(pane, blendOver(pane, Rgba8(0, 0, 0, 255)));
  for (Reconstruction reconstruction : {Reconstruction::splat, Reconstruction::filtered}) {
    ViewSettings settings = plainSettings();
    settings.reconstruction = reconstruction;
    const Canvas canvas = paint(one.scene, view, settings, one.plan);
    std::size_t twice = 0, other = 0;
    for (int x = 0; x < view.width; ++x)
      for (int y = 0; y < view.height; ++y) {
        const glm::dvec3 ray = view.rayThrough(x + 0.5, y + 0.5);
        const glm::dvec3 at = view.eye + (3 - view.eye.x) / ray.x * ray;
        if (std::abs(at.y) > 0.7 || at.z < 0.9 || at.z > 2.3) continue;  // well within both
        const Rgba8 pixel = colourOf(static_cast<std::uint32_t>(canvas.column(x)[y]) | 0xff000000u);
        (pixel == tinted ? twice : other) += 1;
      }
    EXPECT_GT(twice, 1000u);
    EXPECT_LT(static_cast<double>(other), 0.02 * static_cast<double>(twice)) << nameOf(reconstruction);
  }
}

TEST(Warp, DoesNotDependOnTheStrips) {
  const AnalyticScene analytic = test::randomBoxes(15, 60, 1.5);
  const ColumnCamera camera = cameraAt({0, 0, 1.6}, 0);
  PerspectiveView view;
  view.eye = {0.5, 0.6, 1.9};
  view.pitchRadians = -0.3;
  view.width = 300, view.height = 170;
  const OneCapture one = oneCapture(analytic, camera, view);
  for (Reconstruction reconstruction : kReconstructions) {
    ViewSettings settings = plainSettings();
    settings.reconstruction = reconstruction;
    const Canvas whole = paint(one.scene, view, settings, one.plan, false, 1);
    for (int strips : {2, 7, 300})
      EXPECT_EQ(paint(one.scene, view, settings, one.plan, false, strips).pixels, whole.pixels);
  }
}

}  // namespace
}  // namespace acentric
