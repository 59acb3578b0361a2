#pragma once
/// What a RayScene was asked, kept so that the ray tracer alone can be asked it again (RayScene::replay): how
/// much of the time of whoever asked is the tracer's. Of all that is asked some runs are kept, so that
/// neighbouring rays stay neighbours. Of one thread.

#include <cstdint>
#include <vector>

#include "engine/bake/ray_scene.h"

namespace acentric {

class RayLog {
 public:
  /// Rays of which one run in kEvery is kept.
  static constexpr std::uint64_t kRun = 1024, kEvery = 16;

  enum class Asked : std::uint8_t { nearest, passing };  ///< the nearest hit, or whether there is one
  struct Single {
    Ray ray;
    unsigned mask = 0;
    Asked asked = Asked::nearest;
  };
  struct Together {
    RayPacket rays;
    unsigned mask = 0;
  };

  void add(const Ray& ray, unsigned mask, Asked asked) {
    if (isKept(1)) singles_.push_back({ray, mask, asked});
  }
  void add(const RayPacket& rays, unsigned mask) {
    if (isKept(std::uint64_t(rays.count))) packets_.push_back({rays, mask});
  }
  void clear() { *this = {}; }

  const std::vector<Single>& singles() const { return singles_; }
  const std::vector<Together>& packets() const { return packets_; }
  /// Rays asked about over rays kept.
  double scale() const { return kept_ > 0 ? double(asked_) / double(kept_) : 0; }

 private:
  bool isKept(std::uint64_t rays) {
    const bool kept = asked_ / kRun % kEvery == 0;
    asked_ += rays;
    kept_ += kept ? rays : 0;
    return kept;
  }

  std::vector<Single> singles_;
  std::vector<Together> packets_;
  std::uint64_t asked_ = 0, kept_ = 0;
};

}  // namespace acentric
