#pragma once
/// What the walk shows of a place that is not baked: the scene ray-traced without baked light, as the 3D view
/// does.

#include "editor/panels/panel_context.h"
#include "editor/session/preview_stream.h"
#include "ui/texture.h"

namespace acentric::editor {

class WalkPreview {
 public:
  WalkPreview(int threads, std::function<void()> wake) : stream_(threads, std::move(wake)) {}

  /// Over the area between two corners, screen pixels, of which `view` is. False while there is no picture.
  bool draw(PanelContext& context, const PerspectiveView& view, const ImVec2& low, const ImVec2& high);
  /// Nothing is traced any more until the next drawing.
  void clear();

 private:
  PreviewStream stream_;
  PreviewTracerPtr tracer_;
  ui::Texture texture_;
};

}  // namespace acentric::editor
