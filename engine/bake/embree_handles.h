#pragma once
/// Embree's objects as owners. Private to the ray scene: nothing else includes Embree.

#include <embree3/rtcore.h>

#include <utility>

namespace acentric {

template <class Handle, void (*kRelease)(Handle)>
class EmbreeHandle {
 public:
  EmbreeHandle() = default;
  explicit EmbreeHandle(Handle handle) : handle_(handle) {}
  ~EmbreeHandle() {
    if (handle_ != nullptr) kRelease(handle_);
  }
  EmbreeHandle(EmbreeHandle&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  EmbreeHandle& operator=(EmbreeHandle&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  Handle get() const { return handle_; }
  explicit operator bool() const { return handle_ != nullptr; }

 private:
  Handle handle_ = nullptr;
};

using EmbreeDevice = EmbreeHandle<RTCDevice, rtcReleaseDevice>;
using EmbreeScene = EmbreeHandle<RTCScene, rtcReleaseScene>;
using EmbreeGeometry = EmbreeHandle<RTCGeometry, rtcReleaseGeometry>;

}  // namespace acentric
