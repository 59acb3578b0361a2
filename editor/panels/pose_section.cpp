#include "editor/panels/pose_section.h"

#include <fmt/format.h>

#include <functional>

#include "editor/commands/walk_edits.h"
#include "editor/tools/walker.h"
#include "engine/geometry/conventions.h"
#include "engine/pipeline/walk_ground.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

void number(PanelContext& context, const char* logName, const ui::NumberField& field, float labelWidth,
            double value, const std::function<void(PathPose&, double)>& set) {
  const ui::FieldEdit edit = ui::numberField(field, value, labelWidth);
  context.log.item(std::string("pose.") + logName);
  if (!edit) return;
  const WalkSelection& selected = context.state().walkSelection;
  const Project& project = context.session().project();
  const CameraPath& path = project.paths[selected.number].path;
  PathPose pose = path.poses[*selected.pose];
  set(pose, value);
  applyFieldEdit(context, edit, setPath(project, selected.number, withPose(path, *selected.pose, pose)));
}

}  // namespace

void drawPoseSection(PanelContext& context, float labelWidth) {
  const WalkSelection& selected = context.state().walkSelection;
  const auto which = selected.poseIn(context.session().project());
  const bool in3d = context.state().centreView == View::scene3d && context.state().selection.empty();
  if (!which || (context.state().planTool.mode() != PlanMode::path && !in3d)) return;
  const WalkPath walk = *selected.path(context.session().project());
  const PathPose pose = walk.path.poses[*which];
  const std::string title =
      trf("Key pose {} of {}, {}###pose", *which + 1, walk.path.poses.size(), walk.name);
  if (!ui::section(title.c_str())) return;
  number(context, "x", {"x", "%.3f m", 0.01, -1e7, 1e7}, labelWidth, pose.eye.x,
         [](PathPose& p, double v) { p.eye.x = v; });
  number(context, "y", {"y", "%.3f m", 0.01, -1e7, 1e7}, labelWidth, pose.eye.y,
         [](PathPose& p, double v) { p.eye.y = v; });
  number(context, "z", {"z", "%.3f m", 0.005, -1e7, 1e7, tr("Height of the eye, from the scene's zero.")},
         labelWidth, pose.eye.z, [](PathPose& p, double v) { p.eye.z = v; });
  number(context, "yaw", {tr("Looks towards"), "%.1f°", 0.3, -360, 360, tr("Counter-clockwise from +x.")},
         labelWidth, degrees(pose.yawRadians), [](PathPose& p, double v) { p.yawRadians = radians(v); });
  number(context, "pitch", {tr("Looks up"), "%.1f°", 0.3, -83, 83, tr("Degrees above the horizon.")},
         labelWidth, degrees(pose.pitchRadians), [](PathPose& p, double v) { p.pitchRadians = radians(v); });
  number(context, "seconds",
         {tr("At"), "%.2f s", 0.02, 0, kMostPathSeconds,
          tr("Between the times of its neighbours; the first is at 0.")},
         labelWidth, pose.seconds, [](PathPose& p, double v) { p.seconds = v; });
  const auto& built = context.session().built();
  if (built && built->project.storey == walk.storey && !built->ground->holds(walk.storey, pose.eye))
    ui::wrappedText(ui::palette::warning, tr("One cannot walk here: a replay goes as near as it can."));
}

}  // namespace acentric::editor
