#pragma once
/// The seven tilings as pictures, with what each would give here: pointing at one shows it in the plan, a
/// click lays it.

#include <optional>
#include <vector>

#include "editor/panels/panel_context.h"
#include "editor/session/configuration_facts.h"

namespace acentric::editor {

class ConfigurationPicker {
 public:
  /// The field that opens it, `labelWidth` pixels for its label.
  void draw(PanelContext& context, float labelWidth);

 private:
  struct Entry {
    Layout patch;
    ConfigurationFacts facts;
    std::optional<LaidCounts> laid;  ///< once it was pointed at
    bool counted = false;
  };
  void prepare(Session& session);
  bool drawChoice(PanelContext& context, Configuration configuration);

  std::vector<Entry> entries_;  ///< as of when it was opened
  PixelCost cost_;
};

}  // namespace acentric::editor
