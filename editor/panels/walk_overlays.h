#pragma once
/// What lies over the walk's picture on request: the minimap and the images in use in its upper right corner,
/// the graph of frame times along its lower edge.

#include <array>
#include <optional>

#include "editor/panels/minimap.h"
#include "editor/session/frame_times.h"
#include "ui/image_view.h"
#include "ui/texture.h"

namespace acentric::editor {

/// The picture under them.
struct WalkShown {
  std::shared_ptr<const LoadedWalk> loaded;
  PerspectiveView view;
  ViewSettings settings;
  std::shared_ptr<const Frame> frame;  ///< null: not known pixel by pixel, as while the eye moves
};

class WalkOverlays {
 public:
  /// `colours`: of the layout of `shown`; may be null where needColours() is false. Over the window between
  /// two corners, in which the picture lies at `place`.
  void draw(PanelContext& context, ImDrawList& list, const ImVec2& low, const ImVec2& high,
            const ui::FittedImage& place, const WalkShown& shown, const SourceColours* colours,
            const FrameTimes& times);
  static bool needColours(const EditorState& state) { return state.showMinimap || state.showImages; }
  /// Do they lie over this place of the window?
  bool cover(const glm::dvec2& position) const;
  /// Of the graph; 0 where it is not shown.
  float graphHeight(const PanelContext& context, float walkHeight) const;

 private:
  struct Box {
    ImVec2 low, high;
  };
  void follow(const WalkShown& shown);
  Box drawMinimap(PanelContext& context, ImDrawList& list, const Box& room, const SourceColours& colours);
  void drawSpotlight(ImDrawList& list, const ui::FittedImage& place);

  WalkShown of_;  ///< what images_ are of
  std::vector<UsedImage> images_;
  std::optional<int> pointedAt_;  ///< a camera
  ui::Texture spotlight_;
  std::optional<int> spotlightOf_;
  std::shared_ptr<const Frame> spotlightIn_;
  Minimap minimap_;
  std::vector<Box> boxes_;
};

}  // namespace acentric::editor
