#include "editor/panels/bake_section.h"

#include <algorithm>
#include <string>
#include <vector>

#include "editor/commands/setting_edits.h"
#include "editor/panels/project_field.h"
#include "editor/panels/settings_parts.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

/// After the field of one of the bake's settings. `what` names its step in the history.
void applyBakeEdit(PanelContext& context, const char* logName, const ui::FieldEdit& edit,
                   const BakeSettings& bake, const char* what) {
  context.log.item(std::string("settings.") + logName);
  if (edit) applyFieldEdit(context, edit, setBakeSettings(context.session().project(), bake, what));
}

template <class Value>
void bakeNumber(PanelContext& context, const char* logName, const ui::NumberField& field,
                Value BakeSettings::*setting, const char* what) {
  BakeSettings bake = context.session().project().bake;
  const ui::FieldEdit edit = ui::numberField(field, bake.*setting, kLabelWidth);
  applyBakeEdit(context, logName, edit, bake, what);
}

void bakeCheck(PanelContext& context, const char* name, const char* label, const char* help,
               bool BakeSettings::*setting) {
  BakeSettings bake = context.session().project().bake;
  const ui::FieldEdit edit = ui::checkField(label, bake.*setting, kLabelWidth, help);
  applyBakeEdit(context, name, edit, bake, name);
}

void drawPruningLoss(PanelContext& context) {
  constexpr double kPercent = 100;
  BakeSettings bake = context.session().project().bake;
  double percent = kPercent * bake.pruningLoss;
  const ui::FieldEdit edit = ui::numberField(
      {tr("Pruning loss"), "%.3f %%", 0.002, 0, kPercent,
       tr("Of what is seen from a region, pruning loses no more (with 95 % confidence): test eyes "
          "are added until then. Less closes finer holes and takes longer. 0: none are added.")},
      percent, kLabelWidth);
  bake.pruningLoss = percent > 0 ? std::max(percent / kPercent, kLeastPruningLoss) : 0;
  applyBakeEdit(context, "pruningLoss", edit, bake, tr("pruning loss"));
}

constexpr const char* kInView[] = {trLater("samples per degree"), trLater("ambient rays"),
                                   trLater("shadow rays"), trLater("bounces"), trLater("colour quality")};

/// Of the settings that are folded away, those that differ from the preset in force or nearest, or from what
/// new projects have.
std::vector<std::string> changedAdvanced(const BakeSettings& bake) {
  std::vector<std::string> changed = differencesFrom(bake, nearestPreset(bake));
  std::erase_if(
      changed, [](const std::string& name) { return std::ranges::find(kInView, name) != std::end(kInView); });
  if (bake.ambientRadius != BakeSettings{}.ambientRadius) changed.emplace_back(trLater("ambient radius"));
  if (bake.eyeRange != BakeSettings{}.eyeRange) changed.emplace_back(trLater("eye range"));
  return changed;
}

void drawAdvancedBake(PanelContext& context) {
  const BakeSettings& bake = context.session().project().bake;
  if (!advancedPart(context, trLater("Bake quality"), changedAdvanced(bake))) return;
  bakeNumber(
      context, "eyeRange",
      {tr("Eye range"), "%.2f m", 0.005, 0, 10, tr("How far above and below eye height the walk may go.")},
      &BakeSettings::eyeRange, tr("eye range"));
  bakeNumber(context, "maxLayers",
             {tr("Most layers"), "%.0f", 0.05, 1, 64,
              tr("Surfaces kept behind each other in one pixel: what opens up behind edges. 1 to 64.")},
             &BakeSettings::maxLayers, tr("most layers"));
  bakeCheck(context, "pruning", tr("Prune"),
            tr("Keep only what can be seen from somewhere in a region that the camera serves."),
            &BakeSettings::pruning);
  if (context.session().project().bake.pruning) {
    drawPruningLoss(context);
    bakeNumber(
        context, "testEyes",
        {tr("Test eyes"), "%.0f", 0.05, 1, kMostTestEyes,
         tr("Places spread over each region that pruning looks from; where they lose too much, others are "
            "added. 1 to 64.")},
        &BakeSettings::testEyes, tr("test eyes"));
  }
  bakeNumber(
      context, "distanceShift",
      {tr("Distance shift"), trPrintf("%.3f samples"), 0.005, 0, kLargestDistanceShift,
       tr("How far pictures may shift because distances are rounded: more gives smaller files. 0 to 16.")},
      &BakeSettings::distanceShift, tr("distance shift"));
  bakeNumber(context, "surfaceTexel",
             {tr("Surface texel"), "%.3f m", 0.001, 0.002, 10,
              tr("Distance of light samples on near geometry, and of places where light from all around is "
                 "gathered. Edges of strong shadows have samples four times as close.")},
             &BakeSettings::surfaceTexel, tr("surface texel"));
  bakeNumber(
      context, "ambientRadius",
      {tr("Ambient radius"), "%.2f m", 0.01, 0.01, 1000, tr("Farther surfaces cast no ambient shade.")},
      &BakeSettings::ambientRadius, tr("ambient radius"));
}

}  // namespace

void drawBakeSection(PanelContext& context) {
  if (!askedSection(context, trLater("Bake quality"))) return context.session().showBakeCosts(false);
  drawBakePresets(context);
  bakeNumber(context, "samplesPerDegree",
             {tr("Samples per degree"), "%.1f /°", 0.05, 0.5, 64,
              tr("Resolution of captures. Time and bytes grow with its square.")},
             &BakeSettings::samplesPerDegree, tr("samples per degree"));
  bakeNumber(context, "ambientRays",
             {tr("Ambient rays"), "%.0f", 0.2, 0, 1024,
              tr("Per place on a surface, for soft shade in corners and bounced light; 0 to 1024.")},
             &BakeSettings::ambientRays, tr("ambient rays"));
  bakeNumber(
      context, "shadowRays",
      {tr("Shadow rays"), "%.0f", 0.2, 1, 1024, tr("Per sample towards each light with a size; 1 to 1024.")},
      &BakeSettings::shadowRays, tr("shadow rays"));
  bakeNumber(context, "bounces",
             {tr("Bounces"), "%.0f", 0.05, 1, 8,
              tr("Of light between surfaces, where interreflection is on; 1 to 8.")},
             &BakeSettings::bounces, tr("bounces"));
  bakeNumber(
      context, "colourQuality",
      {tr("Colour quality"), "%.0f", 0.1, 0, kLosslessColours,
       tr("How true captures are to the colours that were baked: less gives smaller files. 100 keeps every "
          "bit, in files many times as large.")},
      &BakeSettings::colourQuality, tr("colour quality"));
  drawAdvancedBake(context);
}

}  // namespace acentric::editor
