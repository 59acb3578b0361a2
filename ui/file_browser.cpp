#include "ui/file_browser.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "ui/colour.h"
#include "ui/keys.h"
#include "ui/text_format.h"
#include "ui/theme.h"
#include "ui/translate.h"
#include "ui/widgets.h"

namespace acentric::ui {
namespace fs = std::filesystem;
namespace {

bool isPath(const std::string& typed) { return typed.starts_with('/') || typed.starts_with("~/"); }

/// With the home folder for a ~ at the beginning.
fs::path fromHome(const std::string& typed) {
  const char* home = std::getenv("HOME");
  return typed.starts_with("~/") && home != nullptr ? fs::path(home) / typed.substr(2) : fs::path(typed);
}

}  // namespace

void FileBrowser::open(const FileRequest& request, Chosen chosen) {
  request_ = request;
  chosen_ = std::move(chosen);
  open_ = opening_ = true;
  enter_ = false;
  name_ = request.saving ? request.name : "";
  question_.clear();
  std::error_code error;
  fs::path start = fs::is_directory(request.folder, error) ? request.folder : fs::current_path(error);
  enter(start.empty() ? fs::path("/") : start);
}

void FileBrowser::list(const fs::path& folder) {
  std::error_code error;
  const fs::path absolute = fs::weakly_canonical(fs::absolute(folder, error), error);
  folder_ = absolute.empty() ? folder : absolute;
  listing_ = listDirectory(folder_, request_.endings);
  selected_ = -1;
  question_.clear();
}

void FileBrowser::enter(const fs::path& folder) {
  list(folder);
  if (!request_.saving || isPath(name_)) name_ = request_.saving ? request_.name : "";
  nameField_.begin(request_.saving);
}

/// Lists the folder of a path that is being typed, once there is one.
void FileBrowser::followTyped() {
  selected_ = -1;
  question_.clear();
  if (!isPath(name_)) return;
  std::error_code error;
  const fs::path typed = fromHome(name_).parent_path();
  if (typed != folder_ && fs::is_directory(typed, error)) list(typed);
}

std::vector<std::size_t> FileBrowser::shownEntries() const {
  std::vector<std::size_t> shown;
  const std::string typed = isPath(name_) ? fromHome(name_).filename().string() : name_;
  const std::string filter = request_.saving ? "" : lowerCase(typed);
  for (std::size_t i = 0; i < listing_.entries.size(); ++i)
    if (lowerCase(listing_.entries[i].name).find(filter) != std::string::npos) shown.push_back(i);
  return shown;
}

void FileBrowser::choose(const fs::path& path, bool confirmed) {
  std::error_code error;
  if (fs::is_directory(path, error)) return enter(path);
  if (request_.saving) {
    fs::path target = path;
    if (!request_.endings.empty() && !endsWithAny(target.filename().string(), request_.endings))
      target += request_.endings.front();
    if (!confirmed && fs::exists(target, error)) {
      question_ = trf("{} exists. Replace it?", target.filename().string());
      pending_ = target;
      return;
    }
    open_ = false;
    return chosen_(target);
  }
  if (!fs::exists(path, error)) {
    listing_.problem = trf("{}: no such file", path.string());
    return;
  }
  open_ = false;
  chosen_(path);
}

void FileBrowser::accept() {
  if (!question_.empty()) return choose(pending_, true);
  const std::vector<std::size_t> shown = shownEntries();
  if (selected_ >= 0 && selected_ < int(shown.size()))
    return choose(folder_ / listing_.entries[shown[std::size_t(selected_)]].name, false);
  if (name_.empty()) return;
  const fs::path typed = fromHome(name_);
  std::error_code error;
  if (!request_.saving && shown.size() == 1 && !fs::exists(folder_ / typed, error))
    return choose(folder_ / listing_.entries[shown.front()].name, false);
  choose(typed.is_absolute() ? typed : folder_ / typed, false);
}

bool FileBrowser::handleKey(const InputEvent& event) {
  if (!open_ || (event.kind != InputEvent::Kind::keyPress && event.kind != InputEvent::Kind::keyRepeat))
    return false;
  const int count = int(shownEntries().size());
  const auto select = [&](int index) {
    selected_ = count == 0 ? -1 : std::clamp(index, 0, count - 1);
    scrollToSelection_ = true;
  };
  switch (event.code) {
    case key::down:
      select(selected_ + 1);
      return true;
    case key::up:
      select(std::max(0, selected_ - 1));
      return true;
    case key::pageDown:
      select(selected_ + 12);
      return true;
    case key::pageUp:
      select(selected_ - 12);
      return true;
    case key::enter:
    case key::keypadEnter:
      enter_ = true;  // once the field has what was typed before it
      return true;
    case key::escape:
      if (question_.empty())
        open_ = false;
      else
        question_.clear();
      return true;
    case key::backspace:
      if (!name_.empty() && request_.saving) return false;
      if (!name_.empty()) return false;
      enter(folder_.parent_path());
      return true;
    default:
      return false;
  }
}

void FileBrowser::drawPlaces() {
  const auto place = [this](const char* label, const fs::path& path) {
    if (button(label)) enter(path);
    ImGui::SameLine();
  };
  place(tr("↑ Up"), folder_.parent_path());
  if (const char* home = std::getenv("HOME")) place(tr("Home"), home);
  place("/", "/");
  ImGui::AlignTextToFramePadding();
  mutedText(shortenPath(folder_.string(), 78));
}

void FileBrowser::drawEntries(UiLog& log) {
  const float footer = 2 * ImGui::GetFrameHeightWithSpacing() + scaled(16);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, palette::backdrop.vec());
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, scaled(ImVec2(8, 6)));
  ImGui::BeginChild("##entries", {0, -footer}, true, ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PopStyleVar();
  const std::vector<std::size_t> shown = shownEntries();
  if (!listing_.problem.empty()) wrappedText(palette::danger, listing_.problem);
  if (shown.empty() && listing_.problem.empty()) mutedText(tr("Nothing to open in this folder."));
  fs::path opened;
  for (int row = 0; row < int(shown.size()); ++row) {
    const DirectoryEntry& entry = listing_.entries[shown[std::size_t(row)]];
    ImGui::PushID(row);
    const std::string label = entry.folder ? "▸  " + entry.name : "    " + entry.name;
    if (ImGui::Selectable(label.c_str(), row == selected_, ImGuiSelectableFlags_AllowDoubleClick)) {
      selected_ = row;
      if (request_.saving && !entry.folder) name_ = entry.name;
      if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) opened = folder_ / entry.name;
    }
    log.item("file." + entry.name);
    if (!entry.folder) {
      const std::string size = formatBytes(entry.bytes);
      ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(size.c_str()).x - 4);
      mutedText(size);
    }
    if (row == selected_ && scrollToSelection_) ImGui::SetScrollHereY();
    ImGui::PopID();
  }
  scrollToSelection_ = false;
  ImGui::EndChild();
  ImGui::PopStyleColor();
  if (!opened.empty()) choose(opened, false);
}

void FileBrowser::drawFooter(UiLog& log) {
  ImGui::AlignTextToFramePadding();
  mutedText(request_.saving ? tr("Name") : tr("Find"));
  ImGui::SameLine();
  if (nameField_.draw("", name_)) followTyped();
  log.item("file.name");
  ImGui::AlignTextToFramePadding();
  if (question_.empty()) {
    std::string filter = tr("All files");
    if (!request_.endings.empty()) filter = fmt::format("{}", fmt::join(request_.endings, " "));
    mutedText(filter);
  } else {
    wrappedText(palette::warning, question_);
  }
  const float width = scaled(96);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 2 * width - ImGui::GetStyle().ItemSpacing.x);
  if (button(tr("Cancel"), {width, 0})) open_ = false;
  log.item("file.cancel");
  ImGui::SameLine();
  const char* verb = !question_.empty() ? tr("Replace") : request_.saving ? tr("Save") : tr("Open");
  if (primaryButton(verb, {width, 0}, selected_ >= 0 || !name_.empty())) accept();
  log.item("file.accept");
}

void FileBrowser::draw(UiLog& log) {
  if (!open_) return;
  const std::string id = request_.title + "###fileBrowser";
  if (opening_) {
    ImGui::OpenPopup(id.c_str());
    opening_ = false;
  }
  const ImVec2 centre = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(centre, ImGuiCond_Appearing, {0.5F, 0.5F});
  ImGui::SetNextWindowSize(scaled(ImVec2(760, 520)), ImGuiCond_Appearing);
  bool stay = true;
  if (ImGui::BeginPopupModal(id.c_str(), &stay, ImGuiWindowFlags_NoSavedSettings)) {
    drawPlaces();
    drawEntries(log);
    drawFooter(log);
    if (std::exchange(enter_, false)) accept();
    if (!stay) open_ = false;
    if (!open_) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
  } else if (!stay) {
    open_ = false;
  }
}

}  // namespace acentric::ui
