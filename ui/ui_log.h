#pragma once
/// For tests that drive the program by real input: writes where each named widget is, and what happened, one
/// line each, flushed at once. Without a file it only knows where a widget is that is watched.
///   rect NAME x0 y0 x1 y1     when it first shows or moves (window pixels)
///   gone NAME                 when it no longer shows
///   event NAME DETAIL...

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace acentric::ui {

class UiLog {
 public:
  UiLog() = default;
  struct Rect {
    float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  };

  /// False when the file cannot be written.
  bool open(const std::filesystem::path& file);
  bool on() const { return file_ != nullptr; }

  void beginFrame();
  void rect(std::string_view name, float x0, float y0, float x1, float y1);
  /// The widget that ImGui drew last.
  void item(std::string_view name);
  void endFrame();
  /// Where one widget is, also without a file: of the name that was watched, in this frame.
  void watch(std::string_view name) { watched_ = name; }
  const std::optional<Rect>& watched() const { return watchedPlace_; }
  void event(std::string_view name, std::string_view detail = {});

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Seen {
    std::string place;
    bool now = false;
  };
  void line(const std::string& text);
  std::unique_ptr<std::FILE, Close> file_;
  std::map<std::string, Seen, std::less<>> seen_;
  std::string watched_;
  std::optional<Rect> watchedPlace_;
};

}  // namespace acentric::ui
