#pragma once
/// The file dialog: opens or saves one file. Arrow keys walk the list, Enter opens, Backspace goes up, Escape
/// cancels, and typing in the name field filters (open) or names the file (save). A path that begins with /
/// or ~ may be typed or pasted there: the list follows it.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ui/directory_listing.h"
#include "ui/fields.h"
#include "ui/input_queue.h"
#include "ui/ui_log.h"

namespace acentric::ui {

struct FileRequest {
  std::string title;
  bool saving = false;
  std::filesystem::path folder;
  std::string name;                  ///< proposed, when saving
  std::vector<std::string> endings;  ///< lower case; the first is added to a saved name without it
};

class FileBrowser {
 public:
  using Chosen = std::function<void(const std::filesystem::path&)>;

  void open(const FileRequest& request, Chosen chosen);
  bool isOpen() const { return open_; }
  /// Keys that came while it is open; true if it used the event.
  bool handleKey(const InputEvent& event);
  /// Draws the modal, if open.
  void draw(UiLog& log);

 private:
  void enter(const std::filesystem::path& folder);
  void list(const std::filesystem::path& folder);
  void followTyped();
  void choose(const std::filesystem::path& path, bool confirmed);
  void accept();
  void drawPlaces();
  void drawEntries(UiLog& log);
  void drawFooter(UiLog& log);
  std::vector<std::size_t> shownEntries() const;

  FileRequest request_;
  Chosen chosen_;
  bool open_ = false;
  bool opening_ = false;
  bool enter_ = false;
  bool scrollToSelection_ = false;
  std::filesystem::path folder_;
  DirectoryListing listing_;
  std::string name_;
  ReadyTextField nameField_;
  std::string question_;  ///< "replace it?", else empty
  std::filesystem::path pending_;
  int selected_ = -1;  ///< into shownEntries()
};

}  // namespace acentric::ui
