#include "engine/image/patches.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "engine/geometry/conventions.h"
#include "engine/image/patch_extent.h"
#include "engine/image/patch_order.h"

namespace acentric {
namespace {

/// Wide tiles are drawn in fewer pieces; narrow ones are ordered more often rightly by list order alone.
/// Angles are limited too: renderers take them for their tangents' polynomials.
constexpr int kStripColumns = 32, kTileRows = 64;
constexpr double kWidestStrip = radians(4.0), kHighestTile = radians(8.0);

/// Pairs of patches that are looked at for the order of one strip: leaves make far more. Those left out are
/// ordered by what the camera itself sees of them, and by how near they are.
constexpr std::size_t kMostPairs = 16'000'000;
/// Samples of a pixel behind one that it is compared with.
constexpr std::uint32_t kMostBehind = 64;

int atMost(int samples, double angle, double pitch) {
  return int(std::clamp(angle / pitch, 1.0, double(samples)));
}

class Strip {
 public:
  Strip(const ColumnCamera& camera, const CaptureSamples& samples, double tolerance, int tileRows, int first,
        int end, Patches& out)
      : camera_(camera),
        samples_(samples),
        tolerance_(tolerance),
        tileRows_(tileRows),
        first_(first),
        end_(end),
        pixels_(samples, camera.rows, first, end),
        firstSample_(samples.columnStart[std::size_t(first)]),
        owner_(samples.columnStart[std::size_t(end)] - firstSample_, kNone),
        out_(out) {
    for (int column = first; column < end; ++column) direction_.push_back(camera.directionAt(column + 0.5));
    for (int row = 0; row < camera.rows; ++row) tangent_.push_back(camera.tangentAt(row + 0.5));
  }

  void run() {
    for (int row = 0; row < camera_.rows; row += tileRows_) {
      const int end = std::min(row + tileRows_, camera_.rows);
      groupTile(row, end, true);   // patches begin where a surface is sure,
      groupTile(row, end, false);  // so that what lies at its edges joins it
    }
    findExtents();
    countVotes();
    findOrders();
    std::vector<float> nearest;
    for (const PatchExtent& extent : extents_) nearest.push_back(extent.nearest);
    const PatchOrder order = orderPatches(pairs_, nearest, !looksAtEach());
    out_.unordered += order.broken;
    for (const std::uint32_t i : order.patches) {
      Patch patch = patches_[i];
      const std::vector<Member>& members = members_[i];
      patch.firstSample = std::uint32_t(out_.samples.size());
      for (const Member& member : members) out_.samples.push_back(member.sample);
      out_.patches.push_back(patch);
    }
    out_.stripStart.push_back(std::uint32_t(out_.patches.size()));
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  struct Member {
    std::uint32_t sample = 0;
    int column = 0, row = 0;
  };

  double inverseAt(const SurfacePlane& plane, int column, int row) const {
    return plane.inverseDistance(direction_[std::size_t(column - first_)], tangent_[std::size_t(row)]);
  }
  const SurfacePlane& planeOf(std::uint32_t sample) const { return samples_.planes[samples_.plane[sample]]; }
  bool isBlended(std::uint32_t sample) const { return samples_.colour[sample].a != kOpaque; }
  std::uint8_t mirrorOf(std::uint32_t sample) const {
    return samples_.mirror.empty() ? std::uint8_t(0) : samples_.mirror[sample];
  }
  std::uint32_t& owner(std::uint32_t sample) { return owner_[sample - firstSample_]; }

  void groupTile(int firstRow, int endRow, bool whole) {
    for (int column = first_; column < end_; ++column)
      for (int row = firstRow; row < endRow; ++row)
        for (const std::uint32_t sample : pixels_.at(column, row))
          if (owner(sample) == kNone && (!whole || samples_.coverage[sample] == kWholePixel))
            grow({sample, column, row}, firstRow, endRow);
  }

  /// The patch of all samples around this one that lie in its plane.
  void grow(const Member& seed, int firstRow, int endRow) {
    const std::uint32_t number = std::uint32_t(patches_.size());
    Patch patch;
    patch.plane = planeOf(seed.sample);
    patch.mirror = mirrorOf(seed.sample);
    patch.blended = isBlended(seed.sample);
    std::vector<Member> members{seed};
    owner(seed.sample) = number;
    for (std::size_t next = 0; next < members.size(); ++next) {
      const Member at = members[next];
      patch.roles |= samples_.roles[at.sample];
      for (int column = std::max(at.column - 1, first_); column <= std::min(at.column + 1, end_ - 1);
           ++column)
        for (int row = std::max(at.row - 1, firstRow); row <= std::min(at.row + 1, endRow - 1); ++row)
          if (const std::uint32_t sample = findMember(patch, number, at.sample, column, row);
              sample != kNone) {
            owner(sample) = number;
            members.push_back({sample, column, row});
          }
    }
    int endColumn = 0, lastRow = 0;
    patch.column = std::uint16_t(camera_.columns), patch.row = std::uint16_t(camera_.rows);
    for (const Member& member : members) {
      patch.column = std::min(patch.column, std::uint16_t(member.column));
      patch.row = std::min(patch.row, std::uint16_t(member.row));
      endColumn = std::max(endColumn, member.column + 1), lastRow = std::max(lastRow, member.row + 1);
    }
    patch.columns = std::uint16_t(endColumn - patch.column), patch.rows = std::uint16_t(lastRow - patch.row);
    patches_.push_back(patch);
    members_.push_back(std::move(members));
  }

  /// The pixel's sample that belongs to the patch beside one of its own, if it has none of the pixel yet: for
  /// a role of both, since a surface may look different to each region.
  std::uint32_t findMember(const Patch& patch, std::uint32_t number, std::uint32_t beside, int column,
                           int row) {
    std::uint32_t found = kNone;
    double least = tolerance_;
    const double inverse = inverseAt(patch.plane, column, row);
    for (const std::uint32_t sample : pixels_.at(column, row)) {
      if (owner(sample) == number) return kNone;
      if (owner(sample) != kNone || planeOf(sample).away != patch.plane.away ||
          isBlended(sample) != patch.blended || mirrorOf(sample) != patch.mirror ||
          (samples_.roles[sample] & samples_.roles[beside]) == 0)
        continue;
      const double apart = std::abs(inverseAt(planeOf(sample), column, row) - inverse);
      if (apart <= least) least = apart, found = sample;
    }
    return found;
  }

  void findExtents() {
    const PatchExtents extents(camera_, tolerance_, first_, end_);
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      PatchOutline outline;
      float nearest = 0, farthest = HUGE_VALF;
      for (const Member& member : members_[i]) {
        outline.add(member.column, member.row, samples_.coverage[member.sample]);
        const float inverse = float(inverseAt(patches_[i].plane, member.column, member.row));
        nearest = std::max(nearest, inverse), farthest = std::min(farthest, std::max(inverse, 0.0f));
      }
      extents_.push_back(extents.of(patches_[i].plane, outline, nearest, farthest));
    }
  }

  /// In how many parts of pixels the one of two patches lies before the other, as the camera sees them.
  struct Votes {
    std::uint32_t first = 0, second = 0;  ///< patches, first < second
    int before = 0, behind = 0;           ///< where the first lies before the second, or behind it
  };
  void countVotes() {
    std::vector<Votes> all;
    std::vector<std::size_t> last, now;  // of the pixel before: mostly the same patches lie in this one
    for (int column = first_; column < end_; ++column)
      for (int row = 0; row < camera_.rows; ++row) {
        now.clear();
        const auto pixel = pixels_.at(column, row);
        for (const std::uint32_t a : pixel)
          for (std::uint32_t b = a + 1; b < std::min(*pixel.end(), a + kMostBehind); ++b) {
            const int shared = std::popcount(std::uint16_t(samples_.coverage[a] & samples_.coverage[b]));
            if (planeOf(a).away != 0 || planeOf(b).away != 0) continue;
            const bool aFirst = inverseAt(planeOf(a), column, row) >= inverseAt(planeOf(b), column, row);
            const std::uint32_t before = owner(aFirst ? a : b), behind = owner(aFirst ? b : a);
            const auto [first, second] = std::minmax(before, behind);
            std::size_t at = now.size() < last.size() ? last[now.size()] : all.size();
            if (at == all.size() || all[at].first != first || all[at].second != second) {
              at = all.size();
              all.push_back({first, second, 0, 0});
            }
            (before < behind ? all[at].before : all[at].behind) += std::max(shared, 1);
            now.push_back(at);
          }
        std::swap(last, now);
      }
    std::ranges::sort(all, {}, [](const Votes& v) { return std::pair(v.first, v.second); });
    for (const Votes& one : all) {
      if (votes_.empty() || votes_.back().first != one.first || votes_.back().second != one.second)
        votes_.push_back({one.first, one.second, 0, 0});
      votes_.back().before += one.before, votes_.back().behind += one.behind;
    }
  }

  /// Can no served eye see one before the other? An eye shifts things against each other by no more than
  /// their inverse distances differ, in quarters of samples per tolerance.
  bool areApart(std::uint32_t a, std::uint32_t b) const {
    const Patch &pa = patches_[a], &pb = patches_[b];
    const auto gap = [](int firstA, int sizeA, int firstB, int sizeB) {
      return std::max(firstA - (firstB + sizeB), firstB - (firstA + sizeA));
    };
    const PatchExtent &ea = extents_[a], &eb = extents_[b];
    const double differ = std::max(ea.nearest - eb.farthest, eb.nearest - ea.farthest);
    const double shift = 0.25 * differ / tolerance_ + 2;
    return gap(pa.column, pa.columns, pb.column, pb.columns) > shift ||
           gap(pa.row, pa.rows, pb.row, pb.rows) > shift;
  }

  /// `ij`, `ji`: votes for i before j, and for j before i.
  void addOrder(std::uint32_t i, std::uint32_t j, int ij, int ji) {
    if (areApart(i, j)) return;
    const auto [iHides, jHides] = hidingOf(extents_[i], extents_[j]);
    if (!iHides && !jHides && ij == ji) return;
    bool iFirst = iHides;
    int weight = int(std::min(members_[i].size(), members_[j].size()));
    if (iHides == jHides) {
      iFirst = ij != ji ? ij > ji : extents_[i].nearest > extents_[j].nearest;
      weight = 1;
      out_.unordered += iHides;
    }
    pairs_.push_back({iFirst ? i : j, iFirst ? j : i, weight + (iFirst ? ij : ji)});
  }

  /// Of pairs of patches: which goes first.
  void findOrders() {
    const std::uint32_t count = std::uint32_t(patches_.size());
    const std::vector<char> isLarge = findLarge();
    std::vector<std::uint32_t> large;
    for (std::uint32_t i = 0; i < count; ++i)
      if (isLarge[i] != 0) large.push_back(i);
    auto vote = votes_.begin();
    const auto voted = [&](std::uint32_t i) { return vote != votes_.end() && vote->first == i; };
    const auto addVoted = [&] {
      addOrder(vote->first, vote->second, vote->before, vote->behind);
      ++vote;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto visit = [&](std::uint32_t j) {
        while (voted(i) && vote->second < j) addVoted();
        if (voted(i) && vote->second == j)
          addVoted();
        else
          addOrder(i, j, 0, 0);
      };
      if (isLarge[i] != 0)
        for (std::uint32_t j = i + 1; j < count; ++j) visit(j);
      else
        std::for_each(std::ranges::upper_bound(large, i), large.end(), visit);
      while (voted(i)) addVoted();
    }
  }

  bool looksAtEach() const { return patches_.size() * patches_.size() / 2 <= kMostPairs; }
  /// Those that are looked at beside every other: all, or so many of the largest that it takes no longer than
  /// kMostPairs.
  std::vector<char> findLarge() const {
    const std::size_t count = patches_.size();
    if (looksAtEach()) return std::vector<char>(count, 1);
    std::vector<std::uint32_t> bySize(count);
    std::iota(bySize.begin(), bySize.end(), 0u);
    std::ranges::stable_sort(bySize, std::greater<>(), [&](std::uint32_t i) { return members_[i].size(); });
    std::vector<char> isLarge(count, 0);
    for (std::size_t n = 0; n < kMostPairs / count; ++n) isLarge[bySize[n]] = 1;
    return isLarge;
  }

  static constexpr std::uint16_t kOpaque = 0x3c00;  ///< alpha 1
  const ColumnCamera& camera_;
  const CaptureSamples& samples_;
  double tolerance_;
  int tileRows_, first_, end_;
  PixelSamples pixels_;
  std::uint32_t firstSample_;
  std::vector<std::uint32_t> owner_;  ///< by sample of the strip: the number of its patch
  std::vector<glm::dvec2> direction_;
  std::vector<double> tangent_;
  std::vector<Patch> patches_;
  std::vector<std::vector<Member>> members_;
  std::vector<PatchExtent> extents_;
  std::vector<Votes> votes_;  ///< by patches
  std::vector<PatchPair> pairs_;
  Patches& out_;
};

}  // namespace

PixelSamples::PixelSamples(const CaptureSamples& samples, int rows, int firstColumn, int endColumn)
    : rows_(rows), firstColumn_(firstColumn), endColumn_(endColumn) {
  first_.reserve(std::size_t(endColumn - firstColumn) * std::size_t(rows) + 1);
  for (int column = firstColumn; column < endColumn; ++column) {
    std::uint32_t i = samples.columnStart[std::size_t(column)];
    const std::uint32_t end = samples.columnStart[std::size_t(column) + 1];
    for (int row = 0; row < rows; ++row) {
      first_.push_back(i);
      while (i < end && samples.row[i] == row) ++i;
    }
  }
  first_.push_back(samples.columnStart[std::size_t(endColumn)]);
}

Patches makePatches(const ColumnCamera& camera, const CaptureSamples& samples, double tolerance) {
  Patches patches;
  patches.stripColumns = atMost(kStripColumns, kWidestStrip, camera.columnPitch());
  const int tileRows = atMost(kTileRows, kHighestTile, camera.rowPitch());
  patches.samples.reserve(samples.sampleCount());
  patches.stripStart.push_back(0);
  for (int column = 0; column < camera.columns; column += patches.stripColumns)
    Strip(camera, samples, tolerance, tileRows, column,
          std::min(column + patches.stripColumns, camera.columns), patches)
        .run();
  return patches;
}

}  // namespace acentric
