#pragma once
/// The picture that a capture camera will take, previewed in a panel over the 3D view.

#include "editor/panels/panel_context.h"
#include "editor/session/preview_stream.h"
#include "ui/texture.h"

namespace acentric::editor {

class LookThrough {
 public:
  LookThrough(int threads, std::function<void()> wake) : stream_(threads, std::move(wake)) {}

  /// Index of the camera that is shown, if the layout still has it.
  static std::optional<int> cameraOf(const PanelContext& context);
  /// In the upper left corner of an area of the current window (screen pixels); where it lies is returned:
  /// min and max. Only while a camera is looked through.
  std::pair<ImVec2, ImVec2> draw(PanelContext& context, const PreviewTracerPtr& tracer, int camera,
                                 const ImVec2& areaMin, const ImVec2& areaMax);
  void close();

 private:
  void drawText(PanelContext& context, const ColumnCamera& columns, int camera) const;
  void drawPicture(PanelContext& context, const ImVec2& room);
  void tellFirst(PanelContext& context, int camera);
  bool showsCamera(const PanelContext& context, int camera) const;
  /// Asks for its picture and takes over what was traced.
  void trace(PanelContext& context, const PreviewTracerPtr& tracer, int camera, const ColumnCamera& columns);

  PreviewStream stream_;
  ui::Texture texture_;
  std::optional<CameraPlace> place_;  ///< that is shown
  double askedAt_ = 0;
  bool firstTold_ = true;
};

}  // namespace acentric::editor
