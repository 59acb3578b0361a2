#pragma once
/// What plane mirrors show the served regions along one ray of a camera: the virtual scene behind each,
/// whether or not the camera itself sees it in the mirror.
///
/// The camera sees the virtual scene through the mirror as through a window, the eyes look in at other
/// angles. So the march starts at the mirror's plane even where the ray meets it beside the mirror, or where
/// something hides it, and goes on behind what is reflected first. Kept is what a test eye of any role sees
/// in the mirror, for all roles whose part holds it; of a surface the sides that they see (surface_side.h).

#include <optional>
#include <span>
#include <stop_token>

#include "engine/bake/column_roles.h"
#include "engine/bake/mirror_sight.h"
#include "engine/bake/shading.h"

namespace acentric {

struct ShownInMirror {
  double distance = 0;  ///< metres along the camera's ray; infinity: the sky
  HalfColour colour{0};
  std::uint8_t roles = 0, mirror = 0;
  Side side = Side::met;
  Hit surface;  ///< not found: the sky
  bool isSky() const { return !(distance < std::numeric_limits<double>::infinity()); }
  bool isClear() const { return unpackColour(colour).a < 1; }
};

class MirrorMarch {
 public:
  /// Metres per metre of ray: `sameDepth` and `rightBehind` behind a surface are still itself, and hidden by
  /// it. All must outlive the march.
  MirrorMarch(const Shader& shader, const MirrorSight& sight, int maxLayers, double sameDepth,
              double rightBehind);

  struct Pixel {
    glm::dvec3 origin, direction;  ///< unit
    std::span<const ColumnRole> roles;
    SampleFootprint footprint;
  };
  /// Adds to what the camera itself sees in mirrors along the ray, which comes in `shown`. Only a part when
  /// stopped.
  void run(const Pixel& pixel, std::vector<ShownInMirror>& shown, RayCounts& rays,
           const std::stop_token& stop);

 private:
  /// Something on the way of the mirrored ray.
  struct Met {
    Hit hit;              ///< as from the camera's image; not found: the sky
    double distance = 0;  ///< metres along the camera's ray
    std::optional<MetSurface> surface;
  };
  Met metAt(const Pixel& pixel, const FlatMirror& mirror, const Hit& hit, double distance) const;
  void follow(const Pixel& pixel, const MirrorSight::Span& span, std::vector<ShownInMirror>& shown,
              RayCounts& rays, const std::stop_token& stop);
  double addSeenByCamera(const Pixel& pixel, const FlatMirror& mirror, std::vector<ShownInMirror>& shown,
                         RayCounts& rays);
  void addSide(const Pixel& pixel, const FlatMirror& mirror, const Met& met, Side side,
               std::vector<ShownInMirror>& shown, RayCounts& rays);
  void ask(const Pixel& pixel, const FlatMirror& mirror, const Met& met, bool isKnown, RayCounts& rays);
  std::uint8_t giveTo(std::vector<RoleOnRay*>& roles, double distance, bool isClear) const;
  bool isFull(const RoleOnRay& role) const { return role.samples >= maxLayers_; }

  const Shader& shader_;
  const MirrorSight& sight_;
  int maxLayers_;
  double sameDepth_, rightBehind_;
  MirrorSight::Hints hints_;
  std::vector<MirrorSight::Span> spans_;
  std::vector<RoleOnRay> roles_;  ///< of the pixel
  // What ask() found:
  SeenSides sides_;
  std::vector<RoleOnRay*> unseen_;     ///< may have it, and see neither side
  MirrorSight::Seen byMet_, byOther_;  ///< eyes that see the side
};

}  // namespace acentric
