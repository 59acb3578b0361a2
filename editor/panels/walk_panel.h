#pragma once
/// The live walk: the picture at the eye, by the chosen renderer, and what it cost.

#include <atomic>
#include <memory>
#include <optional>

#include "editor/panels/walk_compare.h"
#include "editor/panels/walk_overlays.h"
#include "editor/panels/walk_preview.h"
#include "editor/session/adaptive_resolution.h"
#include "editor/session/graphics_trial.h"
#include "editor/session/walk_renderer.h"
#include "engine/view_gl/gl_renderer.h"

namespace acentric::editor {

class WalkPanel {
 public:
  /// `wake` is called from other threads when there is something new to be shown.
  WalkPanel(int threads, std::function<void()> wake);

  void draw(PanelContext& context);
  /// Was there a wake since the last call?
  bool takeNews() { return news_.exchange(false); }
  /// Moves the eye by what is held and what happened; also while the panel's picture is not under the
  /// pointer.
  void walk(PanelContext& context);

 private:
  struct Shown {
    std::shared_ptr<const LoadedWalk> loaded;
    PerspectiveView view;
    ViewSettings settings;
    WalkLook look = WalkLook::picture;
    FrameStats stats;
    double holeShare = -1;  ///< < 0: not measured
    bool valid = false;
  };
  void followProject(PanelContext& context);
  void drawToolbar(PanelContext& context);
  void drawButtons(PanelContext& context);
  void look(PanelContext& context, const ImVec2& low, const ImVec2& high);
  /// `at`: where in the picture, shares of its width and height.
  void openMenu(PanelContext& context, const glm::dvec2& at);
  void drawMenu(PanelContext& context);
  PerspectiveView viewAt(PanelContext& context, double scale) const;
  bool stale(const PanelContext& context, const PerspectiveView& full) const;
  void requestFrame(PanelContext& context);
  void takePicture(PanelContext& context);
  /// The first time; tells where it cannot be had.
  void openGl(Session& session);
  /// As the project says, on the processor where OpenGL cannot be had.
  ViewSettings settingsOf(const Session& session) const;
  void drawWithGl(PanelContext& context);
  void tryGraphics(PanelContext& context);
  /// Captures and meshes readied in the background; true if there is one that the picture lacks.
  bool receive(PanelContext& context);
  /// The frame as `shown_.look` says, without the truth.
  ColourImage pictureOf(const Frame& frame);
  void show(const Frame& frame);
  /// Keeps the frame that is shown where something else needs to know its pixels.
  void keepRested(PanelContext& context);
  void askForTruth(PanelContext& context);
  bool onAnswer(const glm::dvec2& at) const;
  void askThePicture(PanelContext& context);
  void drawAnswer(PanelContext& context, const ImVec2& low, const ImVec2& size);
  void savePicture(PanelContext& context);
  const SourceColours& coloursOf(const std::shared_ptr<const Layout>& layout);
  /// The name of the camera that painted what the pointer is at.
  void nameSource(const glm::dvec2& pointer) const;
  void drawOverlays(PanelContext& context, const ImVec2& low, const ImVec2& size);
  void drawPicture(PanelContext& context, const ImVec2& low, const ImVec2& size);
  bool worthPreview(const PanelContext& context) const;
  void drawNotice(const PanelContext& context, const ImVec2& low, const ImVec2& size) const;
  void drawStatistics(PanelContext& context, const ImVec2& low, const ImVec2& size) const;

  std::atomic<bool> news_ = false;
  int threads_;
  std::function<void()> wake_;
  WalkRenderer renderer_;
  AdaptiveResolution resolution_;
  std::unique_ptr<GlRenderer> gl_;
  std::string glProblem_;
  GraphicsTrial trial_;
  bool showingGl_ = false;
  std::uint32_t glPictures_ = 0;  ///< drawn so far

  ui::Texture texture_;
  Frame lastFrame_;
  /// lastFrame_ where it is what the walk wants to show, at full size, and is asked for; else null.
  std::shared_ptr<const Frame> rested_;
  std::shared_ptr<const Layout> colouredLayout_;
  std::optional<SourceColours> colours_;  ///< of colouredLayout_
  ui::FittedImage place_;                 ///< of the picture, last drawn
  Shown shown_;
  FrameTimes times_;
  WalkCompare compare_;
  WalkOverlays overlays_;
  WalkPreview preview_;
  bool previewing_ = false;  ///< the quick picture is shown
  std::string problem_;
  glm::ivec2 area_{0};
  int generation_ = -1;
  double lastStep_ = -1;
  bool looking_ = false;
  bool requested_ = false;
  glm::dvec2 lookFrom_{0};
  std::optional<glm::dvec2> menuAt_;     ///< a right click there opens the menu, if it is one
  std::optional<glm::dvec2> pressedAt_;  ///< a click there asks, if it is one
  std::optional<glm::dvec2> askAt_;      ///< window pixels; as soon as the picture rests
  glm::dvec2 menuFor_{};                 ///< where the menu was opened, window pixels
  glm::dvec2 answerLow_{0}, answerHigh_{0};
  float answerHeight_ = 60;  ///< pixels
  WalkPose loggedPose_;
  std::shared_ptr<const Compared> loggedCompared_;
  std::shared_ptr<const VariantFigures> loggedVariants_;
};

}  // namespace acentric::editor
