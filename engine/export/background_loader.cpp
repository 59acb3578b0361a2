#include "engine/export/background_loader.h"

#include <algorithm>
#include <new>

namespace acentric {

BackgroundLoader::BackgroundLoader(const BundlePlayer& player, int threads) : player_(player) {
  images_.resize(player.bundle().textures.size());
  for (int i = 0; i < threads; ++i)
    threads_.emplace_back([this](const std::stop_token& stop) { work(stop); });
}

BackgroundLoader::~BackgroundLoader() {
  for (std::jthread& thread : threads_) thread.request_stop();
}

void BackgroundLoader::ask(std::vector<LoadJob> jobs) {
  const std::lock_guard lock(mutex_);
  jobs_.clear();
  for (LoadJob& job : jobs)
    if (!begun_.contains(job)) jobs_.push_back(std::move(job));
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
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [&] { return !jobs_.empty(); }) || stop.stop_requested()) return;
      job = jobs_.front();
      jobs_.pop_front();
      begun_.insert(job);
    }
    Result<LoadedPart> part = fail(ErrorKind::outOfSpace, "the memory is out");
    try {
      part = load(job, stop);
    } catch (const std::bad_alloc&) {  // told as it is
    }
    const std::lock_guard lock(mutex_);
    arrived_.push_back({job, std::move(part)});
  }
}

Result<LoadedPart> BackgroundLoader::load(const LoadJob& job, const std::stop_token& stop) {
  const auto partOf = [](auto read) -> Result<LoadedPart> {
    if (!read) return tl::unexpected(std::move(read.error()));
    return LoadedPart(std::move(*read));
  };
  if (job.model && job.region)
    return partOf(regionModel(player_, job.storey, job.number, job.texturePixels, knownImages()));
  if (job.model)
    return partOf(captureModel(player_, job.storey, job.number, job.detail, job.texturePixels, stop));
  if (!job.region) return partOf(player_.readCapture(job.storey, job.number, job.detail));
  auto read = player_.readRegion(job.storey, job.number, knownImages());
  if (read) remember(read->images);
  return partOf(std::move(read));
}

BundlePlayer::Images BackgroundLoader::knownImages() {
  const std::lock_guard lock(mutex_);
  BundlePlayer::Images known;
  for (const auto& image : images_) known.push_back(image.lock());
  return known;
}

void BackgroundLoader::remember(const BundlePlayer::Images& images) {
  const std::lock_guard lock(mutex_);
  for (std::size_t t = 0; t < images.size(); ++t)
    if (images[t]) images_[t] = images[t];
}

}  // namespace acentric
