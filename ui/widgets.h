#pragma once
/// Small widgets that give every panel the same look.

#include <imgui.h>

#include <string>

#include "ui/colour.h"
#include "ui/icons.h"

namespace acentric::ui {

/// A filled button for the one thing that a panel is for.
bool primaryButton(const char* label, const ImVec2& size = {0, 0}, bool enabled = true);
bool button(const char* label, const ImVec2& size = {0, 0}, bool enabled = true);
/// A button that stays down while `on`.
bool toggleButton(const char* label, bool on, const ImVec2& size = {0, 0});

/// How an icon's button stands.
enum class Pressed { no, shown, chosen };
/// A square button with a picture, quiet until it is pointed at; `shown`: what it stands for is on, among
/// others that may be; `chosen`: the one of a row. `icons`: of Fonts.
bool iconButton(ImFont* icons, const char* id, Icon icon, Pressed pressed = Pressed::no, bool enabled = true);
/// Its sides in pixels.
ImVec2 iconButtonSize();

/// A check box whose border shows on any ground; true if it was clicked.
bool checkBox(const char* label, bool* value);
/// Closes the list or menu that was opened last, as Esc does where keys do not walk widgets.
void closeTopPopup();

/// Panel title in bold over a thin line.
void panelTitle(ImFont* bold, const char* text);
/// Collapsible section, open at first.
bool section(const char* label, bool openAtFirst = true);
void mutedText(const std::string& text);
void wrappedText(const Colour& colour, const std::string& text);
/// Label left in muted ink, value from `valueX` (unscaled) on.
void keyValue(const char* label, const std::string& value, float valueX);
/// Bar of the available width with text in it. fraction < 0: unknown, a moving bar (`seconds` moves it).
void progressBar(double fraction, const std::string& text, double seconds,
                 const Colour& colour = palette::accent);
/// Shapes that are told apart without their colours.
enum class Mark { disc, half, ring };
/// A mark and text.
void badge(const Colour& colour, const std::string& text, Mark mark = Mark::disc);
/// Help for the widget before it, wrapped, after a short rest of the pointer.
void tooltip(const std::string& text);

}  // namespace acentric::ui
