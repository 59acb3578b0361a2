#include "projects/gallery/generator/gallery.h"

namespace acentric::gallery {

Model makeGallery(float pictureScale) {
  Model model;
  const Materials materials = addMaterials(model, pictureScale);
  addHall(model, materials);
  addCeiling(model, materials);
  addColonnade(model, materials);
  addPictures(model, materials, pictureScale);
  addFurniture(model, materials);
  addTerrace(model, materials);
  addGarden(model, materials);
  addFolly(model, materials, {33, 0, kLawn});
  addLights(model);
  return model;
}

}  // namespace acentric::gallery
