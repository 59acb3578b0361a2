#include "editor/panels/look_through.h"

#include <fmt/format.h>

#include <algorithm>

#include "editor/session/engine_texts.h"
#include "engine/bake/bake.h"
#include "engine/geometry/conventions.h"
#include "engine/measure/source_colours.h"
#include "ui/image_view.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr float kCardEdge = 12, kPadding = 10, kLeastWidth = 212, kMostWidth = 300, kLeastPicture = 120;

const char* handText(Hand hand) {
  return hand == Hand::counterClockwise ? tr("counter-clockwise") : tr("clockwise");
}

std::string cellText(const Layout& layout, const CameraPlace& place) {
  const Region& region = layout.regions[std::size_t(*layout.findRegion(place.cell))];
  if (region.id.slot == kFreeSlot) return trf("single APV {}", region.id.i);
  const char* kind = region.kind == RegionKind::ring ? tr("ring") : tr("gap");
  std::string text = fmt::format("{} ({}, {})", kind, region.id.i, region.id.j);
  if (region.covers.size() > 1)
    text += fmt::format(", {}", handText(region.covers[std::size_t(place.cover)].hand));
  return text;
}

}  // namespace

std::optional<int> LookThrough::cameraOf(const PanelContext& context) {
  const auto& place = context.actions.state.scene3d.lookThrough;
  if (!place) return std::nullopt;
  return cameraAtPlace(*context.actions.session.built()->layout, *place);
}

void LookThrough::close() {
  place_.reset();
  stream_.clear();
  texture_.clear();
}

void LookThrough::drawText(PanelContext& context, const ColumnCamera& columns, int camera) const {
  const OpenProject& open = *context.session().built();
  const LayoutCamera& of = open.layout->cameras[std::size_t(camera)];
  ImGui::PushFont(context.window.fonts().bold);
  ImGui::TextUnformatted(engineText(sourceName(*open.layout, sourceOfCamera(camera))).c_str());
  ImGui::PopFont();
  const float right = ImGui::GetWindowContentRegionMax().x;
  ImGui::SameLine(right - 22);
  if (ui::button("×##closeCamera", {22, 0})) context.state().scene3d.lookThrough.reset();
  context.log.item("look.close");
  ui::tooltip(tr("Close  [Esc]"));
  const auto whole = [](double radiansValue) { return std::lround(degrees(radiansValue)); };
  ImGui::PushFont(context.window.fonts().small);
  ui::mutedText(cellText(*open.layout, *place_));
  ui::mutedText(trf("sector {}° to {}°, {}° wide", whole(wrapAngle(of.lowAzimuth)),
                    whole(wrapAngle(of.lowAzimuth)) + whole(of.fovRadians), whole(of.fovRadians)));
  ui::mutedText(trf("from {}° below to {}° above the eye", -whole(columns.bottomElevation),
                    whole(columns.topElevation)));
  const auto& captures = context.session().captures();
  const bool baked = captures && captures->cameras[std::size_t(camera)];
  ui::mutedText(
      trf("{} × {} samples, {}", columns.columns, columns.rows, baked ? tr("baked") : tr("not baked yet")));
  ImGui::PopFont();
}

void LookThrough::drawPicture(PanelContext& context, const ImVec2& room) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("##cameraPicture", room);
  context.log.item("look.picture");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + room.x, at.y + room.y}, ui::palette::backdrop.packed(), 3);
  const PreviewShown* shown = stream_.shown();
  if (shown == nullptr || texture_.empty()) return;
  const ColumnCamera& whole = std::get<PreviewCapture>(shown->whole.camera).columns;
  const ui::FittedImage fitted =
      ui::fitImage({at.x, at.y}, {room.x, room.y}, double(whole.columns) / double(whole.rows));
  ui::drawImage(texture_.imguiId(), fitted, false);
}

/// Once for each camera, in the frame after the one that showed it.
void LookThrough::tellFirst(PanelContext& context, int camera) {
  if (firstTold_ || !showsCamera(context, camera)) return;
  firstTold_ = true;
  const ColumnCamera& columns = std::get<PreviewCapture>(stream_.shown()->traced.camera).columns;
  context.log.event("lookthrough", fmt::format("camera {} first {:.1f} ms {}x{} traced {:.1f} ms", camera,
                                               1e3 * (context.now - askedAt_), columns.columns, columns.rows,
                                               1e3 * stream_.shown()->seconds));
}

bool LookThrough::showsCamera(const PanelContext& context, int camera) const {
  if (stream_.shown() == nullptr) return false;
  const auto& cameras = context.actions.session.built()->layout->cameras;
  return std::get<PreviewCapture>(stream_.shown()->traced.camera).camera.id ==
         cameras[std::size_t(camera)].id;
}

void LookThrough::trace(PanelContext& context, const PreviewTracerPtr& tracer, int camera,
                        const ColumnCamera& columns) {
  if (place_ == context.state().scene3d.lookThrough) {
    tellFirst(context, camera);
  } else {
    place_ = context.state().scene3d.lookThrough;
    askedAt_ = context.now;
    firstTold_ = false;
  }
  const LayoutCamera& of = context.session().built()->layout->cameras[std::size_t(camera)];
  stream_.want({tracer, PreviewCapture{of, columns}, kNoCut});
  if (!(showsCamera(context, camera) ? stream_.take() : stream_.takeWithin(PreviewStream::kFirstWait)))
    return;
  const ColourImage& colour = stream_.shown()->picture.colour;
  texture_.upload(colour.width, colour.height,
                  {&colour.pixels.front().x, colour.pixels.size() * sizeof(Rgba8)});
  context.window.pacer().request(1);
}

std::pair<ImVec2, ImVec2> LookThrough::draw(PanelContext& context, const PreviewTracerPtr& tracer, int camera,
                                            const ImVec2& areaMin, const ImVec2& areaMax) {
  const OpenProject& open = *context.session().built();
  const ColumnCamera baked = columnCameraFor(open.layout->cameras[std::size_t(camera)], *open.layout,
                                             open.scene->bounds, open.project.bake);
  const ImGuiStyle& style = ImGui::GetStyle();
  const float texts = ImGui::GetFrameHeight() +
                      4 * (context.window.fonts().small->FontSize + style.ItemSpacing.y) +
                      ImGui::GetFrameHeight() + 2 * style.ItemSpacing.y + 2 * kPadding;
  const float tall = std::max(areaMax.y - areaMin.y - 2 * kCardEdge, texts + kLeastPicture);
  const float aspect = float(baked.columns) / float(baked.rows);
  const float width = std::clamp((tall - texts) * aspect, kLeastWidth, kMostWidth);
  const float height = std::min(width / aspect, tall - texts);

  // No more columns and rows than the panel has pixels.
  const double scale = std::min({1.0, double(width) / baked.columns, double(height) / baked.rows});
  ColumnCamera columns = baked;
  columns.columns = std::max(1, int(baked.columns * scale));
  columns.rows = std::max(1, int(baked.rows * scale));
  trace(context, tracer, camera, columns);

  ImGui::SetCursorScreenPos({areaMin.x + kCardEdge, areaMin.y + kCardEdge});
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ui::palette::panel.withOpacity(0.96F).vec());
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {kPadding, kPadding});
  ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, 5);
  ImGui::BeginChild("##lookThrough", {width + 2 * kPadding, height + texts}, true,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PopStyleVar(2);
  drawText(context, baked, camera);
  drawPicture(context, {width, height});
  actionButton(context, "scene3d.previousCamera", ButtonLook::plain, {34, 0}, "<");
  ImGui::SameLine(0, 4);
  actionButton(context, "scene3d.nextCamera", ButtonLook::plain, {34, 0}, ">");
  ImGui::SameLine(0, 12);
  actionButton(context, "scene3d.otherHand", ButtonLook::plain, {}, tr("Other hand"));
  ImGui::EndChild();
  ImGui::PopStyleColor();
  context.log.item("look");
  return {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
}

}  // namespace acentric::editor
