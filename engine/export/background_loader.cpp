#include "engine/export/background_loader.h"

#include <algorithm>
#include <new>

namespace acentric {

BackgroundLoader::BackgroundLoader(std::size_t textures, int threads) : images_(textures) {
  for (int i = 0; i < threads; ++i)
    threads_.emplace_back([this](const std::stop_token& stop) { work(stop); });
}

BackgroundLoader::~BackgroundLoader() {
  for (std::jthread& thread : threads_) thread.request_stop();
}

void BackgroundLoader::ask(BundlePlacePtr place, std::vector<LoadJob> jobs) {
  const std::lock_guard lock(mutex_);
  place_ = std::move(place);
  jobs_.clear();
  for (LoadJob& job : jobs)
    if (!begun_.contains(job)) jobs_.push_back(std::move(job));
  wake_.notify_all();
}

void BackgroundLoader::doAside(std::function<void()> work) {
  const std::lock_guard lock(mutex_);
  aside_ = std::move(work);
  wake_.notify_all();
}

std::optional<Arrival> BackgroundLoader::take(const std::function<bool(const LoadJob&)>& chosen) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::ranges::find_if(arrived_, [&](const Arrival& arrival) { return chosen(arrival.job); });
  if (found == arrived_.end()) return std::nullopt;
  Arrival first = std::move(*found);
  arrived_.erase(found);
  begun_.erase(first.job);
  return first;
}

std::size_t BackgroundLoader::waiting() const {
  const std::lock_guard lock(mutex_);
  return jobs_.size() + begun_.size();
}

void BackgroundLoader::work(const std::stop_token& stop) {
  for (;;) {
    LoadJob job;
    BundlePlacePtr place;
    std::function<void()> aside;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [&] { return aside_ || !jobs_.empty(); }) || stop.stop_requested()) return;
      aside = std::exchange(aside_, nullptr);
    }
    if (aside) {
      try {
        aside();
      } catch (const std::bad_alloc&) {  // nobody is told of it
      }
      continue;
    }
    {
      const std::lock_guard lock(mutex_);
      if (jobs_.empty()) continue;  // another thread was faster
      job = jobs_.front(), place = place_;
      jobs_.pop_front();
      begun_.insert(job);
    }
    Result<LoadedPart> part = fail(ErrorKind::outOfSpace, "the memory is out");
    try {
      part = load(place, job, stop);
    } catch (const std::bad_alloc&) {  // told as it is
    }
    const std::lock_guard lock(mutex_);
    arrived_.push_back({job, std::move(part)});
  }
}

Result<LoadedPart> BackgroundLoader::load(const BundlePlacePtr& place, const LoadJob& job,
                                          const std::stop_token& stop) {
  const auto partOf = [](auto read) -> Result<LoadedPart> {
    if (!read) return tl::unexpected(std::move(read.error()));
    return LoadedPart(std::move(*read));
  };
  if (!job.region) {
    const std::size_t camera = *place->cameraIn(job.number);
    if (job.model) return partOf(captureModel(*place, camera, job.detail, job.texturePixels, stop));
    return partOf(readCapture(*place, camera, job.detail));
  }
  const std::size_t region = *place->regionIn(job.number);
  if (job.model) return partOf(regionModel(place, region, job.texturePixels, knownImages()));
  auto read = readRegion(*place, region, knownImages());
  if (read) remember(read->images);
  return partOf(std::move(read));
}

Images BackgroundLoader::knownImages() {
  const std::lock_guard lock(mutex_);
  Images known;
  for (const auto& image : images_) known.push_back(image.lock());
  return known;
}

void BackgroundLoader::remember(const Images& images) {
  const std::lock_guard lock(mutex_);
  for (std::size_t t = 0; t < images.size(); ++t)
    if (images[t]) images_[t] = images[t];
}

}  // namespace acentric
