#pragma once
/// The materials of the gallery, with their pictures: stone, plaster, wood, leaves and the rest, made by
/// rule.

#include "projects/gallery/generator/model.h"

namespace acentric::gallery {

/// Indices into Model::materials.
struct Materials {
  int floorTiles, darkMarble, plaster, panel, trim, columnStone, coffer, gilt, bronzeTrim;
  int mirror, glass, lampGlobe, lampShade;
  int walnut, leather, velvet, brass, plinthStone, sculpture;
  int leaf, pot, soil;
  int stucco, paving, grass, hedge, bark, distance, doorWood;
};

/// `pictureScale` makes every picture smaller or larger than its usual size.
Materials addMaterials(Model& model, float pictureScale);

/// A matt material that is one picture.
int addPaintingMaterial(Model& model, const std::string& name, std::vector<std::byte> jpeg);

}  // namespace acentric::gallery
