#pragma once
/// Counts what is read of a walk.

#include <atomic>
#include <memory>
#include <utility>

#include "engine/export/walk_read.h"

namespace acentric {

/// Any thread, if the ranges may be read by any.
class CountedRanges final : public ByteRanges {
 public:
  explicit CountedRanges(std::shared_ptr<const ByteRanges> ranges) : ranges_(std::move(ranges)) {}
  Result<std::uint64_t> size() const override { return ranges_->size(); }
  Status read(std::uint64_t at, std::span<std::byte> into) const override {
    ++requests_, bytes_ += into.size();
    return ranges_->read(at, into);
  }
  std::uint64_t requests() const { return requests_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::shared_ptr<const ByteRanges> ranges_;
  mutable std::atomic<std::uint64_t> requests_ = 0, bytes_ = 0;
};

}  // namespace acentric
