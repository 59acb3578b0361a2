#pragma once
/// Labelled values in two columns, with units. Each returns how the user's edit stands, so that a drag or a
/// typed value becomes one entry of the history.

#include <span>
#include <string>

namespace acentric::ui {

struct FieldEdit {
  bool changed = false;   ///< the value differs from before, now
  bool finished = false;  ///< the edit that changed it is over
  explicit operator bool() const { return changed || finished; }
};

struct NumberField {
  const char* label = "";
  const char* format = "%.2f";  ///< printf, with the unit: "%.2f m"
  double speed = 0.01;          ///< per pixel dragged
  double least = 0;
  double most = 0;
  const char* help = "";
};

/// `labelWidth` for the label column, unscaled.
FieldEdit numberField(const NumberField& field, double& value, float labelWidth);
FieldEdit numberField(const NumberField& field, int& value, float labelWidth);
FieldEdit checkField(const char* label, bool& value, float labelWidth, const char* help = "");

/// A text field that has the keyboard from the frame on that it is shown in. (ImGui's own takes text from its
/// third frame on: what is typed before is put into it, and the caret behind.)
class ReadyTextField {
 public:
  /// It is about to be shown, or is to have the keyboard again, with the text it has now: what is typed comes
  /// behind it, or instead of it.
  void begin(bool instead = false);
  /// True if the text changed.
  bool draw(const char* hint, std::string& text);

 private:
  int number_ = 0;  ///< of begin(): ImGui keeps the text of a field that it knows
  bool focus_ = false;
  bool instead_ = false;
  bool early_ = false;  ///< the field doesn't take text yet
};

struct Choice {
  std::string label;
  std::string help;
  bool enabled = true;
  std::string shortLabel = {};  ///< while the list is closed; empty = label
};
/// Index into `choices`.
FieldEdit choiceField(const char* label, std::span<const Choice> choices, int& index, float labelWidth,
                      const char* help = "");

}  // namespace acentric::ui
