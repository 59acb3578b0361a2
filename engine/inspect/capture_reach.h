#pragma once
/// Which surface points a capture holds, told by the rule of the bake without baking: along each of a
/// camera's rays the opaque surfaces beyond the served regions, within the camera's elevations, as many as
/// the settings allow.
///
/// With pruning, of these surfaces only those that a test eye of the region sees, as CaptureSight answers;
/// the others use up no layers. Not modelled: that glass uses up layers.

#include <span>
#include <vector>

#include "engine/geometry/column_camera.h"
#include "engine/inspect/capture_sight.h"
#include "engine/inspect/opaque_tracer.h"
#include "engine/layout/layout.h"

namespace acentric {

class CaptureReach {
 public:
  /// `columns[i]` bakes Layout::cameras[i]. Refers to layout, tracer and sight; no sight: no pruning.
  CaptureReach(const Layout& layout, std::vector<ColumnCamera> columns, int maxLayers,
               const OpaqueTracer& tracer, const CaptureSight* sight = nullptr);

  const Layout& layout() const { return layout_; }
  const ColumnCamera& columns(int camera) const { return columns_[std::size_t(camera)]; }
  const OpaqueTracer& tracer() const { return tracer_; }

  /// Does the camera's capture hold this point of a surface, for what is drawn by one of its roles (-1: by
  /// any)? Whether the point lies in the camera's sector is the cover's business (Piece::holds).
  bool holds(int camera, const glm::dvec3& point, int role = -1) const;
  /// Does it hold the sky in this direction (unit)? Above and below its rows there is nothing else.
  bool holdsSky(int camera, const glm::dvec3& direction, int role = -1) const;

 private:
  struct Way;
  bool wayTo(int camera, const glm::dvec3& direction, double horizontal, int role, Way& way) const;
  bool endsBefore(const Way& way, double distance) const;
  std::vector<OpaqueHit> surfacesAlong(const Way& way, double from, double farthest) const;
  bool keptFor(int camera, std::size_t role, const Way& way, double from, double distance) const;
  std::vector<OpaqueHit> keptAmong(int camera, std::size_t role, const Way& way,
                                   const std::vector<OpaqueHit>& met, double nearest) const;

  const Layout& layout_;
  std::vector<ColumnCamera> columns_;
  int maxLayers_;
  const OpaqueTracer& tracer_;
  const CaptureSight* sight_;
};

/// Every cover that frames from a region are painted from: its own (Region::covers), then the panoramas that
/// help it.
std::vector<Cover> drawnCovers(const Layout& layout, int region);

/// The piece of the cover that holds a place outside the region; null if none does.
const Piece* pieceAt(const Cover& cover, const glm::dvec2& place);

}  // namespace acentric
