#pragma once
/// What every plan shows beside its contents: metric grid, rulers, scale bar, coordinates under the pointer.

#include <imgui.h>

#include <optional>
#include <span>

#include "ui/canvas_view.h"
#include "ui/colour.h"

namespace acentric::ui {

inline ImVec2 imVec(const glm::dvec2& v) { return {float(v.x), float(v.y)}; }
inline glm::dvec2 fromIm(const ImVec2& v) { return {double(v.x), double(v.y)}; }

void drawGrid(ImDrawList& list, const CanvasView& view);
/// Along the top and left borders; `pointer` (window pixels) is marked on both.
void drawRulers(ImDrawList& list, const CanvasView& view, ImFont* font, std::optional<glm::dvec2> pointer);
void drawScaleBar(ImDrawList& list, const CanvasView& view, ImFont* font);
/// "x 1.25 m   y -0.40 m" in the lower right corner.
void drawCoordinates(ImDrawList& list, const CanvasView& view, ImFont* font, const glm::dvec2& world);

/// Closed polygon in world coordinates, filled and outlined; convex.
void drawConvex(ImDrawList& list, const CanvasView& view, std::span<const glm::dvec2> corners,
                const Colour& fill, const Colour& line, float thickness);
/// Dashes of 6 pixels along a world polyline.
void drawDashed(ImDrawList& list, const CanvasView& view, std::span<const glm::dvec2> points, bool closed,
                const Colour& line, float thickness);
/// Text with a dark plate behind it, so that it reads on any picture.
void drawLabel(ImDrawList& list, ImFont* font, const ImVec2& position, const Colour& colour,
               const char* text);

inline constexpr float kRulerPixels = 18;  ///< unscaled

}  // namespace acentric::ui
