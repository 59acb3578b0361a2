#pragma once
/// Undo and redo: snapshots of the whole Project with a cursor. A drag or a slider is one entry: while it
/// lasts it is a preview that replaces itself, then it is committed or rolled back. Bakes are never on the
/// history. The oldest entries go beyond a number of them or an amount of memory, but never the last edit.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/pipeline/project.h"

namespace acentric::editor {

class History {
 public:
  static constexpr std::size_t kMostEntries = 1000;
  static constexpr std::size_t kUsualBytes = 256'000'000;

  /// `saved`: the project is on disk as it is.
  History(Project initial, bool saved, std::size_t mostBytes = kUsualBytes);

  const Project& current() const { return entries_[cursor_].project; }
  /// A finished edit; what could be redone is gone. An edit that changes nothing is no entry.
  void push(Project project, std::string label);

  void preview(Project project, std::string label);
  void commitPreview();
  void rollbackPreview();
  bool previewing() const { return previewing_; }

  bool canUndo() const { return cursor_ > 0; }
  bool canRedo() const { return cursor_ + 1 < entries_.size(); }
  const std::string& undoLabel() const;  ///< of what undo() takes back; empty if nothing
  const std::string& redoLabel() const;
  void undo();
  void redo();
  /// Where the eye walks is no edit: the current entry is on this storey now, and what is on disk if it is
  /// the same. Not while previewing.
  void walkInto(int storey);
  /// To any entry: as many steps back or forth as lie between.
  void goTo(std::size_t entry);
  /// The entry nearest to the current one that holds this project.
  std::optional<std::size_t> find(const Project& project) const;
  /// Takes back the current entry and forgets it: it turned out to be impossible.
  void discardCurrent();

  void markSaved();
  bool dirty() const { return dirty_; }

  std::size_t size() const { return entries_.size(); }
  std::size_t cursor() const { return cursor_; }
  const std::string& label(std::size_t entry) const { return entries_[entry].label; }
  /// Of all entries, as approximateBytes() tells.
  std::size_t bytes() const { return bytes_; }
  std::size_t dropped() const { return dropped_; }  ///< oldest entries that had no room
  void setMostBytes(std::size_t bytes);

 private:
  struct Entry {
    std::string label;
    Project project;
    std::size_t bytes = 0;
  };
  static Entry makeEntry(Project project, std::string label);
  void append(Project project, std::string label);
  void forgetOldest();
  void compareWithSaved() { dirty_ = !everSaved_ || saved_ != current(); }

  std::vector<Entry> entries_;
  std::size_t cursor_ = 0;
  std::size_t mostBytes_ = kUsualBytes;
  std::size_t bytes_ = 0;
  std::size_t dropped_ = 0;
  Project saved_;
  bool everSaved_ = false;
  bool dirty_ = false;  // asked for in every frame: projects with many cells are not compared each time
  bool previewing_ = false;
  std::vector<Entry> hiddenRedo_;  // what push() would drop, kept until a preview is committed
};

}  // namespace acentric::editor
