/// What a stream holds, and what it reads and evicts next. All of it with the state locked.
#include <algorithm>
#include <limits>

#include "engine/image/coarse_capture.h"
#include "engine/pipeline/counted_capture.h"
#include "engine/pipeline/walk_stream.h"

namespace acentric {
namespace {

/// Coarse renditions have so much of the memory at most.
constexpr std::size_t kCoarseShare = 4;
/// What a coarse rendition takes, with a margin for what does not shrink with the pixels.
constexpr std::size_t coarseBytesOf(std::size_t full) {
  return 3 * full / (2 * kCoarseFactor * kCoarseFactor);
}

}  // namespace

/// Looks again at where the eye is.
void WalkStream::follow() {
  Whereabouts where;
  {
    const std::lock_guard lock(wake_);
    where = where_;
  }
  distances_ = walkDistances(*now_.walk.layout, needs_, where);
  for (Tier& t : tiers_)
    for (std::size_t c = 0; c < t.captures.size(); ++c)
      if (t.captures[c] && distances_.camera[c] <= 0) t.lastUse[c] = ++uses_;
}

std::optional<WalkStream::Task> WalkStream::next(Duty duty) {
  follow();
  const auto step = [&](Detail detail) {
    const ResidencyPlan planned = plan(detail, distances_.camera, 1);
    evict(detail, planned.evict);
    if (detail == Detail::full) counts_.beyondLimit = planned.beyondLimit;
    return planned.steps.empty() ? std::optional<ResidencyPlan::Step>() : planned.steps.front();
  };
  const std::size_t evictions = std::size_t(counts_.evictions);
  const auto coarse = step(Detail::coarse), full = step(Detail::full);
  const auto isNeeded = [&](const auto& s) { return s && distances_.camera[std::size_t(s->load)] <= 0; };
  const auto take = [&](Detail detail, const ResidencyPlan::Step& chosen) {
    evict(detail, chosen.evict);
    return Task{detail == Detail::full ? Task::What::full : Task::What::coarse, chosen.load, false, {}};
  };
  auto here = nextLocals(0);
  const auto choose = [&]() -> std::optional<Task> {
    if (isNeeded(coarse)) return take(Detail::coarse, *coarse);
    if (!here.empty()) return Task{Task::What::local, -1, false, std::move(here)};
    if (isNeeded(full)) return take(Detail::full, *full);
    if (coarse) return take(Detail::coarse, *coarse);
    if (auto ahead = nextLocals(std::numeric_limits<double>::infinity()); !ahead.empty())
      return Task{Task::What::local, -1, false, std::move(ahead)};
    if (full) return take(Detail::full, *full);
    return nextSketch();
  };
  const bool needed = isNeeded(coarse) || !here.empty() || isNeeded(full);
  std::optional<Task> task;
  if (needed == (duty == Duty::needed)) task = choose();
  if (task) begin(*task);
  if (task && task->what == Task::What::full)
    task->standIn = !allFit_ && source_->storedBytes(task->camera, Detail::coarse) == 0;
  if (std::size_t(counts_.evictions) != evictions) publish();
  return task;
}

std::vector<int> WalkStream::nextLocals(double within) const {
  constexpr std::size_t kMost = 64;
  std::vector<int> regions;
  for (std::size_t r = 0; r < locals_.size(); ++r)
    if (locals_[r] == Residence::absent && distances_.region[r] <= within) regions.push_back(int(r));
  const auto distance = [this](int region) { return distances_.region[std::size_t(region)]; };
  const auto end = regions.begin() + std::ptrdiff_t(std::min(kMost, regions.size()));
  std::ranges::partial_sort(regions, end, {}, distance);
  regions.erase(end, regions.end());
  return regions;
}

/// A camera that memory does not hold and that nothing stands in for yet.
std::optional<WalkStream::Task> WalkStream::nextSketch() const {
  if (allFit_) return std::nullopt;
  const Tier &full = tier(Detail::full), &coarse = tier(Detail::coarse);
  int nearest = -1;
  for (std::size_t c = 0; c < full.bytes.size(); ++c)
    if (full.bytes[c] > 0 && full.residence[c] == Residence::absent &&
        coarse.residence[c] == Residence::absent &&
        distances_.camera[c] < std::numeric_limits<double>::infinity() &&
        (nearest < 0 || distances_.camera[c] < distances_.camera[std::size_t(nearest)]))
      nearest = int(c);
  if (nearest < 0) return std::nullopt;
  // One that was made before took what it took: were only the guess believed, it would come and go for ever.
  const auto c = std::size_t(nearest);
  const std::size_t bytes = std::max(coarseBytesOf(full.bytes[c]), coarse.madeBytes[c]);
  if (taken(Detail::coarse) + bytes > limitOf(Detail::coarse)) return std::nullopt;
  return Task{Task::What::sketch, nearest, true, {}};
}

std::size_t WalkStream::taken(Detail detail) const {
  const Tier& t = tier(detail);
  std::size_t bytes = 0;
  for (std::size_t c = 0; c < t.bytes.size(); ++c)
    if (t.residence[c] != Residence::absent) bytes += t.bytes[c];
  return bytes;
}

std::size_t WalkStream::limitOf(Detail detail) const {
  if (detail == Detail::coarse) return options_.memoryBytes / kCoarseShare;
  return options_.memoryBytes -
         std::min(options_.memoryBytes, std::max(taken(Detail::coarse), allFit_ ? 0 : coarseBytes_));
}

ResidencyPlan WalkStream::plan(Detail detail, std::span<const double> distance, std::size_t mostSteps) const {
  const Tier& t = tier(detail);
  std::vector<std::size_t> bytes = t.bytes;
  if (detail == Detail::coarse)  // nothing stands in for what is there
    for (std::size_t c = 0; c < bytes.size(); ++c)
      if (t.residence[c] == Residence::absent && tier(Detail::full).captures[c]) bytes[c] = 0;
  return planResidency({distance, bytes, t.residence, t.lastUse, limitOf(detail), mostSteps});
}

void WalkStream::evict(Detail detail, std::span<const int> cameras) {
  for (const int camera : cameras) drop(detail, camera);
  counts_.evictions += int(cameras.size());
}

void WalkStream::drop(Detail detail, int camera) {
  Tier& t = tier(detail);
  const auto c = std::size_t(camera);
  t.captures[c].reset();
  t.residence[c] = Residence::absent;
  if (t.made[c]) t.bytes[c] = 0;
  show(camera);
}

void WalkStream::begin(const Task& task) {
  for (const int region : task.regions) locals_[std::size_t(region)] = Residence::loading;
  if (task.camera >= 0)
    tier(task.what == Task::What::full ? Detail::full : Detail::coarse).residence[std::size_t(task.camera)] =
        Residence::loading;
}

void WalkStream::insert(Detail detail, int camera, CapturePtr capture, bool made) {
  Tier& t = tier(detail);
  const auto c = std::size_t(camera);
  t.bytes[c] = bytesOf(*capture);
  t.measured[c] = 1;
  t.made[c] = made;
  if (made) t.madeBytes[c] = t.bytes[c];
  t.residence[c] = Residence::resident;
  t.lastUse[c] = ++uses_;
  t.captures[c] = std::move(capture);
  if (detail == Detail::full) {
    readStored_ += source_->storedBytes(camera, detail);
    readBytes_ += t.bytes[c];
  }
  show(camera);
}

/// What each capture that was not read yet will take, from those that were.
void WalkStream::guessBytes() {
  if (readStored_ > 0) bytesPerStored_ = double(readBytes_) / double(readStored_);
  std::size_t all = 0;
  coarseBytes_ = 0;
  for (const Detail detail : {Detail::coarse, Detail::full}) {
    Tier& t = tier(detail);
    for (std::size_t c = 0; c < t.bytes.size(); ++c) {
      if (!t.measured[c])
        t.bytes[c] = std::size_t(bytesPerStored_ * double(source_->storedBytes(int(c), detail)));
      if (detail == Detail::full) all += t.bytes[c];
      if (detail == Detail::full && tier(Detail::coarse).bytes[c] == 0)
        coarseBytes_ += coarseBytesOf(t.bytes[c]);
      if (detail == Detail::coarse) coarseBytes_ += t.bytes[c];
    }
  }
  allFit_ = all <= options_.memoryBytes;
  coarseBytes_ = options_.threads > 0 ? std::min(coarseBytes_, limitOf(Detail::coarse)) : 0;
}

void WalkStream::show(int camera) {
  const auto c = std::size_t(camera);
  const CapturePtr& full = tier(Detail::full).captures[c];
  now_.walk.captures[c] = full ? full : tier(Detail::coarse).captures[c];
  now_.standsIn[c] = !full && now_.walk.captures[c];
}

}  // namespace acentric
