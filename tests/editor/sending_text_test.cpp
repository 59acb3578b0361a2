#include "editor/session/sending_text.h"

#include <gtest/gtest.h>

namespace acentric::editor {
namespace {

TEST(CapturesAwaitedText, TellsHowManyAndWhatIsMissing) {
  FrameStats stats;
  EXPECT_EQ(capturesAwaitedText(stats), "");
  stats.capturesAwaited = stats.standIns = 3;
  EXPECT_EQ(capturesAwaitedText(stats), "3 captures on their way to the graphics card");
  stats.standIns = 1;
  EXPECT_EQ(capturesAwaitedText(stats),
            "3 captures on their way to the graphics card, 2 with nothing in their place");
}

}  // namespace
}  // namespace acentric::editor
