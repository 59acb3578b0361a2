#pragma once
/// What the bake's pruning keeps, asked surface by surface. Injected, since inspect does not trace;
/// engine/pipeline wires it to the very test of the bake.

#include <cstddef>
#include <glm/glm.hpp>

#include "engine/inspect/opaque_tracer.h"

namespace acentric {

class CaptureSight {
 public:
  virtual ~CaptureSight() = default;
  /// Is a surface that a camera's ray (unit direction) meets at `point` kept for one of the camera's roles,
  /// because a test eye of the role's region sees it? Safe from several threads, as the others.
  virtual bool keeps(int camera, std::size_t role, const glm::dvec3& point, const OpaqueHit& hit,
                     const glm::dvec3& direction) const = 0;
  /// The same of the sky in a direction (unit).
  virtual bool keepsSky(int camera, std::size_t role, const glm::dvec3& direction) const = 0;
  /// Share of a distance: surfaces that follow each other more closely along a camera's ray pass for one.
  virtual double rightBehind(int camera) const = 0;
};

}  // namespace acentric
