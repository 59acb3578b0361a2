#include "ui/ui_log.h"

#include <fmt/format.h>
#include <imgui.h>

namespace acentric::ui {

bool UiLog::open(const std::filesystem::path& file) {
  file_.reset(std::fopen(file.c_str(), "w"));
  return on();
}

void UiLog::line(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), file_.get());
  std::fputc('\n', file_.get());
  std::fflush(file_.get());
}

void UiLog::beginFrame() {
  for (auto& [name, seen] : seen_) seen.now = false;
  watchedPlace_.reset();
}

void UiLog::rect(std::string_view name, float x0, float y0, float x1, float y1) {
  if (name == watched_) watchedPlace_ = Rect{x0, y0, x1, y1};
  if (!on()) return;
  std::string place = fmt::format("{:.0f} {:.0f} {:.0f} {:.0f}", x0, y0, x1, y1);
  auto found = seen_.find(name);
  if (found == seen_.end()) found = seen_.emplace(std::string(name), Seen{}).first;
  found->second.now = true;
  if (found->second.place == place) return;
  line(fmt::format("rect {} {}", name, place));
  found->second.place = std::move(place);
}

void UiLog::item(std::string_view name) {
  if (!on() && name != watched_) return;
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  rect(name, low.x, low.y, high.x, high.y);
}

void UiLog::endFrame() {
  if (!on()) return;
  for (auto it = seen_.begin(); it != seen_.end();) {
    if (it->second.now) {
      ++it;
      continue;
    }
    line(fmt::format("gone {}", it->first));
    it = seen_.erase(it);
  }
}

void UiLog::event(std::string_view name, std::string_view detail) {
  if (on()) line(detail.empty() ? fmt::format("event {}", name) : fmt::format("event {} {}", name, detail));
}

}  // namespace acentric::ui
