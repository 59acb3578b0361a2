#include "editor/session/guide.h"

#include <algorithm>
#include <array>

#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr double kWalkMetres = 1;

constexpr std::array<GuideStep, 6> kSteps = {
    {{trLater("Place cells"),
      trLater("The plan shows the floor and the cells laid on it. Click a free place (thin outline) to add a "
              "cell; "
              "drag "
              "one to move it, Del removes it. Everything can be undone with Ctrl+Z."),
      "plan",
      [](const GuideFacts& begin, const GuideFacts& now) {
        return now.changes != begin.changes && now.cells != begin.cells;
      }},
     {trLater("See what will be sampled"),
      trLater("Choose coverage here, or press V: it colours surfaces by how finely the cameras of this "
              "layout would "
              "sample them, before anything is baked. Magenta is never sampled: a hole."),
      "overlay", [](const GuideFacts&, const GuideFacts& now) { return now.coverage; }},
     {trLater("Bake"),
      trLater("Bake makes the captures that the walk is drawn from, in the background and nearest to the eye "
              "first. "
              "Go "
              "on working meanwhile; what is finished stays if you stop it."),
      "bake.start",
      [](const GuideFacts& begin, const GuideFacts& now) { return now.baking || now.baked > begin.baked; }},
     {trLater("Walk"),
      trLater("Walk with W A S D and look around by dragging in the picture; it appears as captures arrive. "
              "Shift "
              "walks faster."),
      "walk",
      [](const GuideFacts& begin, const GuideFacts& now) {
        return now.walkedMetres - begin.walkedMetres >= kWalkMetres;
      }},
     {trLater("Save"),
      trLater(
          "Ctrl+S saves the project; Save as… in the File menu keeps a copy of your own, captures included."),
      "menu.File", [](const GuideFacts& begin, const GuideFacts& now) { return begin.dirty && !now.dirty; }},
     {trLater("Find anything"),
      trLater(
          "Ctrl+Shift+P finds every command by a few letters of its name. F1 lists all keys, F10 opens the "
          "menus. "
          "This guide is in the Help menu."),
      "menu.Help",
      [](const GuideFacts& begin, const GuideFacts& now) { return now.commands > begin.commands; }}}};

}  // namespace

std::span<const GuideStep> guideSteps() { return kSteps; }

bool Guide::last() const { return index_ + 1 == int(kSteps.size()); }

void Guide::go(int index, const GuideFacts& now) {
  running_ = index < int(kSteps.size());
  index_ = std::clamp(index, 0, int(kSteps.size()) - 1);
  begin_ = now;
}

void Guide::start(const GuideFacts& now) { go(0, now); }
void Guide::next(const GuideFacts& now) { go(index_ + 1, now); }
void Guide::back(const GuideFacts& now) { go(index_ - 1, now); }

bool Guide::observe(const GuideFacts& now) {
  if (!running_) return false;
  begin_.dirty = begin_.dirty || now.dirty;
  if (!step().done(begin_, now)) return false;
  next(now);
  return true;
}

}  // namespace acentric::editor
