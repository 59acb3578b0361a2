#include "engine/view/display_patches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/image/sharpen.h"

namespace acentric {
namespace {

/// Lays out the texels of one patch after the other.
class TexelWriter {
 public:
  TexelWriter(const ColumnCamera& camera, const CaptureSamples& samples, const PixelSamples& pixels,
              double tolerance, std::span<const Rgba8> colours, DisplayPatches& out)
      : camera_(camera),
        samples_(samples),
        pixels_(pixels),
        tolerance_(tolerance),
        colours_(colours),
        out_(out) {
    for (int column = 0; column < camera.columns; ++column)
      direction_.push_back(camera.directionAt(column + 0.5));
    for (int row = 0; row < camera.rows; ++row) tangent_.push_back(camera.tangentAt(row + 0.5));
    columnOf_.resize(samples.sampleCount());
    for (int column = 0; column < camera.columns; ++column)
      std::fill(columnOf_.begin() + samples.columnStart[std::size_t(column)],
                columnOf_.begin() + samples.columnStart[std::size_t(column) + 1], std::uint16_t(column));
  }

  void add(const Patch& patch, std::span<const std::uint32_t> members) {
    DisplayPatch display;
    display.normal = patch.plane.normal;
    display.firstTexel = std::uint32_t(out_.cover.size());
    display.column = patch.column, display.row = patch.row;
    display.columns = patch.columns, display.rows = patch.rows;
    display.roles = patch.roles, display.mirror = patch.mirror;
    display.blended = patch.blended, display.away = patch.plane.away != 0;
    width_ = patch.columns + 2, height_ = patch.rows + 2;
    const std::size_t texels = std::size_t(width_) * std::size_t(height_);
    out_.cover.resize(out_.cover.size() + texels);
    out_.colour.resize(out_.colour.size() + texels);
    cover_ = out_.cover.data() + display.firstTexel, colour_ = out_.colour.data() + display.firstTexel;
    std::fill(cover_, cover_ + texels, 0u);
    known_.assign(texels, 0);
    own_.assign(texels, kNoSample);
    std::array<int, 4> cut{255, 255, 255, 255};
    for (const std::uint32_t sample : members) {
      const int i = columnOf_[sample] - patch.column, j = samples_.row[sample] - patch.row;
      const std::size_t at = texel(i, j);
      cover_[at] = samples_.coverage[sample] | std::uint32_t(samples_.roles[sample]) << kTexelRoles;
      colour_[at] = colours_[sample];
      known_[at] = 1;
      own_[at] = sample;
      const int right = patch.columns - 1 - i, below = patch.rows - 1 - j;
      cut[0] = std::min(cut[0], i + j), cut[1] = std::min(cut[1], i + below);
      cut[2] = std::min(cut[2], right + j), cut[3] = std::min(cut[3], right + below);
    }
    for (std::size_t c = 0; c < 4; ++c)
      display.cut[c] = std::uint8_t(std::min({cut[c], patch.columns - 1, patch.rows - 1, 255}));
    goOn(patch);
    fill();
    if (!patch.blended) reachUnder(patch);
    markWholeBlocks(cover_, patch.columns, patch.rows);
    out_.patches.push_back(display);
  }

 private:
  std::size_t texel(int i, int j) const {
    return std::size_t(i + 1) * std::size_t(height_) + std::size_t(j + 1);
  }
  double inverseAt(const SurfacePlane& plane, int column, int row) const {
    return plane.inverseDistance(direction_[std::size_t(column)], tangent_[std::size_t(row)]);
  }

  /// Texels where the surface goes on in other patches: of the pixel's samples the one whose plane is
  /// nearest.
  void goOn(const Patch& patch) {
    constexpr double kBent = 8;  // curved surfaces go on too
    for (int i = -1; i <= patch.columns; ++i)
      for (int j = -1; j <= patch.rows; ++j) {
        const std::size_t at = texel(i, j);
        const int column = patch.column + i, row = patch.row + j;
        if (known_[at] != 0 || !pixels_.holds(column, row)) continue;
        const double expected = inverseAt(patch.plane, column, row);
        double least = kBent * tolerance_;
        for (const std::uint32_t sample : pixels_.at(column, row)) {
          const SurfacePlane& plane = samples_.planes[samples_.plane[sample]];
          const double apart = std::abs(inverseAt(plane, column, row) - expected);
          if (apart > least || plane.away != patch.plane.away ||
              (samples_.roles[sample] & patch.roles) == 0 || (colours_[sample].a < 255) != patch.blended ||
              (!samples_.mirror.empty() && samples_.mirror[sample] != patch.mirror))
            continue;
          least = apart;
          colour_[at] = colours_[sample];
          known_[at] = 1;
        }
      }
  }

  /// Where the surface goes on in another patch, or meets another surface as at a bend, this one reaches one
  /// part of a pixel under it: eyes that look from the side would see in between them, since both are known
  /// to a part only. Two parts where the surface goes on and is drawn on a plane that is off its own.
  void reachUnder(const Patch& patch) {
    parts_.assign(known_.size(), 0);
    for (std::size_t at = 0; at < parts_.size(); ++at) parts_[at] = std::uint16_t(cover_[at] & kTexelParts);
    near_ = parts_;
    for (int i = -1; i <= patch.columns; ++i)
      for (int j = -1; j <= patch.rows; ++j) near_[texel(i, j)] |= std::uint16_t(partsBeside(parts_, i, j));
    for (int i = -1; i <= patch.columns; ++i)
      for (int j = -1; j <= patch.rows; ++j) {
        const std::size_t at = texel(i, j);
        const int column = patch.column + i, row = patch.row + j;
        if (parts_[at] == kTexelParts || !pixels_.holds(column, row)) continue;
        const std::uint32_t first = near_[at] & ~std::uint32_t(parts_[at]);
        const std::uint32_t second = partsBeside(near_, i, j) & ~std::uint32_t(near_[at]);
        if ((first | second) == 0) continue;
        std::uint32_t reached = 0;
        for (const std::uint32_t sample : pixels_.at(column, row)) {
          if (sample == own_[at] || colours_[sample].a < 255) continue;
          if (((first | second) & samples_.coverage[sample]) == 0) continue;
          const Meeting meeting = meetingOf(patch, i, j, samples_.plane[sample]);
          reached |= ((first & meeting.any) | (second & meeting.off)) & samples_.coverage[sample];
        }
        if (reached == 0) continue;
        if (cover_[at] == 0) cover_[at] = std::uint32_t(patch.roles) << kTexelRoles;
        cover_[at] |= reached;
      }
  }
  /// How much nearer one plane is than another around the middle of a pixel, in inverse distance.
  struct Difference {
    double middle;    ///< there
    glm::dvec2 rise;  ///< per sample, across and down

    Difference(const TexelWriter& of, const SurfacePlane& a, const SurfacePlane& b, int column, int row) {
      const glm::dvec3 normal = glm::dvec3(a.normal) - glm::dvec3(b.normal);
      const glm::dvec2& direction = of.direction_[std::size_t(column)];
      const double tangent = of.tangent_[std::size_t(row)];
      middle = glm::dot(normal, glm::dvec3(direction, tangent));
      rise = of.camera_.risePerSample(normal, direction, tangent);
    }
    double perSample() const { return std::abs(rise.x) + std::abs(rise.y); }
    double at(int part) const {
      return middle + (0.25 * (part % 4) - 0.375) * rise.x + (0.25 * (part / 4) - 0.375) * rise.y;
    }
  };
  /// In which parts of a pixel (texel i, j of the patch) the patch's own samples there and beside it meet
  /// another surface; and in which of these that goes on where the patch's plane does not.
  struct Meeting {
    std::uint32_t any = 0, off = 0;
  };
  Meeting meetingOf(const Patch& patch, int i, int j, std::uint32_t plane) const {
    constexpr std::array<glm::ivec2, 5> kAround{{{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    constexpr double kSame = 0.5, kOff = 0.5;  // tolerances
    constexpr double kMeetWithin = 0.06;       // samples
    const int column = patch.column + i, row = patch.row + j;
    const Difference drawn(*this, patch.plane, samples_.planes[plane], column, row);
    Meeting meeting;
    std::uint32_t last = kNoSample;
    for (const glm::ivec2& step : kAround) {
      const int x = i + step.x, y = j + step.y;
      if (x < -1 || y < -1 || x + 1 >= width_ || y + 1 >= height_) continue;
      const std::uint32_t own = own_[texel(x, y)];
      if (own == kNoSample || samples_.plane[own] == last) continue;
      last = samples_.plane[own];
      const Difference d(*this, samples_.planes[last], samples_.planes[plane], column, row);
      const double most = kSame * tolerance_ + kMeetWithin * d.perSample();
      const bool goesOn = 0.5 * d.perSample() <= tolerance_;
      for (int part = 0; part < 16; ++part) {
        if (std::abs(d.at(part)) > most) continue;
        meeting.any |= 1u << part;
        if (goesOn && std::abs(drawn.at(part)) > kOff * tolerance_) meeting.off |= 1u << part;
      }
    }
    return meeting;
  }
  /// Parts of a texel that lie beside one that the patch covers, in it or next to it.
  std::uint32_t partsBeside(const std::vector<std::uint16_t>& parts, int i, int j) const {
    const auto at = [&](int x, int y) -> std::uint32_t {
      return x < 0 || y < 0 || x >= width_ || y >= height_
                 ? 0u
                 : parts[std::size_t(x) * std::size_t(height_) + std::size_t(y)];
    };
    constexpr std::uint32_t kFirstColumn = 0x1111, kLastColumn = 0x8888;
    const int x = i + 1, y = j + 1;
    const std::uint32_t own = at(x, y);
    std::uint32_t beside = (own << 4 | own >> 4) & kTexelParts;
    beside |= (own & ~kLastColumn) << 1 | (own & ~kFirstColumn) >> 1;
    beside |= (at(x - 1, y) & kLastColumn) >> 3 | (at(x + 1, y) & kFirstColumn) << 3;
    beside |= at(x, y - 1) >> 12 | (at(x, y + 1) << 12 & kTexelParts);
    return beside;
  }

  /// The others: of their known neighbours the mean, ring by ring.
  void fill() {
    std::vector<std::size_t> open, next, closed;
    for (std::size_t at = 0; at < known_.size(); ++at)
      if (known_[at] == 0) open.push_back(at);
    while (!open.empty()) {
      next.clear(), closed.clear();
      for (const std::size_t at : open) {
        const int i = int(at) / height_, j = int(at) % height_;
        glm::vec4 sum(0);
        int count = 0;
        for (int x = std::max(i - 1, 0); x <= std::min(i + 1, width_ - 1); ++x)
          for (int y = std::max(j - 1, 0); y <= std::min(j + 1, height_ - 1); ++y)
            if (const std::size_t n = std::size_t(x) * std::size_t(height_) + std::size_t(y); known_[n] != 0)
              sum += glm::vec4(colour_[n]), ++count;
        if (count == 0) {
          next.push_back(at);
          continue;
        }
        colour_[at] = Rgba8(sum / float(count) + 0.5f);
        closed.push_back(at);
      }
      for (const std::size_t at : closed) known_[at] = 1;
      open.swap(next);
    }
  }

  const ColumnCamera& camera_;
  const CaptureSamples& samples_;
  const PixelSamples& pixels_;
  double tolerance_;
  std::span<const Rgba8> colours_;
  DisplayPatches& out_;
  std::vector<glm::dvec2> direction_;
  std::vector<double> tangent_;
  std::vector<std::uint16_t> columnOf_;
  int width_ = 0, height_ = 0;      ///< of the patch, with its border
  std::uint32_t* cover_ = nullptr;  ///< of the patch
  Rgba8* colour_ = nullptr;         ///< of the patch
  static constexpr std::uint32_t kNoSample = 0xffffffff;
  std::vector<std::uint8_t> known_;   ///< of the patch's texels: do they have a colour?
  std::vector<std::uint32_t> own_;    ///< their samples
  std::vector<std::uint16_t> parts_;  ///< that those cover
  std::vector<std::uint16_t> near_;   ///< those and the parts beside them
};

}  // namespace

std::size_t DisplayPatches::bytes() const {
  return stripStart.size() * sizeof(std::uint32_t) + patches.size() * sizeof(DisplayPatch) +
         colour.size() * sizeof(Rgba8) + cover.size() * sizeof(std::uint32_t) +
         columnBorder.size() * sizeof(glm::vec2) + rowBorder.size() * sizeof(float);
}

void markWholeBlocks(std::uint32_t* cover, int columns, int rows) {
  constexpr std::uint32_t kMarks = kBlockWhole | kBlockInner;
  const int height = rows + 2;
  const auto at = [&](int column, int row) -> std::uint32_t& { return cover[column * height + row]; };
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j) {
      const std::uint32_t word = at(i, j) & ~kMarks;
      const auto isWhole = [&](int from, int to) {
        if (i + from < 0 || j + from < 0 || i + to > columns + 1 || j + to > rows + 1) return false;
        for (int x = i + from; x <= i + to; ++x)
          for (int y = j + from; y <= j + to; ++y)
            if ((at(x, y) & ~kMarks) != word) return false;
        return true;
      };
      if ((word & kTexelParts) != kTexelParts || !isWhole(0, 1)) continue;
      at(i, j) |= isWhole(-1, 2) ? kMarks : kBlockWhole;
    }
}

DisplayPatches displayPatches(const ColumnCamera& camera, const CaptureSamples& samples, double tolerance,
                              std::span<const Rgba8> colours) {
  const Patches patches = makePatches(camera, samples, tolerance);
  DisplayPatches display;
  display.stripColumns = patches.stripColumns;
  display.stripStart = patches.stripStart;
  display.patches.reserve(patches.patches.size());
  for (int x = 0; x <= camera.columns; ++x) display.columnBorder.push_back(glm::vec2(camera.directionAt(x)));
  for (int y = 0; y <= camera.rows; ++y) display.rowBorder.push_back(float(camera.tangentAt(y)));
  const PixelSamples pixels(samples, camera.rows, 0, camera.columns);
  const std::vector<Rgba8> sharpened = sharpenedColours(camera, samples, pixels, tolerance, colours);
  TexelWriter writer(camera, samples, pixels, tolerance, sharpened, display);
  for (std::size_t i = 0; i < patches.patches.size(); ++i) {
    const std::uint32_t first = patches.patches[i].firstSample;
    writer.add(patches.patches[i], std::span(patches.samples).subspan(first, patches.endOf(i) - first));
  }
  return display;
}

}  // namespace acentric
