/// What a very large layout costs, and what exact signs cost against naive ones.

#include <random>

#include "engine/geometry/conventions.h"
#include "engine/geometry/predicates/orientation.h"
#include "engine/layout/drawing_order.h"
#include "tests/bench_functions/benches.h"

namespace acentric::bench {
namespace {

/// A square outline that holds about 100,000 regions.
LayoutSpec largeSpec(Configuration configuration) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = 2;
  const auto square = [](double side) { return Outline{{{{0, 0}, {side, 0}, {side, side}, {0, side}}}}; };
  spec.outline = square(40);
  const double perRegion = 1600.0 / double(buildLayout(spec)->regions.size());
  spec.outline = square(std::sqrt(perRegion * 120000));
  return spec;
}

/// Regions and cameras of each configuration, and the region of an eye.
Status timeLayouts(Figures& figures) {
  for (int c = 0; c <= int(Configuration::g); ++c) {
    const LayoutSpec spec = largeSpec(Configuration(c));
    Result<Layout> layout = tl::unexpected(Error{});
    std::vector<double> build;
    for (int i = 0; i < 3; ++i) {
      layout = tl::unexpected(Error{});  // freeing the one before is not timed
      build.push_back(secondsOf(1, [&] { layout = buildLayout(spec); }).front());
    }
    if (!layout) return tl::unexpected(layout.error());
    const std::string name = std::string("configuration ") + nameOf(Configuration(c));
    figures.fact(name, {{"regions", layout->regions.size()}, {"cameras", layout->cameras.size()}});
    figures.add(name + ": lay out", "s", build);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> within(0, spec.outline.loops[0][2].x);
    std::vector<glm::dvec2> eyes(200000);
    for (glm::dvec2& eye : eyes) eye = {within(random), within(random)};
    const auto find = secondsOf(3, [&] {
      long sum = 0;
      for (const glm::dvec2& eye : eyes) sum += layout->regionAt(eye).value_or(-1);
      used(double(sum));
    });
    figures.add(name + ": region of an eye", "ns", scaled(find, 1e9 / double(eyes.size())));
  }
  return {};
}

void timeSigns(Figures& figures) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<glm::dvec2> points(3000000);
  for (glm::dvec2& p : points) p = {unit(random), unit(random)};
  const auto sum = [&](const auto& sign) {
    long all = 0;
    for (std::size_t k = 0; k + 2 < points.size(); k += 3)
      all += sign(points[k], points[k + 1], points[k + 2]);
    used(double(all));
  };
  const Turns turns = secondsByTurns(
      5, [&] { sum([](auto a, auto b, auto c) { return orientation(a, b, c); }); },
      [&] { sum([](auto a, auto b, auto c) { return cross(b - a, c - a) > 0 ? 1 : -1; }); });
  figures.add("exact sign of a side", "ns", scaled(turns.one, 1e3), "naive", scaled(turns.other, 1e3));
}

void timePieces(Figures& figures) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  LayoutSpec spec;
  spec.outline.loops = {{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}};
  const Layout layout = buildLayout(spec).value();
  constexpr int kViews = 100000;
  const auto order = secondsOf(3, [&] {
    std::size_t pieces = 0;
    for (int n = 0; n < kViews; ++n) {
      const glm::dvec2 eye{3 * unit(random), 3 * unit(random)};
      const int region = layout.regionAt(eye).value();
      const ViewSector sector{eye, {4 * unit(random), radians(60)}};
      pieces +=
          visiblePieces(layout, region, chooseCover(layout.regions[std::size_t(region)], sector), sector)
              .size();
    }
    used(double(pieces));
  });
  figures.add("pieces of a view in order", "us", scaled(order, 1e6 / kViews));
}

}  // namespace

Status benchLayout(const Subject&, Figures& figures) {
  timeSigns(figures);
  timePieces(figures);
  return timeLayouts(figures);
}

}  // namespace acentric::bench
