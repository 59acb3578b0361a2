#pragma once
/// Scenes of axis-aligned solid boxes and single triangles with a ray probe worked out by hand: the truth for
/// the tests of floors, storeys and placement.

#include <vector>

#include "engine/inspect/walkable_outline.h"

namespace acentric::test {

struct Box {
  glm::dvec3 min, max;
};

/// A sheet: its front is where its corners run counter-clockwise.
struct Sheet {
  glm::dvec3 a, b, c;
};

struct BoxWorld {
  std::vector<Box> boxes;
  std::vector<Sheet> sheets;

  Bounds bounds() const {
    Bounds all;
    for (const Box& box : boxes) all.add(glm::vec3(box.min)), all.add(glm::vec3(box.max));
    for (const Sheet& sheet : sheets)
      for (const glm::dvec3& corner : {sheet.a, sheet.b, sheet.c}) all.add(glm::vec3(corner));
    return all;
  }

  /// Two sheets with corners a, b, c, d in order.
  void addQuad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    sheets.push_back({a, b, c}), sheets.push_back({a, c, d});
  }

  /// A box of sheets, as a closed sky box is: its fronts outwards.
  void addShell(const glm::dvec3& low, const glm::dvec3& high) {
    const auto at = [&](int x, int y, int z) {
      return glm::dvec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
    };
    addQuad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
    addQuad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
    addQuad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
    addQuad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
    addQuad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
    addQuad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
  }

  /// A room open to the sky, its corner at `low`: a floor that faces up and four walls that face inwards.
  void addCourt(const glm::dvec3& low, double width, double height) {
    const glm::dvec3 x(width, 0, 0), y(0, width, 0), z(0, 0, height);
    addQuad(low, low + x, low + x + y, low + y);
    addQuad(low, low + z, low + z + x, low + x);
    addQuad(low + y, low + y + x, low + y + x + z, low + y + z);
    addQuad(low, low + y, low + y + z, low + z);
    addQuad(low + x, low + x + z, low + x + y + z, low + x + y);
  }

  /// Nearest side of any box, from outside or inside, or sheet.
  SurfaceProbe probe() const {
    return [this](const glm::dvec3& origin, const glm::dvec3& direction) {
      SurfaceHit nearest;
      for (const Box& box : boxes) meet(box, origin, direction, nearest);
      for (const Sheet& sheet : sheets) meet(sheet, origin, direction, nearest);
      return nearest;
    };
  }

  static void meet(const Box& box, const glm::dvec3& origin, const glm::dvec3& direction,
                   SurfaceHit& nearest) {
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    int enterAxis = 0, leaveAxis = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) {
        if (!(origin[axis] > box.min[axis] && origin[axis] < box.max[axis])) return;
        continue;
      }
      const double a = (box.min[axis] - origin[axis]) / direction[axis];
      const double b = (box.max[axis] - origin[axis]) / direction[axis];
      if (std::min(a, b) > enter) enter = std::min(a, b), enterAxis = axis;
      if (std::max(a, b) < leave) leave = std::max(a, b), leaveAxis = axis;
    }
    if (enter > leave || leave < 0) return;
    const bool fromOutside = enter >= 0;
    const double distance = fromOutside ? enter : leave;
    if (distance >= nearest.distance) return;
    const int axis = fromOutside ? enterAxis : leaveAxis;
    nearest = {distance, glm::dvec3(0)};
    nearest.normal[axis] = (direction[axis] > 0) == fromOutside ? -1 : 1;
  }

  /// Two sheets leave no gap at the edge that they share, as no tracer of ours does: a point counts that lies
  /// outside by this share of the sheet's size.
  static constexpr double kOnEdge = 1e-9;

  static void meet(const Sheet& sheet, const glm::dvec3& origin, const glm::dvec3& direction,
                   SurfaceHit& nearest) {
    const glm::dvec3 normal = glm::cross(sheet.b - sheet.a, sheet.c - sheet.a);
    const double along = glm::dot(normal, direction);
    if (along == 0) return;
    const double distance = glm::dot(normal, sheet.a - origin) / along;
    if (distance < 0 || distance >= nearest.distance) return;
    const glm::dvec3 at = origin + distance * direction;
    for (const auto& [from, to] :
         {std::pair{sheet.a, sheet.b}, std::pair{sheet.b, sheet.c}, std::pair{sheet.c, sheet.a}})
      if (glm::dot(glm::cross(to - from, at - from), normal) < -kOnEdge * glm::dot(normal, normal)) return;
    nearest = {distance, glm::normalize(normal)};
  }

  /// A room [0,w] x [0,d], floor at z = 0, with walls, floor and ceiling 0.2 m thick.
  static BoxWorld room(double w, double d, double height) {
    const double t = 0.2;
    return {{{{-t, -t, -t}, {w + t, d + t, 0}},
             {{-t, -t, height}, {w + t, d + t, height + t}},
             {{-t, -t, 0}, {0, d + t, height}},
             {{w, -t, 0}, {w + t, d + t, height}},
             {{0, -t, 0}, {w, 0, height}},
             {{0, d, 0}, {w, d + t, height}}},
            {}};
  }
};

}  // namespace acentric::test
