#include "engine/export/sky_model.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/image/colour.h"
#include "engine/view/background.h"

namespace acentric {

void addSky(const WalkScene& walk, const glm::dvec3& middle, DrawModel& model) {
  constexpr int kRound = 64, kUp = 32;
  constexpr double kFar = 4;  // sizes of the scene
  const Sky sky = backgroundSky(walk);
  double radius = 1;
  for (int corner = 0; corner < 8; ++corner) {
    const Bounds& box = walk.scene->bounds;
    const glm::vec3 at(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                       corner & 4 ? box.max.z : box.min.z);
    if (!box.empty()) radius = std::max(radius, kFar * glm::distance(glm::dvec3(at), middle));
  }
  DrawMesh mesh;
  for (int i = 0; i <= kUp; ++i)
    for (int k = 0; k <= kRound; ++k) {
      const double up = kPi * (double(i) / kUp - 0.5), round = kTwoPi * k / kRound;
      const glm::dvec3 to(std::cos(up) * std::cos(round), std::cos(up) * std::sin(round), std::sin(up));
      mesh.positions.emplace_back(middle - model.origin + radius * to);
      mesh.colours.push_back(toneMap(sky.radiance(glm::vec3(to)), walk.exposure));
    }
  for (int i = 0; i < kUp; ++i)
    for (int k = 0; k < kRound; ++k) {
      const auto a = std::uint32_t(i * (kRound + 1) + k), b = a + kRound + 1;
      if (i > 0) mesh.triangles.emplace_back(a, b, a + 1);  // at the poles a side is a point
      if (i + 1 < kUp) mesh.triangles.emplace_back(a + 1, b, b + 1);
    }
  mesh.part = mesh.material = "sky";
  model.meshes.push_back(std::move(mesh));
}

}  // namespace acentric
