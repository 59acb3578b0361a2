#include "editor/session/history.h"

#include <utility>

#include "editor/session/project_size.h"
#include "engine/base/contract.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {
const std::string kNothing;
}

History::Entry History::makeEntry(Project project, std::string label) {
  const std::size_t bytes = approximateBytes(project) + label.capacity();
  return {std::move(label), std::move(project), bytes};
}

History::History(Project initial, bool saved, std::size_t mostBytes)
    : mostBytes_(mostBytes), everSaved_(saved) {
  if (saved) saved_ = initial;
  entries_.push_back(makeEntry(std::move(initial), tr("Open")));
  forgetOldest();
  compareWithSaved();
}

void History::append(Project project, std::string label) {
  entries_.resize(cursor_ + 1);
  entries_.push_back(makeEntry(std::move(project), std::move(label)));
  cursor_ = entries_.size() - 1;
  compareWithSaved();
}

/// Not while previewing: what is rolled back has to leave no trace.
void History::forgetOldest() {
  bytes_ = 0;
  for (const Entry& entry : entries_) bytes_ += entry.bytes;
  std::size_t oldest = 0;
  while (oldest + 1 < cursor_ && (entries_.size() - oldest > kMostEntries || bytes_ > mostBytes_))
    bytes_ -= entries_[oldest++].bytes;
  entries_.erase(entries_.begin(), entries_.begin() + std::ptrdiff_t(oldest));
  cursor_ -= oldest;
  dropped_ += oldest;
}

void History::setMostBytes(std::size_t bytes) {
  mostBytes_ = bytes;
  if (!previewing_) forgetOldest();
}

void History::push(Project project, std::string label) {
  commitPreview();
  if (project == current()) return;
  append(std::move(project), std::move(label));
  forgetOldest();
}

void History::walkInto(int storey) {
  if (previewing_) return;
  if (everSaved_ && !dirty_) saved_.storey = storey;
  entries_[cursor_].project.storey = storey;
  compareWithSaved();
}

void History::preview(Project project, std::string label) {
  if (previewing_) {
    entries_[cursor_] = makeEntry(std::move(project), std::move(label));
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
  forgetOldest();
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

void History::goTo(std::size_t entry) {
  commitPreview();
  require(entry < entries_.size(), "an entry of the history");
  cursor_ = entry;
  compareWithSaved();
}

std::optional<std::size_t> History::find(const Project& project) const {
  for (std::size_t away = 0; away < entries_.size(); ++away) {
    if (away <= cursor_ && entries_[cursor_ - away].project == project) return cursor_ - away;
    if (cursor_ + away < entries_.size() && entries_[cursor_ + away].project == project)
      return cursor_ + away;
  }
  return std::nullopt;
}

void History::discardCurrent() {
  if (previewing_) return rollbackPreview();
  if (!canUndo()) return;
  entries_.resize(cursor_);
  --cursor_;
  forgetOldest();
  compareWithSaved();
}

void History::markSaved() {
  saved_ = current();
  everSaved_ = true;
  compareWithSaved();
}

}  // namespace acentric::editor
