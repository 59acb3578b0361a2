#pragma once
/// The sample scene: a hall of 14 x 10 m, 4.5 m high, with two rows of columns along x, pictures in the
/// aisles, a mirror at the west end and a door to a terrace at the east end. The hall's floor is z = 0, its
/// middle the origin.

#include "projects/gallery/generator/model.h"
#include "projects/gallery/generator/surfaces.h"

namespace acentric::gallery {

inline constexpr float kHalfLength = 7.0f;  ///< x of the end walls' inner faces
inline constexpr float kHalfWidth = 5.0f;   ///< y of the side walls' inner faces
inline constexpr float kHeight = 4.5f;      ///< of the ceiling
inline constexpr float kWall = 0.35f;       ///< thickness
inline constexpr float kParapet = 5.5f;     ///< top of the outer walls
inline constexpr float kDadoHeight = 0.92f;
inline constexpr float kBay = 2.5f;  ///< between columns
inline constexpr int kColumnsPerRow = 5;
inline constexpr float kColumnRow = 2.6f;  ///< y of the columns' axes
inline constexpr float kBeamHalf = 0.25f;  ///< half the width of the beams on the columns
inline constexpr float kBeamBottom = 3.75f;
inline constexpr float kDoorHalf = 1.2f;     ///< the door's opening: half its width,
inline constexpr float kDoorSpring = 2.3f;   ///< where its arch begins
inline constexpr float kTerraceEnd = 13.6f;  ///< x of the balustrade
inline constexpr float kTerraceHalf = 7.0f;
inline constexpr float kLawn = -0.5f;  ///< z of the garden

void addHall(Model& model, const Materials& materials);       ///< floor, walls, windows, door, outside faces
void addCeiling(Model& model, const Materials& materials);    ///< coffers, skylights, beams, cornices
void addColonnade(Model& model, const Materials& materials);  ///< fluted columns
void addPictures(Model& model, const Materials& materials,
                 float pictureScale);                         ///< framed, on three walls, and the mirror
void addFurniture(Model& model, const Materials& materials);  ///< glass case, ropes, benches, lamp, plants
void addTerrace(Model& model, const Materials& materials);    ///< paving, balustrade, urns
void addGarden(Model& model, const Materials& materials);     ///< lawn, hedges, trees, hills
/// A round temple, its foot there.
void addFolly(Model& model, const Materials& materials, const glm::vec3& foot);
void addLights(Model& model);  ///< sun and lamp

/// All of it. `pictureScale` below 1 makes the pictures coarser and the making faster; the geometry stays.
Model makeGallery(float pictureScale = 1);

}  // namespace acentric::gallery
