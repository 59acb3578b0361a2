/// Editing in the 3D view by pointer events, without a window: what a press takes, what becomes of the
/// project, and that each is one step of the history.

#include "editor/actions/scene_editing.h"

#include "editor/actions/action_table.h"
#include "editor/actions/plan_intents.h"
#include "editor/commands/walk_edits.h"
#include "editor/tools/orbit_camera.h"
#include "editor/tools/scene_hits.h"
#include "ui/keys.h"

#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

class SceneEditingTest : public OpenSessionTest {
 protected:
  using Kind = ScenePointer::Kind;

  void SetUp() override {
    OpenSessionTest::SetUp();
    OrbitCamera camera;
    camera.setSize({1000, 800});
    camera.frame({-3, -2.5, 0}, {3, 2.5, 1.6}, true);
    sight_ = {camera.view(), camera.target(), 1};
    state_.centreView = View::scene3d;
    before_ = session_->history().cursor();
  }
  ActionContext context() { return {*session_, state_}; }
  double floor() const { return latticeHeight(session_->project().layout()); }
  glm::dvec2 pixelOf(const glm::dvec3& place) const { return project(sight_.view, place).pixel; }
  glm::dvec2 onFloor(const glm::dvec2& place) const { return pixelOf({place, floor()}); }
  std::optional<SceneIntent> send(Kind kind, const glm::dvec2& pixel, int modifiers = 0) {
    ActionContext c = context();
    return editing_.handle(c, {kind, ui::mouse::left, modifiers, pixel, 0}, sight_);
  }
  bool click(const glm::dvec2& pixel, int modifiers = 0) {
    const bool taken = send(Kind::press, pixel, modifiers).has_value();
    send(Kind::release, pixel, modifiers);
    return taken;
  }
  bool drag(const glm::dvec2& from, const glm::dvec2& to, int modifiers = 0) {
    if (!send(Kind::press, from, modifiers)) return false;
    send(Kind::move, 0.5 * (from + to), modifiers);
    send(Kind::move, to, modifiers);
    EXPECT_TRUE(send(Kind::release, to, modifiers).has_value());
    return true;
  }
  void select(const glm::dvec2& pixel, const std::optional<CellId>& cell, Combine how = Combine::replace) {
    ActionContext c = context();
    editing_.select(c, {pixel, how}, cell, sight_);
  }
  Gizmo gizmo() {
    const auto found = editing_.gizmo(context());
    EXPECT_TRUE(found.has_value());
    return found.value_or(Gizmo{});
  }
  /// A place on an arrow or the square of the gizmo.
  glm::dvec3 handle(const glm::dvec3& way, double pixels) {
    const Gizmo at = gizmo();
    return at.at + pixels / pixelsPerMetre(sight_.view, at.at) * way;
  }
  void run(const std::string& id) {
    const Action* action = findAction(table_, id);
    ASSERT_NE(action, nullptr) << id;
    ActionContext c = context();
    ASSERT_TRUE(action->enabled(c)) << id;
    action->run(c);
  }
  std::size_t steps() const { return session_->history().cursor() - before_; }
  const LayoutSpec& spec() const { return session_->project().layout(); }
  /// The middle of a place of the lattice that is free.
  glm::dvec2 freePlace() const {
    for (const LatticeCell& cell : cellsIn(spec(), {-8, -8}, {8, 8}, 2000))
      if (!isPlaced(spec(), cell.id)) return cell.polygon.centroid();
    ADD_FAILURE() << "no free place";
    return {};
  }

  SceneSight sight_;
  SceneEditing editing_;
  EditorState state_;
  const std::vector<Action> table_ = makeActionTable();
  std::size_t before_ = 0;
};

TEST_F(SceneEditingTest, PressesThatEditNothingAreTheCameras) {
  const glm::dvec2 floorPixel = onFloor({0, 0});
  EXPECT_FALSE(send(Kind::press, floorPixel)) << "a drag orbits";
  state_.planTool.setMode(PlanMode::panorama);
  EXPECT_FALSE(send(Kind::press, floorPixel, ui::modifier::alt)) << "Alt asks a surface";
  EXPECT_FALSE(send(Kind::press, {500, -30000})) << "the sky";
  state_.scene3d.picking = true;
  EXPECT_FALSE(send(Kind::press, floorPixel));
  EXPECT_EQ(steps(), 0U);
}

TEST_F(SceneEditingTest, AnApvIsPlacedByAClickAndMovedAndTurnedByTheGizmoInOneStepEach) {
  state_.planTool.setMode(PlanMode::panorama);
  const glm::dvec2 place(0.4, -0.3);
  EXPECT_TRUE(click(onFloor(place)));
  ASSERT_EQ(spec().freeApvs.size(), 1U);
  const int number = spec().freeApvs.begin()->first;
  EXPECT_LT(glm::distance(spec().freeApvs.at(number).centre, place), 1e-9);
  EXPECT_EQ(state_.selection, (std::set<CellId>{{number, 0, kFreeSlot}}));
  EXPECT_EQ(steps(), 1U);

  state_.planTool.setMode(PlanMode::cells);
  const glm::dvec3 x(1, 0, 0);
  const glm::dvec3 grip = handle(x, 50);
  send(Kind::press, pixelOf(grip));
  send(Kind::move, pixelOf(grip + 0.5 * x));
  EXPECT_NEAR(spec().freeApvs.at(number).centre.x, place.x + 0.5, 1e-9) << "shown while it is dragged";
  EXPECT_NE(editing_.text(context()).find("x +0.500 m"), std::string::npos) << editing_.text(context());
  EXPECT_EQ(gizmo().at.x, spec().freeApvs.at(number).centre.x);
  send(Kind::move, pixelOf(grip + 0.8 * x));
  send(Kind::release, pixelOf(grip + 0.8 * x));
  EXPECT_LT(glm::distance(spec().freeApvs.at(number).centre, place + glm::dvec2(0.8, 0)), 1e-9);
  EXPECT_EQ(steps(), 2U);

  const glm::dvec2 offset = spec().freeApvs.at(number).offset;
  const Gizmo ring = gizmo();
  const double radius = 58 / pixelsPerMetre(sight_.view, ring.at);
  const auto on = [&](double azimuth) {
    return pixelOf(ring.at + radius * glm::dvec3(directionOf(azimuth), 0));
  };
  EXPECT_TRUE(drag(on(-2.0), on(-1.5)));
  const glm::dvec2 turned = spec().freeApvs.at(number).offset;
  EXPECT_NEAR(glm::length(turned), glm::length(offset), 1e-9);
  EXPECT_NEAR(std::atan2(turned.y, turned.x) - std::atan2(offset.y, offset.x), 0.5, 1e-9);
  EXPECT_EQ(steps(), 3U);
  for (int i = 0; i < 3; ++i) session_->undo();
  EXPECT_TRUE(spec().freeApvs.empty());
}

TEST_F(SceneEditingTest, EscapeAndADragBackLeaveNoTrace) {
  session_->apply(addFreeApv(session_->project(), {{0.2, 0.2}, {1, 0}}));
  const Project before = session_->project();
  state_.selection = {{0, 0, kFreeSlot}};
  const glm::dvec3 x(1, 0, 0), grip = handle(x, 50);
  send(Kind::press, pixelOf(grip));
  send(Kind::move, pixelOf(grip + x));
  EXPECT_FALSE(session_->project() == before);
  ActionContext c = context();
  EXPECT_TRUE(editing_.cancel(c));
  EXPECT_TRUE(session_->project() == before);
  EXPECT_FALSE(send(Kind::release, pixelOf(grip + x)).has_value());
  send(Kind::press, pixelOf(grip));
  send(Kind::move, pixelOf(grip + x));
  send(Kind::move, pixelOf(grip));
  send(Kind::release, pixelOf(grip));
  EXPECT_LT(glm::distance(spec().freeApvs.at(0).centre, before.layout().freeApvs.at(0).centre), 1e-9);
  EXPECT_FALSE(editing_.cancel(c));
  session_->undo();
  EXPECT_TRUE(spec().freeApvs.empty()) << "one step: that it was added" << session_->history().undoLabel();
}

TEST_F(SceneEditingTest, CellsAreDraggedByTheGizmoOntoFreePlacesOnly) {
  session_->apply(setCellSize(session_->project(), 1));
  session_->apply(setOutline(session_->project(), {{{{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}}}}));
  before_ = session_->history().cursor();
  const CellId cell = cellAt(spec(), {0, 0}).id;
  ASSERT_TRUE(isPlaced(spec(), cell));
  state_.selection = {cell};
  const CellGroup group(spec(), state_.selection);
  const glm::dvec2 step = group.metresOf({1, 0});
  const glm::dvec3 square =
      handle(glm::dvec3(directionOf(gizmo().axesRadians + kPi / 4), 0), 29 * std::sqrt(2.0));
  ASSERT_TRUE(drag(pixelOf(square), pixelOf(square + glm::dvec3(step + 0.05, 0))));
  EXPECT_EQ(state_.selection, (std::set<CellId>{{cell.i + 1, cell.j, cell.slot, cell.level}}));
  EXPECT_TRUE(isPlaced(spec(), *state_.selection.begin()));
  EXPECT_FALSE(isPlaced(spec(), cell));
  EXPECT_EQ(steps(), 1U);
  session_->undo();
  EXPECT_TRUE(isPlaced(spec(), cell));
}

TEST_F(SceneEditingTest, CellsArePlacedByClicksOnceThatIsChosen) {
  session_->apply(setOutline(session_->project(), {{{{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}}}}));
  before_ = session_->history().cursor();
  const glm::dvec2 place = freePlace();
  EXPECT_FALSE(click(onFloor(place)));
  state_.scene3d.placing = true;
  state_.walker.setPose({{50, 50, 1.6}, 0, 0});  // a press on the eye would drag it
  EXPECT_TRUE(click(onFloor(place)));
  const CellId cell = cellAt(spec(), place).id;
  EXPECT_TRUE(isPlaced(spec(), cell));
  EXPECT_EQ(state_.selection, std::set<CellId>{cell});
  EXPECT_EQ(steps(), 1U);
  // A drag on free ground is the camera's, although the tool took the press.
  state_.selection.clear();
  const glm::dvec2 from = onFloor(freePlace());
  ASSERT_TRUE(send(Kind::press, from).has_value());
  const auto turned = send(Kind::move, from + glm::dvec2(30, 0));
  ASSERT_TRUE(turned && std::holds_alternative<OrbitIntent>(*turned));
  EXPECT_EQ(std::get<OrbitIntent>(*turned).pixels, glm::dvec2(30, 0));
  send(Kind::release, from + glm::dvec2(30, 0));
  EXPECT_EQ(steps(), 1U);
}

TEST_F(SceneEditingTest, TheOutlineGetsACornerOnASideAndItsCornersAreDragged) {
  session_->apply(setOutline(session_->project(), {{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}}));
  before_ = session_->history().cursor();
  state_.planTool.setMode(PlanMode::outline);
  EXPECT_TRUE(drag(onFloor({0, -1}), onFloor({0.1, -1.4})));
  ASSERT_EQ(spec().outline.loops[0].size(), 5U);
  EXPECT_LT(glm::distance(spec().outline.loops[0][1], glm::dvec2(0.1, -1.4)), 1e-9);
  EXPECT_EQ(state_.scene3d.corner, (OutlineCorner{0, 1}));
  EXPECT_EQ(steps(), 1U);
  const glm::dvec3 y(0, 1, 0), grip = handle(y, 50);
  ASSERT_TRUE(drag(pixelOf(grip), pixelOf(grip + 0.25 * y)));
  EXPECT_LT(glm::distance(spec().outline.loops[0][1], glm::dvec2(0.1, -1.15)), 1e-9);
  EXPECT_EQ(steps(), 2U);
  run("edit.remove");
  EXPECT_EQ(spec().outline.loops[0].size(), 4U);
  EXPECT_EQ(steps(), 3U);
  // The middle of the handles is the corner itself; with Ctrl it is the tool's.
  click(onFloor({1, 1}));
  ASSERT_TRUE(drag(onFloor({1, 1}), onFloor({1.2, 0.9})));
  EXPECT_LT(glm::distance(spec().outline.loops[0][2], glm::dvec2(1.2, 0.9)), 1e-9);
  EXPECT_EQ(steps(), 4U);
  click(onFloor({1.2, 0.9}), ui::modifier::control);
  EXPECT_EQ(spec().outline.loops[0].size(), 3U);
  EXPECT_EQ(steps(), 5U);
  EXPECT_FALSE(editing_.gizmo(context()).has_value());
}

TEST_F(SceneEditingTest, KeyPosesAreLiftedTurnedAndDraggedAtTheirOwnHeight) {
  CameraPath path;
  path.poses.resize(2);
  path.poses[0].eye = {-1, 0, 1.3};
  path.poses[1].eye = {1, 0.5, 1.9}, path.poses[1].seconds = 2, path.poses[1].yawRadians = 0.3;
  session_->apply(addPath(session_->project(), path, session_->project().storey));
  before_ = session_->history().cursor();
  state_.walkSelection = {WalkSelection::Kind::path, 0, {}};
  const auto pose = [&] { return session_->project().paths[0].path.poses[1]; };
  select(pixelOf(pose().eye), cellAt(spec(), {1, 0.5}).id);
  ASSERT_EQ(state_.walkSelection.pose, 1U) << "a pose comes before the cell behind it";
  EXPECT_TRUE(state_.selection.empty());
  const glm::dvec3 up(0, 0, 1), grip = handle(up, 50);
  ASSERT_TRUE(drag(pixelOf(grip), pixelOf(grip + 0.3 * up)));
  EXPECT_NEAR(pose().eye.z, 2.2, 1e-9);
  EXPECT_EQ(steps(), 1U);
  state_.planTool.setMode(PlanMode::path);
  // By the plan's tool, from where its handle is not in the way.
  state_.walkSelection.pose.reset();
  const glm::dvec3 to(0.4, 0.1, 2.2);
  ASSERT_TRUE(drag(pixelOf(pose().eye), pixelOf(to)));
  EXPECT_LT(glm::distance(pose().eye, to), 1e-9);
  EXPECT_EQ(steps(), 2U);
}

TEST_F(SceneEditingTest, ThePlansToolFollowsOnePointerAtATime) {
  ActionContext c = context();
  state_.planTool.setMode(PlanMode::panorama);
  ASSERT_TRUE(takeOver(c, View::plan, ui::mouse::left));
  const PlanSituation plan = editing_.situation(c, {0, 0, 0}, sight_);
  state_.planTool.handle({PointerEvent::Kind::press, ui::mouse::left, 0, {0, 0}, {5, 5}}, plan);
  ASSERT_TRUE(state_.planTool.capturing());
  EXPECT_FALSE(editing_.capturing(c)) << "what began on the plan";
  EXPECT_FALSE(send(Kind::move, onFloor({0, 0})));
  EXPECT_FALSE(takeOver(c, View::scene3d, ui::mouse::right));
  // Its release was lost, as where the plan is no longer shown: a press takes over.
  EXPECT_TRUE(click(onFloor({0.5, 0.5})));
  ASSERT_EQ(spec().freeApvs.size(), 1U);
  EXPECT_LT(glm::distance(spec().freeApvs.begin()->second.centre, glm::dvec2(0.5)), 1e-9);
  EXPECT_FALSE(state_.planTool.capturing());
}

TEST_F(SceneEditingTest, TheWalkAddsAndSelectsWhereItsEyeStands) {
  session_->apply(setOutline(session_->project(), {{{{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}}}}));
  waitFor([&] { return !session_->working() && session_->built()->project == session_->project(); });
  before_ = session_->history().cursor();
  state_.walker.setPose({{0.05, 0.02, 1.6}, 0, 0});
  const CellId cell = cellAt(spec(), {0.05, 0.02}).id;
  run("walk.addCell");
  EXPECT_EQ(steps(), 0U);
  EXPECT_TRUE(told(*session_, "covers this place already"));
  state_.selection.clear();
  run("walk.selectCell");
  EXPECT_EQ(state_.selection, std::set<CellId>{cell});

  const glm::dvec2 free = freePlace();
  state_.walker.setPose({{free, 1.6}, 0, 0});
  run("walk.addCell");
  EXPECT_TRUE(isPlaced(spec(), cellAt(spec(), free).id));
  EXPECT_EQ(steps(), 1U);
  run("walk.addApv");
  ASSERT_EQ(spec().freeApvs.size(), 1U);
  EXPECT_EQ(spec().freeApvs.begin()->second.centre, free);
  EXPECT_EQ(steps(), 2U);
  run("walk.addApv");
  EXPECT_EQ(steps(), 2U) << "one stands there already";
  EXPECT_TRUE(told(*session_, "stands here already"));

  EXPECT_FALSE(findAction(table_, std::string("walk.addCellThere"))->enabled(context()));
  state_.pointedFloor = freePlace();
  run("walk.addCellThere");
  EXPECT_TRUE(isPlaced(spec(), cellAt(spec(), *state_.pointedFloor).id));
  EXPECT_EQ(steps(), 3U);
}

TEST_F(SceneEditingTest, ClicksSelectWhatIsNearestAndModifiersCombineAsOnThePlan) {
  session_->apply(setOutline(session_->project(), {{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}}));
  const CellId first = cellAt(spec(), {0, 0}).id, second = cellAt(spec(), {-1.5, 1.2}).id;
  const glm::dvec2 nowhere(3, 3);
  select(nowhere, first);
  EXPECT_EQ(state_.selection, std::set<CellId>{first});
  select(nowhere, second, Combine::add);
  EXPECT_EQ(state_.selection.size(), 2U);
  select(nowhere, first, Combine::add);
  EXPECT_EQ(state_.selection.size(), 2U);
  select(nowhere, first, Combine::toggle);
  EXPECT_EQ(state_.selection, std::set<CellId>{second});
  select(onFloor({1, 1}), first);
  EXPECT_EQ(state_.scene3d.corner, (OutlineCorner{0, 2}));
  EXPECT_TRUE(state_.selection.empty());
  select(nowhere, std::nullopt);
  EXPECT_FALSE(state_.scene3d.corner.has_value());
  // With Shift, a drag draws a box on the floor.
  ASSERT_TRUE(drag(onFloor({-0.3, -0.3}), onFloor({0.3, 0.3}), ui::modifier::shift));
  EXPECT_EQ(state_.selection,
            combined({}, cellsTouching(*session_->built()->layout, {-0.3, -0.3}, {0.3, 0.3}), Combine::add));
  EXPECT_FALSE(state_.selection.empty());
}

}  // namespace
}  // namespace acentric::editor
