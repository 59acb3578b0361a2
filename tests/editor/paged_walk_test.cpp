/// Walks in a session that are read page by page, against the same walk read as a whole.

#include <gtest/gtest.h>

#include <cstring>

#include "editor/actions/path_walk.h"
#include "engine/base/file.h"
#include "engine/bench/repeated_walk.h"
#include "engine/export/walk_pages.h"
#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

class PagedSessionTest : public SessionTest {
 protected:
  static void SetUpTestSuite() {
    room = fs::temp_directory_path() / ("acentric-paged-session-test-" + std::to_string(::getpid()));
    fs::create_directories(room / "cell");
    TaskRunner runner(1);
    RepeatedCellOptions options;
    options.samplesPerDegree = 1;
    const auto cell = RepeatedCell::make(options, room / "cell", runner);
    ASSERT_TRUE(cell) << cell.error().describe();
    const auto walk = RepeatedWalk::make(*cell, {100, 12}, runner);
    ASSERT_TRUE(walk) << walk.error().describe();
    std::vector<std::byte> bytes(*(*walk)->size());
    ASSERT_TRUE((*walk)->read(0, bytes));
    ASSERT_TRUE(writeFileAtomically(file(), bytes));
    regions = (*walk)->regions();
  }
  static void TearDownTestSuite() { fs::remove_all(room); }
  static fs::path file() { return room / "repeated.acentric"; }

  SessionOptions byPages() const {
    SessionOptions paged = options();
    paged.regionsAtOnce = 10;
    return paged;
  }
  void settle(Session& session, const std::string& expected = {}) {
    waitFor(
        session, [&] { return session.walk() && !session.working(); }, expected);
  }
  void walkTo(Session& session, const glm::dvec2& eye, const std::string& expected = {}) {
    session.walkAt({eye, 0, {}});
    settle(session, expected);
  }
  static Frame frameOf(const Session& session, const glm::dvec2& eye, double yaw) {
    PerspectiveView view;
    view.eye = {eye, session.built()->layout->eyeZ()};
    view.yawRadians = yaw, view.fovRadians = 1;
    view.width = 96, view.height = 64;
    TaskRunner runner(1);
    auto frame = renderFrame(session.walk()->walk, view, session.project().view, runner);
    EXPECT_TRUE(frame) << frame.error().describe();
    return frame ? std::move(*frame) : Frame{};
  }
  static int numberAt(const Session& session, const glm::dvec2& eye) {
    const Layout& layout = *session.built()->layout;
    const auto region = layout.regionAt(eye);
    return region ? layout.regions[std::size_t(*region)].id.i : -1;
  }
  static glm::dvec2 farFrom(const Layout& whole, const glm::dvec2& start) {
    const auto farthest = std::ranges::max_element(whole.regions, {}, [&](const Region& region) {
      return glm::distance(region.polygon.centroid(), start);
    });
    return farthest->polygon.centroid();
  }

  static inline fs::path room;
  static inline std::uint64_t regions = 0;
};

TEST_F(PagedSessionTest, ShowsTheFramesOfTheWholeWalkWhereverTheEyeGoes) {
  Session whole(options()), paged(byPages());
  openAndSettle(whole, file());
  openAndSettle(paged, file());
  ASSERT_FALSE(whole.shippedWalk()->pages);
  ASSERT_TRUE(paged.shippedWalk()->pages);
  EXPECT_EQ(paged.shippedWalk()->regionCount(0), regions);
  EXPECT_EQ(paged.shippedWalk()->bytes, whole.shippedWalk()->bytes);
  EXPECT_TRUE(told(paged, "regions, of which those around the eye are shown"));
  const Layout& layout = *whole.built()->layout;
  int pages = 0;
  for (std::size_t r = 0; r < layout.regions.size(); r += 5) {
    const glm::dvec2 eye = layout.regions[r].polygon.centroid() + glm::dvec2(0.05, 0.3);
    const auto before = paged.shippedWalk();
    if (!paged.isAround(eye)) settle(paged);
    ASSERT_TRUE(paged.isAround(eye));
    walkTo(paged, eye);
    if (HasFatalFailure()) return;
    pages += paged.shippedWalk() != before ? 1 : 0;
    EXPECT_LT(paged.built()->layout->regions.size(), layout.regions.size());
    EXPECT_EQ(numberAt(paged, eye), *layout.regionAt(eye));
    EXPECT_TRUE(paged.shippedWalk()->isOwn(0, *paged.built()->layout->regionAt(eye)));
    const Frame a = frameOf(paged, eye, 0.9 * double(r)), b = frameOf(whole, eye, 0.9 * double(r));
    EXPECT_EQ(a.stats.missingImages, 0);
    EXPECT_EQ(a.colour.pixels, b.colour.pixels) << r;
  }
  EXPECT_GT(pages, 3);
}

TEST_F(PagedSessionTest, WhatBothPagesHaveStaysInMemory) {
  Session session(byPages());
  openAndSettle(session, file());
  walkTo(session, {4, 10});
  const auto before = session.walk();
  const auto first = session.shippedWalk();
  for (int step = 0; session.shippedWalk() == first && step < 100; ++step)
    walkTo(session, {4 + 0.2 * step, 10});
  ASSERT_NE(session.shippedWalk(), first);
  const auto after = session.walk();
  ASSERT_EQ(after->walk.layout, session.built()->layout);
  int kept = 0;
  for (std::size_t c = 0; c < after->walk.captures.size(); ++c) {
    const auto& had = before->walk.layout->cameras;
    const int number = after->walk.layout->cameras[c].id.i;
    const auto same = std::ranges::find(had, number, [](const LayoutCamera& camera) { return camera.id.i; });
    if (same == had.end()) continue;
    EXPECT_EQ(after->walk.captures[c], before->walk.captures[std::size_t(same - had.begin())]);
    ++kept;
  }
  EXPECT_GT(kept, 0);
}

TEST_F(PagedSessionTest, TheEyeGoesToPlacesFarAway) {
  Session whole(options()), session(byPages());
  openAndSettle(whole, file());
  openAndSettle(session, file());
  EditorState state;
  ActionContext context{session, state};
  const glm::dvec2 place = farFrom(*whole.built()->layout, session.project().spawn().position);
  EXPECT_EQ(numberAt(session, place), -1);
  state.goTo = WalkPose{{place, session.built()->layout->eyeZ()}, 1, 0};
  const auto there = [&] { return !state.goTo && !session.working(); };
  waitFor(session, [&] {
    followPath(context, 0, false);
    return there();
  });
  EXPECT_EQ(glm::dvec2(state.walker.pose().eye), place);
  EXPECT_EQ(numberAt(session, place), *whole.built()->layout->regionAt(place));

  // Beside all regions it is the nearest page's, which is read once.
  const glm::dvec2 outside = place + 1000.0 * glm::normalize(place - session.project().spawn().position);
  if (!session.isAround(outside)) settle(session);
  EXPECT_TRUE(session.isAround(outside));
}

TEST_F(PagedSessionTest, ADamagedPageIsNamedOnceAndTheWalkGoesOnBesideIt) {
  const auto pages = WalkPages::open(*fileRanges(file()), "repeated");
  ASSERT_TRUE(pages);
  const glm::dvec2 start = (*pages)->root().storeys.front().start;
  const auto first = (*pages)->placeAt(0, start);
  ASSERT_TRUE(first);
  const Layout& layout = (*first)->here().layout;
  const auto beyond = std::ranges::find((*first)->own, 0) - (*first)->own.begin();
  ASSERT_LT(std::size_t(beyond), layout.regions.size());
  const glm::dvec2 eye = layout.regions[std::size_t(beyond)].polygon.centroid();
  const auto next = (*pages)->placeAt(0, eye);
  ASSERT_TRUE(next);
  ASSERT_NE((*next)->page, (*first)->page);
  auto bytes = *readFile(file());
  std::uint64_t pagesAt = 0;
  std::memcpy(&pagesAt, bytes.data() + 40, sizeof pagesAt);
  bytes[pagesAt + (*next)->page + 20] ^= std::byte(0x55);
  const fs::path damaged = folder_ / "damaged.acentric";
  ASSERT_TRUE(writeFileAtomically(damaged, bytes));

  Session session(byPages());
  openAndSettle(session, damaged);
  const auto errors = [&] {
    return std::ranges::count_if(session.messages().all(),
                                 [](const Message& message) { return message.level == MessageLevel::error; });
  };
  for (const double step : {0.0, 0.05, -0.05}) walkTo(session, eye + glm::dvec2(step, 0), "Reading the walk");
  EXPECT_EQ(errors(), 1);
  EXPECT_TRUE(told(session, damaged.string()));
  EXPECT_EQ(numberAt(session, eye), int((*first)->regions[std::size_t(beyond)]));
  EXPECT_GT(frameOf(session, eye, 1).stats.samplesDrawn, 100u) << "what is known of it is shown";
  walkTo(session, start, "Reading the walk");
  EXPECT_EQ(errors(), 1);
}

}  // namespace
}  // namespace acentric::editor
