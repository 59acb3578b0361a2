#pragma once
/// The guided start: a few steps that each point at a widget and are done when the user has done the thing.
/// Pure: what the editor shows and holds is handed in.

#include <span>

namespace acentric::editor {

struct GuideFacts {
  int cells = 0;          ///< regions that are laid out
  int changes = 0;        ///< where the history stands
  bool coverage = false;  ///< is shown on the plan
  bool baking = false;
  int baked = 0;            ///< captures there are
  double walkedMetres = 0;  ///< since the program began
  bool dirty = false;       ///< unsaved changes
  int commands = 0;         ///< how often an action was looked up by name
};

struct GuideStep {
  const char* title;
  const char* text;
  const char* widget;  ///< name in the log of widgets of what it points at
  /// `begin`: when the step began; but dirty if it was at any time since.
  bool (*done)(const GuideFacts& begin, const GuideFacts& now);
};

std::span<const GuideStep> guideSteps();

class Guide {
 public:
  void start(const GuideFacts& now);
  void stop() { running_ = false; }
  bool running() const { return running_; }
  /// Into guideSteps().
  int index() const { return index_; }
  const GuideStep& step() const { return guideSteps()[std::size_t(index_)]; }
  bool first() const { return index_ == 0; }
  bool last() const;
  /// Goes to the next step when this one is done; after the last one it stops. True if it moved.
  bool observe(const GuideFacts& now);
  /// After the last one it stops.
  void next(const GuideFacts& now);
  void back(const GuideFacts& now);

 private:
  void go(int index, const GuideFacts& now);

  bool running_ = false;
  int index_ = 0;
  GuideFacts begin_;
};

}  // namespace acentric::editor
