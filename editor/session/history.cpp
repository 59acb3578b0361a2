#include "editor/session/history.h"

#include <utility>

#include "engine/base/contract.h"

namespace acentric::editor {
namespace {
const std::string kNothing;
}

History::History(Project initial, bool saved) : everSaved_(saved) {
  if (saved) saved_ = initial;
  entries_.push_back({"Open", std::move(initial)});
  compareWithSaved();
}

void History::append(Project project, std::string label) {
  entries_.resize(cursor_ + 1);
  entries_.push_back({std::move(label), std::move(project)});
  if (entries_.size() > kMostEntries) entries_.erase(entries_.begin());
  cursor_ = entries_.size() - 1;
  compareWithSaved();
}

void History::push(Project project, std::string label) {
  commitPreview();
  if (project == current()) return;
  append(std::move(project), std::move(label));
}

void History::preview(Project project, std::string label) {
  if (previewing_) {
    entries_[cursor_] = {std::move(label), std::move(project)};
    return compareWithSaved();
  }
  if (project == current()) return;
  const auto behind = entries_.begin() + static_cast<std::ptrdiff_t>(cursor_) + 1;
  hiddenRedo_.assign(std::make_move_iterator(behind), std::make_move_iterator(entries_.end()));
  append(std::move(project), std::move(label));
  previewing_ = true;
}

void History::commitPreview() {
  if (!previewing_) return;
  // Dragged back to where it began: not an edit, so nothing to undo and nothing lost for redo.
  if (cursor_ > 0 && entries_[cursor_].project == entries_[cursor_ - 1].project) return rollbackPreview();
  previewing_ = false;
  hiddenRedo_.clear();
}

void History::rollbackPreview() {
  if (!previewing_) return;
  require(cursor_ > 0, "a preview stands on an entry");
  entries_.resize(cursor_);
  --cursor_;
  for (Entry& entry : hiddenRedo_) entries_.push_back(std::move(entry));
  hiddenRedo_.clear();
  previewing_ = false;
  compareWithSaved();
}

const std::string& History::undoLabel() const { return canUndo() ? entries_[cursor_].label : kNothing; }
const std::string& History::redoLabel() const { return canRedo() ? entries_[cursor_ + 1].label : kNothing; }

void History::undo() {
  commitPreview();
  if (canUndo()) --cursor_;
  compareWithSaved();
}

void History::redo() {
  commitPreview();
  if (canRedo()) ++cursor_;
  compareWithSaved();
}

void History::discardCurrent() {
  if (previewing_) return rollbackPreview();
  if (!canUndo()) return;
  entries_.resize(cursor_);
  --cursor_;
  compareWithSaved();
}

void History::markSaved() {
  saved_ = current();
  everSaved_ = true;
  compareWithSaved();
}

}  // namespace acentric::editor
