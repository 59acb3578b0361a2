/// The walk asked about one of its pixels.
#include "editor/panels/answer_card.h"
#include "editor/panels/walk_panel.h"
#include "ui/canvas_draw.h"

namespace acentric::editor {

bool WalkPanel::onAnswer(const glm::dvec2& at) const {
  return at.x >= answerLow_.x && at.y >= answerLow_.y && at.x < answerHigh_.x && at.y < answerHigh_.y;
}

/// As soon as the frame under the click is known pixel by pixel.
void WalkPanel::askThePicture(PanelContext& context) {
  PictureAsk& asking = context.session().asking();
  // What it says is of a project that is no more.
  if (asking.question() && asking.question()->open != context.session().built()) asking.clear();
  if (context.session().shippedWalk()) askAt_.reset();
  if (!askAt_ || !rested_ || shown_.loaded->walk.layout != context.session().built()->layout) return;
  const glm::dvec2 at = (*askAt_ - place_.min) / place_.size;
  askAt_.reset();
  const glm::ivec2 pixel(glm::floor(at * glm::dvec2(shown_.view.width, shown_.view.height)));
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= shown_.view.width || pixel.y >= shown_.view.height) return;
  asking.ask({context.session().built(), shown_.loaded, rested_, shown_.view, pixel});
}

void WalkPanel::drawAnswer(PanelContext& context, const ImVec2& low, const ImVec2& size) {
  answerLow_ = answerHigh_ = glm::dvec2(0);
  const auto& question = context.session().asking().question();
  if (!question || context.state().fullScreen) return;
  if (samePlace(question->view, viewAt(context, 1))) {  // what was asked about, in sight
    const glm::dvec2 scale = place_.size / glm::dvec2(question->view.width, question->view.height);
    const ImVec2 at = ui::imVec(place_.min + (glm::dvec2(question->pixel) + 0.5) * scale);
    const float reach = float(kAskedPixels * scale.x);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto frame = [&](float by, const ui::Colour& colour) {
      list.AddRect({at.x - reach - by, at.y - reach - by}, {at.x + reach + by, at.y + reach + by},
                   colour.packed(), 0, 0, 1);
    };
    frame(0, ui::palette::text);
    frame(1, ui::palette::backdrop);
  }
  const auto [min, max] = drawAnswerCard(context, low, {low.x + size.x, low.y + size.y}, answerHeight_);
  answerLow_ = ui::fromIm(min);
  answerHigh_ = ui::fromIm(max);
}

}  // namespace acentric::editor
