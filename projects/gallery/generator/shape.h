#pragma once
/// Triangles under construction and the ways to make them: quads, boxes, turned bodies, mouldings, tubes,
/// grids. Metres, Z up, counter-clockwise = front. Texture coordinates are in metres on the surface (a
/// material says how many metres its picture covers), except where a function says otherwise.

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace acentric::gallery {

struct Shape {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uv;
  std::vector<glm::vec3> colours;  ///< linear; empty, or one a vertex
  std::vector<std::uint32_t> indices;

  std::uint32_t add(const glm::vec3& position, const glm::vec3& normal, const glm::vec2& texture);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void append(const Shape& other, const glm::mat4& placement = glm::mat4(1));
  /// Gives every vertex the colour that `colourOf` says.
  void paint(const std::function<glm::vec3(const glm::vec3& position, const glm::vec3& normal)>& colourOf);
};

/// Flat, corners counter-clockwise. Texture by the plane the quad faces most: right and up as one stands
/// before it.
void addQuad(Shape& out, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d);
/// Flat, with the whole picture on it: a is its bottom left, b its bottom right.
void addPicture(Shape& out, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d);

/// Axis-aligned, outside faces. `bevel` > 0 cuts every edge at 45 degrees.
void addBox(Shape& out, const glm::vec3& min, const glm::vec3& max, float bevel = 0);

/// Grid over (s, t) in [0,1]^2 of `f`, smooth normals facing dP/ds x dP/dt. Texture (s, t) * uvScale.
void addGrid(Shape& out, int columns, int rows, const std::function<glm::vec3(float s, float t)>& f,
             const glm::vec2& uvScale = glm::vec2(1));

/// Turned on a lathe about the z axis: `profile` is (radius, z), listed upwards for an outside surface.
/// Corners sharper than 35 degrees stay sharp.
Shape lathe(std::span<const glm::vec2> profile, int segments);

/// A moulding around the rectangle [-half, half] in xy, mitred at the corners: `profile` is (distance inwards
/// from the rectangle, z). Its face is to the right of the profile's direction in that plane: listed upwards
/// it faces inwards.
Shape moulding(const glm::vec2& half, std::span<const glm::vec2> profile);

/// A round rod along `points`.
Shape tube(std::span<const glm::vec3> points, float radius, int sides, bool closed = false);

/// A closed body about the origin: radius(direction) metres in each direction.
Shape blob(int columns, int rows, const std::function<float(const glm::vec3& direction)>& radius);

glm::mat4 moved(float x, float y, float z);
glm::mat4 turned(float degrees);  ///< about z
/// Moves the xy plane to a wall: x stays level and points right as one stands before it, z becomes the way
/// `normal` (level, unit) points, y becomes up; the origin goes to `centre`.
glm::mat4 onWall(const glm::vec3& centre, const glm::vec3& normal);

}  // namespace acentric::gallery
