#include "ui/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <vector>

#include "ui/colour.h"
#include "ui/icons.h"
#include "ui/translate.h"

namespace acentric::ui {
namespace {

// Latin, dashes and ellipsis, arrows, mathematical signs, geometric shapes, check marks.
constexpr float kJapaneseSize = 1;  ///< beside the main font, whose letters fill less of their height
constexpr std::array<ImWchar, 13> kGlyphs = {0x0020, 0x00ff, 0x2010, 0x2027, 0x2190, 0x21ff, 0x2212,
                                             0x2265, 0x25a0, 0x25ff, 0x2713, 0x2718, 0};

/// Each icon as a range of its own, as ImGui takes them.
constexpr std::array<ImWchar, 2 * std::size(kIcons) + 1> iconRanges() {
  std::array<ImWchar, 2 * std::size(kIcons) + 1> ranges{};
  for (std::size_t i = 0; i < std::size(kIcons); ++i) ranges[2 * i] = ranges[2 * i + 1] = ImWchar(kIcons[i]);
  return ranges;
}
constexpr auto kIconGlyphs = iconRanges();

bool isThere(const char* file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error);
}

ImFont* loadFont(const char* file, float size, const ImWchar* glyphs = kGlyphs.data()) {
  if (!isThere(file)) return nullptr;
  ImFontConfig config;
  config.OversampleH = 2;
  config.OversampleV = 1;
  config.PixelSnapH = true;
  return ImGui::GetIO().Fonts->AddFontFromFileTTF(file, size, &config, glyphs);
}

/// Japanese letters that the program's own texts need, and those that names are written with.
struct JapaneseGlyphs {
  std::vector<ImWchar> texts, names;
};

std::vector<ImWchar> rangesOf(ImFontGlyphRangesBuilder& builder) {
  ImVector<ImWchar> ranges;
  builder.BuildRanges(&ranges);
  return {ranges.begin(), ranges.end()};
}

JapaneseGlyphs japaneseGlyphs(bool names) {
  JapaneseGlyphs glyphs;
  ImFontGlyphRangesBuilder builder;
  for (const Language& each : languages()) builder.AddText(each.name);
  builder.AddText(catalogueTexts().c_str());
  // What the main font has stays the main font's.
  for (std::size_t i = 0; kGlyphs[i] != 0; i += 2)
    for (unsigned c = kGlyphs[i]; c <= kGlyphs[i + 1]; ++c)
      builder.UsedChars[int(c >> 5U)] &= ~(1U << (c & 31U));
  glyphs.texts = rangesOf(builder);
  if (!names) return glyphs;
  ImFontGlyphRangesBuilder more = builder;
  for (const ImWchar* range = ImGui::GetIO().Fonts->GetGlyphRangesJapanese(); *range != 0; range += 2)
    for (unsigned c = std::max<unsigned>(range[0], 0x3000); c <= range[1]; ++c) more.AddChar(ImWchar(c));
  glyphs.names = rangesOf(more);
  return glyphs;
}

/// Adds to the font that was loaded last what it has no glyph for.
void addJapanese(const char* file, float size, const std::vector<ImWchar>& glyphs) {
  if (glyphs.empty() || glyphs[0] == 0 || !isThere(file)) return;
  ImFontConfig config;
  config.MergeMode = true;
  config.OversampleH = 1;
  config.PixelSnapH = true;
  ImGui::GetIO().Fonts->AddFontFromFileTTF(file, size, &config, glyphs.data());
}

void setSizes(ImGuiStyle& style) {
  style.WindowPadding = {12, 10};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.CellPadding = {6, 3};
  style.IndentSpacing = 16;
  style.ScrollbarSize = 11;
  style.GrabMinSize = 10;
  style.WindowRounding = 6;
  style.ChildRounding = 0;
  style.FrameRounding = 4;
  style.PopupRounding = 5;
  style.ScrollbarRounding = 6;
  style.GrabRounding = 3;
  style.TabRounding = 4;
  style.WindowBorderSize = 1;
  style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 0;
  style.WindowTitleAlign = {0.0F, 0.5F};
  style.WindowMenuButtonPosition = ImGuiDir_None;
  style.DisabledAlpha = 0.45F;
}

void setColours(ImGuiStyle& style) {
  using namespace palette;
  const bool light = currentPalette().light;
  const auto set = [&style](ImGuiCol_ id, const Colour& colour) { style.Colors[id] = colour.vec(); };
  set(ImGuiCol_Text, text);
  set(ImGuiCol_TextDisabled, muted);
  set(ImGuiCol_WindowBg, panel);
  set(ImGuiCol_ChildBg, panel.withOpacity(0));
  set(ImGuiCol_PopupBg, popup.withOpacity(0.985F));
  set(ImGuiCol_Border, border);
  set(ImGuiCol_BorderShadow, panel.withOpacity(0));
  set(ImGuiCol_FrameBg, raised);
  set(ImGuiCol_FrameBgHovered, hovered);
  set(ImGuiCol_FrameBgActive, pressed);
  set(ImGuiCol_TitleBg, panel);
  set(ImGuiCol_TitleBgActive, raised);
  set(ImGuiCol_TitleBgCollapsed, panel);
  set(ImGuiCol_MenuBarBg, backdrop);
  set(ImGuiCol_ScrollbarBg, panel.withOpacity(0));
  set(ImGuiCol_ScrollbarGrab, border);
  set(ImGuiCol_ScrollbarGrabHovered, faint);
  set(ImGuiCol_ScrollbarGrabActive, muted);
  set(ImGuiCol_CheckMark, accent);
  set(ImGuiCol_SliderGrab, accent);
  set(ImGuiCol_SliderGrabActive, accent);
  set(ImGuiCol_Button, raised);
  set(ImGuiCol_ButtonHovered, hovered);
  set(ImGuiCol_ButtonActive, pressed);
  set(ImGuiCol_Header, selected);
  set(ImGuiCol_HeaderHovered, hovered);
  set(ImGuiCol_HeaderActive, pressed);
  set(ImGuiCol_Separator, border);
  set(ImGuiCol_SeparatorHovered, accent);
  set(ImGuiCol_SeparatorActive, accent);
  set(ImGuiCol_ResizeGrip, border);
  set(ImGuiCol_ResizeGripHovered, accent);
  set(ImGuiCol_ResizeGripActive, accent);
  set(ImGuiCol_Tab, panel);
  set(ImGuiCol_TabHovered, hovered);
  set(ImGuiCol_TabActive, raised);
  set(ImGuiCol_TabUnfocused, panel);
  set(ImGuiCol_TabUnfocusedActive, raised);
  set(ImGuiCol_PlotHistogram, accent);
  set(ImGuiCol_TableHeaderBg, raised);
  set(ImGuiCol_TableBorderStrong, border);
  set(ImGuiCol_TableBorderLight, border.withOpacity(0.5F));
  set(ImGuiCol_TableRowBgAlt, text.withOpacity(0.03F));
  set(ImGuiCol_TextSelectedBg, accent.withOpacity(0.35F));
  set(ImGuiCol_DragDropTarget, accent);
  set(ImGuiCol_NavHighlight, accent);
  set(ImGuiCol_ModalWindowDimBg, Colour::hex(0x000000, light ? 0.32F : 0.55F));
}

}  // namespace

Fonts applyTheme(const Look& look, std::vector<std::string>& missingFonts, const FontFiles& files) {
  ImGuiIO& io = ImGui::GetIO();
  io.UserData = const_cast<Look*>(&look);  // ImGui's slot for the program; read by currentLook() alone
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  setSizes(style);
  setColours(style);
  style.ScaleAllSizes(look.scale);

  io.Fonts->Clear();
  missingFonts.clear();
  const auto missing = [&](const char* file, const char* package) {
    missingFonts.push_back(trf("The font {} is missing; install {}", file, package));
  };
  Fonts fonts;
  static JapaneseGlyphs japanese;  // as long as the atlas, which refers to its ranges
  japanese = japaneseGlyphs(look.japanese);
  const auto load = [&](const char* file, float size, bool withNames) {
    ImFont* const font = loadFont(file, size);
    if (font != nullptr)
      addJapanese(files.japanese, size * kJapaneseSize,
                  withNames && look.japanese ? japanese.names : japanese.texts);
    return font;
  };
  fonts.regular = load(files.regular, std::round(14.0F * look.scale), true);
  fonts.bold = load(files.bold, std::round(14.0F * look.scale), true);
  fonts.small = load(files.regular, 11.5F * look.scale, true);
  fonts.title = load(files.regular, std::round(24.0F * look.scale), false);
  fonts.icons = loadFont(files.icons, std::round(17.0F * look.scale), kIconGlyphs.data());
  if (fonts.regular == nullptr) {
    missing(files.regular, tr("fonts-dejavu-core for a better look."));
    ImFontConfig config;
    config.SizePixels = std::round(13.0F * look.scale);
    fonts.regular = io.Fonts->AddFontDefault(&config);
  }
  if (look.japanese && !isThere(files.japanese))
    missing(files.japanese, tr("fonts-vlgothic for Japanese letters."));
  io.FontDefault = fonts.regular;  // else the first in the atlas, which the icons may be
  if (fonts.icons == nullptr) missing(files.icons, tr("fonts-fork-awesome for icons in place of words."));
  if (fonts.bold == nullptr) fonts.bold = fonts.regular;
  if (fonts.small == nullptr) fonts.small = fonts.regular;
  if (fonts.title == nullptr) fonts.title = fonts.regular;
  return fonts;
}

const Look* currentLook() {
  return ImGui::GetCurrentContext() == nullptr ? nullptr : static_cast<const Look*>(ImGui::GetIO().UserData);
}

float interfaceScale() {
  const Look* look = currentLook();
  return look != nullptr ? look->scale : 1;
}

float scaled(float pixels) { return pixels * interfaceScale(); }

ImVec2 scaled(const ImVec2& pixels) { return {scaled(pixels.x), scaled(pixels.y)}; }

}  // namespace acentric::ui
