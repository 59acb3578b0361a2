#include "engine/scene/drawn_scene.h"

#include <algorithm>
#include <utility>

#include "engine/scene/instances.h"

namespace acentric {
namespace {

ScenePtr withExcerpts(const Scene& traced, const InstanceExcerpts& excerpts) {
  auto drawn = std::make_shared<Scene>(traced);
  drawn->prototypes = std::vector<Mesh>();
  drawn->instances = std::vector<Instance>();
  drawn->meshes.reserve(traced.meshes.size() + excerpts.size());
  for (const InstanceExcerpt& excerpt : excerpts)
    drawn->meshes.push_back(placedAsMesh(traced, traced.instances[excerpt.instance], excerpt.triangles));
  return drawn;
}

}  // namespace

DrawnScene::DrawnScene(ScenePtr traced)
    : DrawnScene(std::move(traced), std::make_shared<const InstanceExcerpts>()) {}

DrawnScene::DrawnScene(ScenePtr traced, std::shared_ptr<const InstanceExcerpts> excerpts)
    : traced_(std::move(traced)),
      drawn_(excerpts->empty() ? traced_ : withExcerpts(*traced_, *excerpts)),
      excerpts_(std::move(excerpts)),
      boxes_(boundsOf(drawn_->meshes)),
      firstTriangles_(drawn_->firstTriangles()) {}

DrawnScene::Place DrawnScene::traced(std::uint32_t mesh, std::uint32_t triangle,
                                     const glm::vec2& barycentric) const {
  const std::size_t own = traced_->meshes.size();
  if (mesh < own) return {mesh, triangle, barycentric};
  const InstanceExcerpt& excerpt = (*excerpts_)[mesh - own];
  const bool mirrored = PlacedMesh(*traced_, std::uint32_t(own) + excerpt.instance).mirrored();
  return {std::uint32_t(own) + excerpt.instance, excerpt.triangles[triangle],
          mirrored ? glm::vec2(barycentric.y, barycentric.x) : barycentric};
}

std::optional<std::uint32_t> DrawnScene::numberOf(std::uint32_t placed, std::uint32_t triangle) const {
  if (!traced_->isInstance(placed)) return firstTriangles_[placed] + triangle;
  const auto own = std::uint32_t(traced_->meshes.size());
  const auto excerpt = std::ranges::lower_bound(*excerpts_, placed - own, {}, &InstanceExcerpt::instance);
  if (excerpt == excerpts_->end() || excerpt->instance != placed - own) return {};
  const auto found = std::ranges::lower_bound(excerpt->triangles, triangle);
  if (found == excerpt->triangles.end() || *found != triangle) return {};
  return firstTriangles_[own + std::size_t(excerpt - excerpts_->begin())] +
         std::uint32_t(found - excerpt->triangles.begin());
}

}  // namespace acentric
