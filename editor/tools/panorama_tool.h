#pragma once
/// Places single panoramas beside the lattice: click free ground for one with cameras a cell's edge from its
/// centre, or drag to choose how far and which way; click one to select it, drag it to move it, Ctrl+click
/// takes it away. Events in, intentions out.

#include <optional>
#include <variant>

#include "editor/tools/pointer_event.h"
#include "engine/layout/layout_spec.h"

namespace acentric::editor {

/// A free APV as it should be; while it is dragged, not yet `finished`. Without a number, a new one.
struct FreeApvIntent {
  std::optional<int> number;
  Apv apv;
  bool finished = true;
};
struct SelectApvIntent {
  int number = 0;
};
struct RemoveApvIntent {
  int number = 0;
};
using PanoramaIntent = std::variant<std::monostate, FreeApvIntent, SelectApvIntent, RemoveApvIntent>;

/// The one whose centre is nearest within reach, else the first whose polygon holds the point.
std::optional<int> freeApvAt(const LayoutSpec& spec, const glm::dvec2& point, double pixelsPerMetre);

class PanoramaTool {
 public:
  /// Left button only.
  PanoramaIntent press(const PointerEvent& event, const LayoutSpec& spec, double pixelsPerMetre);
  PanoramaIntent move(const PointerEvent& event);
  PanoramaIntent release(const PointerEvent& event);
  /// True if something was afoot.
  bool cancel();
  bool dragging() const { return number_ && dragged_; }
  /// The one that is being placed.
  std::optional<Apv> inHand() const { return pressed_ && !number_ ? std::optional(apv_) : std::nullopt; }

 private:
  bool pressed_ = false, dragged_ = false;
  std::optional<int> number_;  // of the one in hand; none: a new one
  Apv apv_;                    // as it would be
  glm::dvec2 pressScreen_{0}, grabOffset_{0};
};

}  // namespace acentric::editor
