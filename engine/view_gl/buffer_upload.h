#pragma once
/// Storage buffers on their way to the graphics card, piece by piece.

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/view_gl/gl_object.h"

namespace acentric {

/// Captures are cut into buffers of about this many bytes: to make a buffer takes as long as it is
/// large, because drivers clear it.
inline constexpr std::size_t kUsualBuffer = std::size_t(4) << 20;
/// What storage buffers may hold, bytes; at most `largestBuffer` unless that is 0.
std::size_t storageLimit(std::size_t largestBuffer);

class BufferUpload {
 public:
  /// The buffer that these values will be sent to; none of no values. They are let go of once they are sent.
  template <class Value>
  GlBuffer add(std::vector<Value>&& values) {
    auto owned = std::make_shared<const std::vector<Value>>(std::move(values));
    const std::span<const std::byte> bytes = std::as_bytes(std::span(*owned));
    return add(bytes, std::move(owned));
  }
  /// Of values that `owner` keeps.
  template <class Value>
  GlBuffer add(std::span<const Value> values, std::shared_ptr<const void> owner) {
    return add(std::as_bytes(values), std::move(owner));
  }
  /// Sends at most so many bytes more, or all that are left; returns how many.
  std::size_t send(std::size_t most);
  bool done() const { return next_ == parts_.size(); }
  /// Of all buffers.
  std::size_t bytes() const { return bytes_; }

 private:
  struct Part {
    GLuint buffer = 0;
    std::span<const std::byte> bytes;
    std::shared_ptr<const void> owned;
  };
  GlBuffer add(std::span<const std::byte> bytes, std::shared_ptr<const void> owned);

  std::vector<Part> parts_;
  std::size_t next_ = 0, sentOfNext_ = 0, bytes_ = 0;
};

}  // namespace acentric
