#pragma once
/// Short messages in a corner that go away by themselves; errors stay until clicked.

#include <imgui.h>

#include <optional>
#include <string>
#include <vector>

#include "ui/colour.h"
#include "ui/ui_log.h"

namespace acentric::ui {

enum class Tone { info, good, warning, danger };
Colour colourOf(Tone tone);

class Toasts {
 public:
  static constexpr std::size_t kMost = 5;
  static constexpr double kSeconds = 5;

  /// The same text again renews the toast that shows it.
  void post(Tone tone, const std::string& text, double now);
  void expire(double now);
  /// When something will change by itself: the next expiry.
  std::optional<double> nextChange() const;
  std::size_t count() const { return toasts_.size(); }
  /// Does a toast that was drawn last cover this place (window pixels)?
  bool covers(const ImVec2& place) const;
  /// Stacked upwards from a corner (window pixels). True if the details of one were asked for.
  bool draw(const ImVec2& lowerRight, UiLog& log);

 private:
  struct Toast {
    Tone tone = Tone::info;
    std::string text;
    double until = 0;  ///< infinity: until clicked
    ImVec2 low{0, 0}, high{0, 0};
  };
  std::vector<Toast> toasts_;
};

}  // namespace acentric::ui
