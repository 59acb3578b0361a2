#include "projects/gallery/generator/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace acentric::gallery {
namespace {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

glm::vec3 quadNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
  return glm::normalize(glm::cross(c - a, d - b));
}

/// Metres to the right and up on the plane that `normal` faces most.
glm::vec2 planarTexture(const glm::vec3& p, const glm::vec3& normal) {
  const glm::vec3 size = glm::abs(normal);
  if (size.z >= size.x && size.z >= size.y) return {p.x, -p.y};
  if (size.x >= size.y) return {normal.x > 0 ? p.y : -p.y, -p.z};
  return {normal.y > 0 ? -p.x : p.x, -p.z};
}

/// A profile cut into pieces at its sharp corners, with a normal (left of the direction of travel turned
/// right, that is: away from the axis for a profile listed upwards) at each end of each segment.
struct ProfileSegment {
  glm::vec2 from, to;
  glm::vec2 normalFrom, normalTo;
  float lengthFrom = 0, lengthTo = 0;
};

std::vector<ProfileSegment> segmentsOf(std::span<const glm::vec2> profile) {
  std::vector<ProfileSegment> segments;
  float length = 0;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const glm::vec2 along = profile[i + 1] - profile[i];
    const float step = glm::length(along);
    if (step < 1e-6f) continue;
    const glm::vec2 normal = glm::vec2(along.y, -along.x) / step;
    segments.push_back({profile[i], profile[i + 1], normal, normal, length, length + step});
    length += step;
  }
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
    const glm::vec2 a = segments[i].normalTo, b = segments[i + 1].normalFrom;
    if (glm::dot(a, b) > 0.82f && segments[i].to == segments[i + 1].from)
      segments[i].normalTo = segments[i + 1].normalFrom = glm::normalize(a + b);
  }
  return segments;
}

}  // namespace

std::uint32_t Shape::add(const glm::vec3& position, const glm::vec3& normal, const glm::vec2& texture) {
  positions.push_back(position);
  normals.push_back(normal);
  uv.push_back(texture);
  return static_cast<std::uint32_t>(positions.size() - 1);
}

void Shape::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (positions[a] == positions[b] || positions[b] == positions[c] || positions[a] == positions[c]) return;
  indices.insert(indices.end(), {a, b, c});
}

void Shape::append(const Shape& other, const glm::mat4& placement) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  const glm::mat3 linear(placement);
  const glm::mat3 forNormals = glm::transpose(glm::inverse(linear));
  const bool mirrored = glm::determinant(linear) < 0;
  if (!other.colours.empty()) colours.resize(first, glm::vec3(1));
  for (std::size_t i = 0; i < other.positions.size(); ++i)
    add(glm::vec3(placement * glm::vec4(other.positions[i], 1)),
        glm::normalize(forNormals * other.normals[i]), other.uv[i]);
  colours.insert(colours.end(), other.colours.begin(), other.colours.end());
  if (!colours.empty()) colours.resize(positions.size(), glm::vec3(1));
  for (std::size_t i = 0; i + 2 < other.indices.size(); i += 3) {
    indices.push_back(first + other.indices[i]);
    indices.push_back(first + other.indices[i + (mirrored ? 2 : 1)]);
    indices.push_back(first + other.indices[i + (mirrored ? 1 : 2)]);
  }
}

void Shape::paint(const std::function<glm::vec3(const glm::vec3&, const glm::vec3&)>& colourOf) {
  colours.clear();
  for (std::size_t i = 0; i < positions.size(); ++i) colours.push_back(colourOf(positions[i], normals[i]));
}

void addQuad(Shape& out, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
  const glm::vec3 normal = quadNormal(a, b, c, d);
  std::array<std::uint32_t, 4> v{};
  const std::array<glm::vec3, 4> corners{a, b, c, d};
  for (std::size_t i = 0; i < 4; ++i) v[i] = out.add(corners[i], normal, planarTexture(corners[i], normal));
  out.triangle(v[0], v[1], v[2]);
  out.triangle(v[0], v[2], v[3]);
}

void addPicture(Shape& out, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
  const glm::vec3 normal = quadNormal(a, b, c, d);
  const auto va = out.add(a, normal, {0, 1}), vb = out.add(b, normal, {1, 1});
  const auto vc = out.add(c, normal, {1, 0}), vd = out.add(d, normal, {0, 0});
  out.triangle(va, vb, vc);
  out.triangle(va, vc, vd);
}

void addBox(Shape& out, const glm::vec3& min, const glm::vec3& max, float bevel) {
  const glm::vec3 centre = 0.5f * (min + max);
  const glm::vec3 half = 0.5f * (max - min);
  const float cut = std::min({bevel, half.x, half.y, half.z});
  // A point of the box by signs; `full` tells in which axes it reaches the outer face.
  const auto at = [&](const glm::vec3& sign, const glm::vec3& full) {
    return centre + sign * (half - cut * (1.0f - full));
  };
  const auto axis = [](int i) {
    glm::vec3 v(0);
    v[i] = 1;
    return v;
  };
  const auto emit = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    const glm::vec3 outward = 0.25f * (a + b + c + d) - centre;
    if (glm::dot(glm::cross(c - a, d - b), outward) > 0)
      addQuad(out, a, b, c, d);
    else
      addQuad(out, a, d, c, b);
  };
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (const float side : {-1.0f, 1.0f}) {
      const auto corner = [&](float sj, float sk) {
        return at(side * axis(i) + sj * axis(j) + sk * axis(k), axis(i));
      };
      emit(corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1));
      if (cut <= 0) continue;
      // The bevel between this face and the next axis' faces; each pair once.
      for (const float other : {-1.0f, 1.0f}) {
        const auto edge = [&](float sk, int full) {
          return at(side * axis(i) + other * axis(j) + sk * axis(k), axis(full));
        };
        emit(edge(-1, i), edge(1, i), edge(1, j), edge(-1, j));
      }
    }
  }
  if (cut <= 0) return;
  for (int bits = 0; bits < 8; ++bits) {
    const glm::vec3 sign((bits & 1) ? 1 : -1, (bits & 2) ? 1 : -1, (bits & 4) ? 1 : -1);
    const std::array<glm::vec3, 3> p{at(sign, axis(0)), at(sign, axis(1)), at(sign, axis(2))};
    const glm::vec3 normal = glm::normalize(sign);
    std::array<std::uint32_t, 3> v{};
    for (std::size_t i = 0; i < 3; ++i) v[i] = out.add(p[i], normal, planarTexture(p[i], normal));
    if (sign.x * sign.y * sign.z > 0)
      out.triangle(v[0], v[1], v[2]);
    else
      out.triangle(v[0], v[2], v[1]);
  }
}

void addGrid(Shape& out, int columns, int rows, const std::function<glm::vec3(float, float)>& f,
             const glm::vec2& uvScale) {
  const auto first = static_cast<std::uint32_t>(out.positions.size());
  constexpr float kStep = 1e-3f;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const float s = static_cast<float>(column) / static_cast<float>(columns);
      const float t = static_cast<float>(row) / static_cast<float>(rows);
      const glm::vec3 ds = f(s + kStep, t) - f(s - kStep, t);
      const glm::vec3 dt = f(s, t + kStep) - f(s, t - kStep);
      glm::vec3 normal = glm::cross(ds, dt);
      // At a pole one derivative vanishes: look a little beside it.
      if (glm::dot(normal, normal) < 1e-30f) {
        const float beside = t < 0.5f ? t + 0.01f : t - 0.01f;
        normal = glm::cross(f(s + kStep, beside) - f(s - kStep, beside),
                            f(s, beside + kStep) - f(s, beside - kStep));
      }
      out.add(f(s, t), glm::normalize(normal), glm::vec2(s, t) * uvScale);
    }
  const auto at = [&](int column, int row) {
    return first + static_cast<std::uint32_t>(row * (columns + 1) + column);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      out.triangle(at(column, row), at(column + 1, row), at(column + 1, row + 1));
      out.triangle(at(column, row), at(column + 1, row + 1), at(column, row + 1));
    }
}

Shape lathe(std::span<const glm::vec2> profile, int segments) {
  Shape out;
  for (const ProfileSegment& s : segmentsOf(profile)) {
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    const float around = kTurn * std::max(s.from.x, s.to.x);
    for (int i = 0; i <= segments; ++i) {
      const float turn = static_cast<float>(i) / static_cast<float>(segments);
      // The last ring of vertices meets the first exactly.
      const float angle = i == segments ? 0.0f : kTurn * turn;
      const glm::vec2 spoke(std::cos(angle), std::sin(angle));
      const auto put = [&](const glm::vec2& p, const glm::vec2& n, float length) {
        out.add({spoke * p.x, p.y}, {spoke * n.x, n.y}, {turn * around, -length});
      };
      put(s.from, s.normalFrom, s.lengthFrom);
      put(s.to, s.normalTo, s.lengthTo);
    }
    for (int i = 0; i < segments; ++i) {
      const std::uint32_t v = first + 2 * static_cast<std::uint32_t>(i);
      out.triangle(v, v + 2, v + 3);
      out.triangle(v, v + 3, v + 1);
    }
  }
  return out;
}

Shape moulding(const glm::vec2& half, std::span<const glm::vec2> profile) {
  Shape out;
  const std::array<glm::vec2, 5> corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
  const std::array<glm::vec2, 4> inwards{{{0, 1}, {-1, 0}, {0, -1}, {1, 0}}};
  for (const ProfileSegment& s : segmentsOf(profile))
    for (std::size_t side = 0; side < 4; ++side) {
      const auto place = [&](const glm::vec2& corner, const glm::vec2& p) {
        return glm::vec3(corner * (half - p.x), p.y);
      };
      const auto put = [&](const glm::vec2& corner, const glm::vec2& p, const glm::vec2& n, float length) {
        const glm::vec3 position = place(corner, p);
        const float along = (side % 2 == 0) ? position.x : position.y;
        return out.add(position, glm::vec3(inwards[side] * n.x, n.y), {along, length});
      };
      const auto a = put(corners[side], s.from, s.normalFrom, s.lengthFrom);
      const auto b = put(corners[side + 1], s.from, s.normalFrom, s.lengthFrom);
      const auto c = put(corners[side + 1], s.to, s.normalTo, s.lengthTo);
      const auto d = put(corners[side], s.to, s.normalTo, s.lengthTo);
      // Which way round faces along the normal depends on the profile's direction.
      const glm::vec3 across =
          glm::cross(out.positions[b] - out.positions[a], out.positions[d] - out.positions[a]);
      if (glm::dot(across, out.normals[a] + out.normals[d]) > 0) {
        out.triangle(a, b, c);
        out.triangle(a, c, d);
      } else {
        out.triangle(a, c, b);
        out.triangle(a, d, c);
      }
    }
  return out;
}

Shape tube(std::span<const glm::vec3> points, float radius, int sides, bool closed) {
  Shape out;
  const std::size_t count = points.size();
  const auto tangentAt = [&](std::size_t i) {
    const std::size_t before = i > 0 ? i - 1 : (closed ? count - 1 : 0);
    const std::size_t after = i + 1 < count ? i + 1 : (closed ? 0 : count - 1);
    return glm::normalize(points[after] - points[before]);
  };
  // A frame carried along without twisting.
  glm::vec3 tangent = tangentAt(0);
  glm::vec3 side = std::abs(tangent.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  side = glm::normalize(side - tangent * glm::dot(side, tangent));
  float length = 0;
  const std::size_t rings = closed ? count + 1 : count;
  for (std::size_t ring = 0; ring < rings; ++ring) {
    const std::size_t i = ring % count;
    tangent = tangentAt(i);
    side = glm::normalize(side - tangent * glm::dot(side, tangent));
    const glm::vec3 other = glm::cross(tangent, side);
    if (ring > 0) length += glm::length(points[i] - points[(ring - 1) % count]);
    for (int s = 0; s <= sides; ++s) {
      const float angle = s == sides ? 0.0f : kTurn * static_cast<float>(s) / static_cast<float>(sides);
      const glm::vec3 normal = std::cos(angle) * side + std::sin(angle) * other;
      out.add(points[i] + radius * normal, normal,
              {kTurn * radius * static_cast<float>(s) / static_cast<float>(sides), length});
    }
  }
  const auto stride = static_cast<std::uint32_t>(sides + 1);
  for (std::uint32_t ring = 0; ring + 1 < static_cast<std::uint32_t>(rings); ++ring)
    for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(sides); ++s) {
      const std::uint32_t a = ring * stride + s, b = a + 1, c = a + stride + 1, d = a + stride;
      out.triangle(a, b, c);
      out.triangle(a, c, d);
    }
  return out;
}

Shape blob(int columns, int rows, const std::function<float(const glm::vec3&)>& radius) {
  Shape out;
  addGrid(
      out, columns, rows,
      [&](float s, float t) {
        const float azimuth = kTurn * (s - std::floor(s));
        const float polar = 0.5f * kTurn * std::clamp(1 - t, 0.0f, 1.0f);
        const float ring = t <= 0 || t >= 1 ? 0.0f : std::sin(polar);
        const glm::vec3 direction(ring * std::cos(azimuth), ring * std::sin(azimuth), std::cos(polar));
        return radius(direction) * direction;
      },
      glm::vec2(2, 1));
  return out;
}

glm::mat4 moved(float x, float y, float z) { return glm::translate(glm::mat4(1), glm::vec3(x, y, z)); }
glm::mat4 turned(float degrees) {
  return glm::rotate(glm::mat4(1), glm::radians(degrees), glm::vec3(0, 0, 1));
}

glm::mat4 onWall(const glm::vec3& centre, const glm::vec3& normal) {
  const glm::vec3 up(0, 0, 1);
  const glm::vec3 right = glm::cross(up, normal);
  return glm::mat4(glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(normal, 0), glm::vec4(centre, 1));
}

}  // namespace acentric::gallery
