#pragma once
/// What the 3D view shows and asks, as plain values.

#include <optional>
#include <string>

#include "editor/tools/camera_steps.h"
#include "editor/tools/gizmo_subject.h"
#include "engine/inspect/surface_points.h"

namespace acentric::editor {

struct Scene3dState {
  std::optional<bool> cutCeiling;       ///< chosen; else cut where there is a ceiling
  bool ceiling = false;                 ///< found over the layout by the view
  bool allFrusta = false;               ///< of every camera, not of the selected cells' alone
  bool picking = false;                 ///< clicks pick surfaces
  bool placing = false;                 ///< clicks and drags place and move cells, as on the plan
  std::optional<OutlineCorner> corner;  ///< selected; may have become stale by an undo
  std::string readout;                  ///< of what is dragged, for the status bar
  bool frame = true;                    ///< asked for; the view clears it
  std::optional<SurfacePoint> picked;
  std::optional<CameraPlace> lookThrough;  ///< the camera whose picture is shown
};

}  // namespace acentric::editor
