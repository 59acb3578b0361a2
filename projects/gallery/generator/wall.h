#pragma once
/// Walls with openings, seen from one side, and what runs along them.

#include <glm/glm.hpp>
#include <span>

#include "projects/gallery/generator/shape.h"

namespace acentric::gallery {

/// Rectangular up to `head`; an arched one goes on as a half circle above it.
struct Opening {
  float centre = 0;  ///< along the wall
  float half = 0;    ///< half its width
  float sill = 0;
  float head = 0;
  bool arched = false;
};

/// An upright plane seen from where `normal` points. u runs to the right as one stands before it, from
/// `origin`.
struct WallSide {
  glm::vec3 origin{0};
  glm::vec3 normal{0, -1, 0};  ///< level, unit
  glm::vec3 along() const { return glm::cross(glm::vec3(0, 0, 1), normal); }
  /// `out` metres before the wall.
  glm::vec3 at(float u, float z, float out = 0) const {
    return origin + along() * u + glm::vec3(0, 0, z) + normal * out;
  }
};

/// The quad, turned so that it faces `towards`.
void addQuadFacing(Shape& shape, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                   const glm::vec3& d, const glm::vec3& towards);

/// The wall's surface between two u and two z, without the openings.
void addWall(Shape& shape, const WallSide& side, float uFrom, float uTo, float zFrom, float zTo,
             std::span<const Opening> openings = {});

/// The inside of an opening, `depth` metres into the wall; with its sill if it has one above the floor or
/// `withSill`.
void addReveal(Shape& shape, const WallSide& side, const Opening& opening, float depth, bool withSill = true);

/// A straight moulding along the wall: `profile` is (metres before the wall, z), listed upwards.
void addRail(Shape& shape, const WallSide& side, float uFrom, float uTo, std::span<const glm::vec2> profile);

/// A moulding around an opening's sides and top: `profile` is (metres away from the opening, metres before
/// the wall), listed from the opening outwards.
void addSurround(Shape& shape, const WallSide& side, const Opening& opening,
                 std::span<const glm::vec2> profile);

}  // namespace acentric::gallery
