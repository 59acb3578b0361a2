#include "engine/scene/source_scene.h"

#include <fmt/format.h>

#include <cmath>

namespace acentric {
namespace {

constexpr std::size_t kMaxReportLines = 60;

glm::vec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0);
}

}  // namespace

std::string counted(std::size_t count, const char* one, const char* many) {
  std::string digits = std::to_string(count);
  for (int i = int(digits.size()) - 3; i > 0; i -= 3) digits.insert(std::size_t(i), ",");
  return fmt::format("{} {}", digits, count == 1 ? one : many);
}

Status checkRoom(std::uint64_t triangles, std::uint64_t memoryBytes) {
  // Measured with 8 and 50 million triangles without normals, which have three vertices each: 92 bytes, most
  // of them the ray tracer's, and a third of the 84 that are mapped, which should stay in memory too.
  constexpr std::uint64_t kBytesPerTriangle = 120;
  constexpr double kGigabyte = 1 << 30;
  if (memoryBytes == 0 || triangles <= memoryBytes / kBytesPerTriangle) return {};
  return fail(
      ErrorKind::tooLarge,
      fmt::format("has {}, those of instances counted once, which take about {:.1f} GB of memory; {:.1f} GB "
                  "may be taken: raise that with --import-memory if there is more, show what is repeated as "
                  "instances, simplify the model or split it",
                  counted(triangles, "triangle", "triangles"),
                  double(triangles) * double(kBytesPerTriangle) / kGigabyte,
                  double(memoryBytes) / kGigabyte));
}

void ReportLines::add(std::string line) {
  if (seen_.contains(line)) return;
  if (lines_.size() >= kMaxReportLines) {
    ++leftOut_;
    return;
  }
  seen_.insert(line);
  lines_.push_back(std::move(line));
}

std::vector<std::string> ReportLines::take() {
  if (leftOut_ > 0) lines_.push_back(fmt::format("and {} more", leftOut_));
  leftOut_ = 0;
  return std::move(lines_);
}

void applyTransform(SourceMesh& mesh, const glm::dmat4& worldFromMesh) {
  const glm::dmat3 linear(worldFromMesh);
  // The cofactor matrix carries normals even where the transform flattens an axis and has no inverse.
  const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1]));
  const double determinant = glm::dot(linear[0], cofactor[0]);
  const double handedness = determinant < 0 ? -1 : 1;
  for (glm::dvec3& p : mesh.positions) p = linear * p + glm::dvec3(worldFromMesh[3]);
  for (glm::vec3& n : mesh.normals) n = unitOrZero(handedness * (cofactor * glm::dvec3(n)));
  for (glm::vec4& t : mesh.tangents)
    t = glm::vec4(unitOrZero(linear * glm::dvec3(t)), t.w * float(handedness));
  if (determinant < 0)
    for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
}

std::shared_ptr<const ColourImage> decodeOrIgnore(std::span<const std::byte> bytes, const std::string& name,
                                                  ReportLines& ignored) {
  auto image = decodeColourImage(bytes, name);
  if (image) return std::make_shared<const ColourImage>(std::move(*image));
  ignored.add(fmt::format("texture {}: {}", name, image.error().message));
  return nullptr;
}

}  // namespace acentric
