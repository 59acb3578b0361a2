#include "engine/scene/mesh_cleaning.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace acentric {
namespace {

/// Beyond this a position is as broken as an infinite one (a light-hour in metres).
constexpr double kFarthest = 1e12;
constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

template <class T>
void gather(MeshArray<T>& values, const std::vector<std::uint32_t>& from) {
  if (values.empty()) return;
  std::vector<T> out(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) out[i] = values[from[i]];
  values = std::move(out);
}

/// New corner i is old corner from[i], in every array.
void gatherCorners(Mesh& mesh, const std::vector<std::uint32_t>& from) {
  gather(mesh.positions, from);
  gather(mesh.normals, from);
  gather(mesh.tangents, from);
  gather(mesh.uv[0], from);
  gather(mesh.uv[1], from);
  gather(mesh.colours, from);
}

glm::dvec3 areaVector(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return glm::cross(b - a, c - a);
}

/// No area to speak of: its normal would be rounding noise.
bool isDegenerate(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  const double longest = std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
  const double area = glm::length(glm::cross(b - a, c - a));
  return !(area > 1e-10 * longest) || longest == 0;
}

void dropUnusedCorners(Mesh& mesh) {
  std::vector<std::uint32_t> newIndex(mesh.positions.size(), kUnused);
  std::vector<std::uint32_t> from;
  for (glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      std::uint32_t& index = newIndex[triangle[corner]];
      if (index == kUnused) {
        index = std::uint32_t(from.size());
        from.push_back(triangle[corner]);
      }
    }
  if (from.size() == mesh.positions.size()) return;
  for (glm::uvec3& triangle : mesh.triangles)
    triangle = {newIndex[triangle.x], newIndex[triangle.y], newIndex[triangle.z]};
  gatherCorners(mesh, from);
}

/// Each triangle gets corners of its own with its own normal.
void makeFlatNormals(Mesh& mesh) {
  std::vector<std::uint32_t> from;
  from.reserve(3 * mesh.triangles.size());
  std::vector<glm::vec3> normals;
  normals.reserve(from.capacity());
  for (glm::uvec3& triangle : mesh.triangles) {
    const glm::vec3 normal(glm::normalize(areaVector(mesh, triangle)));
    for (int corner = 0; corner < 3; ++corner) {
      from.push_back(triangle[corner]);
      normals.push_back(normal);
    }
    const auto last = std::uint32_t(from.size());
    triangle = {last - 3, last - 2, last - 1};
  }
  gatherCorners(mesh, from);
  mesh.normals = std::move(normals);
}

/// Unit normals; one that is zero or not finite becomes the mean of the triangles around it.
void repairNormals(Mesh& mesh) {
  bool broken = false;
  for (glm::vec3& n : mesh.normals) {
    const float length = glm::length(n);
    const bool sound = std::isfinite(length) && length > 1e-6f;
    n = sound ? n / length : glm::vec3(0);
    broken = broken || !sound;
  }
  if (!broken) return;
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) sums[triangle[corner]] += areaVector(mesh, triangle);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (mesh.normals[i] != glm::vec3(0)) continue;
    const double length = glm::length(sums[i]);
    mesh.normals[i] = length > 0 ? glm::vec3(sums[i] / length) : glm::vec3(0, 0, 1);
  }
}

glm::vec3 anyPerpendicular(const glm::vec3& n) {
  const glm::vec3 axis = std::abs(n.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  return glm::normalize(glm::cross(n, axis));
}

struct UvFrame {
  glm::dvec3 tangent{0};  ///< along u, scaled by the triangle's area
  float handedness = 0;   ///< of the uv map; 0 = it is flat here
};

UvFrame uvFrame(const Mesh& mesh, const glm::uvec3& t, std::span<const glm::vec2> uv) {
  const glm::dvec3 p1 = glm::dvec3(mesh.positions[t.y]) - glm::dvec3(mesh.positions[t.x]);
  const glm::dvec3 p2 = glm::dvec3(mesh.positions[t.z]) - glm::dvec3(mesh.positions[t.x]);
  const glm::dvec2 u1(uv[t.y] - uv[t.x]), u2(uv[t.z] - uv[t.x]);
  const double determinant = u1.x * u2.y - u1.y * u2.x;
  if (determinant == 0 || !std::isfinite(determinant)) return {};
  UvFrame out;
  // v runs down in the texture, the bitangent runs up: the sign of cross(n, t) is the other way round.
  out.handedness = determinant > 0 ? -1 : 1;
  const glm::dvec3 along = (u2.y * p1 - u1.y * p2) * (determinant > 0 ? 1.0 : -1.0);
  const double length = glm::length(along);
  if (length > 0) out.tangent = along / length * glm::length(glm::cross(p1, p2));
  return out;
}

/// Area-weighted tangents; corners shared by triangles whose uv maps are mirror images are split.
void makeTangents(Mesh& mesh, std::span<const glm::vec2> sourceUv, const glm::mat3x2& uvTransform) {
  std::vector<glm::vec2> uv(sourceUv.size());
  for (std::size_t i = 0; i < uv.size(); ++i) uv[i] = uvTransform * glm::vec3(sourceUv[i], 1);
  const std::size_t corners = mesh.positions.size();
  std::vector<UvFrame> frames(mesh.triangles.size());
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i] = uvFrame(mesh, mesh.triangles[i], uv);

  std::vector<float> sign(corners, 0);
  std::vector<std::uint32_t> twin(corners, kUnused), from(corners);
  for (std::uint32_t i = 0; i < corners; ++i) from[i] = i;
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& corner = mesh.triangles[i][k];
      const float wanted = frames[i].handedness;
      if (wanted == 0) continue;
      if (sign[corner] == 0) sign[corner] = wanted;
      if (sign[corner] == wanted) continue;
      if (twin[corner] == kUnused) {
        twin[corner] = std::uint32_t(from.size());
        from.push_back(corner);
        sign.push_back(wanted);
      }
      corner = twin[corner];
    }
  if (from.size() != corners) gatherCorners(mesh, from);

  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (int k = 0; k < 3; ++k) sums[mesh.triangles[i][k]] += frames[i].tangent;
  mesh.tangents.resize(mesh.positions.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const glm::dvec3 n(mesh.normals[i]);
    const glm::dvec3 flat = sums[i] - n * glm::dot(n, sums[i]);
    const double length = glm::length(flat);
    const glm::vec3 tangent = length > 1e-20 ? glm::vec3(flat / length) : anyPerpendicular(mesh.normals[i]);
    mesh.tangents[i] = glm::vec4(tangent, sign[i] == 0 ? 1 : sign[i]);
  }
}

void repairTangents(Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    const glm::vec3 t(mesh.tangents[i]);
    const float length = glm::length(t);
    const bool sound = std::isfinite(length) && length > 1e-6f;
    mesh.tangents[i] =
        glm::vec4(sound ? t / length : anyPerpendicular(mesh.normals[i]), mesh.tangents[i].w < 0 ? -1 : 1);
  }
}

}  // namespace

void dropBroken(SourceMesh& mesh, CleaningCounts& counts) {
  const auto finite = [&](std::uint32_t i) {
    const glm::dvec3& p = mesh.positions[i];
    return std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest &&
           std::abs(p.z) < kFarthest;  // false for NaN
  };
  std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
    if (std::max({t.x, t.y, t.z}) >= mesh.positions.size()) return ++counts.indexOutOfRange, true;
    if (!finite(t.x) || !finite(t.y) || !finite(t.z)) return ++counts.notFinite, true;
    return false;
  });
}

Mesh cleanMesh(SourceMesh&& source, const glm::dvec3& origin, bool wantsTangents, int tangentSet,
               const glm::mat3x2& uvTransform, CleaningCounts& counts) {
  Mesh out;
  out.name = std::move(source.name);
  out.material = source.material;
  out.positions.reserve(source.positions.size());
  for (const glm::dvec3& p : source.positions) out.positions.emplace_back(p - origin);
  source.positions = {};
  out.normals = std::move(source.normals);
  if (wantsTangents) out.tangents = std::move(source.tangents);
  out.uv[0] = std::move(source.uv[0]);
  out.uv[1] = std::move(source.uv[1]);
  out.colours = std::move(source.colours);
  out.triangles = std::move(source.triangles);

  const std::size_t before = out.triangles.size();
  const auto degenerate =
      std::ranges::remove_if(out.triangles, [&](const glm::uvec3& t) { return isDegenerate(out, t); });
  out.triangles.resize(before - degenerate.size());
  counts.degenerate += before - out.triangles.size();
  counts.kept += out.triangles.size();
  if (out.triangles.empty()) return out;

  dropUnusedCorners(out);
  for (auto& set : out.uv)
    for (glm::vec2& uv : set)
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = glm::vec2(0);
  if (out.normals.empty()) {
    makeFlatNormals(out);
    out.tangents.clear();  // made for other normals
    ++counts.normalsMade;
  } else {
    repairNormals(out);
  }
  if (wantsTangents && out.tangents.empty() && !out.uv[tangentSet].empty()) {
    makeTangents(out, out.uv[tangentSet], uvTransform);
    ++counts.tangentsMade;
  } else {
    repairTangents(out);
  }
  return out;
}

}  // namespace acentric
