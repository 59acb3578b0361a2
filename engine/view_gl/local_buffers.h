#pragma once
/// One region's local geometry as OpenGL buffers, with the surface light of just its triangles.

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "engine/base/result.h"
#include "engine/view/local_corners.h"
#include "engine/view_gl/gl_object.h"

namespace acentric {

struct LocalBuffers {
  std::weak_ptr<const LocalGeometry> owner;
  std::weak_ptr<const SurfaceLight> lightOwner;
  std::weak_ptr<const FlatMirrors> mirrorsOwner;
  bool lit = false;      ///< a surface light was there
  bool mirrors = false;  ///< some batch is a mirror
  GlVertexArray vertexArray;
  GlBuffer vertices;     ///< LocalCorner, three per triangle
  GlBuffer indices;      ///< of the clear triangles, rewritten in each frame's order
  GlBuffer light;        ///< uvec2 (four halves) per sample
  glm::dvec3 origin{0};  ///< amid the region, so that floats do not lose digits far from the project's
  std::vector<LocalBatch> batches;
  /// Corners of the triangles whose material can be clear, three each, for sorting: these come last, from
  /// this one on.
  std::vector<glm::vec3> clearCorners;
  std::uint32_t firstClear = 0;
  std::uint32_t triangles = 0;
};

Result<LocalBuffers> uploadLocal(const WalkScene& scene,
                                 const std::shared_ptr<const LocalGeometry>& geometry);

class LocalResidency {
 public:
  /// Valid until the next call of dropGone.
  Result<LocalBuffers*> get(const WalkScene& scene, std::size_t region);
  /// Drops what `scene` no longer holds, or holds with another light or other mirrors.
  void dropGone(const WalkScene& scene);
  std::size_t count() const { return resident_.size(); }

 private:
  std::map<const LocalGeometry*, LocalBuffers> resident_;
};

}  // namespace acentric
