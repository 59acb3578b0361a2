#include "ui/input_queue.h"

#include <gtest/gtest.h>

#include "ui/keys.h"

namespace acentric::ui {
namespace {

using Kind = InputEvent::Kind;

TEST(InputQueue, KeepsAPressAndItsReleaseFromWithinOneFrame) {
  InputQueue queue;
  queue.push({Kind::keyPress, 65, 0, {}, {}, 1.00});
  queue.push({Kind::keyRelease, 65, 0, {}, {}, 1.01});
  EXPECT_FALSE(queue.keyHeld(65));
  const auto events = queue.take();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, Kind::keyPress);
  EXPECT_EQ(events[1].kind, Kind::keyRelease);
  EXPECT_TRUE(queue.empty());
}

TEST(InputQueue, RemembersWhereAButtonWentDownThoughThePointerMovedOn) {
  InputQueue queue;
  queue.push({Kind::move, 0, 0, {10, 20}, {}, 0});
  queue.push({Kind::buttonPress, 0, 0, queue.pointer(), {}, 0});
  queue.push({Kind::move, 0, 0, {90, 80}, {}, 0});
  const auto events = queue.take();
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[1].position, glm::dvec2(10, 20));
  EXPECT_EQ(queue.pointer(), glm::dvec2(90, 80));
}

TEST(InputQueue, GivesWhatWasPutBackBeforeWhatCameSince) {
  InputQueue queue;
  queue.push(InputEvent{InputEvent::Kind::keyPress, 'A'});
  queue.push(InputEvent{InputEvent::Kind::keyPress, 'B'});
  std::vector<InputEvent> taken = queue.take();
  queue.push(InputEvent{InputEvent::Kind::keyPress, 'C'});
  queue.putBack({taken.begin() + 1, taken.end()});
  taken = queue.take();
  ASSERT_EQ(taken.size(), 2U);
  EXPECT_EQ(taken[0].code, 'B');
  EXPECT_EQ(taken[1].code, 'C');
}

TEST(InputQueue, MergesMovesThatFollowOneAnother) {
  InputQueue queue;
  for (int i = 0; i < 50; ++i) queue.push({Kind::move, 0, 0, {double(i), 0}, {}, 0});
  const auto events = queue.take();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].position.x, 49);
}

TEST(InputQueue, ModifiersHoldFromTheirKeysPressToItsRelease) {
  InputQueue queue;
  queue.push({Kind::keyPress, key::leftShift, 0, {}, {}, 0});  // X11 tells what was held before it
  EXPECT_EQ(queue.modifiers(), modifier::shift);
  queue.push({Kind::move, 0, queue.modifiers(), {5, 5}, {}, 0});
  queue.push({Kind::keyPress, key::rightControl, modifier::shift, {}, {}, 0});
  EXPECT_EQ(queue.modifiers(), modifier::shift | modifier::control);
  queue.push({Kind::keyRelease, key::leftShift, modifier::shift | modifier::control, {}, {}, 0});
  EXPECT_EQ(queue.modifiers(), modifier::control);
}

TEST(InputQueue, LosingTheFocusReleasesWhatIsHeld) {
  InputQueue queue;
  queue.push({Kind::keyPress, 87, 0, {}, {}, 0});
  queue.push({Kind::buttonPress, 1, 0, {}, {}, 0});
  queue.take();
  queue.releaseAll(2);
  EXPECT_FALSE(queue.keyHeld(87));
  const auto events = queue.take();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, Kind::keyRelease);
  EXPECT_EQ(events[1].kind, Kind::buttonRelease);
}

}  // namespace
}  // namespace acentric::ui
