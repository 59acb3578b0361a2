#pragma once
/// A Scene made traceable (Embree) for one EffectPlan. Immutable; tracing is safe from any number of threads.

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/base/result.h"
#include "engine/scene/effect_plan.h"
#include "engine/scene/scene.h"
#include "engine/scene/triangle_normal.h"

namespace acentric {

struct Ray {
  glm::vec3 origin;
  glm::vec3 direction;  ///< unit
  float nearest = 0;    ///< metres
  float farthest = std::numeric_limits<float>::infinity();
};

struct Hit {
  float distance = std::numeric_limits<float>::infinity();  ///< metres; infinity = none
  std::uint32_t mesh = 0;  ///< placed mesh: one of the scene's own, or an instance (placed_mesh.h)
  std::uint32_t triangle = 0;
  glm::vec2 barycentric{0};  ///< weights of corner 2 and 3
  glm::vec3 across{0};       ///< normal to the triangle as wound (front side), of any length
  glm::vec3 geometricNormal() const { return unitNormal(across); }
  bool found() const { return distance < std::numeric_limits<float>::infinity(); }
};

/// Rays from one place in neighbouring directions, traced together.
struct RayPacket {
  static constexpr int kSize = 8;
  glm::vec3 origin{0};
  std::array<glm::vec3, kSize> direction;  ///< unit
  std::array<float, kSize> nearest{};      ///< metres
  int count = 0;                           ///< of them that are traced
};

/// Rays traced, by purpose; a plan that lacks an effect traces none of its rays.
struct RayCounts {
  std::uint64_t primary = 0;
  std::uint64_t visibility = 0;  ///< from the regions' eyes, for pruning
  std::uint64_t shadow = 0;      ///< towards lights without size
  std::uint64_t softShadow = 0;  ///< towards lights with a size, and surfaces that glow
  std::uint64_t ambient = 0;
  std::uint64_t bounce = 0;
  std::uint64_t mirror = 0;
  std::uint64_t through = 0;   ///< of the others: those that met glass or a blended surface
  std::uint64_t gathered = 0;  ///< of the others: those that a place's light was gathered by, once for all
  double gatherSeconds = 0;    ///< of one thread, that these took with all that comes of them
  std::uint64_t total() const {
    return primary + visibility + shadow + softShadow + ambient + bounce + mirror;
  }
  RayCounts& operator+=(const RayCounts& other);
};

class AreaLights;
class RayLog;
class GatheredLight;
struct BakeSettings;

class RayScene {
 public:
  /// `log`: what is asked of the scene is added to it; it outlives the scene.
  static Result<std::shared_ptr<const RayScene>> build(ScenePtr scene, const EffectPlan& plan,
                                                       RayLog* log = nullptr);
  ~RayScene();

  const Scene& scene() const { return *scene_; }
  ScenePtr sharedScene() const { return scene_; }
  const EffectPlan& plan() const { return plan_; }
  const AreaLights& areaLights() const { return *areaLights_; }
  /// Light gathered from all around, kept from one asker to the next as long as the settings that shape it
  /// stay.
  std::shared_ptr<const GatheredLight> gatheredLight(const BakeSettings& settings) const;

  /// Nearest surface. Alpha-tested surfaces are cut out where the plan has alpha tests. Back sides count.
  Hit trace(const Ray& ray) const;
  /// The same for each ray of a packet; those beyond its count are left as they are.
  void trace(const RayPacket& rays, std::array<Hit, RayPacket::kSize>& hits) const;
  /// How many of them hit something: the ray tracer alone.
  int countHits(const RayPacket& rays) const;
  /// Fraction of light that passes, per channel: 0 behind an opaque surface, the tint behind glass or blended
  /// surfaces.
  glm::vec3 transmittance(const Ray& ray) const;
  /// Nearest surface that light does not pass.
  Hit traceSolid(const Ray& ray) const;
  /// Distance to the nearest occluder, alpha tests respected, transmissive surfaces ignored.
  float occluderDistance(const Ray& ray) const;
  /// The same for each ray of a packet.
  void occluderDistances(const RayPacket& rays, std::array<float, RayPacket::kSize>& distances) const;
  /// Is there an occluder nearer than the ray's end? Whichever is found first will do.
  bool isOccluded(const Ray& ray) const;
  /// Asks the ray tracer alone what a log holds: how many rays hit something.
  std::uint64_t replay(const RayLog& log) const;

 private:
  struct Embree;
  Hit trace(const Ray& ray, unsigned mask) const;
  void note(const Ray& ray, unsigned mask, bool nearest) const;
  void note(const RayPacket& rays, unsigned mask) const;
  glm::vec3 acrossOf(std::uint32_t placed, const glm::vec3& across) const;
  RayScene(ScenePtr scene, const EffectPlan& plan);
  ScenePtr scene_;
  EffectPlan plan_;
  std::unique_ptr<Embree> embree_;
  RayLog* log_ = nullptr;
  std::unique_ptr<const AreaLights> areaLights_;
  mutable std::mutex gatheredMutex_;
  mutable std::shared_ptr<const GatheredLight> gathered_;
};

using RayScenePtr = std::shared_ptr<const RayScene>;

}  // namespace acentric
