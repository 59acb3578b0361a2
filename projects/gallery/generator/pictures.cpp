// Framed pictures and the mirror.

#include <array>
#include <string>
#include <vector>

#include "projects/gallery/generator/gallery.h"
#include "projects/gallery/generator/paintings.h"

namespace acentric::gallery {
namespace {

constexpr float kFrameWidth = 0.115f;
constexpr float kPixelsPerMetre = 360;
constexpr float kPictureCentre = 1.85f;  // z

struct Hanging {
  const char* name;
  Canvas (*paint)(int, int, std::uint32_t);
  std::uint32_t seed;
  glm::vec2 size;  // metres
  glm::vec3 place;
  glm::vec3 normal;
  bool dark;  // walnut frame instead of gilt
};

std::vector<Hanging> hangings() {
  const glm::vec3 north(0, -1, 0), south(0, 1, 0), east(-1, 0, 0), west(1, 0, 0);
  const auto on = [](float along, const glm::vec3& normal) {
    const float distance = normal.x != 0 ? kHalfLength : kHalfWidth;
    const glm::vec3 across = glm::vec3(1) - glm::abs(normal);
    return -normal * distance + glm::vec3(across.x * along, across.y * along, kPictureCentre);
  };
  return {
      {"Mountains at dusk", paintMountains, 101, {1.75f, 1.1f}, on(-3.75f, north), north, false},
      {"Construction", paintConstruction, 102, {1.2f, 1.2f}, on(-1.25f, north), north, true},
      {"Evening at sea", paintSea, 103, {1.75f, 1.1f}, on(1.25f, north), north, false},
      {"Poppies", paintMeadow, 104, {1.5f, 1.1f}, on(3.75f, north), north, false},
      {"Rings", paintRings, 105, {1.55f, 1.16f}, on(-3.75f, south), south, true},
      {"Night with stars", paintNightSky, 106, {1.5f, 1.2f}, on(-1.25f, south), south, false},
      {"Roofs", paintTown, 107, {1.3f, 1.2f}, on(1.25f, south), south, false},
      {"Mist in the ranges", paintMountains, 108, {1.75f, 1.0f}, on(3.75f, south), south, false},
      {"Birches", paintBirches, 109, {1.0f, 1.4f}, on(-3.75f, west), west, false},
      {"Fields of colour", paintFields, 110, {1.05f, 1.4f}, on(3.75f, west), west, true},
      {"Still life with oranges", paintStillLife, 111, {1.25f, 1.0f}, on(-3.8f, east), east, false},
      {"Moonlit bay", paintSea, 112, {1.25f, 1.0f}, on(3.8f, east), east, false},
  };
}

/// Around an opening of `half`, from the wall (z = 0) forwards.
Shape frame(const glm::vec2& half, float width) {
  const std::array<glm::vec2, 12> profile{{{width, 0.006f},
                                           {0.9f * width, 0.02f},
                                           {0.86f * width, 0.02f},
                                           {0.82f * width, 0.027f},
                                           {0.6f * width, 0.034f},
                                           {0.42f * width, 0.048f},
                                           {0.34f * width, 0.05f},
                                           {0.27f * width, 0.064f},
                                           {0.14f * width, 0.068f},
                                           {0.05f * width, 0.06f},
                                           {0, 0.045f},
                                           {0, 0}}};
  return moulding(half + width, profile);
}

}  // namespace

void addPictures(Model& model, const Materials& materials, float pictureScale) {
  Shape labels;
  for (const Hanging& h : hangings()) {
    const glm::vec2 half = 0.5f * h.size;
    const glm::ivec2 pixels(glm::round(h.size * kPixelsPerMetre * pictureScale));
    Canvas canvas = h.paint(pixels.x, pixels.y, h.seed);
    varnish(canvas, h.seed);
    const int painting = addPaintingMaterial(model, h.name, canvas.encodeJpeg(92));
    Shape face;
    addPicture(face, {-half.x, -half.y, 0.012f}, {half.x, -half.y, 0.012f}, {half.x, half.y, 0.012f},
               {-half.x, half.y, 0.012f});
    model.things.push_back({h.name,
                            {{painting, std::move(face)},
                             {h.dark ? materials.walnut : materials.gilt, frame(half, kFrameWidth)}},
                            {onWall(h.place, h.normal)}});
    Shape label;
    addBox(label, {-0.08f, -0.045f, 0}, {0.08f, 0.045f, 0.008f}, 0.002f);
    labels.append(label, onWall(h.place, h.normal) * moved(half.x + 0.26f, -half.y + 0.02f, 0));
  }
  model.add("Labels", materials.trim, std::move(labels));

  const glm::vec2 half(1.05f, 1.28f);
  constexpr float kGlassOut = 0.05f;  // before the wall, clear of its mouldings
  Shape glass;
  addPicture(glass, {-half.x, -half.y, kGlassOut}, {half.x, -half.y, kGlassOut}, {half.x, half.y, kGlassOut},
             {-half.x, half.y, kGlassOut});
  Shape surround;
  surround.append(frame(half, 0.17f), moved(0, 0, kGlassOut - 0.01f));
  addBox(surround, {-half.x - 0.165f, -half.y - 0.165f, 0},
         {half.x + 0.165f, half.y + 0.165f, kGlassOut - 0.005f});
  model.things.push_back({"Mirror",
                          {{materials.mirror, std::move(glass)}, {materials.gilt, std::move(surround)}},
                          {onWall({-kHalfLength, 0, 1.75f}, {1, 0, 0})}});
}

}  // namespace acentric::gallery
