/// Where the window opens, on desktops that are only described.

#include "ui/window_place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace acentric::ui {
namespace {

const glm::ivec2 kWanted(1600, 900);
const FrameSize kFrame{1, 30, 1, 1};

Monitor monitor(const char* name, const glm::ivec2& at, const glm::ivec2& size, int panel = 0) {
  return {name, {at, size}, {{at.x, at.y + panel}, {size.x, size.y - panel}}};
}
/// Frame and all.
bool liesIn(const ScreenRect& rect, const FrameSize& frame, const ScreenRect& area) {
  const glm::ivec2 low = rect.at - glm::ivec2(frame.left, frame.top);
  const glm::ivec2 high = rect.at + rect.size + glm::ivec2(frame.right, frame.bottom);
  return low.x >= area.at.x && low.y >= area.at.y && high.x <= area.at.x + area.size.x &&
         high.y <= area.at.y + area.size.y;
}

TEST(WindowPlace, AScreenWithRoomShowsTheWantedSizeInItsMiddle) {
  const std::vector<Monitor> monitors = {monitor("A", {0, 0}, {2560, 1440})};
  EXPECT_EQ(placeWindow(kWanted, {}, monitors, {}), (PlacedWindow{{{480, 270}, kWanted}, false}));
  const std::vector<Monitor> exact = {monitor("A", {0, 0}, {1600, 900})};
  EXPECT_EQ(placeWindow(kWanted, {}, exact, {}), (PlacedWindow{{{0, 0}, kWanted}, false}));
}

TEST(WindowPlace, ASmallScreenIsFilledAndNothingLiesOutside) {
  for (const glm::ivec2& size :
       {glm::ivec2(1280, 720), glm::ivec2(1366, 768), glm::ivec2(1600, 900), glm::ivec2(640, 480)})
    for (const int panel : {0, 28}) {
      const std::vector<Monitor> monitors = {monitor("A", {100, 50}, size, panel)};
      const PlacedWindow placed = placeWindow(kWanted, kFrame, monitors, {});
      EXPECT_TRUE(liesIn(placed.rect, kFrame, monitors.front().work)) << size.x << " " << panel;
      EXPECT_TRUE(placed.maximised) << size.x;
      EXPECT_GE(placed.rect.size.x, std::min(kWanted.x, size.x - 2));
    }
}

TEST(WindowPlace, EachMonitorHasItsOwnAndTheLastUsedOneIsFirst) {
  const Monitor left = monitor("left", {0, 0}, {1920, 1080}, 30);
  const Monitor right = monitor("right", {1920, 0}, {2560, 1440});
  const std::vector<Monitor> both = {left, right};
  std::vector<WindowPlace> places;
  remember(places, *placeToRemember({{{40, 90}, {900, 700}}, false}, both));
  remember(places, *placeToRemember({{{2000, 60}, {1200, 800}}, true}, both));
  EXPECT_EQ(places.front().monitor, "right");
  EXPECT_EQ(placeWindow(kWanted, kFrame, both, places), (PlacedWindow{{{2000, 60}, {1200, 800}}, true}));
  const std::vector<Monitor> alone = {left};
  EXPECT_EQ(placeWindow(kWanted, kFrame, alone, places), (PlacedWindow{{{40, 90}, {900, 700}}, false}));
}

TEST(WindowPlace, AMonitorThatMovedTakesItsWindowAlong) {
  const std::vector<Monitor> then = {monitor("A", {0, 0}, {1920, 1080}),
                                     monitor("B", {1920, 0}, {1280, 1024})};
  const std::vector<WindowPlace> places = {*placeToRemember({{{2020, 100}, {800, 600}}, false}, then)};
  const std::vector<Monitor> now = {monitor("A", {1280, 0}, {1920, 1080}),
                                    monitor("B", {0, 0}, {1280, 1024})};
  EXPECT_EQ(placeWindow(kWanted, {}, now, places).rect, (ScreenRect{{100, 100}, {800, 600}}));
}

TEST(WindowPlace, AnotherResolutionOrAMonitorThatIsGoneBeginsAnew) {
  const std::vector<Monitor> then = {monitor("A", {0, 0}, {3840, 2160})};
  const std::vector<WindowPlace> places = {*placeToRemember({{{2000, 1200}, {1700, 900}}, false}, then)};
  for (const Monitor& other : {monitor("A", {0, 0}, {1920, 1080}), monitor("B", {0, 0}, {3840, 2160})}) {
    const std::vector<Monitor> now = {other};
    EXPECT_EQ(placeWindow(kWanted, {}, now, places), placeWindow(kWanted, {}, now, {}));
  }
}

TEST(WindowPlace, WhatWasLeftOffTheScreenComesBackOntoIt) {
  const std::vector<Monitor> monitors = {monitor("A", {0, 0}, {1920, 1080}, 30)};
  for (const ScreenRect& left :
       {ScreenRect{{-700, 500}, {800, 600}}, ScreenRect{{1900, 1000}, {800, 600}},
        ScreenRect{{0, -20}, {5000, 4000}}, ScreenRect{{1'000'000, -1'000'000}, {0, -5}}}) {
    const WindowPlace place{"A", {1920, 1080}, left, false};
    const PlacedWindow placed = placeWindow(kWanted, kFrame, monitors, {&place, 1});
    EXPECT_TRUE(liesIn(placed.rect, kFrame, monitors.front().work)) << left.at.x;
    EXPECT_GE(std::min(placed.rect.size.x, placed.rect.size.y), 1);
  }
}

TEST(WindowPlace, ASizeThatWasAskedForIsKeptWithItsCornerOnTheScreen) {
  const std::vector<Monitor> monitors = {monitor("A", {0, 0}, {1280, 720})};
  EXPECT_EQ(placeWithSize({1600, 900}, kFrame, monitors).rect, (ScreenRect{{1, 30}, {1600, 900}}));
  EXPECT_EQ(placeWithSize({640, 400}, {}, monitors).rect, (ScreenRect{{320, 160}, {640, 400}}));
}

TEST(WindowPlace, WithoutAMonitorTheWindowOpensAllTheSame) {
  EXPECT_EQ(placeWindow(kWanted, kFrame, {}, {}), (PlacedWindow{{{0, 0}, kWanted}, false}));
  EXPECT_EQ(placeWithSize({700, 500}, kFrame, {}).rect.size, glm::ivec2(700, 500));
  EXPECT_EQ(placeToRemember({{{0, 0}, kWanted}, false}, {}), std::nullopt);
}

TEST(WindowPlace, AWindowThatNoMonitorShowsIsNotRemembered) {
  const std::vector<Monitor> monitors = {monitor("A", {0, 0}, {1920, 1080})};
  EXPECT_EQ(placeToRemember({{{3000, 0}, {800, 600}}, false}, monitors), std::nullopt);
}

TEST(WindowPlace, OnlySoManyMonitorsAreRememberedTheNewestOfThem) {
  std::vector<WindowPlace> places;
  for (int i = 0; i < 20; ++i) remember(places, {"monitor " + std::to_string(i % 15), {800, 600}, {}, false});
  ASSERT_EQ(places.size(), kMostWindowPlaces);
  EXPECT_EQ(places.front().monitor, "monitor 4");
  EXPECT_EQ(places.back().monitor, "monitor 12");
}

}  // namespace
}  // namespace acentric::ui
