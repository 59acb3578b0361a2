#include "engine/inspect/estimates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "engine/inspect/estimate_picture.h"

namespace acentric {
namespace {

/// A bake whose costs are known by heart: each camera has its own, as real ones do.
class KnownBake final : public BakeProber {
 public:
  struct Camera {
    double pixels, samplesPerPixel, secondsPerPixel, bytesPerSample;
  };
  std::vector<Camera> cameras;
  CaptureOverhead overhead{0.002, 0.004, 900};
  double writeSecondsPerSample = 1e-7;
  std::vector<double> lightSamples{5e5, 2e5}, lightSecondsPerSample{4e-6, 1e-6};
  double probedShare = 0.1;  ///< of each camera, and of each kind of triangle
  double slicePace = 1;      ///< seconds of slices against those that the cameras' parts foretell
  double raysPerProbe = 2e5;
  GatherForecast gathering;
  std::vector<int> probed;
  std::vector<int> lightProbes = std::vector<int>(2, 0);

  static KnownBake random(int count, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> vary(0.6, 1.4);
    KnownBake bake;
    for (int i = 0; i < count; ++i)
      bake.cameras.push_back({1e5, 1.1 * vary(engine), 1e-6 * vary(engine), 7 * vary(engine)});
    return bake;
  }

  std::vector<double> pixels() const {
    std::vector<double> all;
    for (const Camera& camera : cameras) all.push_back(camera.pixels);
    return all;
  }
  template <class Part>
  double total(const Part& part) const {
    return std::accumulate(cameras.begin(), cameras.end(), 0.0,
                           [&](double sum, const Camera& camera) { return sum + part(camera); });
  }
  double samples() const {
    return total([](const Camera& c) { return c.pixels * c.samplesPerPixel; });
  }
  double bytes() const {
    return total(
        [&](const Camera& c) { return overhead.bytes + c.pixels * c.samplesPerPixel * c.bytesPerSample; });
  }
  double traceSeconds() const {
    return total([&](const Camera& c) { return overhead.traceSeconds + c.pixels * c.secondsPerPixel; });
  }

  double sight = 0;  ///< seconds for what the regions see

  double sightSeconds() override { return sight; }
  Result<CaptureOverhead> captureOverhead() override { return overhead; }
  Result<GatherForecast> forecastGathering(bool surfaceLight) override {
    GatherForecast forecast = gathering;
    if (!surfaceLight) forecast.lightRays = 0;
    return forecast;
  }
  Result<double> probeCapture(int camera) override {
    probed.push_back(camera);
    return raysPerProbe;
  }
  Result<std::vector<SliceProbe>> bakeSlices(const std::vector<int>& numbers) override {
    std::vector<SliceProbe> slices;
    for (const int number : numbers) {
      const Camera& c = cameras[std::size_t(number)];
      const double pixels = 0.4 * c.pixels;
      slices.push_back({pixels, slicePace * std::max(overhead.traceSeconds + pixels * c.secondsPerPixel,
                                                     overhead.writeSeconds + pixels * c.samplesPerPixel *
                                                                                 writeSecondsPerSample)});
    }
    return slices;
  }
  Result<std::vector<CaptureProbe>> finishCaptures() override {
    std::vector<CaptureProbe> probes;
    for (const int number : probed) {
      const Camera& c = cameras[std::size_t(number)];
      CaptureProbe probe;
      probe.pixels = probedShare * c.pixels;
      probe.samples = probe.writtenSamples = probe.pixels * c.samplesPerPixel;
      probe.rays = 5 * probe.pixels;
      probe.traceSeconds = probe.pixels * c.secondsPerPixel;
      probe.bytes = probe.samples * c.bytesPerSample;
      probe.writeSeconds = probe.samples * writeSecondsPerSample;
      probes.push_back(probe);
    }
    return probes;
  }
  Result<LightOverhead> lightOverhead() override { return LightOverhead{1e5, 0.5, lightSamples}; }
  Result<LightProbe> probeLight(int kind) override {
    const auto k = std::size_t(kind);
    if (lightProbes[k] * probedShare >= 1) return LightProbe{};
    ++lightProbes[k];
    const double samples = probedShare * lightSamples[k];
    return LightProbe{samples, 3 * samples, samples * lightSecondsPerSample[k], 2 * samples};
  }
};

EstimateOptions brief() {
  EstimateOptions options;
  options.effort = 0;
  return options;
}

TEST(Estimates, AreOfFewProbesWhereTheyAreToBeBrief) {
  KnownBake bake = KnownBake::random(200, 3);
  EstimateOptions options;
  options.brief = true;
  options.effort = 1000;
  const auto estimate = estimateBake(bake.pixels(), options, bake);
  ASSERT_TRUE(estimate) << estimate.error().describe();
  EXPECT_EQ(estimate->probedCameras, 10);
  EXPECT_EQ(bake.lightProbes, (std::vector{1, 1})) << "one of each kind";
  EXPECT_NEAR(estimate->samples.value / bake.samples(), 1, 0.3);
  EXPECT_NEAR(estimate->traceSeconds.value / bake.traceSeconds(), 1, 0.5);
}

TEST(Estimates, OfEveryCameraProbedWholeAreExact) {
  KnownBake bake = KnownBake::random(12, 1);
  bake.probedShare = 1;
  const auto estimate = estimateBake(bake.pixels(), {1000, true}, bake);
  ASSERT_TRUE(estimate) << estimate.error().describe();
  EXPECT_EQ(estimate->cameras, 12);
  EXPECT_EQ(estimate->probedCameras, 12);
  EXPECT_NEAR(estimate->samples.value / bake.samples(), 1, 1e-9);
  EXPECT_NEAR(estimate->captureBytes.value / bake.bytes(), 1, 1e-9);
  EXPECT_NEAR(estimate->traceSeconds.value / bake.traceSeconds(), 1, 1e-9);
  EXPECT_NEAR(estimate->rays.value, 5 * estimate->pixels, 1e-3);
  EXPECT_EQ(estimate->samples.relativeError, 0);
  EXPECT_NEAR(estimate->lightSamples.value, 14e5, 1e-6) << "finer at the edges of shadows";
  EXPECT_NEAR(estimate->lightBytes.value, 1e5 + 3 * 7e5, 1e-3);
  EXPECT_NEAR(estimate->lightSeconds.value, 0.5 + 5e5 * 4e-6 + 2e5 * 1e-6, 1e-9);
  EXPECT_NEAR(estimate->bytes.value, estimate->captureBytes.value + estimate->lightBytes.value, 1e-3);
  bake.sight = 5;
  bake.probed.clear();
  const auto slower = estimateBake(bake.pixels(), {1000, false}, bake);
  ASSERT_TRUE(slower) << slower.error().describe();
  EXPECT_EQ(slower->sightSeconds, 5);
  EXPECT_NEAR(slower->captureSeconds.value, estimate->captureSeconds.value + 5, 1e-9);
}

TEST(Estimates, OfAFewCamerasLieWithinTheErrorTheyState) {
  // Over many scenes the true value lies within two standard errors nineteen times in twenty, or so.
  int within = 0, trials = 0;
  double worst = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    KnownBake bake = KnownBake::random(150, seed);
    const auto estimate = estimateBake(bake.pixels(), brief(), bake);
    ASSERT_TRUE(estimate);
    EXPECT_LT(estimate->probedCameras, 40);
    const std::pair<Figure, double> checks[] = {{estimate->samples, bake.samples()},
                                                {estimate->captureBytes, bake.bytes()},
                                                {estimate->traceSeconds, bake.traceSeconds()}};
    for (const auto& [figure, truth] : checks) {
      const double error = std::abs(figure.value / truth - 1);
      ++trials;
      within += error <= 2 * figure.relativeError ? 1 : 0;
      worst = std::max(worst, error);
    }
  }
  EXPECT_GT(double(within) / trials, 0.9);
  EXPECT_LT(worst, 0.25);
}

TEST(Estimates, TakeTheSlowerOfTracingAndWritingForTheTime) {
  KnownBake tracing = KnownBake::random(50, 3), writing = tracing;
  writing.writeSecondsPerSample = 1e-5;
  const auto traced = estimateBake(tracing.pixels(), brief(), tracing);
  const auto written = estimateBake(writing.pixels(), brief(), writing);
  ASSERT_TRUE(traced && written);
  EXPECT_GT(traced->traceSeconds.value, traced->writeSeconds.value);
  EXPECT_NEAR(traced->captureSeconds.value, traced->traceSeconds.value + traced->writeSeconds.value / 50,
              1e-9);
  EXPECT_GT(written->writeSeconds.value, written->traceSeconds.value);
  EXPECT_NEAR(written->captureSeconds.value, written->writeSeconds.value + written->traceSeconds.value / 50,
              1e-9);
}

TEST(Estimates, GiveEachKindOfTriangleItsOwnRate) {
  KnownBake bake = KnownBake::random(5, 4);
  const auto estimate = estimateBake({}, brief(), bake);
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->cameras, 0);
  EXPECT_EQ(estimate->captureBytes.value, 0);
  EXPECT_NEAR(estimate->seconds.value, 0.5 + 5e5 * 4e-6 + 2e5 * 1e-6, 1e-9);
  EstimateOptions none = brief();
  none.surfaceLight = false;
  EXPECT_EQ(estimateBake({}, none, bake)->seconds.value, 0);
}

TEST(Estimates, ProbeByRaysNotByTime) {
  KnownBake bake = KnownBake::random(300, 6);
  const auto probedWith = [&](double raysPerProbe, double effort) {
    bake.raysPerProbe = raysPerProbe;
    bake.probed.clear();
    return estimateBake(bake.pixels(), {effort, false}, bake)->probedCameras;
  };
  const int usual = probedWith(2e5, 1);
  EXPECT_GT(usual, 20);
  EXPECT_LT(usual, 300);
  EXPECT_EQ(probedWith(1e5, 1), 2 * usual);
  EXPECT_EQ(probedWith(2e5, 2), 2 * usual);
  EXPECT_EQ(probedWith(1e9, 1), 32) << "a few tell how they differ, whatever it takes";
  EXPECT_EQ(probedWith(2e5, 0), 32);
  EXPECT_EQ(probedWith(2e5, 1000), 300);
}

TEST(Estimates, AddWhatIsGatheredOnceForAll) {
  KnownBake bake = KnownBake::random(40, 7);
  const auto without = estimateBake(bake.pixels(), {1000, true}, bake);
  KnownBake gathering = KnownBake::random(40, 7);
  gathering.gathering = {3e6, 1e6, 0.1, 1e-6};
  const auto with = estimateBake(gathering.pixels(), {1000, true}, gathering);
  ASSERT_TRUE(without && with);
  EXPECT_EQ(with->gatheredRays, 3e6);
  EXPECT_NEAR(with->rays.value, without->rays.value + 3e6, 1e-3);
  EXPECT_NEAR(with->rays.relativeError, 0.1 * 3e6 / with->rays.value, 1e-9);
  EXPECT_NEAR(with->traceSeconds.value, without->traceSeconds.value + 3, 1e-9);
  EXPECT_NEAR(with->lightSeconds.value, without->lightSeconds.value + 1, 1e-9);
  EXPECT_EQ(with->bytes.value, without->bytes.value);
}

TEST(Estimates, StopAndRefuse) {
  KnownBake bake = KnownBake::random(30, 5);
  std::stop_source source;
  source.request_stop();
  const auto stopped = estimateBake(bake.pixels(), brief(), bake, {}, source.get_token());
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::cancelled);
  EXPECT_FALSE(estimateBake(bake.pixels(), {-1, true}, bake));
  EXPECT_FALSE(estimateBake(bake.pixels(), {NAN, true}, bake));
}

TEST(ShuffledOrder, HasEachOnceAndFallsInStepWithNoGroups) {
  EXPECT_TRUE(shuffledOrder(0).empty());
  for (const int count : {1, 2, 7, 100, 644}) {
    std::vector<int> order = shuffledOrder(count);
    EXPECT_EQ(order, shuffledOrder(count)) << "the same each time";
    if (count >= 100) {
      std::set<int> groups;
      for (int n = 0; n < 32; ++n) groups.insert(order[std::size_t(n)] % 8);
      EXPECT_GE(groups.size(), 7u) << "cameras of a region come in groups of eight";
    }
    std::ranges::sort(order);
    for (int k = 0; k < count; ++k) EXPECT_EQ(order[std::size_t(k)], k);
  }
}

TEST(Estimates, DenseSlicesSetThePaceWherePartsMislead) {
  KnownBake bake = KnownBake::random(300, 8);
  EstimateOptions options;
  options.effort = 0;
  options.surfaceLight = false;
  const auto plain = estimateBake(bake.pixels(), options, bake);
  ASSERT_TRUE(plain);
  KnownBake brisk = KnownBake::random(300, 8);
  brisk.slicePace = 0.7;
  const auto paced = estimateBake(brisk.pixels(), options, brisk);
  ASSERT_TRUE(paced);
  EXPECT_NEAR(paced->seconds.value, 0.7 * plain->seconds.value, 1e-9);
  EXPECT_NEAR(paced->traceSeconds.value, 0.7 * plain->traceSeconds.value, 1e-9);
  EXPECT_EQ(paced->bytes.value, plain->bytes.value) << "bytes are no matter of pace";
}

TEST(EstimatePicture, ARegionTakesTheBytesOfItsCaptures) {
  LayoutSpec spec;
  spec.configuration = Configuration::e;
  spec.cellSize = 1;
  spec.outline.loops = {{{0.1, 0.1}, {1.9, 0.1}, {1.9, 0.4}, {0.1, 0.4}}};
  const Layout layout = buildLayout(spec).value();
  std::vector<double> pixels(layout.cameras.size());
  for (std::size_t c = 0; c < pixels.size(); ++c) pixels[c] = 1000.0 + double(c);
  BakeEstimate estimate;
  estimate.cameras = int(pixels.size());
  estimate.pixels = std::accumulate(pixels.begin(), pixels.end(), 0.0);
  estimate.captureBytes.value = 3 * estimate.pixels;
  const std::vector<double> bytes = bytesPerRegion(layout, pixels, estimate);
  ASSERT_EQ(bytes.size(), layout.regions.size());
  for (std::size_t r = 0; r < bytes.size(); ++r) {
    double expected = 0;
    for (std::size_t c = 0; c < pixels.size(); ++c) {
      const bool serves = std::ranges::any_of(layout.regions[r].covers, [&](const Cover& cover) {
        return std::ranges::find(cover.pieces, int(c), &Piece::camera) != cover.pieces.end();
      });
      if (serves) expected += 3 * pixels[c];
    }
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(bytes[r], expected, 1e-6 * expected);
  }
  const PlanPicture picture = pictureOf(layout, pixels, estimate, "room");
  ASSERT_GE(picture.polygons.size(), bytes.size());
  EXPECT_DOUBLE_EQ(*picture.polygons[0].value, bytes[0] / 1e6);
}

}  // namespace
}  // namespace acentric
