#pragma once
/// What the tools draw in the 3D view: as on the plan, on the floor of the storey.

#include <set>

#include "editor/actions/scene_editing.h"
#include "editor/overlays/scene_ink.h"
#include "engine/pipeline/pipeline.h"

namespace acentric::editor {

/// Handles of the same size at any distance, over light and dark; `lit`: the one under the pointer or in
/// hand.
void drawGizmo(const SceneInk& ink, const Gizmo& gizmo, GizmoGrip lit);
/// Where cells on their way would land: free places in the accent colour, taken ones in red.
void drawLandings(const SceneInk& ink, const LayoutSpec& spec, const CellGroup& group,
                  const LatticeStep& step, double floor);
/// Lines of the storey's paths, and key poses of the selected one; `hit`: what a press would take.
void drawScenePaths(const SceneInk& ink, const PathSituation& situation, const OpenProject& open,
                    const PathHit& hit);
/// Centres of APVs beside the lattice; one that is being placed too.
void drawSceneApvs(const SceneInk& ink, const LayoutSpec& spec, const std::set<CellId>& selection,
                   const std::optional<Apv>& inHand, double floor);
/// Handles at the outline's corners and what a press would do there; the loop or rectangle in hand.
void drawSceneOutline(const SceneInk& ink, const Outline& outline, const OutlineTool& tool,
                      const OutlineHit& hit, const std::optional<glm::dvec2>& pointer, double floor);
void drawSceneLattice(const SceneInk& ink, const LatticeHandles& handles, LatticeGrip lit, double floor);
/// Free and placed cells of a lattice that is tried, about its middle.
void drawSceneTrial(const SceneInk& ink, const LayoutSpec& spec, const glm::dvec2& middle, double floor);
void drawSceneRuler(const SceneInk& ink, const MeasureTool::Ruler& ruler, double floor);
void drawSceneMarquee(const SceneInk& ink, const MarqueeIntent& box, double floor);

}  // namespace acentric::editor
