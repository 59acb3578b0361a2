#pragma once
/// Which surface points a capture holds, told by the rule of the bake without baking: along each of a
/// camera's rays the opaque surfaces beyond the served regions, within the camera's elevations, as many as
/// the settings allow.
///
/// It is asked about points that some eye of a served region sees. Three things are not modelled: that
/// samples lie at pixel centres (sampling_rate.h judges how dense they are), that surfaces which no region
/// sees use up no layers (so that it foretells too little rather than too much), and that the bake's test
/// eyes are few.

#include <span>
#include <vector>

#include "engine/geometry/column_camera.h"
#include "engine/inspect/opaque_tracer.h"
#include "engine/layout/layout.h"

namespace acentric {

class CaptureReach {
 public:
  /// `columns[i]` bakes Layout::cameras[i]. Refers to layout and tracer.
  CaptureReach(const Layout& layout, std::vector<ColumnCamera> columns, int maxLayers,
               const OpaqueTracer& tracer);

  const Layout& layout() const { return layout_; }
  const ColumnCamera& columns(int camera) const { return columns_[std::size_t(camera)]; }
  const OpaqueTracer& tracer() const { return tracer_; }

  /// Does the camera's capture hold this point of a surface? Whether the point lies in the camera's sector is
  /// the cover's business (Piece::holds).
  bool holds(int camera, const glm::dvec3& point) const;
  /// Does it hold the sky in this direction (unit)? Above and below its rows there is nothing else.
  bool holdsSky(int camera, const glm::dvec3& direction) const;

 private:
  struct Way;
  bool wayTo(int camera, const glm::dvec3& direction, double horizontal, Way& way) const;
  bool endsBefore(const Way& way, double distance) const;

  const Layout& layout_;
  std::vector<ColumnCamera> columns_;
  int maxLayers_;
  const OpaqueTracer& tracer_;
};

/// Every cover that frames from a region are painted from: its own (Region::covers), then the panoramas that
/// help it.
std::vector<Cover> drawnCovers(const Layout& layout, int region);

/// The camera whose piece of the cover holds a place outside the region; -1 if none does.
int cameraAt(const Cover& cover, const glm::dvec2& place);

}  // namespace acentric
