#pragma once
/// Per pixel of a capture a march along the camera's ray, from surface to surface beyond the regions it
/// serves.

#include <array>
#include <optional>
#include <stop_token>
#include <vector>

#include "engine/bake/chunk_samples.h"
#include "engine/bake/column_rays.h"
#include "engine/bake/mirror_march.h"
#include "engine/bake/region_sight.h"
#include "engine/bake/shading.h"
#include "engine/scene/flat_mirrors.h"

namespace acentric {

/// Of radiance: two that differ by a smaller share look the same.
inline constexpr float kContrast = 0.05f;

/// Marches along the rays of one column after the other, on one thread.
class ColumnMarch {
 public:
  /// What is the same for all pixels of a capture.
  struct Setting {
    const Shader& shader;
    const LayoutCamera& camera;
    const ColumnCamera& columns;
    const RowAngles& rows;
    const BakeSettings& settings;
    const RegionSight* sight;         ///< null: no pruning
    const FlatMirrors* mirrors;       ///< null: there are none
    const MirrorSight* beyond;        ///< null: only what the camera itself sees in them
    const TexturePyramids* textures;  ///< null: none to be averaged
    double distanceStep;
    std::vector<glm::dvec3> eyes;  ///< by role: the middle of its region, at eye height
  };
  /// All must outlive the march.
  ColumnMarch(const Setting& setting, ChunkSamples& out);

  /// False when stopped.
  bool run(int column, const std::stop_token& stop);

 private:
  void runRows(int first, int last, const std::stop_token& stop);
  Shaded shade(const Hit& hit, const glm::vec3& direction, const glm::vec3& toViewer);
  bool addAlone(int row, const glm::vec3& direction, const Hit& hit);
  void beginPixel(int row);
  void runPixel(const glm::vec3& direction, float distance, const ColumnRole* next,
                const std::stop_token& stop);
  const ColumnRole* addHit(const glm::vec3& direction, const Hit& hit);
  bool goesOnBeyond(const ColumnRole& role, const Hit& hit, const glm::dvec3& point) const;
  void addSurface(const glm::vec3& direction, const Hit& hit);
  void addAsSeen(std::vector<RoleOnRay*>& needed, const MetSurface& surface, Side side,
                 const glm::vec3& direction, const Hit& hit, double horizontal);
  void addSide(std::vector<RoleOnRay*>& needed, Side side, const Shaded& shaded, double horizontal,
               std::uint8_t mirror);
  Shaded mirrorSurface(const glm::vec3& direction, const Hit& hit, double horizontal, std::uint8_t mirror);
  void addShown(const glm::vec3& direction);
  void addBackgroundAlong(const glm::vec3& direction);
  void addBackground(int row, std::uint8_t mask);
  bool isFull(const RoleOnRay& role) const { return role.samples >= setting_.settings.maxLayers; }

  /// How some regions see a surface.
  struct Look {
    Shaded shaded;
    std::vector<RoleOnRay*> roles;
  };

  const Setting& setting_;
  ChunkSamples& out_;
  double sameDepth_;    ///< metres per metre of ray
  double rightBehind_;  ///< the same: what the test eyes do not tell from what lies before it
  std::array<Hit, RayPacket::kSize> hits_;
  RegionSight::Hints hints_;
  int column_ = 0;
  glm::dvec2 direction_{0};                ///< of the column
  std::vector<ColumnRole> roles_;          ///< of the column
  bool alone_ = false;                     ///< of the column: see addAlone
  int row_ = 0;                            ///< of the pixel
  double flat_ = 1;                        ///< of the pixel: horizontal metres per metre of ray
  int layer_ = 0;                          ///< of the pixel: samples that it has
  bool reachedBackground_ = false;         ///< of the pixel: is nothing left along its ray?
  std::vector<RoleOnRay> having_;          ///< of the pixel, as roles_; horizontal metres
  SeenSides sides_;                        ///< of the surface
  std::vector<Look> looks_;                ///< of the surface
  SurfacePlane plane_;                     ///< of the surface, where silhouettes are asked for
  std::vector<const ColumnRole*> facing_;  ///< those that a mirror shows something
  std::optional<MirrorMarch> mirrorMarch_;
  std::vector<ShownInMirror> shown_;       ///< by the mirrors of the pixel
  std::array<FlatMirror, 256> mirrors_{};  ///< by number, where silhouettes are asked for
};

/// From a point that a ray of the camera meets towards the regions of some roles, by their bits, unit: to the
/// middle of their eyes, or if that is not on `side`, as the camera's ray tells.
glm::vec3 towardsEyes(const ColumnMarch::Setting& setting, std::uint8_t roles, const MetSurface& surface,
                      Side side);

/// What a sample stands for wherever it hits a surface.
SampleFootprint sampleFootprint(const ColumnMarch::Setting& setting, const glm::vec3& direction);

}  // namespace acentric
