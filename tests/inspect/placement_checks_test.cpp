#include "engine/inspect/placement_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/inspect/lattice_shift.h"
#include "tests/inspect/box_world.h"

namespace acentric {
namespace {
using test::BoxWorld;
using testing::HasSubstr;

/// Cameras wherever a test wants them: the checks look at positions alone.
Layout camerasAt(const std::vector<glm::dvec2>& places) {
  Layout layout;
  for (const glm::dvec2& place : places) {
    LayoutCamera camera;
    camera.position = place;
    layout.cameras.push_back(camera);
  }
  return layout;
}

PlacementReport check(const BoxWorld& world, const Layout& layout, const PlacementRules& rules = {}) {
  TaskRunner runner;
  const auto report = checkPlacement(layout, world.bounds(), rules, world.probe(), runner);
  EXPECT_TRUE(report) << (report ? "" : report.error().describe());
  return report ? *report : PlacementReport{};
}

std::vector<PlacementFlaw> flawsOf(const PlacementReport& report) {
  std::vector<PlacementFlaw> flaws;
  for (const PlacementFinding& finding : report.findings) flaws.push_back(finding.flaw);
  return flaws;
}

/// A room of 8 x 6 x 3 m with a column of 1 x 1 m whose middle is (4, 3).
BoxWorld roomWithColumn() {
  BoxWorld room = BoxWorld::room(8, 6, 3);
  room.boxes.push_back({{3.5, 2.5, 0}, {4.5, 3.5, 3}});
  return room;
}

TEST(PlacementChecks, FindNothingWhereCamerasStandFree) {
  const PlacementReport report = check(roomWithColumn(), camerasAt({{1, 1}, {7, 5}, {2, 3}}));
  EXPECT_TRUE(report.findings.empty());
  EXPECT_EQ(report.centres, 3);
}

TEST(PlacementChecks, FindACameraInsideAColumnAndPushItOutTheShortWay) {
  const PlacementReport report =
      check(roomWithColumn(), camerasAt({{4.3, 3}, {1, 1}, {7, 5}, {7, 1}, {1, 5}}));
  ASSERT_THAT(flawsOf(report), testing::ElementsAre(PlacementFlaw::insideSolid, PlacementFlaw::tooNear));
  const PlacementFinding& finding = report.findings[0];
  EXPECT_EQ(finding.severity, Severity::error);
  EXPECT_THAT(finding.cameras, testing::ElementsAre(0));
  // Straight up and down the room's ceiling and floor lie in the same planes as the column's ends.
  EXPECT_THAT(finding.reason, HasSubstr("48 of 50 directions"));
  ASSERT_TRUE(finding.push);
  // 0.2 m to the column's side and 0.4 m clear of it; a ring's directions are 15 degrees apart.
  EXPECT_NEAR(finding.push->x, 0.6, 0.03);
  EXPECT_NEAR(finding.push->y, 0, 0.2);
}

TEST(PlacementChecks, FindACameraAtAWallAndSayHowNearItIs) {
  const PlacementReport report = check(roomWithColumn(), camerasAt({{0.25, 3}, {0.05, 1.5}, {4, 1}}));
  ASSERT_EQ(report.findings.size(), 2u);
  EXPECT_EQ(report.findings[0].severity, Severity::error);
  EXPECT_EQ(report.findings[0].place, glm::dvec2(0.05, 1.5));
  EXPECT_EQ(report.findings[1].severity, Severity::warning);
  EXPECT_THAT(report.findings[1].reason, HasSubstr("0.25 m away"));
  EXPECT_THAT(report.findings[1].reason, HasSubstr("0.40 m are asked for"));
  ASSERT_TRUE(report.findings[1].push);
  EXPECT_NEAR(glm::length(*report.findings[1].push), 0.15, 0.01);
  EXPECT_GT(report.findings[1].push->x, 0);
}

TEST(PlacementChecks, SeeWhatIsCloseAboveAndBelow) {
  BoxWorld room = BoxWorld::room(8, 6, 1.9);
  EXPECT_THAT(check(room, camerasAt({{4, 3}})).findings.at(0).reason, HasSubstr("above"));
  room = BoxWorld::room(8, 6, 3);
  room.boxes.push_back({{3, 2, 0}, {5, 4, 1.4}});
  const PlacementReport report = check(room, camerasAt({{4, 3}, {1, 1}}));
  ASSERT_THAT(flawsOf(report), testing::ElementsAre(PlacementFlaw::tooNear, PlacementFlaw::floorTooHigh));
  EXPECT_THAT(report.findings[0].reason, HasSubstr("straight below it"));
}

TEST(PlacementChecks, CompareTheFloorWithTheWalkPlane) {
  BoxWorld world;  // a square of 10 x 10 m with a table, and a pit 2 m deep beyond x = 6
  world.boxes = {{{0, 0, -1}, {6, 10, 0}}, {{6, 0, -3}, {10, 10, -2}}, {{2, 2, 0.7}, {3, 3, 0.75}}};
  const PlacementReport report = check(world, camerasAt({{2.5, 2.5}, {8, 5}, {12, 5}, {1, 8}}));
  ASSERT_THAT(flawsOf(report), testing::ElementsAre(PlacementFlaw::noFloor, PlacementFlaw::floorTooLow,
                                                    PlacementFlaw::floorTooHigh));
  EXPECT_EQ(report.findings[0].place.x, 12);
  EXPECT_FALSE(report.findings[0].push) << "the floor is farther than the farthest push";
  EXPECT_THAT(report.findings[1].reason, HasSubstr("2.00 m below the walk plane"));
  EXPECT_THAT(report.findings[2].reason, HasSubstr("0.75 m above the walk plane"));
  EXPECT_EQ(report.findings[2].severity, Severity::note);
  EXPECT_FALSE(report.findings[2].push);
  PlacementRules far;
  far.mostPush = 3;
  const auto pushed = check(world, camerasAt({{8, 5}}), far).findings.at(0).push;
  ASSERT_TRUE(pushed);
  EXPECT_NEAR(pushed->x, -2.0, 0.02) << "back over the edge of the square, which lies below the camera";
}

TEST(PlacementChecks, FindACameraInASolidThatIsOpenBelow) {
  BoxWorld room = BoxWorld::room(8, 6, 3);
  // A column of four sheets facing outwards, without top and bottom.
  room.addQuad({3, 2, 0}, {5, 2, 0}, {5, 2, 3}, {3, 2, 3});
  room.addQuad({5, 2, 0}, {5, 4, 0}, {5, 4, 3}, {5, 2, 3});
  room.addQuad({5, 4, 0}, {3, 4, 0}, {3, 4, 3}, {5, 4, 3});
  room.addQuad({3, 4, 0}, {3, 2, 0}, {3, 2, 3}, {3, 4, 3});
  const PlacementReport report = check(room, camerasAt({{4, 3}, {1, 1}, {7, 5}}));
  ASSERT_THAT(flawsOf(report), testing::ElementsAre(PlacementFlaw::insideSolid));
  EXPECT_FALSE(report.findings[0].push) << "1 m to the side and 0.4 m clear is more than 1 m";
}

TEST(PlacementChecks, BelieveTheCamerasOfOneSpaceRatherThanOneAmongWallsWoundTheOtherWay) {
  BoxWorld room = BoxWorld::room(12, 6, 3);
  // A bay of sheets around (10, 3), open towards -x, all of them showing their backs to it.
  room.addQuad({9, 2, 0}, {11, 2, 0}, {11, 2, 3}, {9, 2, 3});
  room.addQuad({11, 2, 0}, {11, 4, 0}, {11, 4, 3}, {11, 2, 3});
  room.addQuad({11, 4, 0}, {9, 4, 0}, {9, 4, 3}, {11, 4, 3});
  room.addQuad({9, 2, 2.9}, {11, 2, 2.9}, {11, 4, 2.9}, {9, 4, 2.9});
  EXPECT_TRUE(lookAround({10.3, 3, 1.6}, room.probe()).inside());
  EXPECT_TRUE(check(room, camerasAt({{10.3, 3}, {7, 3}, {6, 2}})).findings.empty());
}

TEST(PlacementChecks, TrustNoSidesWhereAllWallsShowTheirBacks) {
  BoxWorld shell{{{{0, 0, 0}, {8, 6, 3}}}, {}};  // a box seen from within
  const PlacementReport report = check(shell, camerasAt({{4, 3}, {2, 2}, {0.1, 3}}));
  EXPECT_TRUE(report.ignoredSides);
  EXPECT_THAT(flawsOf(report), testing::ElementsAre(PlacementFlaw::tooNear));
}

LayoutSpec squares(const glm::dvec2& origin, double cellSize = 2) {
  LayoutSpec spec;
  spec.configuration = Configuration::e;
  spec.cellSize = cellSize;
  spec.latticeOrigin = origin;
  spec.outline.loops = {{{0.5, 0.5}, {7.5, 0.5}, {7.5, 5.5}, {0.5, 5.5}}};
  return spec;
}

TEST(PlacementChecks, FindARegionWithoutStandingRoom) {
  BoxWorld room = BoxWorld::room(8, 6, 3);
  room.boxes.push_back({{2, 2, 0}, {4.3, 4.3, 1}});  // a block that fills the square 2..4 x 2..4
  const Layout layout = buildLayout(squares({1, 1})).value();
  const PlacementReport report = check(room, layout);
  EXPECT_EQ(report.regions, int(layout.regions.size()));
  std::vector<int> none;
  for (const PlacementFinding& finding : report.findings)
    if (finding.flaw == PlacementFlaw::noStandingRoom) none.push_back(finding.region);
  ASSERT_EQ(none.size(), 1u);
  EXPECT_EQ(none[0], *layout.regionAt({3, 3}));
}

/// The findings of centres at a place.
std::vector<PlacementFinding> at(const PlacementReport& report, const glm::dvec2& place) {
  std::vector<PlacementFinding> found;
  for (const PlacementFinding& finding : report.findings)
    if (finding.region < 0 && glm::distance(finding.place, place) < 1e-6) found.push_back(finding);
  return found;
}

TEST(PlacementChecks, NoteACameraBeyondAWallThatNobodySeesPast) {
  const BoxWorld room = BoxWorld::room(8, 6, 3);
  LayoutSpec beyond = squares({1.5, 1});  // corners at x = 0.5 ... 8.5
  beyond.outline.loops = {{{0.6, 0.5}, {7.9, 0.5}, {7.9, 5.5}, {0.6, 5.5}}};
  const PlacementReport report = check(room, buildLayout(beyond).value());
  const auto outside = at(report, {8.5, 2});
  ASSERT_FALSE(outside.empty());
  for (const PlacementFinding& finding : outside) {
    EXPECT_EQ(finding.severity, Severity::note) << finding.reason;
    EXPECT_TRUE(finding.suffices);
    EXPECT_FALSE(finding.push) << "none is needed";
  }
}

/// A block 3 m thick parts two rooms, with a door 1.4 m wide along y = 3 through it.
BoxWorld roomsWithADoor() {
  BoxWorld rooms = BoxWorld::room(16, 6, 3);
  rooms.boxes.push_back({{6, 0, 0}, {9, 2.3, 3}});
  rooms.boxes.push_back({{6, 3.7, 0}, {9, 6, 3}});
  return rooms;
}

/// One square before the door, corners at (6.8, 1) and (6.8, 5) within the block.
LayoutSpec squareBeforeTheDoor() {
  LayoutSpec spec = squares({4.8, 3}, 4);
  spec.configuration = Configuration::d;  // cameras look one way from each corner
  spec.outline.loops = {{{2.9, 1.1}, {6.7, 1.1}, {6.7, 4.9}, {2.9, 4.9}}};
  spec.nearBand = 0.25;
  return spec;
}

Severity worstAt(const PlacementReport& report, const glm::dvec2& place) {
  Severity worst = Severity::note;
  for (const PlacementFinding& finding : at(report, place)) worst = std::max(worst, finding.severity);
  return worst;
}

TEST(PlacementChecks, WarnOfCamerasFromWhichAWallHidesWhatIsSeenThroughADoor) {
  const PlacementReport report = check(roomsWithADoor(), buildLayout(squareBeforeTheDoor()).value());
  ASSERT_FALSE(at(report, {6.8, 1}).empty());
  EXPECT_EQ(std::max(worstAt(report, {6.8, 1}), worstAt(report, {6.8, 5})), Severity::error);
  for (const PlacementFinding& finding : report.findings)
    if (finding.severity == Severity::error) {
      EXPECT_EQ(finding.panorama, glm::dvec2(4.8, 3)) << "the middle is free";
    }
}

TEST(PlacementChecks, NoteACameraWhereAPanoramaShowsWhatItMisses) {
  LayoutSpec helped = squareBeforeTheDoor();
  helped.freeApvs[0] = Apv{{4.8, 3}, {0, 0}};
  const PlacementReport report = check(roomsWithADoor(), buildLayout(helped).value());
  ASSERT_FALSE(at(report, {6.8, 1}).empty());
  EXPECT_EQ(worstAt(report, {6.8, 1}), Severity::note);
  EXPECT_EQ(worstAt(report, {6.8, 5}), Severity::note);
}

TEST(PlacementChecks, DoNotDependOnTheNumberOfThreads) {
  BoxWorld room = roomWithColumn();
  const Layout layout = buildLayout(squares({1.3, 0.7}, 1)).value();
  TaskRunner one, three(2);
  const auto a = checkPlacement(layout, room.bounds(), {}, room.probe(), one);
  const auto b = checkPlacement(layout, room.bounds(), {}, room.probe(), three);
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->findings.size(), b->findings.size());
  EXPECT_GT(a->findings.size(), 0u);
  for (std::size_t k = 0; k < a->findings.size(); ++k) {
    EXPECT_EQ(a->findings[k].reason, b->findings[k].reason);
    EXPECT_EQ(a->findings[k].push, b->findings[k].push);
  }
}

TEST(PlacementChecks, ClearEachCameraThatTheyPush) {
  const BoxWorld room = roomWithColumn();
  Layout layout = buildLayout(squares({1.3, 0.7}, 1)).value();
  layout.regions.clear();  // nothing says that what they see suffices
  const PlacementReport report = check(room, layout);
  int pushed = 0;
  for (const PlacementFinding& finding : report.findings) {
    if (!finding.push) continue;
    ++pushed;
    for (const PlacementFinding& after : check(room, camerasAt({finding.place + *finding.push})).findings)
      EXPECT_EQ(after.severity, Severity::note) << after.reason;
  }
  EXPECT_GT(pushed, 3);
}

TEST(PlacementChecks, RefuseBadRulesAndStopWhenAsked) {
  TaskRunner runner;
  const BoxWorld room = roomWithColumn();
  PlacementRules bad;
  bad.cameraRoom = -1;
  EXPECT_FALSE(checkPlacement(camerasAt({{1, 1}}), room.bounds(), bad, room.probe(), runner));
  std::stop_source source;
  source.request_stop();
  const auto stopped =
      checkPlacement(camerasAt({{1, 1}}), room.bounds(), {}, room.probe(), runner, source.get_token());
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::cancelled);
}

TEST(LatticeShift, MovesTheCamerasOffTheWalls) {
  const BoxWorld room = BoxWorld::room(8, 6, 3);
  LayoutSpec spec = squares({1.1, 1.1});  // corners at 0.1, 2.1 ... : at two walls
  spec.outline.loops = {{{1.1, 1.1}, {6.7, 1.1}, {6.7, 4.7}, {1.1, 4.7}}};
  const LatticeShift shift = findFreestOrigin(spec, {}, room.probe());
  EXPECT_GT(shift.before, 3);
  EXPECT_EQ(shift.after, 0);
  LayoutSpec moved = spec;
  moved.latticeOrigin = shift.origin;
  EXPECT_EQ(crowding(buildLayout(moved).value(), {}, room.probe()), 0);
}

TEST(LatticeShift, CountsTheInsideOfALargeSolidAgainstAnOrigin) {
  BoxWorld room = BoxWorld::room(8, 6, 3);
  room.boxes.push_back({{3, 2, 0}, {5, 4, 3}});
  // Corners at even metres: (4, 3) is 1 m deep in the column, farther than the room that a camera needs.
  Layout deep = camerasAt({{4, 3}});
  EXPECT_EQ(crowding(deep, {}, room.probe()), 2);
  CrowdingRules blind;
  blind.trustSides = false;
  EXPECT_EQ(crowding(deep, blind, room.probe()), 0) << "the naive measure sees 1 m of free way";
}

TEST(LatticeShift, CountsCamerasOffTheFloorAgainstAnOrigin) {
  const BoxWorld room = BoxWorld::room(8, 6, 3);
  EXPECT_EQ(crowding(camerasAt({{12, 3}}), {}, room.probe()), 2) << "nothing is below";
  Layout high = camerasAt({{4, 3}});
  high.spec.floorHeight = 0.2, high.spec.eyeHeight = 1.4;
  EXPECT_EQ(crowding(high, {}, room.probe()), 0);
  high.spec.floorHeight = 0.3, high.spec.eyeHeight = 1.3;
  EXPECT_EQ(crowding(high, {}, room.probe()), 2) << "more than the tolerance above the floor";
}

TEST(LatticeShift, StaysWhereItIsInTheOpen) {
  BoxWorld open{{{{-50, -50, -1}, {50, 50, 0}}}, {}};
  const LayoutSpec spec = squares({1.23, 0.77});
  const LatticeShift shift = findFreestOrigin(spec, {}, open.probe());
  EXPECT_EQ(shift.origin, spec.latticeOrigin);
  EXPECT_EQ(shift.before, 0);
}

/// Rays that finding an origin takes.
std::size_t raysOf(const LayoutSpec& spec, const ShiftOptions& options, const BoxWorld& world) {
  std::size_t rays = 0;
  (void)findFreestOrigin(spec, options, [&rays, probe = world.probe()](const auto& from, const auto& along) {
    ++rays;
    return probe(from, along);
  });
  return rays;
}

TEST(LatticeShift, TriesNoMoreOnceNoCameraIsCrowded) {
  const BoxWorld open{{{{-50, -50, -1}, {50, 50, 0}}}, {}};
  const LayoutSpec spec = squares({1.23, 0.77});
  std::size_t once = 0;
  (void)crowding(buildLayout(spec).value(), {}, [&once](const auto&, const auto&) {
    ++once;
    return SurfaceHit{};
  });
  ASSERT_GT(once, 0U);
  EXPECT_EQ(raysOf(spec, {}, open), once);
}

TEST(LatticeShift, TriesFewerOriginsOverManyCameras) {
  // A post in the middle of every cell's way: some camera is crowded wherever the lattice lies.
  BoxWorld posts = BoxWorld::room(8, 6, 3);
  for (double x = 0; x < 8; x += 0.5)
    for (double y = 0; y < 6; y += 0.5) posts.boxes.push_back({{x, y, 0}, {x + 0.1, y + 0.1, 3}});
  const LayoutSpec spec = squares({1.1, 1.1});
  const std::size_t cameras = buildLayout(spec)->cameras.size();
  const std::size_t whole = raysOf(spec, {}, posts);
  ShiftOptions few;
  few.mostCameras = 4 * cameras;  // two origins each way, and the spec's own
  EXPECT_LT(raysOf(spec, few, posts), whole / 5);
  few.mostCameras = cameras - 1;
  EXPECT_LT(raysOf(spec, few, posts), whole / 25) << "the spec's own alone";
}

}  // namespace
}  // namespace acentric
