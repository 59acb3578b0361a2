#pragma once
/// The forest town's materials and pictures, all of them painted by the generator.

#include "projects/gallery/generator/model.h"

namespace acentric::forest {

struct Materials {
  // Alpha-tested, four sprigs on each picture.
  int oak, lime, birch, spruce, pine, apple, hazel, fern;
  int grass, flowers;  ///< blades: tints from left to right, foot below tip
  int bark, birchBark, pineBark;
  int ground;  ///< tinted by vertex colours
  int cobbles, kerb;
  int plasters[3], timber, paint[3], frame, pane, tiles, stone, door;
};

/// `pictureScale` below 1 makes pictures coarser and the making faster.
Materials addMaterials(gallery::Model& model, float pictureScale);

}  // namespace acentric::forest
