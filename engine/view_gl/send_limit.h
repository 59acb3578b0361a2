#pragma once
/// How much one frame sends to the graphics card.

#include <algorithm>
#include <cstddef>

#include "engine/base/stopwatch.h"

namespace acentric {

class SendLimit {
 public:
  /// At most so many bytes; none are begun to be sent after so many seconds from now, but the first.
  SendLimit(std::size_t bytes, double seconds) : left_(bytes), seconds_(seconds) {}

  std::size_t left() const { return any_ && watch_.seconds() > seconds_ ? 0 : left_; }
  void sent(std::size_t bytes) {
    left_ -= std::min(bytes, left_);
    any_ = true;
  }

 private:
  std::size_t left_;
  double seconds_;
  bool any_ = false;
  Stopwatch watch_;
};

}  // namespace acentric
