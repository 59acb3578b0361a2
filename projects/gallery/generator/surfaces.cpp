#include "projects/gallery/generator/surfaces.h"

#include <algorithm>
#include <cmath>

#include "projects/gallery/generator/canvas.h"
#include "projects/gallery/generator/noise.h"

namespace acentric::gallery {
namespace {

constexpr int kJpegQuality = 90;

/// Where a point of a field of square tiles is: which tile, how far from its joint, how far from its nearest
/// corner.
struct TilePlace {
  glm::ivec2 tile{0};
  float toJoint = 0;   ///< tile widths, 0 = in the middle of the joint
  float toCorner = 0;  ///< by taxicab distance, tile widths
};

TilePlace tilePlace(const glm::vec2& p) {
  const glm::vec2 base = glm::floor(p);
  const glm::vec2 edge = glm::min(p - base, 1.0f - (p - base));
  return {glm::ivec2(base), std::min(edge.x, edge.y), edge.x + edge.y};
}

constexpr int kFloorTiles = 4;  // along one side of the picture
constexpr float kInset = 0.15f;
constexpr float kJoint = 0.006f;

/// Limestone slabs with small dark squares set into their corners.
Canvas floorPicture(int size) {
  Canvas canvas(size, size);
  constexpr std::uint32_t kSeed = 11;
  canvas.fill([&](const glm::vec2& p) {
    const TilePlace at = tilePlace(p * static_cast<float>(kFloorTiles));
    const glm::vec3 q(p * 8.0f, 0);
    const float own = hashUnit(at.tile.x, at.tile.y, 0, kSeed);
    // Each slab is cut from another place of the quarry.
    const glm::vec3 away(0, 0, 37 * own);
    const float cloud = fractalNoise(q + away, 5, kSeed, 8);
    const float vein = 1 - std::abs(fractalNoise(q * 2.0f + 2.0f * away, 4, kSeed + 1U, 16));
    if (at.toCorner < kInset) {
      const glm::vec3 dark =
          glm::mix(colour(0x27332f), colour(0x4a5a52), glm::smoothstep(0.0f, 0.6f, cloud + 0.3f));
      return at.toCorner > kInset - 1.4f * kJoint ? colour(0x8d8471) : dark;
    }
    if (at.toJoint < kJoint) return colour(0x8d8471);
    const glm::vec3 stone =
        gradient({colour(0xb99f72), colour(0xcfb78a), colour(0xe0cca3)}, 0.5f + 0.75f * cloud);
    const glm::vec3 veined = glm::mix(stone, colour(0xa18c6b), 0.35f * glm::smoothstep(0.90f, 1.0f, vein));
    return veined * (0.9f + 0.18f * own) * (1 + 0.04f * noise(q * 16.0f, kSeed, 128));
  });
  return canvas;
}

std::vector<std::byte> floorRelief(int size, float metres) {
  return normalMapPng(size, metres, [&](int x, int y) {
    const float scale = static_cast<float>(kFloorTiles) / static_cast<float>(size);
    const TilePlace at =
        tilePlace(glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) * scale);
    const float fromInset = std::abs(at.toCorner - kInset) * 0.7f;
    const float edge = at.toCorner < kInset ? fromInset : std::min(at.toJoint, fromInset);
    return 0.0025f * glm::smoothstep(0.0f, 0.012f, edge);
  });
}

Canvas plasterPicture(int size) {
  Canvas canvas(size, size);
  canvas.fill([](const glm::vec2& p) {
    const float trowel = fractalNoise({p.x * 6, p.y * 6, 0}, 5, 21, 6);
    const float stroke = fractalNoise({p.x * 20, p.y * 60, 0.5f}, 3, 22, 20);
    return colour(0xa9553f) * (1 + 0.10f * trowel + 0.035f * stroke);
  });
  return canvas;
}

Canvas marblePicture(int size, const glm::vec3& dark, const glm::vec3& light, const glm::vec3& vein,
                     std::uint32_t seed) {
  Canvas canvas(size, size);
  canvas.fill([&](const glm::vec2& p) {
    const glm::vec3 q(p * 4.0f, 0);
    const float bend = fractalNoise(q, 4, seed, 4);
    const float cloud = fractalNoise(q * 2.0f + glm::vec3(0, 0, bend), 5, seed + 1U, 8);
    const float line = 1 - std::abs(fractalNoise(q * 2.0f + glm::vec3(0, 0, 1.5f * bend), 4, seed + 2U, 8));
    return glm::mix(glm::mix(dark, light, 0.5f + 0.6f * cloud), vein,
                    0.55f * glm::smoothstep(0.93f, 1.0f, line));
  });
  return canvas;
}

/// Grain along x.
Canvas woodPicture(int size, const glm::vec3& dark, const glm::vec3& light, std::uint32_t seed) {
  Canvas canvas(size, size);
  canvas.fill([&](const glm::vec2& p) {
    const float wander = fractalNoise({p.x * 3, p.y * 6, 0}, 4, seed, 3);
    const float ring = 0.5f + 0.5f * std::sin(6.2831853f * (7 * p.y + 0.9f * wander));
    const float pore = fractalNoise({p.x * 12, p.y * 192, 0}, 3, seed + 1U, 12);
    return glm::mix(dark, light, 0.25f + 0.5f * ring) * (1 + 0.16f * pore);
  });
  return canvas;
}

Canvas pavingPicture(int size) {
  Canvas canvas(size, size);
  constexpr int kRows = 6;
  canvas.fill([](const glm::vec2& p) {
    const float row = std::floor(p.y * kRows);
    const float shift = std::fmod(row, 2.0f) * 0.5f;
    const glm::vec2 local(p.x * 3 + shift, p.y * kRows);
    const glm::vec2 base = glm::floor(local);
    const glm::vec2 edge = glm::min(local - base, 1.0f - (local - base)) * glm::vec2(2, 1);
    const float own = hashUnit(static_cast<int>(base.x) % 3, static_cast<int>(base.y), 0, 31);
    if (std::min(edge.x, edge.y) < 0.02f) return colour(0x8f8672);
    const float grain = fractalNoise({p * 24.0f, 9 * own}, 4, 32, 24);
    return gradient({colour(0xa99878), colour(0xbba98a), colour(0xcbbda2)}, own) * (1 + 0.12f * grain);
  });
  return canvas;
}

Canvas grassPicture(int size) {
  Canvas canvas(size, size);
  canvas.fill([](const glm::vec2& p) {
    const float patch = fractalNoise({p * 4.0f, 0}, 4, 41, 4);
    const float blade = fractalNoise({p.x * 64, p.y * 64, 0}, 3, 42, 64);
    return gradient({colour(0x4c6b2c), colour(0x668a3a), colour(0x8aa650)},
                    0.5f + 0.5f * patch + 0.35f * blade);
  });
  return canvas;
}

/// One leaf, stem at the bottom middle, with a pale rib; outside it alpha is 0.
Canvas leafPicture(int width, int height) {
  Canvas canvas(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float across = (static_cast<float>(x) + 0.5f) / static_cast<float>(width) * 2 - 1;
      const float up = 1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
      const float rib = std::abs(across);
      // A long pointed oval, slit between its side veins towards the rim.
      const float half =
          0.96f *
          std::pow(std::max(0.0f, std::sin(3.14159265f * std::pow(std::clamp(up, 0.0f, 1.0f), 0.72f))), 0.8f);
      const float vein = std::abs(std::fmod(11 * (up - 0.55f * rib) + 11.0f, 1.0f) - 0.5f) * 2;
      const float slit = glm::smoothstep(0.45f, 1.0f, rib / std::max(half, 1e-3f)) *
                         glm::smoothstep(0.75f, 0.95f, vein) * 1.2f;
      const bool stem = up < 0.12f && rib < 0.05f;
      const float coverage = stem ? 1.0f : glm::smoothstep(-0.03f, 0.03f, half - rib - slit * 0.45f);
      glm::vec3 tint = gradient({colour(0x1f4a2a), colour(0x2f6b37), colour(0x5b8f45)}, 0.25f + 0.5f * up);
      tint *= 0.85f + 0.3f * glm::smoothstep(0.0f, 0.5f, 1 - vein);
      tint = glm::mix(tint, colour(0xa9c07a), glm::smoothstep(0.055f, 0.02f, rib));
      canvas.at(x, y) = tint;
      canvas.alphaAt(x, y) = coverage;
    }
  return canvas;
}

}  // namespace

Materials addMaterials(Model& model, float pictureScale) {
  const auto pixels = [&](int usual) {
    return std::max(8, static_cast<int>(std::lround(static_cast<float>(usual) * pictureScale)));
  };
  const auto jpeg = [&](const char* name, const Canvas& canvas) {
    return model.add(Picture{name, canvas.encodeJpeg(kJpegQuality), true, true});
  };
  constexpr float kFloorMetres = 2.4f;
  const int floorPictureIndex = jpeg("Floor tiles", floorPicture(pixels(1024)));
  const int floorReliefIndex =
      model.add(Picture{"Floor relief", floorRelief(pixels(512), kFloorMetres), false, true});
  const int plaster = jpeg("Plaster", plasterPicture(pixels(512)));
  const int green = jpeg(
      "Green marble", marblePicture(pixels(512), colour(0x1c2b26), colour(0x3a5247), colour(0x9fb3a4), 51));
  const int travertine = jpeg(
      "Travertine", marblePicture(pixels(512), colour(0xdcc8a2), colour(0xebdcbd), colour(0xcbb185), 61));
  const int walnut = jpeg("Walnut", woodPicture(pixels(512), colour(0x4a2e1c), colour(0x7d5230), 71));
  const int oak = jpeg("Oak", woodPicture(pixels(512), colour(0x6b4a2b), colour(0x9a7044), 81));
  const int paving = jpeg("Paving", pavingPicture(pixels(512)));
  const int grass = jpeg("Grass", grassPicture(pixels(512)));
  const int leaf =
      model.add(Picture{"Leaf", leafPicture(pixels(128), pixels(256)).encodePng(true), false, false});

  const auto plain = [&](const char* name, const glm::vec3& base, float roughness = 0.8f,
                         float metallic = 0) {
    Material m;
    m.name = name;
    m.baseColour = glm::vec4(base, 1);
    m.roughness = roughness;
    m.metallic = metallic;
    return m;
  };
  const auto pictured = [&](const char* name, int picture, float metres, float roughness = 0.8f) {
    Material m;
    m.name = name;
    m.picture = picture;
    m.metres = metres;
    m.roughness = roughness;
    return m;
  };

  Materials out{};
  Material floor = pictured("Floor tiles", floorPictureIndex, kFloorMetres, 0.45f);
  floor.normalPicture = floorReliefIndex;
  out.floorTiles = model.add(floor);
  out.darkMarble = model.add(pictured("Green marble", green, 1.6f, 0.35f));
  out.plaster = model.add(pictured("Plaster", plaster, 2.5f, 0.9f));
  out.panel = model.add(plain("Dado", colour(0xe3d5b8)));
  out.trim = model.add(plain("Cream paint", colour(0xf2e6cc), 0.6f));
  out.columnStone = model.add(pictured("Travertine", travertine, 1.3f, 0.7f));
  out.coffer = model.add(plain("Coffer blue", colour(0x86a3a6)));
  out.gilt = model.add(plain("Gilt", colour(0xd2a64e), 0.4f, 0.35f));
  out.bronzeTrim = model.add(plain("Bronze", colour(0x7a5a35), 0.45f, 0.3f));

  out.mirror = model.add(plain("Mirror", glm::vec3(0.94f, 0.95f, 0.95f), 0, 1));
  Material glass = plain("Glass", glm::vec3(0.94f, 0.98f, 0.97f), 0);
  glass.transmission = 0.95f;
  glass.doubleSided = true;
  out.glass = model.add(glass);
  Material globe = plain("Lamp globe", glm::vec3(0.9f, 0.88f, 0.82f), 0.5f);
  globe.emission = glm::vec3(1.0f, 0.86f, 0.62f);
  globe.emissionStrength = 3;
  out.lampGlobe = model.add(globe);
  Material shade = plain("Lamp shade", colour(0xb08a45), 0.4f, 0.35f);
  shade.doubleSided = true;
  out.lampShade = model.add(shade);

  out.walnut = model.add(pictured("Walnut", walnut, 0.9f, 0.5f));
  out.leather = model.add(plain("Leather", colour(0x7c4a28), 0.55f));
  out.velvet = model.add(plain("Velvet", colour(0x1d5566), 0.95f));
  out.brass = model.add(plain("Brass", colour(0xc79a4b), 0.3f, 0.35f));
  out.plinthStone = model.add(pictured("Plinth stone", travertine, 0.9f, 0.6f));
  out.sculpture = model.add(plain("Glaze", glm::vec3(1), 0.25f));

  Material leaves = pictured("Leaf", leaf, 0, 0.7f);
  leaves.alphaCutoff = 0.5f;
  leaves.doubleSided = true;
  out.leaf = model.add(leaves);
  out.pot = model.add(plain("Glazed pot", colour(0x2f5964), 0.4f));
  out.soil = model.add(plain("Soil", colour(0x3a2c20), 1));

  out.stucco = model.add(plain("Stucco", colour(0xe3d3b4), 0.95f));
  out.paving = model.add(pictured("Paving", paving, 2.4f, 0.9f));
  out.grass = model.add(pictured("Grass", grass, 3.0f, 1));
  out.hedge = model.add(plain("Foliage", glm::vec3(1), 1));
  out.bark = model.add(plain("Bark", colour(0x6a5440), 1));
  out.distance = model.add(plain("Hills", glm::vec3(1), 1));
  out.doorWood = model.add(pictured("Oak", oak, 1.1f, 0.55f));
  return out;
}

int addPaintingMaterial(Model& model, const std::string& name, std::vector<std::byte> jpeg) {
  const int picture = model.add(Picture{name, std::move(jpeg), true, false});
  Material m;
  m.name = name;
  m.picture = picture;
  m.metres = 0;
  m.roughness = 0.85f;
  return model.add(m);
}

}  // namespace acentric::gallery
