#pragma once
/// Light from surfaces that glow (Effect::areaLights). A hierarchy over the emitting triangles: at a shaded
/// point it is cut where its parts are small against their distance. What a near triangle sends is known in
/// closed form (Lambert), what a far group sends by its intensity in that direction; so without shadows
/// nothing is sampled at all. Shadow rays are dealt out in proportion to what each part sends and tell only
/// which share arrives: where nothing is in the way the light is free of noise.

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/bake/position_samples.h"
#include "engine/bake/surface.h"
#include "engine/scene/effect_plan.h"
#include "engine/scene/scene.h"

namespace acentric {

class RayScene;
struct RayCounts;

class AreaLights {
 public:
  AreaLights() = default;
  /// Nothing where the plan has area lights off.
  AreaLights(const Scene& scene, const EffectPlan& plan);
  bool empty() const { return emitters_.empty(); }
  /// Does this mesh's glow arrive through here?
  bool include(std::uint32_t mesh) const {
    return !empty() && mesh < lighting_.size() && lighting_[mesh] != 0;  // else an instance
  }

  /// Irradiance with nothing in between; not of an empty set.
  glm::vec3 irradiance(const Surface& surface) const;
  /// Irradiance with shadows, by `count` rays.
  glm::vec3 irradiance(const RayScene& scene, const Surface& surface, const PositionSamples& samples,
                       int count, RayCounts& rays) const;

 private:
  struct Emitter {
    glm::vec3 corners[3];
    glm::vec3 normal;
    glm::vec3 radiance;
    float area = 0;
    bool twoSided = false;
    glm::vec3 middle() const;
    double power() const;  ///< luminance of radiance * area
  };
  struct Node {
    glm::vec3 centre{0};
    float radius = 0;  ///< of a sphere around all of it
    std::uint32_t first = 0, count = 0;
    std::uint32_t second = 0;  ///< second child; the first follows its parent; 0 = a single emitter
    std::int32_t table = -1;   ///< intensities by direction; -1 = none
    glm::vec3 strength{0};     ///< sum of radiance * area
    float power = 0;           ///< its luminance
  };
  /// What of an emitter tells how much it sends in a direction.
  struct Facet {
    glm::vec3 normal;
    float power = 0;  ///< luminance of radiance * area
    float back = 0;   ///< -1 if both sides glow, else 0
    float shareOf(const glm::vec3& direction) const;
  };
  struct Estimate {
    glm::vec3 irradiance{0};
    float error = 0;
    bool far = false;  ///< taken as a point
  };
  /// The hierarchy is cut into no more parts than this.
  static constexpr std::size_t kMostParts = 96;
  /// A part of the cut, and what it sends here.
  struct Part {
    glm::vec3 irradiance;
    float upTo = 0;  ///< weights of the parts before and of this one
    std::uint32_t node = 0;
    bool far = false;
  };
  /// Each surface has its own: not worth a visit to the heap.
  class Cut {
   public:
    void add(const Part& part) { parts_[count_++] = part; }
    bool empty() const { return count_ == 0; }
    const Part* begin() const { return parts_.data(); }
    const Part* end() const { return parts_.data() + count_; }
    const Part& back() const { return parts_[count_ - 1]; }

   private:
    std::array<Part, kMostParts> parts_;
    std::size_t count_ = 0;
  };
  struct Sample {
    glm::vec3 target{0};
    float weight = 0;  ///< relative to the part's mean; 0 = cannot arrive
  };

  std::uint32_t split(std::uint32_t first, std::uint32_t count);
  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  void fillTable(std::uint32_t index);
  float shareTowards(const Node& node, const glm::vec3& direction) const;
  Estimate estimate(std::uint32_t index, const Surface& surface) const;
  Cut cut(const Surface& surface) const;
  Sample sample(const Part& part, const Surface& surface, glm::vec2 u) const;

  std::vector<std::uint8_t> lighting_;  ///< by mesh
  std::vector<Emitter> emitters_;       ///< in the order of the hierarchy
  std::vector<Facet> facets_;           ///< of these
  std::vector<double> strengthBefore_;  ///< of emitters [0, i), summed luminance * area
  std::vector<Node> nodes_;
  std::vector<float> tables_;
};

}  // namespace acentric
