#pragma once
/// Scenes of axis-aligned boxes with a ray probe worked out by hand: the truth for the walkable area's tests.

#include <vector>

#include "engine/inspect/walkable_outline.h"

namespace acentric::test {

struct Box {
  glm::dvec3 min, max;
};

struct BoxWorld {
  std::vector<Box> boxes;

  Bounds bounds() const {
    Bounds all;
    for (const Box& box : boxes) all.add(glm::vec3(box.min)), all.add(glm::vec3(box.max));
    return all;
  }

  /// Nearest side of any box, from outside or inside.
  DistanceProbe probe() const {
    return [this](const glm::dvec3& origin, const glm::dvec3& direction) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Box& box : boxes) {
        double enter = -nearest, leave = nearest;
        bool hit = true;
        for (int axis = 0; axis < 3; ++axis) {
          if (direction[axis] == 0) {
            hit &= origin[axis] > box.min[axis] && origin[axis] < box.max[axis];
            continue;
          }
          const double a = (box.min[axis] - origin[axis]) / direction[axis];
          const double b = (box.max[axis] - origin[axis]) / direction[axis];
          enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
        }
        if (!hit || enter > leave || leave < 0) continue;
        nearest = std::min(nearest, enter >= 0 ? enter : leave);
      }
      return nearest;
    };
  }

  /// A room [0,w] x [0,d], floor at z = 0, with walls, floor and ceiling 0.2 m thick.
  static BoxWorld room(double w, double d, double height) {
    const double t = 0.2;
    return {{{{-t, -t, -t}, {w + t, d + t, 0}},
             {{-t, -t, height}, {w + t, d + t, height + t}},
             {{-t, -t, 0}, {0, d + t, height}},
             {{w, -t, 0}, {w + t, d + t, height}},
             {{0, -t, 0}, {w, 0, height}},
             {{0, d, 0}, {w, d + t, height}}}};
  }
};

}  // namespace acentric::test
