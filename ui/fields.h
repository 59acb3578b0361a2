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
