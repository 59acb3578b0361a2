#include "engine/layout/images_per_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <set>

#include "engine/base/contract.h"
#include "engine/layout/drawing_order.h"

namespace acentric {
namespace {

constexpr int kTriesPerView = 10'000;

/// Standard distributions differ between libraries; this does not.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + double(engine_() >> 11) * 0x1p-53 * (high - low); }

 private:
  std::mt19937_64 engine_;
};

/// A cell with its neighbours all around.
Result<Layout> patchAround(Configuration configuration) {
  constexpr double kReach = 4.2;
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = 1;
  spec.outline.loops = {{{-kReach, -kReach}, {kReach, -kReach}, {kReach, kReach}, {-kReach, kReach}}};
  return buildLayout(spec);
}

/// The regions of the lattice's first cell: each kind as often as it occurs.
std::vector<int> oneCell(const Layout& layout) {
  std::vector<int> regions;
  for (std::size_t r = 0; r < layout.regions.size(); ++r)
    if (layout.regions[r].id.i == 0 && layout.regions[r].id.j == 0) regions.push_back(int(r));
  return regions;
}

int imagesOf(const Layout& layout, int region, const ViewSector& sector) {
  std::set<int> cameras;
  const Cover& cover = chooseCover(layout.regions[std::size_t(region)], sector);
  for (const OrderedPiece& piece : visiblePieces(layout, region, cover, sector)) cameras.insert(piece.camera);
  return int(cameras.size());
}

}  // namespace

double ImageCounts::mean() const {
  double sum = 0;
  for (std::size_t n = 0; n < shares.size(); ++n) sum += double(n) * shares[n];
  return sum;
}

Status ImageCountOptions::check() const {
  if (!(fovDegrees >= 1 && fovDegrees <= 179))
    return fail(ErrorKind::invalidArgument,
                fmt::format("a field of view of {} degrees: must be 1 to 179", fovDegrees),
                "images per view");
  if (views < 1 || views > 10'000'000)
    return fail(ErrorKind::invalidArgument, fmt::format("{} views: must be 1 to 10000000", views),
                "images per view");
  return {};
}

Result<ImageCounts> countImages(Configuration configuration, const ImageCountOptions& options) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  const auto layout = patchAround(configuration);
  if (!layout) return tl::unexpected(layout.error());
  const std::vector<int> cell = oneCell(*layout);
  glm::dvec2 low(4), high(-4);
  for (const int region : cell)
    for (const glm::dvec2& corner : layout->regions[std::size_t(region)].polygon.corners)
      low = glm::min(low, corner), high = glm::max(high, corner);
  Uniform random(options.seed);
  std::vector<int> views;
  for (int counted = 0; counted < options.views; ++counted) {
    int region = -1;
    glm::dvec2 eye(0);
    for (int tries = 0; region < 0; ++tries) {
      require(tries < kTriesPerView, "a cell fills its box well enough to be found");
      eye = {random.in(low.x, high.x), random.in(low.y, high.y)};
      const auto at = layout->regionAt(eye);
      if (at && std::ranges::find(cell, *at) != cell.end()) region = *at;
    }
    const double width = radians(options.fovDegrees), yaw = random.in(0, kTwoPi);
    const int images = imagesOf(*layout, region, {eye, {wrapAngle(yaw - width / 2), width}});
    if (std::size_t(images) >= views.size()) views.resize(std::size_t(images) + 1, 0);
    ++views[std::size_t(images)];
  }
  ImageCounts counts;
  for (const int count : views) counts.shares.push_back(double(count) / options.views);
  return counts;
}

const ImagesPerView& imagesPerView(Configuration configuration) {
  static constexpr ImagesPerView kTable[] = {
      {{0.0, 0.0, 5.1, 48.9, 37.7, 7.7, 0.2, 0.2}, {0.0, 0.0, 0.0, 14.5, 48.9, 32.2, 1.6, 2.8}},  // a
      {{0.0, 0.0, 40.0, 58.3, 1.7}, {0.0, 0.0, 8.3, 67.7, 23.5, 0.5}},                            // b
      {{0.0, 0.0, 36.7, 61.0, 2.3}, {0.0, 0.0, 6.7, 64.9, 28.3, 0.1}},                            // c
      {{0.0, 0.0, 4.5, 33.3, 38.3, 22.5, 0.7, 0.7}, {0.0, 0.0, 0.0, 9.2, 31.7, 46.8, 4.4, 7.9}},  // d
      {{0.0, 0.0, 9.0, 43.2, 41.0, 6.7}, {0.0, 0.0, 0.0, 18.5, 47.4, 31.6, 2.6}},                 // e
      {{0.0, 0.0, 8.5, 13.5, 15.9, 24.5, 21.5, 11.1, 5.0},
       {0.0, 0.0, 2.7, 12.5, 9.2, 7.6, 24.6, 13.1, 21.3, 2.0, 6.8, 0.2}},  // f
      {{0.0, 0.0, 42.0, 51.9, 6.1}, {0.0, 0.0, 11.9, 62.8, 23.1, 2.3}},    // g
  };
  const auto index = static_cast<std::size_t>(configuration);
  require(index < std::size(kTable), "each configuration has its row");
  return kTable[index];
}

std::string sharesText(const std::array<double, ImagesPerView::kMost>& percent) {
  std::string text;
  for (std::size_t n = 0; n < percent.size(); ++n)
    if (percent[n] > 0) text += fmt::format("{}{} in {:.1f} %", text.empty() ? "" : ", ", n, percent[n]);
  return text;
}

}  // namespace acentric
