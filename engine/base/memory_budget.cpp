#include "engine/base/memory_budget.h"

#include <algorithm>

namespace acentric {

MemoryBudget::Share& MemoryBudget::Share::operator=(Share&& other) noexcept {
  if (this == &other) return *this;
  release();
  budget_ = std::exchange(other.budget_, nullptr);
  bytes_ = std::exchange(other.bytes_, 0);
  passing_ = std::exchange(other.passing_, false);
  return *this;
}

void MemoryBudget::Share::set(std::size_t bytes) {
  if (budget_ != nullptr) budget_->change(bytes_, bytes, 0);
  bytes_ = bytes;
}

bool MemoryBudget::Share::setWhenRoom(std::size_t bytes, const std::stop_token& stop) {
  if (budget_ != nullptr && !budget_->growWhenRoom(bytes_, bytes, stop)) return false;
  bytes_ = bytes;
  return true;
}

void MemoryBudget::Share::pass() {
  if (budget_ == nullptr || passing_) return;
  passing_ = true;
  budget_->change(0, 0, 1);
}

void MemoryBudget::Share::release() {
  if (budget_ != nullptr) budget_->change(bytes_, 0, passing_ ? -1 : 0);
  budget_ = nullptr;
}

bool MemoryBudget::growWhenRoom(std::size_t before, std::size_t after, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const auto room = [&] { return held_ - before + after <= limit_ || passing_ == 0; };
  if (!less_.wait(lock, stop, room)) return false;
  held_ = held_ - before + after;
  peak_ = std::max(peak_, held_);
  return true;
}

std::size_t MemoryBudget::held() const {
  const std::lock_guard lock(mutex_);
  return held_;
}

std::size_t MemoryBudget::peak() const {
  const std::lock_guard lock(mutex_);
  return peak_;
}

void MemoryBudget::change(std::size_t before, std::size_t after, int passing) {
  const std::lock_guard lock(mutex_);
  held_ = held_ - before + after;
  peak_ = std::max(peak_, held_);
  passing_ += passing;
  if (after < before || passing < 0) less_.notify_all();
}

}  // namespace acentric
