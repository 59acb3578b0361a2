#pragma once
/// The column beside the plan: the scale of values, what colours and signs mean, and notes.

#include "engine/picture/plan_picture.h"

namespace acentric {

class CairoCanvas;

bool hasLegend(const PlanPicture& picture);
/// Draws downwards from `at`; returns the height used.
double drawLegend(CairoCanvas& canvas, const PlanPicture& picture, const glm::dvec2& at, double width);
/// A marker, in the plan as in the legend.
void drawMarker(CairoCanvas& canvas, MarkerShape shape, const glm::dvec2& at, double size,
                const Rgba8& colour);
/// Round numbers (1, 2, 5 times a power of ten) within [low, high]: at most `most`.
std::vector<double> roundNumbers(double low, double high, int most, bool logarithmic);
/// "1.5 M", "250 k", "12", "0.25".
std::string shortNumber(double value);

}  // namespace acentric
