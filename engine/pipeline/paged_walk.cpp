#include "engine/pipeline/paged_walk.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "engine/base/stopwatch.h"

namespace acentric {
namespace {

/// Of a cell: so far the eye goes before its region is looked up. A page knows what is two regions farther.
constexpr double kLookAgain = 0.1;

void add(WalkStreamStats& sum, const WalkStreamStats& counts) {
  sum.loads += counts.loads, sum.coarseLoads += counts.coarseLoads, sum.evictions += counts.evictions;
  sum.beyondLimit = std::max(sum.beyondLimit, counts.beyondLimit);
}

}  // namespace

PagedWalk::PagedWalk(std::unique_ptr<WalkPages> pages, std::size_t storey, std::filesystem::path file,
                     WalkStreamOptions options)
    : pages_(std::move(pages)),
      storey_(storey),
      file_(std::move(file)),
      options_(std::move(options)),
      where_(options_.where),
      told_(options_.where.eye) {}

Result<std::unique_ptr<PagedWalk>> PagedWalk::open(std::unique_ptr<WalkPages> pages, std::size_t storey,
                                                   const std::filesystem::path& file,
                                                   WalkStreamOptions options, TaskRunner& runner) {
  std::unique_ptr<PagedWalk> walk(new PagedWalk(std::move(pages), storey, file, std::move(options)));
  const auto place = walk->pages_->placeAt(storey, walk->where_.eye);
  if (!place) return tl::unexpected(place.error());
  auto shipped = shippedPlaces(walk->placed(*place), file, nullptr, runner);
  if (!shipped) return tl::unexpected(shipped.error());
  walk->warn((*shipped)->warnings);
  walk->lookAgain_ = kLookAgain * (*shipped)->layouts[storey]->spec.cellSize;
  WalkStreamOptions streaming = walk->options_;
  walk->stream_ =
      std::make_shared<WalkStream>(startWalk(*shipped, int(storey), nullptr), std::move(streaming));
  walk->counts_.regions = (*place)->regions.size(), walk->counts_.cameras = (*place)->cameras.size();
  walk->at_ = {*place, std::move(*shipped), walk->stream_};
  PagedWalk& self = *walk;
  walk->follower_ = std::jthread([&self](const std::stop_token& stop) { self.follow(stop); });
  return walk;
}

PagedWalk::~PagedWalk() {
  follower_.request_stop();
  moved_.notify_all();
}

std::shared_ptr<WalkStream> PagedWalk::stream() const {
  const std::lock_guard lock(published_);
  return stream_;
}

void PagedWalk::go(const Whereabouts& where) {
  {
    const std::lock_guard lock(published_);
    stream_->go(where);
  }
  {
    const std::lock_guard lock(wake_);
    where_ = where;
    if (glm::distance(where.eye, told_) <= lookAgain_) return;
    told_ = where.eye;
    ++calls_;
  }
  moved_.notify_all();
}

std::shared_ptr<const LoadedWalk> PagedWalk::walk() const {
  const std::lock_guard lock(published_);
  return stream_->walk();
}

void PagedWalk::warn(std::vector<std::string> warnings) {
  const std::lock_guard lock(tally_);
  std::ranges::move(warnings, std::back_inserter(warnings_));
}

std::vector<std::string> PagedWalk::takeWarnings() {
  auto fresh = stream()->takeWarnings();
  const std::lock_guard lock(tally_);
  std::ranges::move(fresh, std::back_inserter(warnings_));
  std::vector<std::string> told;
  for (std::string& warning : warnings_)  // what is damaged is damaged in each page that has it
    if (known_.insert(warning).second) told.push_back(std::move(warning));
  warnings_.clear();
  return told;
}

bool PagedWalk::busy() const {
  {
    const std::lock_guard lock(wake_);
    if (seen_ != calls_) return true;
  }
  return stream()->busy();
}

PagedWalkStats PagedWalk::stats() const {
  const WalkStreamStats now = stream()->stats();
  PagedWalkStats stats;
  {
    const std::lock_guard lock(tally_);
    stats = counts_;
  }
  const WalkStreamStats before = std::exchange(stats.captures, now);
  add(stats.captures, before);
  stats.index = pages_->stats();
  return stats;
}

// The thread that follows the eye
// ------------------------------------------------------------------------------------------------------------

std::vector<BundlePlacePtr> PagedWalk::placed(const BundlePlacePtr& place) const {
  std::vector<BundlePlacePtr> places(place->bundle->storeys.size());
  places[storey_] = place;
  return places;
}

bool PagedWalk::isOwn(const glm::dvec2& eye) const {
  const auto region = at_.walk->layouts[storey_]->regionAt(eye);
  return region && at_.walk->isOwn(int(storey_), *region);
}

Result<PagedWalk::Place> PagedWalk::enter(const BundlePlacePtr& place, const Whereabouts& where,
                                          const std::stop_token& stop) {
  TaskRunner alone(0);
  auto walk = shippedPlaces(placed(place), file_, at_.walk.get(), alone, stop);
  if (!walk) return tl::unexpected(walk.error());
  WalkStart start = startWalk(*walk, int(storey_), nullptr);
  const int dropped = takeOver(*at_.stream->walk(), at_.stream->held(), start);
  WalkStreamOptions streaming = options_;
  streaming.where = where;
  auto stream = std::make_shared<WalkStream>(std::move(start), std::move(streaming));
  const std::lock_guard lock(tally_);
  counts_.captures.evictions += dropped;
  return Place{place, std::move(*walk), std::move(stream)};
}

/// The stream of the page before ends here, in this thread: it has perhaps a capture to read to its end.
void PagedWalk::replace(Place next, const Whereabouts& where) {
  std::swap(at_, next);
  {
    const std::lock_guard lock(published_);
    stream_ = at_.stream;
  }
  at_.stream->go(where);
  if (options_.wake) options_.wake();
  {
    const std::lock_guard lock(tally_);
    ++counts_.changes;
    counts_.regions = at_.place->regions.size(), counts_.cameras = at_.place->cameras.size();
    add(counts_.captures, next.stream->stats());
  }
  warn(next.stream->takeWarnings());
  while (next.stream.use_count() > 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void PagedWalk::look(const Whereabouts& where, const std::stop_token& stop) {
  if (isOwn(where.eye)) return;
  const Stopwatch clock;
  const auto place = pages_->placeAt(storey_, where.eye);
  if (!place) return warn({place.error().describe()});
  if ((*place)->page == at_.place->page) return;  // beside all regions
  auto next = enter(*place, where, stop);
  if (!next) {
    if (next.error().kind != ErrorKind::cancelled) warn({next.error().describe()});
    return;
  }
  replace(std::move(*next), where);
  const std::lock_guard lock(tally_);
  counts_.longestChange = std::max(counts_.longestChange, clock.seconds());
}

void PagedWalk::follow(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Whereabouts where;
    std::uint64_t calls = 0;
    {
      std::unique_lock lock(wake_);
      (void)moved_.wait(lock, stop, [&] { return calls_ != seen_; });
      where = where_, calls = calls_;
    }
    if (stop.stop_requested()) return;
    look(where, stop);
    const std::lock_guard lock(wake_);
    seen_ = calls;
  }
}

}  // namespace acentric
