#pragma once
/// What a bake's threads gather of some neighbouring columns each, and how it becomes one capture.

#include <stop_token>

#include "engine/bake/bake.h"
#include "engine/base/memory_budget.h"
#include "engine/base/task_runner.h"
#include "engine/image/capture.h"

namespace acentric {

/// In capture order.
struct SampleList {
  std::vector<std::uint32_t> perColumn;
  std::vector<std::uint16_t> row;
  std::vector<float> inverseDistance;
  std::vector<HalfColour> colour;
  std::vector<std::uint8_t> roles;
  std::vector<std::uint8_t> mirror;  ///< in a scene with flat mirrors
  std::vector<std::uint32_t> plane;  ///< where silhouettes are asked for, into `planes`
  std::vector<SurfacePlane> planes;  ///< most of them once

  void reserve(std::size_t samples);
  /// Gives back what was reserved in vain, where it is much: a copy takes time.
  void trim();
  std::size_t heldSamples() const { return row.capacity(); }
  [[gnu::always_inline]] void add(int r, float w, const HalfColour& packed, std::uint8_t mask) {
    row.push_back(std::uint16_t(r));
    inverseDistance.push_back(w);
    colour.push_back(packed);
    roles.push_back(mask);
  }
  /// Of the sample added last.
  void addPlane(const SurfacePlane& itsPlane) {
    if (planes.empty() || planes.back() != itsPlane) planes.push_back(itsPlane);
    plane.push_back(std::uint32_t(planes.size() - 1));
  }
};

struct ChunkSamples : SampleList {
  BackgroundBuilder background;
  SampleList reflections;  ///< in a scene with flat mirrors
  CaptureCounts counts;
  MemoryBudget::Share held;

  /// Of a sample that belongs to a mirror.
  static constexpr std::size_t kBytes = kCaptureSampleBytes + sizeof(std::uint8_t);
  static constexpr std::size_t kSilhouetteBytes = sizeof(std::uint16_t) + sizeof(std::uint32_t);

  /// No more will come.
  void close();
};

/// All chunks behind one another: samples, background (without its sky) and, if there are any, reflections.
/// Only a part when stopped.
Capture joined(const std::vector<ChunkSamples>& chunks, bool reflections, TaskRunner& runner,
               const std::stop_token& stop);

}  // namespace acentric
