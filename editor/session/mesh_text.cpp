#include "editor/session/mesh_text.h"

#include <fmt/format.h>

#include "ui/text_format.h"

namespace acentric::editor {

std::string meshText(const MeshCost& cost) {
  return fmt::format("mesh: {} triangles within {:g} samples, {}", ui::formatCount(cost.triangles),
                     cost.error, ui::formatBytes(cost.bytes));
}

std::string meshSumText(const FrameStats& stats) {
  if (stats.meshes.empty()) return {};
  const MeshCost sum = stats.meshSum();
  return fmt::format("{} meshes: {} of {} triangles drawn, within {:g} samples, {}", stats.meshes.size(),
                     ui::formatCount(stats.meshTriangles), ui::formatCount(sum.triangles), sum.error,
                     ui::formatBytes(sum.bytes));
}

std::string meshesAwaitedText(const FrameStats& stats) {
  const int old = stats.meshesAwaited - stats.pointsForMeshes;
  std::string text;
  if (stats.pointsForMeshes > 0)
    text = fmt::format("{} captures as points until their meshes are built", stats.pointsForMeshes);
  if (old > 0) text += fmt::format("{}{} meshes are being built anew", text.empty() ? "" : ", ", old);
  return text;
}

std::string capturesAwaitedText(const FrameStats& stats) {
  if (stats.capturesAwaited == 0) return {};
  const int missing = stats.capturesAwaited - stats.standIns;
  return fmt::format("{} captures on their way to the graphics card", stats.capturesAwaited) +
         (missing > 0 ? fmt::format(", {} with nothing in their place", missing) : "");
}

}  // namespace acentric::editor
