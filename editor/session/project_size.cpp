#include "editor/session/project_size.h"

namespace acentric::editor {
namespace {

/// Of a tree's node: three pointers and a colour, and what the allocator adds.
constexpr std::size_t kNodeBytes = 48;

template <class Container>
std::size_t nodesOf(const Container& container) {
  return container.size() * (sizeof(typename Container::value_type) + kNodeBytes);
}

std::size_t bytesBehind(const Outline& outline) {
  std::size_t bytes = 0;
  for (const auto& loop : outline.loops) bytes += sizeof loop + loop.capacity() * sizeof(glm::dvec2);
  return bytes;
}

std::size_t bytesBehind(const LayoutSpec& spec) {
  return nodesOf(spec.added) + nodesOf(spec.removed) + nodesOf(spec.split) + nodesOf(spec.freeApvs) +
         nodesOf(spec.density) + bytesBehind(spec.outline);
}

}  // namespace

std::size_t approximateBytes(const Project& project) {
  std::size_t bytes = sizeof project + project.scene.native().capacity() + nodesOf(project.effects);
  for (const Storey& storey : project.storeys)
    bytes +=
        sizeof storey + storey.name.capacity() + bytesBehind(storey.layout) + bytesBehind(storey.walkable);
  return bytes;
}

}  // namespace acentric::editor
