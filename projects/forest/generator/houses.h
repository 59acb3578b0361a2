#pragma once
/// Half-timbered houses and what stands beside them. Fronts face -y, along the street is x; the middle of the
/// front's foot is the origin.

#include "projects/forest/generator/materials.h"

namespace acentric::forest {

inline constexpr int kHouseDesigns = 3;
inline constexpr float kHouseDepth = 8;  ///< metres; widths are below

struct HouseDesign {
  float width = 9.5f;
  float eaves = 4.9f;
  float pitch = 50;         ///< degrees
  bool gableFront = false;  ///< its ridge leads away from the street
};
HouseDesign houseDesign(int design);

gallery::Thing makeHouse(int design, const Materials& materials);
/// Along x around the origin, a slat missing nowhere.
gallery::Thing makeFence(float length, const Materials& materials);
gallery::Thing makeLamp(const Materials& materials);
gallery::Thing makeWell(const Materials& materials);
gallery::Thing makeBench(const Materials& materials);

}  // namespace acentric::forest
