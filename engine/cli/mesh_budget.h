#pragma once
/// What it takes to draw captures as meshes, gathered over frames.

#include <map>

#include "engine/cli/command.h"

namespace acentric::cli {

class MeshBudget {
 public:
  void add(const FrameStats& stats);
  /// Were any drawn?
  bool any() const { return !meshes_.empty(); }
  /// Triangles, bytes and milliseconds of building, of each capture and together.
  Json json() const;
  std::string text() const;

 private:
  MeshCost sum() const;
  double drawnPerFrame() const { return double(drawn_) / double(frames_); }

  std::map<int, MeshCost> meshes_;  ///< by camera
  std::uint64_t drawn_ = 0, frames_ = 0;
};

}  // namespace acentric::cli
