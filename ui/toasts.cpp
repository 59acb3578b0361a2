#include "ui/toasts.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "ui/theme.h"
#include "ui/translate.h"
#include "ui/widgets.h"

namespace acentric::ui {

Colour colourOf(Tone tone) {
  switch (tone) {
    case Tone::info:
      return palette::accent;
    case Tone::good:
      return palette::good;
    case Tone::warning:
      return palette::warning;
    case Tone::danger:
      return palette::danger;
  }
  return palette::accent;
}

void Toasts::post(Tone tone, const std::string& text, double now) {
  const double until = tone == Tone::danger ? std::numeric_limits<double>::infinity() : now + kSeconds;
  const auto same = std::find_if(toasts_.begin(), toasts_.end(),
                                 [&](const Toast& t) { return t.tone == tone && t.text == text; });
  if (same != toasts_.end()) {
    same->until = until;
    return;
  }
  toasts_.push_back({tone, text, until, {0, 0}, {0, 0}});
  if (toasts_.size() > kMost) toasts_.erase(toasts_.begin());
}

void Toasts::expire(double now) {
  std::erase_if(toasts_, [now](const Toast& toast) { return toast.until <= now; });
}

std::optional<double> Toasts::nextChange() const {
  double earliest = std::numeric_limits<double>::infinity();
  for (const Toast& toast : toasts_) earliest = std::min(earliest, toast.until);
  if (earliest == std::numeric_limits<double>::infinity()) return std::nullopt;
  return earliest;
}

bool Toasts::covers(const ImVec2& place) const {
  return std::any_of(toasts_.begin(), toasts_.end(), [&place](const Toast& toast) {
    return place.x >= toast.low.x && place.y >= toast.low.y && place.x < toast.high.x &&
           place.y < toast.high.y;
  });
}

bool Toasts::draw(const ImVec2& lowerRight, UiLog& log) {
  const float width = std::clamp(lowerRight.x, 1.0F, scaled(380));
  bool details = false;
  float bottom = lowerRight.y;
  int clicked = -1;
  for (int i = int(toasts_.size()) - 1; i >= 0; --i) {
    Toast& toast = toasts_[std::size_t(i)];
    ImGui::SetNextWindowPos({lowerRight.x, bottom}, ImGuiCond_Always, {1, 1});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::raised.withOpacity(0.97F).vec());
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                        ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
    if (ImGui::Begin(fmt::format("##toast{}", i).c_str(), nullptr, kFlags)) {
      const ImVec2 at = ImGui::GetWindowPos();
      const ImVec2 size = ImGui::GetWindowSize();
      ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + scaled(4), at.y + size.y},
                                                colourOf(toast.tone).packed(), 3);
      ImGui::PushTextWrapPos(0);
      ImGui::TextUnformatted(toast.text.c_str());
      ImGui::PopTextWrapPos();
      const bool grave = toast.tone == Tone::warning || toast.tone == Tone::danger;
      if (grave && ImGui::SmallButton(tr("Details"))) {
        details = true;
        clicked = i;
      }
      if (grave) {
        log.item("toast.details");
        tooltip(tr("Shows the message among all others, where it can be copied."));
      }
      if (ImGui::IsWindowHovered() && !ImGui::IsAnyItemHovered() &&
          ImGui::IsMouseClicked(ImGuiMouseButton_Left))
        clicked = i;
      toast.low = at;
      toast.high = {at.x + size.x, at.y + size.y};
      bottom -= size.y + scaled(8);
    }
    ImGui::End();
    ImGui::PopStyleColor();
  }
  if (clicked >= 0) toasts_.erase(toasts_.begin() + clicked);
  return details;
}

}  // namespace acentric::ui
