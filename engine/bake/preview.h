#pragma once
/// Quick pictures of a scene that need no light and nothing baked: each surface in its own colour or texture,
/// lit from the viewer and a little from above. Clear surfaces show what lies behind them. Distances and
/// normals are those of the ray tracer.
///
/// With a cut all that lies above a height is taken away, as on the plan: the insides of solids are closed by
/// dark caps in the plane of the cut, and one-sided walls seen from behind do not hide the room.

#include <limits>
#include <memory>
#include <stop_token>

#include "engine/bake/ray_scene.h"
#include "engine/base/task_runner.h"
#include "engine/geometry/column_camera.h"
#include "engine/geometry/perspective_view.h"
#include "engine/image/image.h"
#include "engine/layout/layout.h"
#include "engine/scene/material_rules.h"

namespace acentric {

inline constexpr double kNoCut = std::numeric_limits<double>::infinity();

/// What a ray of a preview sees.
struct PreviewSeen {
  float distance =
      std::numeric_limits<float>::infinity();  ///< metres to what ends the ray; infinity = nothing
  glm::vec3 normal{0, 0, 1};                   ///< unit, of the triangle, on the viewer's side
  std::uint32_t mesh = 0, triangle = 0;        ///< that ends the ray
  bool cap = false;                            ///< the cut's plane ends it, within a solid
  glm::vec3 colour{0};                         ///< linear, 0..1 or a little more
  float alpha = 0;                             ///< below 1 where nothing ends the ray
  bool found() const { return distance < std::numeric_limits<float>::infinity(); }
};

class PreviewTracer {
 public:
  explicit PreviewTracer(RayScenePtr rays);
  const RayScene& rays() const { return *rays_; }

  /// `cutHeight`: world z in metres.
  PreviewSeen along(const Ray& ray, double cutHeight = kNoCut) const;
  /// The same for each ray of a packet.
  void along(const RayPacket& packet, double cutHeight,
             std::array<PreviewSeen, RayPacket::kSize>& seen) const;

 private:
  struct Start;
  Start startOf(const Ray& ray, double cutHeight) const;
  PreviewSeen follow(const Ray& ray, const Start& start, Hit hit) const;
  bool seenFromBehind(const Hit& hit, const glm::vec3& direction) const;
  bool inSolid(const glm::vec3& place) const;

  RayScenePtr rays_;
  std::vector<MaterialRules> rules_;
  DetailRules detail_;
};
using PreviewTracerPtr = std::shared_ptr<const PreviewTracer>;

struct PreviewPicture {
  ColourImage colour;      ///< alpha 0 where there is nothing
  FloatImage rayDistance;  ///< metres from the centre of projection; infinity = nothing
  bool empty() const { return colour.empty(); }
};

/// One ray through each pixel's centre. An empty picture if stopped.
PreviewPicture previewView(const PreviewTracer& tracer, const PerspectiveView& view, double cutHeight,
                           TaskRunner& runner, std::stop_token stop = {});
/// What a capture camera sees first beyond the regions that it serves, a pixel per column and row of
/// `columns`, which may be fewer than are baked. As an eye sees it: the first column is at the right.
PreviewPicture previewCapture(const PreviewTracer& tracer, const LayoutCamera& camera,
                              const ColumnCamera& columns, TaskRunner& runner, std::stop_token stop = {});

}  // namespace acentric
