#include "editor/session/sending_text.h"

#include <fmt/format.h>

#include "ui/translate.h"

namespace acentric::editor {

std::string capturesAwaitedText(const FrameStats& stats) {
  if (stats.capturesAwaited == 0) return {};
  const int missing = stats.capturesAwaited - stats.standIns;
  return trf("{} captures on their way to the graphics card", stats.capturesAwaited) +
         (missing > 0 ? trf(", {} with nothing in their place", missing) : "");
}

}  // namespace acentric::editor
