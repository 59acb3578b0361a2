#include "engine/view/view_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/base/contract.h"
#include "engine/view/piece_planner.h"

namespace acentric {
namespace {

int roleIn(const Cover& cover, const OrderedPiece& ordered) {
  const auto found = std::ranges::find_if(cover.pieces, [&](const Piece& piece) {
    return piece.camera == ordered.camera && piece.clip == ordered.clip;
  });
  return found == cover.pieces.end() ? -1 : found->role;
}

}  // namespace

Result<ViewPlan> planView(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings) {
  require(scene.layout != nullptr, "a walk scene needs a layout");
  if (auto status = view.check(); !status) return tl::unexpected(status.error());
  const Layout& layout = *scene.layout;
  const glm::dvec2 eye(view.eye);
  const auto regionIndex = layout.regionAt(eye);
  if (!regionIndex) {
    const Layout::Nearest nearest = layout.nearestRegion(eye);
    if (nearest.region < 0)
      return fail(ErrorKind::invalidArgument, "the layout has no region to stand in: place a cell first",
                  "view");
    return fail(ErrorKind::invalidArgument,
                fmt::format("the eye ({:.3f}, {:.3f}) stands outside every region; the nearest point inside "
                            "is ({:.3f}, {:.3f})",
                            eye.x, eye.y, nearest.point.x, nearest.point.y),
                "view");
  }
  return planRegion(scene, view, settings, *regionIndex);
}

Result<ViewPlan> planRegion(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                            int number) {
  if (auto status = view.check(); !status) return tl::unexpected(status.error());
  if (auto status = settings.check(); !status) return tl::unexpected(status.error());
  const Layout& layout = *scene.layout;
  ViewPlan plan;
  plan.region = number;
  const Region& region = layout.regions[static_cast<std::size_t>(plan.region)];
  const ViewSector sector = sectorOf(view);
  const PiecePlanner planner(scene, view, settings);
  std::set<int> missing;

  const auto addCover = [&](const Cover& cover, bool secondary) {
    for (const OrderedPiece& ordered : visiblePieces(layout, plan.region, cover, sector)) {
      const std::size_t camera = static_cast<std::size_t>(ordered.camera);
      if (camera >= scene.captures.size() || scene.captures[camera] == nullptr) {
        missing.insert(ordered.camera);
        continue;
      }
      PieceDraw piece;
      piece.camera = ordered.camera;
      piece.part = ordered.part;
      piece.clipToPart = ordered.part.azimuths.low != sector.azimuths.low ||
                         ordered.part.azimuths.width != sector.azimuths.width;
      piece.secondary = secondary;
      piece.roles = roleBit(layout.cameras[camera], roleIn(cover, ordered));
      planner.add(std::move(piece), &region.grown, ordered.clip, plan);
    }
  };

  const Cover& chosen = chooseCover(region, sector);
  if (settings.secondaryCover) {
    for (const Cover& panorama : layout.panoramasFor(plan.region)) addCover(panorama, true);
    for (const Cover& cover : region.covers)
      if (&cover != &chosen) addCover(cover, true);
  }
  addCover(chosen, false);
  plan.missingImages = static_cast<int>(missing.size());
  return plan;
}

int imagesOf(const ViewPlan& plan) {
  std::set<int> images;
  for (const auto* pieces : {&plan.pieces, &plan.backgrounds})
    for (const PieceDraw& piece : *pieces) images.insert(piece.camera);
  return static_cast<int>(images.size());
}

Result<ViewPlan> planCaptures(const WalkScene& scene, const PerspectiveView& view,
                              const ViewSettings& settings, std::span<const int> cameras) {
  if (auto status = view.check(); !status) return tl::unexpected(status.error());
  if (auto status = settings.check(); !status) return tl::unexpected(status.error());
  ViewPlan plan;
  const PiecePlanner planner(scene, view, settings);
  for (const int camera : cameras) {
    require(camera >= 0 && static_cast<std::size_t>(camera) < scene.captures.size(), "the camera exists");
    if (scene.captures[static_cast<std::size_t>(camera)] == nullptr) {
      ++plan.missingImages;
      continue;
    }
    PieceDraw piece;
    piece.camera = camera;
    planner.add(std::move(piece), nullptr, std::nullopt, plan);
  }
  return plan;
}

}  // namespace acentric
