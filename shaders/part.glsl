// The part of the view that a piece is drawn in.
uniform vec2 partLow;  // unit directions of the part's borders, half-open [low, high)
uniform vec2 partHigh;
uniform bool partIsWide;  // more than half a turn

float left(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

bool inPart(vec2 inPlan) {
  bool fromLow = left(partLow, inPlan) >= 0.0;
  bool toHigh = left(inPlan, partHigh) > 0.0;
  return partIsWide ? fromLow || toHigh : fromLow && toHigh;
}
