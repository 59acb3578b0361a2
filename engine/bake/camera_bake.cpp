// One capture: per pixel a march along the camera's ray, from surface to surface beyond the regions it
// serves.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <new>
#include <optional>

#include "engine/bake/bake.h"
#include "engine/bake/chunk_samples.h"
#include "engine/bake/column_roles.h"
#include "engine/bake/flush_denormals.h"
#include "engine/bake/mirror_march.h"
#include "engine/bake/mirror_sight.h"
#include "engine/bake/region_sight.h"
#include "engine/bake/shading.h"
#include "engine/base/stopwatch.h"
#include "engine/scene/flat_mirrors.h"

namespace acentric {
namespace {

constexpr int kColumnsPerChunk = 4;
/// Of a sample's footprint: what lies nearer behind it than this is still the same surface.
constexpr double kSameDepth = 0.5;
/// Of a sample's spacing: how far the picture may shift by the rounding of a distance.
constexpr double kShiftByRounding = 0.1;

/// The largest step of inverse distances that shifts no picture from a served region by more than a share of
/// a sample: a sample off by dw is seen off by dw times the eye's distance from the camera.
double distanceStepFor(const LayoutCamera& camera, const ColumnCamera& columns) {
  double reach = 0;
  for (const Role& role : camera.roles)
    for (const glm::dvec2& corner : role.polygon.corners)
      reach = std::max(reach, glm::distance(corner, camera.position));
  if (!(reach > 0)) return 0;
  const double largest = kShiftByRounding * std::min(columns.columnPitch(), columns.rowPitch()) / reach;
  return std::ldexp(1.0, std::ilogb(largest));
}

/// Of each row's elevation.
struct RowAngles {
  std::vector<double> cosine, sine;

  explicit RowAngles(const ColumnCamera& columns) {
    for (int row = 0; row < columns.rows; ++row) {
      cosine.push_back(std::cos(columns.elevationAt(row + 0.5)));
      sine.push_back(std::sin(columns.elevationAt(row + 0.5)));
    }
  }
};

/// The rays of rows [first, last) of a column from horizontal distance `nearest` on.
RayPacket firstRays(const ColumnCamera& columns, const RowAngles& rows, const glm::dvec2& columnDirection,
                    int first, int last, double nearest) {
  RayPacket packet;
  packet.origin = glm::vec3(columns.centreOfProjection);
  packet.count = last - first;
  for (int row = first; row < last; ++row) {
    const auto n = std::size_t(row - first), r = std::size_t(row);
    const double flat = rows.cosine[r];
    packet.direction[n] = glm::vec3(columnDirection.x * flat, columnDirection.y * flat, rows.sine[r]);
    packet.nearest[n] = float(nearest / flat);
  }
  return packet;
}

/// What is the same for all pixels of a capture.
struct March {
  const Shader& shader;
  const LayoutCamera& camera;
  const ColumnCamera& columns;
  const RowAngles& rows;
  const BakeSettings& settings;
  const RegionSight* sight;    ///< null: no pruning
  const FlatMirrors* mirrors;  ///< null: there are none
  const MirrorSight* beyond;   ///< null: only what the camera itself sees in them
  double distanceStep;
};

/// Marches along the rays of one column after the other, on one thread.
class ColumnMarch {
 public:
  ColumnMarch(const March& march, ChunkSamples& out)
      : march_(march),
        out_(out),
        sameDepth_(kSameDepth * march.columns.rowPitch()),
        rightBehind_(std::max(sameDepth_, kSameSurface)),
        stored_(march.camera.roles.size()),
        opaqueAt_(march.camera.roles.size()) {
    if (march.sight != nullptr) hints_ = march.sight->hints();
    if (march.beyond != nullptr)
      mirrorMarch_.emplace(march.shader, *march.beyond, march.settings.maxLayers, sameDepth_, rightBehind_);
  }

  /// False when stopped.
  bool run(int column, const std::stop_token& stop) {
    direction_ = march_.columns.directionAt(column + 0.5);
    roles_ = rolesAlong(march_.camera, direction_);
    alone_ = roles_.size() == 1 && roles_.front().clip == nullptr && march_.sight == nullptr &&
             march_.mirrors == nullptr && march_.settings.maxLayers == 1;
    const std::size_t before = out_.row.size(), shownBefore = out_.reflections.row.size();
    for (int row = 0; row < march_.columns.rows && !roles_.empty(); row += RayPacket::kSize) {
      if (stop.stop_requested()) return false;
      runRows(row, std::min(row + RayPacket::kSize, march_.columns.rows), stop);
    }
    out_.perColumn.push_back(std::uint32_t(out_.row.size() - before));
    out_.background.closeColumn();
    if (march_.mirrors != nullptr)
      out_.reflections.perColumn.push_back(std::uint32_t(out_.reflections.row.size() - shownBefore));
    return true;
  }

 private:
  void runRows(int first, int last, const std::stop_token& stop) {
    const RayPacket packet =
        firstRays(march_.columns, march_.rows, direction_, first, last, roles_.front().exit);
    march_.shader.scene().trace(packet, hits_);
    out_.counts.rays.primary += std::uint64_t(packet.count);
    for (int row = first; row < last; ++row) {
      const auto n = std::size_t(row - first);
      if (alone_ && addAlone(row, packet.direction[n], hits_[n])) continue;
      beginPixel(row);
      if (const ColumnRole* next = addHit(packet.direction[n], hits_[n]))
        runPixel(packet.direction[n], hits_[n].distance, next, stop);
      addBackgroundAlong(packet.direction[n]);
      if (mirrorMarch_)
        mirrorMarch_->run({march_.columns.centreOfProjection, glm::dvec3(packet.direction[n]), flat_, roles_},
                          shown_, out_.counts.rays, stop);
      if (!shown_.empty()) addShown();
    }
  }
  /// A pixel of a column that serves one role, with one layer and without pruning: no march. False where the
  /// surface does not hide what is behind it.
  bool addAlone(int row, const glm::vec3& direction, const Hit& hit) {
    const std::uint8_t mask = roles_.front().bit;
    if (!hit.found()) {
      addBackground(row, mask);
      return true;
    } else {
      const double horizontal = double(hit.distance) * march_.rows.cosine[std::size_t(row)];
      const float stored = storedInverseDistance(1 / horizontal, march_.distanceStep);
      if (const auto& even = march_.shader.evenColours(); !even.empty()) {
        out_.add(row, stored, even[hit.mesh], mask);
      } else {
        const Shaded shaded = march_.shader.shade(hit, -direction, out_.counts.rays);
        if (shaded.alpha < kOpaqueAlpha) return false;
        out_.add(row, stored, packColour({shaded.radiance(), 1}), mask);
      }
    }
    ++out_.counts.samples.kept[0];
    return true;
  }

  void beginPixel(int row) {
    row_ = row;
    flat_ = march_.rows.cosine[std::size_t(row)];
    layer_ = 0;
    reachedBackground_ = false;
    std::ranges::fill(stored_, 0);
    std::ranges::fill(opaqueAt_, 0);
  }

  /// What is behind the pixel's first hit: from surface to surface, until every role has all it may have, or
  /// nothing is left that it could see.
  void runPixel(const glm::vec3& direction, float distance, const ColumnRole* next,
                const std::stop_token& stop) {
    Ray ray{glm::vec3(march_.columns.centreOfProjection), direction};
    for (int step = 1; step < kMaxMarch && next != nullptr && !stop.stop_requested(); ++step) {
      ray.nearest = std::max(justBehind(distance), float(next->exit / flat_));
      ++out_.counts.rays.primary;
      const Hit hit = march_.shader.scene().trace(ray);
      next = addHit(direction, hit);
      distance = hit.distance;
    }
  }
  /// The next role that may still have samples behind the hit: ahead of its exit nobody needs anything. None
  /// if the pixel is done.
  const ColumnRole* addHit(const glm::vec3& direction, const Hit& hit) {
    if (!hit.found()) {
      reachedBackground_ = true;
      return nullptr;
    }
    addSurface(direction, hit);
    const auto next = std::ranges::find_if(roles_, [&](const ColumnRole& r) { return !isFull(r); });
    return next == roles_.end() ? nullptr : &*next;
  }
  bool isFull(const ColumnRole& role) const { return stored_[role.index] >= march_.settings.maxLayers; }

  void addSurface(const glm::vec3& direction, const Hit& hit) {
    const double horizontal = double(hit.distance) * flat_;
    const glm::dvec3 point = march_.columns.centreOfProjection + double(hit.distance) * glm::dvec3(direction);
    const double tolerance = sameDepth_ * double(hit.distance);
    const glm::vec3 wound = hit.geometricNormal(), normal = glm::dot(wound, direction) <= 0 ? wound : -wound;
    const std::uint8_t mirror =
        march_.mirrors == nullptr ? 0 : march_.mirrors->at(hit.mesh, hit.triangle, -direction);
    needed_.clear();
    neededBehind_.clear();
    facing_.clear();
    bool limited = false;
    for (const ColumnRole& role : roles_) {
      if (role.exit > horizontal * (1 + kBorderSlack)) break;
      const bool inPart = role.clip == nullptr || role.clip->holds(glm::dvec2(point));
      if (!inPart && mirror == 0) continue;
      if (isFull(role)) {
        limited = limited || inPart;
        continue;
      }
      RegionSight::Side side = RegionSight::Side::normal;
      if (march_.sight != nullptr) {
        if (!(horizontal * (1 - rightBehind_) > opaqueAt_[role.index])) continue;
        side = march_.sight->sees(role.index, point, glm::dvec3(normal), tolerance, hints_, out_.counts.rays);
        if (side == RegionSight::Side::none) continue;
      }
      const bool behind = side == RegionSight::Side::other;
      if (inPart) (behind ? neededBehind_ : needed_).push_back(&role);
      if (mirror != 0 && !behind) facing_.push_back(&role);
    }
    if (needed_.empty() && neededBehind_.empty())
      ++(limited ? out_.counts.samples.overLimit : out_.counts.samples.hidden);
    if (!needed_.empty() || !facing_.empty())
      addSide(needed_,
              mirror != 0 ? mirrorSurface(direction, hit, horizontal, mirror)
                          : march_.shader.shade(hit, -direction, out_.counts.rays),
              horizontal, mirror);
    // The camera looks at its back: as from the mirrored place.
    if (!neededBehind_.empty())
      addSide(neededBehind_, march_.shader.shade(hit, glm::reflect(-direction, normal), out_.counts.rays),
              horizontal, 0);
  }

  /// A sample of one side of a surface for the roles that see it.
  void addSide(std::vector<const ColumnRole*>& needed, const Shaded& shaded, double horizontal,
               std::uint8_t mirror) {
    const bool opaque = shaded.alpha >= kOpaqueAlpha;
    if (needed.empty() || shaded.alpha < kInvisibleAlpha) return;
    // The last place is kept for an opaque surface: there is always something behind glass.
    if (!opaque)
      std::erase_if(needed, [&](const ColumnRole* role) {
        return stored_[role->index] + 1 >= march_.settings.maxLayers;
      });
    if (needed.empty()) {
      ++out_.counts.samples.overLimit;
      return;
    }
    if (opaque)
      for (const ColumnRole* role : needed) opaqueAt_[role->index] = horizontal;
    add(needed, storedInverseDistance(1 / horizontal, march_.distanceStep), shaded.radiance(),
        opaque ? 1 : shaded.alpha, mirror);
  }

  /// The surface of a plane mirror; what it shows is kept for the roles in facing_ whose part holds its
  /// virtual place, which may be another part than the mirror's own.
  Shaded mirrorSurface(const glm::vec3& direction, const Hit& hit, double horizontal, std::uint8_t mirror) {
    const Shader::Mirrored mirrored = march_.shader.shadeFlatMirror(hit, -direction, out_.counts.rays);
    const bool sky = !(mirrored.distance < std::numeric_limits<float>::infinity());
    const double reach = horizontal * (1 + double(mirrored.distance) / double(hit.distance));
    const glm::dvec2 place = march_.camera.position + reach * direction_;
    std::uint8_t mask = 0;
    for (const ColumnRole* role : facing_)
      if (sky ? role->holdsBackground : role->clip == nullptr || role->clip->holds(place)) mask |= role->bit;
    if (mask != 0)
      shown_.push_back({reach / flat_, packColour({mirrored.surface.radiance(), 1}), mask, mirror});
    return mirrored.surface;
  }

  /// What the mirrors of the pixel show, nearest first.
  void addShown() {
    std::ranges::stable_sort(shown_, {}, &ShownInMirror::distance);
    for (const ShownInMirror& s : shown_) {
      const float w = s.isSky() ? 0 : storedInverseDistance(1 / (s.distance * flat_), march_.distanceStep);
      out_.reflections.add(row_, w, s.colour, s.roles);
      out_.reflections.mirror.push_back(s.mirror);
    }
    out_.counts.reflections += shown_.size();
    shown_.clear();
  }

  /// For the roles that see it, whatever the march met before, or how many samples they have: behind all
  /// surfaces there is the background, and it takes none.
  void addBackgroundAlong(const glm::vec3& direction) {
    std::uint8_t mask = 0;
    for (const ColumnRole& role : roles_)
      if (role.holdsBackground &&
          (march_.sight == nullptr
               ? reachedBackground_ && !isFull(role)
               : march_.sight->seesAlong(role.index, glm::dvec3(direction), hints_, out_.counts.rays)))
        mask |= role.bit;
    if (mask != 0) addBackground(row_, mask);
  }
  void addBackground(int row, std::uint8_t mask) {
    out_.background.add(row, mask);
    ++out_.counts.samples.background;
  }

  void add(const std::vector<const ColumnRole*>& needed, float w, const glm::vec3& radiance, float alpha,
           std::uint8_t mirror) {
    std::uint8_t mask = 0;
    for (const ColumnRole* role : needed) {
      mask |= role->bit;
      ++stored_[role->index];
    }
    out_.add(row_, w, packColour({radiance, alpha}), mask);
    if (march_.mirrors != nullptr) out_.mirror.push_back(mirror);
    ++out_.counts.samples.kept[std::min(std::size_t(layer_++), SampleCounts::kLayers - 1)];
  }

  const March& march_;
  ChunkSamples& out_;
  double sameDepth_;    ///< metres per metre of ray
  double rightBehind_;  ///< the same: what the test eyes do not tell from what lies before it
  std::array<Hit, RayPacket::kSize> hits_;
  RegionSight::Hints hints_;
  glm::dvec2 direction_{0};         ///< of the column
  std::vector<ColumnRole> roles_;   ///< of the column
  bool alone_ = false;              ///< of the column: see addAlone
  int row_ = 0;                     ///< of the pixel
  double flat_ = 1;                 ///< of the pixel: horizontal metres per metre of ray
  int layer_ = 0;                   ///< of the pixel: samples that it has
  bool reachedBackground_ = false;  ///< of the pixel: is nothing left along its ray?
  std::vector<int> stored_;         ///< of the pixel, by role
  /// The same: horizontal distance of the last opaque surface stored. What lies right behind it, as the backs
  /// of panels and mouldings, would pass for it before the test eyes, and show in its cracks.
  std::vector<double> opaqueAt_;
  std::vector<const ColumnRole*> needed_;        ///< those that see the side that the camera sees
  std::vector<const ColumnRole*> neededBehind_;  ///< those that see the other
  std::vector<const ColumnRole*> facing_;        ///< those that a mirror shows something
  std::optional<MirrorMarch> mirrorMarch_;
  std::vector<ShownInMirror> shown_;  ///< by the mirrors of the pixel
};

}  // namespace

std::uint64_t traceFirstRays(const RayScene& scene, const LayoutCamera& camera, const ColumnCamera& columns,
                             TaskRunner& runner) {
  std::atomic<std::uint64_t> hits = 0;
  const RowAngles rows(columns);
  runner.parallelFor(std::size_t(columns.columns), [&](std::size_t column) {
    const FlushDenormals flush;
    const glm::dvec2 direction = columns.directionAt(double(column) + 0.5);
    const auto roles = rolesAlong(camera, direction);
    std::uint64_t found = 0;
    for (int row = 0; row < columns.rows && !roles.empty(); row += RayPacket::kSize)
      found += std::uint64_t(
          scene.countHits(firstRays(columns, rows, direction, row,
                                    std::min(row + RayPacket::kSize, columns.rows), roles.front().exit)));
    hits += found;
  });
  return hits;
}

CaptureCounts& CaptureCounts::operator+=(const CaptureCounts& other) {
  rays += other.rays;
  samples += other.samples;
  reflections += other.reflections;
  eyeViews += other.eyeViews;
  eyeViewSeconds += other.eyeViewSeconds;
  return *this;
}

CameraBaker::CameraBaker(const RayScene& scene, const BakeSettings& settings, MemoryBudget* budget)
    : scene_(scene),
      settings_(settings),
      ownBudget_(budget == nullptr ? std::make_unique<MemoryBudget>() : nullptr),
      budget_(budget == nullptr ? *ownBudget_ : *budget) {}
CameraBaker::~CameraBaker() = default;

Result<Capture> CameraBaker::bake(const LayoutCamera& camera, const ColumnCamera& columns, TaskRunner& runner,
                                  CaptureCounts& counts, std::stop_token stop, const Traced& traced) {
  if (auto sound = settings_.check(); !sound) return tl::unexpected(sound.error());
  if (auto sound = columns.check(); !sound) return tl::unexpected(sound.error());
  const auto noMemory = [&] {
    return fail(ErrorKind::outOfSpace, "not enough memory for this capture; lower the samples per degree",
                scene_.scene().name);
  };
  const auto stopped = [] { return fail(ErrorKind::cancelled, "the bake was stopped"); };
  try {
    if (!shader_ || shaderStop_ != stop) {
      shader_ = std::make_unique<Shader>(scene_, settings_, stop);
      shaderStop_ = stop;
    }
    if (!mirrors_) mirrors_ = std::make_unique<FlatMirrors>(scene_.scene(), scene_.plan());
    std::optional<RegionSight> sight;
    if (settings_.pruning) {
      const ElevationRange elevations{columns.bottomElevation, columns.topElevation};
      if (!views_) views_ = std::make_unique<EyeViews>(scene_, elevations, settings_, budget_);
      const Stopwatch watch;
      const int before = views_->traced();
      sight = RegionSight::look(scene_, camera, columns.centreOfProjection.z, settings_, *views_, runner,
                                counts.rays, stop);
      if (!sight) return stopped();
      counts.eyeViews += views_->traced() - before;
      counts.eyeViewSeconds += watch.seconds();
    }
    const FlatMirrors* mirrors = mirrors_->any() ? mirrors_.get() : nullptr;
    std::optional<MirrorSight> beyond;
    if (sight && mirrors != nullptr) beyond.emplace(scene_, *mirrors, *sight);
    const RowAngles rows(columns);
    const March march{*shader_,
                      camera,
                      columns,
                      rows,
                      settings_,
                      sight ? &*sight : nullptr,
                      mirrors,
                      beyond && beyond->any() ? &*beyond : nullptr,
                      distanceStepFor(camera, columns)};
    const std::size_t chunkCount = std::size_t((columns.columns + kColumnsPerChunk - 1) / kColumnsPerChunk);
    std::vector<ChunkSamples> chunks(chunkCount);
    std::atomic<std::size_t> total = 0;
    std::atomic<int> columnsTraced = 0;
    std::atomic<std::uint64_t> raysTraced = counts.rays.total();
    std::atomic<bool> full = false;  // of memory
    runner.parallelFor(chunkCount, [&](std::size_t chunk) {
      if (stop.stop_requested() || full || total > kMaxCaptureSamples) return;
      const FlushDenormals flush;
      const int first = int(chunk) * kColumnsPerChunk;
      const int last = std::min(first + kColumnsPerChunk, columns.columns);
      const std::size_t pixels = std::size_t(last - first) * std::size_t(columns.rows);
      if (!budget_.waitForRoom(pixels * ChunkSamples::kBytes, stop)) return;
      try {
        ChunkSamples samples;  // not in `chunks`, where another thread works on the next
        samples.held = MemoryBudget::Share(budget_);
        samples.reserve(pixels);
        samples.held.set(pixels * ChunkSamples::kBytes);
        ColumnMarch columnMarch(march, samples);
        for (int column = first; column < last && columnMarch.run(column, stop);) ++column;
        samples.close();
        total += samples.row.size() + samples.reflections.row.size();
        columnsTraced += last - first;
        raysTraced += samples.counts.rays.total();
        chunks[chunk] = std::move(samples);
        if (traced) traced(columnsTraced, raysTraced);
      } catch (const std::bad_alloc&) {
        full = true;
      }
    });
    if (stop.stop_requested()) return stopped();
    if (full) return noMemory();
    if (total > kMaxCaptureSamples)
      return fail(ErrorKind::tooLarge, "more than 2^31 samples in one capture; lower the samples per degree",
                  scene_.scene().name);
    CaptureCounts counted;
    for (const ChunkSamples& s : chunks) counted += s.counts;
    counts += counted;
    if (!budget_.waitForRoom(total * ChunkSamples::kBytes, stop)) return stopped();
    MemoryBudget::Share whole(budget_);
    whole.set(total * ChunkSamples::kBytes);
    Capture capture = joined(chunks, counted.reflections > 0, runner, stop);
    if (stop.stop_requested()) return stopped();
    capture.camera = columns;
    capture.distanceStep = march.distanceStep;
    if (capture.background.runCount() > 0) capture.background.sky = shader_->sky();
    return capture;
  } catch (const std::bad_alloc&) {
    return noMemory();
  }
}

}  // namespace acentric
