#pragma once
/// Every user action, in menu order.

#include <vector>

#include "editor/actions/action.h"

namespace acentric::editor {

std::vector<Action> makeActionTable();

const Action* findAction(const std::vector<Action>& table, const std::string& id);
/// The action of a key press; nothing if none has this key with exactly these modifiers.
const Action* findAction(const std::vector<Action>& table, const Shortcut& shortcut);

}  // namespace acentric::editor
