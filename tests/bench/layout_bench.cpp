/// Prints what a very large layout costs, and what exact signs cost against naive ones.

#include <fmt/format.h>

#include <chrono>
#include <random>

#include "engine/geometry/conventions.h"
#include "engine/geometry/predicates/orientation.h"
#include "engine/layout/drawing_order.h"

namespace acentric {
namespace {

double seconds(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

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

void printLayouts() {
  fmt::print("configuration  regions   cameras   build   region of an eye\n");
  for (int c = 0; c <= int(Configuration::g); ++c) {
    const LayoutSpec spec = largeSpec(Configuration(c));
    Result<Layout> layout = tl::unexpected(Error{});
    const double build = seconds([&] { layout = buildLayout(spec); });
    if (!layout) {
      fmt::print("{}: {}\n", nameOf(Configuration(c)), layout.error().describe());
      continue;
    }
    std::mt19937 random(1);
    std::uniform_real_distribution<double> within(0, spec.outline.loops[0][2].x);
    std::vector<glm::dvec2> eyes(200000);
    for (glm::dvec2& eye : eyes) eye = {within(random), within(random)};
    long sum = 0;
    const double find = seconds([&] {
      for (const glm::dvec2& eye : eyes) sum += layout->regionAt(eye).value_or(-1);
    });
    fmt::print("{:<13}  {:7}  {:8}  {:4.2f} s  {:6.0f} ns  (sum {})\n", nameOf(Configuration(c)),
               layout->regions.size(), layout->cameras.size(), build, 1e9 * find / double(eyes.size()), sum);
  }
}

void printSigns() {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<glm::dvec2> points(3000000);
  for (glm::dvec2& p : points) p = {unit(random), unit(random)};
  long exact = 0, naive = 0;
  const double exactTime = seconds([&] {
    for (std::size_t k = 0; k + 2 < points.size(); k += 3)
      exact += orientation(points[k], points[k + 1], points[k + 2]);
  });
  const double naiveTime = seconds([&] {
    for (std::size_t k = 0; k + 2 < points.size(); k += 3)
      naive += cross(points[k + 1] - points[k], points[k + 2] - points[k]) > 0 ? 1 : -1;
  });
  fmt::print("sign of a side: exact {:.1f} ns, naive {:.1f} ns (sums {} and {})\n", 1e3 * exactTime,
             1e3 * naiveTime, exact, naive);

  LayoutSpec spec;
  spec.outline.loops = {{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}};
  const Layout layout = buildLayout(spec).value();
  constexpr int kViews = 100000;
  std::size_t pieces = 0;
  const double order = seconds([&] {
    for (int n = 0; n < kViews; ++n) {
      const glm::dvec2 eye{3 * unit(random), 3 * unit(random)};
      const int region = layout.regionAt(eye).value();
      const ViewSector sector{eye, {4 * unit(random), radians(60)}};
      pieces +=
          visiblePieces(layout, region, chooseCover(layout.regions[std::size_t(region)], sector), sector)
              .size();
    }
  });
  fmt::print("pieces of a view in order: {:.2f} us a view, {:.2f} pieces on average\n", 1e6 * order / kViews,
             double(pieces) / kViews);
}

}  // namespace
}  // namespace acentric

int main() {
  acentric::printLayouts();
  acentric::printSigns();
}
