#include "engine/bake/silhouettes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "engine/bake/flush_denormals.h"
#include "engine/bake/part_rays.h"

namespace acentric {
namespace {

constexpr int kColumnsPerTask = 16;
constexpr int kParts = kPixelPartCount;
constexpr std::uint16_t kCorners = partBit(0, 0) | partBit(3, 0) | partBit(0, 3) | partBit(3, 3);
constexpr std::uint16_t kMiddle = partBit(1, 1);
/// One in each row and column.
constexpr std::uint16_t kSpread = partBit(1, 0) | partBit(3, 1) | partBit(0, 2) | partBit(2, 3);

/// Of some neighbouring columns.
struct NewSamples {
  std::vector<std::uint32_t> perColumn;
  CaptureSamples list;
  CaptureCounts counts;
};

class ColumnSilhouettes {
 public:
  /// Of surfaces, or of what mirrors show.
  ColumnSilhouettes(const ColumnMarch::Setting& setting, const PartAngles& parts, const CaptureSamples& all,
                    bool reflections, double tolerance, NewSamples& out)
      : setting_(setting),
        parts_(parts),
        rays_(setting, all, reflections, tolerance, out.counts),
        all_(all),
        reflections_(reflections),
        out_(out),
        rows_(setting.columns.rows),
        tolerance_(tolerance) {
    for (int row = 0; row < rows_; ++row) tangent_.push_back(setting.columns.tangentAt(row + 0.5));
    if (setting.sight != nullptr) hints_ = setting.sight->hints();
  }

  void run(int column) {
    for (int step = -1; step <= 1; ++step) {
      Beside& beside = beside_[std::size_t(step + 1)];
      beside.inImage = column + step >= 0 && column + step < setting_.columns.columns;
      if (beside.inImage) listRows(column + step, beside);
    }
    column_ = column;
    rivalsOf_ = {0, -1};
    const std::size_t before = out_.list.row.size();
    for (int row = 0; row < rows_; ++row) addPixel(row);
    out_.perColumn.push_back(std::uint32_t(out_.list.row.size() - before));
  }

 private:
  /// Of this column, or one next to it.
  struct Beside {
    bool inImage = false;
    glm::dvec2 direction{0};
    std::vector<std::uint32_t> first;  ///< sample of each row, and one after the last
  };
  struct Pixel {
    const Beside* beside = nullptr;
    int row = 0;
    std::uint32_t first() const { return beside->first[std::size_t(row)]; }
    std::uint32_t end() const { return beside->first[std::size_t(row) + 1]; }
    bool holds(std::uint32_t sample) const { return sample >= first() && sample < end(); }
  };
  /// A sample of the pixel as it will be.
  struct New {
    std::uint32_t of = 0;  ///< the sample that it is, or the neighbour's that it goes on
    std::uint16_t coverage = kWholePixel;
    float inverseDistance = 0;
    HalfColour colour{0};
    std::uint8_t roles = 0, mirror = 0;
  };
  /// What rays through parts of the pixel meet of one surface.
  struct Met {
    std::uint16_t parts = 0;
    std::array<Hit, kParts> hits;
  };

  void listRows(int column, Beside& beside) const {
    beside.direction = setting_.columns.directionAt(column + 0.5);
    beside.first.assign(std::size_t(rows_) + 1, 0);
    std::uint32_t i = all_.columnStart[std::size_t(column)];
    const std::uint32_t end = all_.columnStart[std::size_t(column) + 1];
    for (int row = 0; row <= rows_; ++row) {
      while (i < end && all_.row[i] < row) ++i;
      beside.first[std::size_t(row)] = i;
    }
  }

  const SurfacePlane& planeOf(std::uint32_t sample) const { return all_.planes[all_.plane[sample]]; }
  bool isOpaque(std::uint32_t sample) const { return unpackColour(all_.colour[sample]).a >= 1; }
  /// Infinitely far: it lies behind all else and ends nowhere.
  bool isSky(std::uint32_t sample) const { return !(all_.inverseDistance[sample] > 0); }
  double at(const SurfacePlane& plane, const Pixel& pixel) const {
    return plane.inverseDistance(pixel.beside->direction, tangent_[std::size_t(pixel.row)]);
  }

  /// Do two samples lie in one plane, as far as either of them tells?
  bool isSame(std::uint32_t a, const Pixel& ofA, std::uint32_t b, const Pixel& ofB) const {
    const SurfacePlane &planeA = planeOf(a), &planeB = planeOf(b);
    if (planeA.away != planeB.away || isOpaque(a) != isOpaque(b)) return false;
    if (reflections_ && all_.mirror[a] != all_.mirror[b]) return false;
    if (planeA == planeB) return true;
    const double apart =
        std::min(std::abs(at(planeA, ofA) - at(planeB, ofA)), std::abs(at(planeA, ofB) - at(planeB, ofB)));
    return apart <= tolerance_;
  }
  bool hasSame(const Pixel& pixel, std::uint32_t sample, const Pixel& itsPixel) const {
    for (std::uint32_t i = pixel.first(); i < pixel.end(); ++i)
      if (isSame(i, pixel, sample, itsPixel)) return true;
    return false;
  }

  /// The planes of other surfaces around that run close behind the sample's without meeting it in this pixel,
  /// as a wall does behind mouldings: these must not spread over it, while it may go on beneath them.
  void findRivals(std::uint32_t sample, int row) {
    if (std::exchange(rivalsOf_, std::pair{sample, row}) == std::pair{sample, row}) return;
    rivals_.clear();
    const Pixel pixel{&beside_[1], row};
    const SurfacePlane& own = planeOf(sample);
    const auto add = [&](const Pixel& from) {
      for (std::uint32_t i = from.first(); i < from.end(); ++i) {
        if (i == sample || isSky(i) || (all_.roles[sample] & ~all_.roles[i]) != 0) continue;
        const SurfacePlane& plane = planeOf(i);
        const double apart = at(own, pixel) - at(plane, pixel);
        if (apart < tolerance_ || apart > 2 * rays_.loose() || meet(own, plane, pixel)) continue;
        if (pixel.holds(i) || !hasSame(pixel, i, from)) rivals_.push_back(plane);
      }
    };
    add(pixel);
    eachNeighbour(row, [&](const Pixel& neighbour, int, int) { add(neighbour); });
  }
  bool meet(const SurfacePlane& a, const SurfacePlane& b, const Pixel& pixel) const {
    const glm::dvec3 normal = glm::dvec3(a.normal) - glm::dvec3(b.normal);
    const double tangent = tangent_[std::size_t(pixel.row)];
    const glm::dvec2 rise = setting_.columns.risePerSample(normal, pixel.beside->direction, tangent);
    return std::abs(glm::dot(normal, glm::dvec3(pixel.beside->direction, tangent))) <=
           0.5 * (std::abs(rise.x) + std::abs(rise.y));
  }

  template <class Visit>
  void eachNeighbour(int row, const Visit& visit) const {
    for (int across = -1; across <= 1; ++across)
      for (int down = -1; down <= 1; ++down) {
        const Beside& beside = beside_[std::size_t(across + 1)];
        if ((across == 0 && down == 0) || !beside.inImage || row + down < 0 || row + down >= rows_) continue;
        visit(Pixel{&beside, row + down}, across, down);
      }
  }

  void addPixel(int row) {
    const Pixel pixel{&beside_[1], row};
    pixel_.clear();
    for (std::uint32_t i = pixel.first(); i < pixel.end(); ++i) {
      bool whole = true;
      if (!isSky(i))
        eachNeighbour(
            row, [&](const Pixel& neighbour, int, int) { whole = whole && hasSame(neighbour, i, pixel); });
      const std::uint16_t coverage = whole ? kWholePixel : ownCoverage(i, row);
      pixel_.push_back({i, coverage, all_.inverseDistance[i], meanColour(i, row, coverage), all_.roles[i],
                        all_.mirror.empty() ? std::uint8_t(0) : all_.mirror[i]});
    }
    const std::size_t own = pixel_.size();
    for (std::size_t k = 0; k < own; ++k) goOnBeside(k, row);
    eachNeighbour(row, [&](const Pixel& neighbour, int across, int down) {
      for (std::uint32_t i = neighbour.first(); i < neighbour.end(); ++i)
        if (!isSky(i) && !hasSame(pixel, i, neighbour))
          addNeighbours(i, neighbour, partsTowards(across, down), row, own);
    });
    if (pixel_.size() > own) std::ranges::stable_sort(pixel_, std::greater<>(), &New::inverseDistance);
    for (const New& sample : pixel_) add(row, sample);
    for (std::size_t layer = own; layer < pixel_.size() && !reflections_; ++layer)
      ++out_.counts.samples.kept[std::min(layer, SampleCounts::kLayers - 1)];
  }

  /// Those of some parts that no nearer one of the first samples covers.
  std::uint16_t openOf(std::uint16_t parts, float inverseDistance, std::size_t first) const {
    for (std::size_t k = 0; k < first; ++k)
      if (isOpaque(pixel_[k].of) && pixel_[k].inverseDistance > inverseDistance)
        parts &= std::uint16_t(~pixel_[k].coverage);
    return parts;
  }

  /// The pixel's own ray met the surface beneath another, where some regions do not see it, though they do in
  /// parts that the other leaves open: beside a neighbour's sample of it that they need. So they need this
  /// one too, and it looks as it does there.
  void goOnBeside(std::size_t k, int row) {
    New& sample = pixel_[k];
    if (isSky(sample.of)) return;
    const std::uint16_t open = openOf(sample.coverage, sample.inverseDistance, k);
    if (open == 0 || open == sample.coverage) return;
    const Pixel pixel{&beside_[1], row};
    const auto rolesOn = [&](const Pixel& at) {
      std::uint8_t roles = 0;
      for (std::uint32_t i = at.first(); i < at.end(); ++i)
        if (isSame(i, at, sample.of, pixel)) roles |= all_.roles[i];
      return roles;
    };
    std::uint8_t more = 0;
    eachNeighbour(row, [&](const Pixel& neighbour, int across, int down) {
      if ((open & partsTowards(across, down)) != 0) more |= rolesOn(neighbour);
    });
    more &= std::uint8_t(~rolesOn(pixel));
    if (more == 0) return;
    const int part = middlePart(open);
    findRivals(sample.of, row);
    const Hit hit = rays_.meet(sample.of, parts_.through(column_, row, part), rivals_);
    if (!hit.found()) return;
    const std::uint8_t before = sample.roles;
    for (std::size_t role = 0; role < setting_.camera.roles.size(); ++role)
      if ((more & bitOf(role)) != 0 && isSeenBy(role, sample.of, hit, row, part, true))
        sample.roles |= bitOf(role);
    New there = sample;
    if (sample.roles != before && shade(sample.of, hit, part, row, there)) sample.colour = there.colour;
  }

  void add(int row, const New& sample) {
    CaptureSamples& list = out_.list;
    list.row.push_back(std::uint16_t(row));
    list.inverseDistance.push_back(sample.inverseDistance);
    list.colour.push_back(sample.colour);
    list.roles.push_back(sample.roles);
    if (!all_.mirror.empty()) list.mirror.push_back(sample.mirror);
    list.coverage.push_back(sample.coverage);
    list.plane.push_back(all_.plane[sample.of]);
  }

  std::uint16_t ownCoverage(std::uint32_t sample, int row) {
    findRivals(sample, row);
    Met met;
    meet(sample, row, kCorners | kMiddle, met);
    if (met.parts == (kCorners | kMiddle)) return kWholePixel;
    meet(sample, row, kWholePixel & ~(kCorners | kMiddle), met);
    return met.parts == 0 ? kMiddle : met.parts;  // its ray went between those of the parts
  }

  /// A sample of a neighbour's surface, if that covers a part here. Where the neighbour has several, for
  /// regions that see it differently, each is gone on with.
  void addNeighbours(std::uint32_t sample, const Pixel& neighbour, std::uint16_t beside, int row,
                     std::size_t own) {
    const Pixel pixel{&beside_[1], row};
    for (std::size_t k = own; k < pixel_.size(); ++k)
      if (isSame(pixel_[k].of, pixel, sample, pixel) &&
          ((pixel_[k].roles & all_.roles[sample]) != 0 || !neighbour.holds(pixel_[k].of))) {
        pixel_[k].roles |= all_.roles[sample];
        return;
      }
    findRivals(sample, row);
    Met met;
    meet(sample, row, beside, met);
    if (met.parts == 0) return;
    const std::uint16_t few = kCorners | kMiddle | beside;
    meet(sample, row, std::uint16_t(few & ~beside), met);
    std::uint16_t coverage = kWholePixel;
    if (met.parts != few) {
      meet(sample, row, std::uint16_t(~few), met);
      coverage = met.parts;
    }
    const std::uint16_t open = openOf(met.parts, float(at(planeOf(sample), pixel)), own);
    const int part = middlePart(open != 0 ? open : met.parts);
    if (!isSeen(sample, met.hits[std::size_t(part)], row, part)) return;
    New added{sample, coverage};
    if (!shade(sample, met.hits[std::size_t(part)], part, row, added)) return;
    added.roles = all_.roles[sample];
    pixel_.push_back(added);
  }

  /// Adds those of `asked` parts where a ray meets the sample's surface.
  void meet(std::uint32_t sample, int row, std::uint16_t asked, Met& met) {
    for (int part = 0; part < kParts; ++part) {
      if ((asked >> part & 1) == 0) continue;
      const Hit hit = rays_.meet(sample, parts_.through(column_, row, part), rivals_);
      if (!hit.found()) continue;
      met.parts |= std::uint16_t(1u << part);
      met.hits[std::size_t(part)] = hit;
    }
  }

  /// By a role of the sample, at that part.
  bool isSeen(std::uint32_t sample, const Hit& hit, int row, int part) {
    for (std::size_t role = 0; role < setting_.camera.roles.size(); ++role)
      if ((all_.roles[sample] & bitOf(role)) != 0 && isSeenBy(role, sample, hit, row, part, false))
        return true;
    return false;
  }
  std::uint8_t bitOf(std::size_t role) const { return roleBit(setting_.camera, int(role)); }
  bool isSeenBy(std::size_t role, std::uint32_t sample, const Hit& hit, int row, int part, bool byRays) {
    if (setting_.sight == nullptr || reflections_) return true;
    const glm::vec3 direction(parts_.through(column_, row, part).unit());
    const glm::dvec3 point =
        setting_.columns.centreOfProjection + double(hit.distance) * glm::dvec3(direction);
    const MetSurface surface(hit, point, direction);
    const double tolerance = kSameDepth * setting_.columns.rowPitch() * double(hit.distance);
    const Side side = planeOf(sample).away != 0 ? Side::other : Side::met;
    return setting_.sight->sees(role, surface, tolerance, hints_, out_.counts.rays, byRays) == side;
  }

  /// False where the surface is not what the neighbour's sample is.
  bool shade(std::uint32_t sample, const Hit& hit, int part, int row, New& out) {
    const PartAngles::Direction direction = parts_.through(column_, row, part);
    const double met = 1 / (double(hit.distance) * direction.row.cosine),
                 own = at(planeOf(sample), {&beside_[1], row});
    out.inverseDistance = storedInverseDistance(ownInverseDistance(own, met), setting_.distanceStep);
    if (reflections_) {
      out.colour = all_.colour[sample], out.mirror = all_.mirror[sample];
      return true;
    }
    const glm::vec3 way(direction.unit());
    if (setting_.mirrors != nullptr && planeOf(sample).away == 0)
      out.mirror = setting_.mirrors->at(hit.mesh, hit.triangle, -way);
    const Shaded shaded = out.mirror != 0 ? mirrorSurface(hit, way) : rays_.shade(sample, hit, direction, 1);
    const bool opaque = shaded.alpha >= kOpaqueAlpha;
    if (opaque != isOpaque(sample) || shaded.alpha < kInvisibleAlpha) return false;
    out.colour = packColour({shaded.radiance(), opaque ? 1 : shaded.alpha});
    return true;
  }
  Shaded mirrorSurface(const Hit& hit, const glm::vec3& direction) {
    return setting_.shader
        .shadeFlatMirror(hit, -direction, out_.counts.rays, sampleFootprint(setting_, direction))
        .surface;
  }

  /// The mean over what the sample covers, where neighbours show that the surface's light changes: textures
  /// are averaged already.
  HalfColour meanColour(std::uint32_t sample, int row, std::uint16_t coverage) {
    const HalfColour plain = all_.colour[sample];
    const bool isMirror = !reflections_ && !all_.mirror.empty() && all_.mirror[sample] != 0;
    if (!isOpaque(sample) || isSky(sample) || isMirror || !contrasts(sample, row)) return plain;
    findRivals(sample, row);
    const glm::vec3 shown(unpackColour(plain));
    glm::vec3 own = shown;
    if (reflections_) {  // which the mirror tints
      const std::optional<glm::vec3> untinted = look(sample, parts_.through(column_, row), 1);
      constexpr float kRoundings = 1.01f;  // no mirror shows more than there is: that is another surface
      if (!untinted || glm::any(glm::greaterThan(shown, kRoundings * *untinted))) return plain;
      own = *untinted;
    }
    glm::vec3 sum = own;
    int count = 1;
    for (int part = 0; part < kParts; ++part) {
      if ((kSpread & coverage & (1u << part)) == 0) continue;
      const auto radiance = look(sample, parts_.through(column_, row, part), 0.5f);
      if (radiance) sum += *radiance, ++count;
    }
    glm::vec3 mean = sum / float(count);
    if (reflections_)
      for (int i = 0; i < 3; ++i) mean[i] = own[i] > 0 ? shown[i] * mean[i] / own[i] : shown[i];
    return packColour({mean, 1});
  }
  /// The sample's surface in that direction; nothing where it is not, or clear.
  std::optional<glm::vec3> look(std::uint32_t sample, const PartAngles::Direction& direction, float width) {
    const Hit hit = rays_.meet(sample, direction, rivals_);
    if (!hit.found()) return {};
    const Shaded shaded = rays_.shade(sample, hit, direction, width);
    if (shaded.alpha < kOpaqueAlpha) return {};
    return shaded.radiance();
  }
  bool contrasts(std::uint32_t sample, int row) const {
    const Pixel pixel{&beside_[1], row};
    const glm::vec3 own(unpackColour(all_.colour[sample]));
    bool found = false;
    eachNeighbour(row, [&](const Pixel& neighbour, int, int) {
      for (std::uint32_t i = neighbour.first(); i < neighbour.end() && !found; ++i) {
        const glm::vec3 its(unpackColour(all_.colour[i]));
        found = isContrast(glm::min(own, its), glm::max(own, its)) &&
                (all_.roles[i] & all_.roles[sample]) != 0 && isSame(i, neighbour, sample, pixel);
      }
    });
    return found;
  }
  static bool isContrast(const glm::vec3& least, const glm::vec3& most) {
    return glm::any(glm::greaterThan(most, (1 + kContrast) * least));
  }

  const ColumnMarch::Setting& setting_;
  const PartAngles& parts_;
  PartRays rays_;
  const CaptureSamples& all_;
  bool reflections_;
  NewSamples& out_;
  int rows_;
  double tolerance_;  ///< 1/m
  std::vector<double> tangent_;
  std::array<Beside, 3> beside_;
  int column_ = 0;
  std::vector<New> pixel_;
  std::vector<SurfacePlane> rivals_;
  std::pair<std::uint32_t, int> rivalsOf_{0, -1};  ///< the sample and the row
  RegionSight::Hints hints_;
};

/// The samples of all tasks, behind one another; planes and reflections stay.
void replace(CaptureSamples& list, const std::vector<NewSamples>& tasks) {
  std::vector<std::uint32_t> starts{0};
  for (const NewSamples& task : tasks)
    for (const std::uint32_t count : task.perColumn) starts.push_back(starts.back() + count);
  const auto join = [&](auto CaptureSamples::*part) {
    auto& all = list.*part;
    all.clear();
    all.reserve(starts.back());
    for (const NewSamples& task : tasks)
      all.insert(all.end(), (task.list.*part).begin(), (task.list.*part).end());
  };
  join(&CaptureSamples::row), join(&CaptureSamples::inverseDistance), join(&CaptureSamples::colour);
  join(&CaptureSamples::roles), join(&CaptureSamples::mirror);
  join(&CaptureSamples::coverage), join(&CaptureSamples::plane);
  list.columnStart = std::move(starts);
}

}  // namespace

double planeToleranceFor(const LayoutCamera& camera, const ColumnCamera& columns) {
  constexpr double kSamples = 0.25;
  return kSamples * std::min(columns.columnPitch(), columns.rowPitch()) / std::max(reachOf(camera), 1e-6);
}

void traceSilhouettes(const ColumnMarch::Setting& setting, Capture& capture, TaskRunner& runner,
                      CaptureCounts& counts, const std::stop_token& stop) {
  const PartAngles parts(setting.columns);
  const int columns = setting.columns.columns;
  const auto trace = [&](CaptureSamples& list, bool reflections) {
    if (list.sampleCount() == 0) return;
    std::vector<NewSamples> tasks(std::size_t((columns + kColumnsPerTask - 1) / kColumnsPerTask));
    runner.parallelFor(tasks.size(), [&](std::size_t task) {
      const FlushDenormals flush;
      NewSamples out;  // not in `tasks`, where another thread works on the next
      ColumnSilhouettes silhouettes(setting, parts, list, reflections, capture.planeTolerance, out);
      const int first = int(task) * kColumnsPerTask;
      for (int column = first; column < std::min(first + kColumnsPerTask, columns); ++column) {
        if (stop.stop_requested()) return;
        silhouettes.run(column);
      }
      tasks[task] = std::move(out);
    });
    if (stop.stop_requested()) return;
    for (const NewSamples& task : tasks) counts += task.counts;
    replace(list, tasks);
  };
  trace(capture, false);
  trace(capture.reflections, true);
}

}  // namespace acentric
