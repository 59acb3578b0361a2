#include "projects/forest/generator/materials.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "projects/gallery/generator/canvas.h"
#include "projects/gallery/generator/noise.h"

namespace acentric::forest {
namespace {

using gallery::Canvas;
using gallery::cellAt;
using gallery::colour;
using gallery::fractalNoise;
using gallery::gradient;
using gallery::hashUnit;
using gallery::Material;
using gallery::Picture;
using gallery::Random;

constexpr int kJpegQuality = 88;

/// Marks on a picture with alpha; positions in pixels, y downwards.
class Sprigs {
 public:
  /// Where nothing is, the colour is of leaves, so that it does not show at their edges.
  Sprigs(int size, const glm::vec3& ground) : canvas_(size, size, ground), size_(size) {
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) canvas_.alphaAt(x, y) = 0;
  }
  int size() const { return size_; }

  /// From foot to tip; `half(t)`: half of its width there, share of the length. Colour by (t, side in -1..1).
  void leaf(const glm::vec2& foot, const glm::vec2& tip, const std::function<float(float)>& half,
            const std::function<glm::vec3(float, float)>& tint) {
    const glm::vec2 along = tip - foot;
    const float length = glm::length(along), reach = 0.6f * length + 2;
    const glm::vec2 middle = 0.5f * (foot + tip), way = along / length, side(-way.y, way.x);
    for (int y = std::max(0, int(middle.y - reach)); y <= std::min(size_ - 1, int(middle.y + reach)); ++y)
      for (int x = std::max(0, int(middle.x - reach)); x <= std::min(size_ - 1, int(middle.x + reach)); ++x) {
        const glm::vec2 p = glm::vec2(float(x) + 0.5f, float(y) + 0.5f) - foot;
        const float t = glm::dot(p, way) / length;
        if (t < 0 || t > 1) continue;
        const float across = glm::dot(p, side), width = half(t) * length;
        const float coverage = std::clamp(width - std::abs(across) + 0.5f, 0.0f, 1.0f);
        if (coverage <= 0) continue;
        canvas_.at(x, y) = glm::mix(canvas_.at(x, y), tint(t, across / std::max(width, 0.5f)), coverage);
        canvas_.alphaAt(x, y) = std::max(canvas_.alphaAt(x, y), coverage);
      }
  }
  void twig(const glm::vec2& from, const glm::vec2& to, float width, const glm::vec3& tint) {
    const float half = 0.5f * width / std::max(1.0f, glm::length(to - from));
    leaf(
        from, to, [half](float t) { return half * (1 - 0.6f * t); }, [&](float, float) { return tint; });
  }
  Picture picture(const char* name) const { return {name, canvas_.encodePng(true), false, false}; }

 private:
  Canvas canvas_;
  int size_;
};

struct LeafKind {
  float length = 0.3f;  ///< share of a sprig's
  float width = 0.45f;  ///< half, share of the leaf's length
  int count = 9;
  float lobes = 0;  ///< how deep its rim is cut,
  float lobeCount = 0;
  float tipward = 0.45f;  ///< where it is widest
  glm::vec3 dark{0}, light{0}, rib{0};
};

/// Broad leaves on both sides of a twig and one at its end.
void paintSprig(Sprigs& out, const glm::vec2& corner, float size, const LeafKind& kind, Random& random) {
  const glm::vec2 foot = corner + size * glm::vec2(0.5f, 0.98f), tip = corner + size * glm::vec2(0.5f, 0.3f);
  out.twig(foot, tip, 0.02f * size, glm::mix(kind.dark, colour(0x4a3a26), 0.6f));
  for (int i = 0; i < kind.count; ++i) {
    const bool last = i + 1 == kind.count;
    const float at = last ? 1.0f : (float(i) + 0.6f) / float(kind.count);
    const float turn =
        last ? random.between(-0.2f, 0.2f) : (i % 2 == 0 ? 1.0f : -1.0f) * random.between(0.65f, 1.15f);
    const float length = size * kind.length * random.between(0.8f, 1.1f);
    const glm::vec2 from = glm::mix(foot, tip, at);
    glm::vec2 to = from + length * glm::vec2(std::sin(turn), -std::cos(turn));
    to = glm::clamp(to, corner + 2.0f, corner + size - 2.0f);
    const float shade = random.between(0, 1), hue = random.between(-1, 1);
    out.leaf(
        from, to,
        [&](float t) {
          const float body = std::sin(3.14159265f * std::pow(t, std::log(0.5f) / std::log(kind.tipward)));
          const float lobe = 1 - kind.lobes * (0.5f + 0.5f * std::cos(6.2831853f * kind.lobeCount * t));
          return t < 0.1f ? 0.03f : kind.width * std::pow(std::max(0.0f, body), 0.8f) * lobe;
        },
        [&](float t, float side) {
          glm::vec3 tint =
              glm::mix(kind.dark, kind.light, std::clamp(0.25f + 0.5f * shade + 0.25f * t, 0.0f, 1.0f));
          tint *= glm::vec3(1 + 0.12f * hue, 1, 1 - 0.1f * hue);
          tint *= 0.93f + 0.1f * std::abs(std::sin(22 * (t - 0.35f * std::abs(side))));
          return glm::mix(tint, kind.rib, 0.7f * glm::smoothstep(0.12f, 0.03f, std::abs(side)));
        });
  }
}

/// Needles on both sides of a twig, and on side twigs.
void paintNeedles(Sprigs& out, const glm::vec2& corner, float size, float length, float spread, int count,
                  float width, const LeafKind& kind, Random& random) {
  const auto needles = [&](const glm::vec2& from, const glm::vec2& to, int n, float scale) {
    out.twig(from, to, 0.03f * size * scale, colour(0x54402a));
    const glm::vec2 way = glm::normalize(to - from);
    for (int i = 0; i < n; ++i) {
      const float at = (float(i) + random.unit()) / float(n);
      const float turn =
          (i % 2 == 0 ? 1.0f : -1.0f) * spread * random.between(0.6f, 1.2f) * (1 - 0.5f * at * at);
      const glm::vec2 d(way.x * std::cos(turn) - way.y * std::sin(turn),
                        way.x * std::sin(turn) + way.y * std::cos(turn));
      const glm::vec2 foot = glm::mix(from, to, at);
      glm::vec2 tip = foot + size * length * scale * random.between(0.75f, 1.1f) * d;
      tip = glm::clamp(tip, corner + 1.0f, corner + size - 1.0f);
      const glm::vec3 tint = glm::mix(kind.dark, kind.light, random.unit());
      const float half = 0.5f * width * size / std::max(4.0f, glm::length(tip - foot));
      out.leaf(
          foot, tip, [&](float t) { return half * (1 - 0.5f * t); },
          [&](float t, float) { return tint * (0.8f + 0.4f * t); });
    }
  };
  const glm::vec2 foot = corner + size * glm::vec2(0.5f, 0.99f), tip = corner + size * glm::vec2(0.5f, 0.12f);
  for (const float at : {0.2f, 0.36f, 0.52f, 0.66f}) {
    const float side = random.between(0.28f, 0.36f) * (1.15f - at);
    const glm::vec2 from = glm::mix(foot, tip, at);
    for (const float sign : {-1.0f, 1.0f})
      needles(from, from + size * glm::vec2(sign * side, -side * 0.95f), count / 3, 0.8f);
  }
  needles(foot, tip, count, 1);
}

void paintFrond(Sprigs& out, const LeafKind& kind, Random& random) {
  const float size = float(out.size());
  const glm::vec2 foot(0.5f * size, 0.995f * size), tip(0.5f * size, 0.02f * size);
  out.twig(foot, tip, 0.02f * size, glm::mix(kind.dark, colour(0x5d4a28), 0.5f));
  constexpr int kPairs = 17;
  for (int i = 0; i < kPairs; ++i)
    for (const float sign : {-1.0f, 1.0f}) {
      const float at = 0.14f + 0.84f * float(i) / float(kPairs);
      const float length =
          0.48f * size * std::pow(std::sin(3.14159265f * std::pow(1 - at, 0.75f) * 0.93f + 0.2f), 0.8f);
      const glm::vec2 from = glm::mix(foot, tip, at);
      const glm::vec2 to = from + length * glm::vec2(sign * 0.93f, -0.36f);
      const float shade = random.between(0, 1);
      out.leaf(
          from, to,
          [&](float t) { return 0.075f * (1 - 0.75f * t) * (0.7f + 0.3f * std::abs(std::sin(19 * t))); },
          [&](float t, float side) {
            return glm::mix(kind.dark, kind.light,
                            std::clamp(0.2f + 0.5f * shade + 0.3f * t - 0.15f * std::abs(side), 0.0f, 1.0f));
          });
    }
}

/// Tints from left to right, brighter towards the tip.
Canvas bladesPicture(int size, const std::vector<glm::vec3>& tints, float share,
                     const std::vector<glm::vec3>& tips) {
  Canvas canvas(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float up = 1 - (float(y) + 0.5f) / float(size);
      const int column = x * 24 / size;
      const float pick = hashUnit(column, 0, 0, 7), own = hashUnit(column, 1, 0, 7);
      glm::vec3 tint = gradient(tints, pick) * (0.45f + 0.65f * up);
      if (!tips.empty() && own < share && up > 0.72f)
        tint = tips[std::size_t(pick * float(tips.size())) % tips.size()];
      canvas.at(x, y) = tint;
    }
  return canvas;
}

Canvas barkPicture(int size, const glm::vec3& dark, const glm::vec3& light, float plates) {
  Canvas canvas(size, size);
  canvas.fill([&](const glm::vec2& p) {
    const float wander = 0.4f * fractalNoise({p.x * 4, p.y * 4, 0}, 3, 91, 4);
    const auto ridge = cellAt({p.x * 14 + wander, p.y * plates + wander}, 92, 0);
    const float crack = glm::smoothstep(0.0f, 0.22f, ridge.second - ridge.nearest);
    const float grain = fractalNoise({p.x * 32, p.y * 8, 1}, 3, 93, 8);
    return glm::mix(dark, light, std::clamp(0.15f + 0.6f * crack + 0.25f * grain, 0.0f, 1.0f));
  });
  return canvas;
}

Canvas birchPicture(int size) {
  Canvas canvas(size, size);
  canvas.fill([](const glm::vec2& p) {
    const float streak = fractalNoise({p.x * 4, p.y * 40, 0}, 3, 95, 4);
    const float patch = fractalNoise({p.x * 4, p.y * 12, 4}, 3, 96, 4);
    const glm::vec3 white = colour(0xdcd7cb) * (0.95f + 0.1f * patch);
    const glm::vec3 lined = glm::mix(white, colour(0x6f655a), 0.75f * glm::smoothstep(0.2f, 0.38f, streak));
    return glm::mix(lined, colour(0x25211d), glm::smoothstep(0.3f, 0.38f, patch));
  });
  return canvas;
}

/// Grey, to be tinted: litter and moss.
Canvas groundPicture(int size) {
  Canvas canvas(size, size);
  canvas.fill([](const glm::vec2& p) {
    const float patch = fractalNoise({p * 5.0f, 0}, 4, 101, 5);
    const auto litter = cellAt(p * 48.0f, 102, 48);
    const float blade = fractalNoise({p * 64.0f, 0}, 3, 103, 64);
    return glm::vec3(0.62f + 0.16f * patch + 0.22f * (litter.value - 0.5f) + 0.2f * blade) *
           glm::vec3(1, 1, 0.97f);
  });
  return canvas;
}

Canvas cobblesPicture(int size) {
  Canvas canvas(size, size);
  canvas.fill([](const glm::vec2& p) {
    const auto stone = cellAt(p * 16.0f, 111, 16);
    const float edge = stone.second - stone.nearest;
    const float grain = fractalNoise({p * 32.0f, 9 * stone.value}, 4, 112, 32);
    const glm::vec3 face =
        gradient({colour(0x6e675d), colour(0x857c6f), colour(0x9b9183), colour(0x77716a)}, stone.value) *
        (1 + 0.16f * grain);
    const float dome = 0.8f + 0.2f * glm::smoothstep(0.05f, 0.5f, edge);
    return glm::mix(colour(0x4b453a), face * dome, glm::smoothstep(0.03f, 0.12f, edge));
  });
  return canvas;
}

Canvas kerbPicture(int size) {
  Canvas canvas(size, size);
  canvas.fill([](const glm::vec2& p) {
    const float block = std::floor(p.y * 2), local = p.y * 2 - block;
    const float joint = std::min(local, 1 - local);
    const float grain = fractalNoise({p * 20.0f, 5 * block}, 4, 121, 20);
    return glm::mix(
        colour(0x5b554b),
        gradient({colour(0x98907f), colour(0xaba292)}, hashUnit(int(block), 0, 0, 122)) * (1 + 0.14f * grain),
        glm::smoothstep(0.01f, 0.03f, joint));
  });
  return canvas;
}

Canvas plasterPicture(int size) {
  Canvas canvas(size, size);
  canvas.fill([](const glm::vec2& p) {
    const float cloud = fractalNoise({p * 4.0f, 0}, 5, 131, 4);
    const float grain = fractalNoise({p * 40.0f, 1}, 3, 132, 40);
    return glm::vec3(0.86f) * (1 + 0.09f * cloud + 0.05f * grain);
  });
  return canvas;
}

/// Rows of tiles, round at their lower ends; y down the roof.
Canvas tilesPicture(int size) {
  Canvas canvas(size, size);
  constexpr int kRows = 8, kColumns = 10;
  canvas.fill([](const glm::vec2& p) {
    const float v = p.y * kRows, row = std::floor(v);
    const float u = p.x * kColumns + 0.5f * std::fmod(row, 2.0f), column = std::floor(u);
    const glm::vec2 local(u - column - 0.5f, v - row);
    const float end = 0.72f + 0.28f * std::sqrt(std::max(0.0f, 1 - 4 * local.x * local.x));
    const float own = hashUnit(int(column) % kColumns, int(row), 0, 141);
    const glm::vec3 tile =
        gradient({colour(0x7a3a26), colour(0x934a2f), colour(0xa85a3a), colour(0x8a4a38)}, own);
    const float gap = std::min(0.5f - std::abs(local.x), 1.0f);
    const float shade = local.y > end ? 0.4f : 0.72f + 0.33f * local.y;
    const float moss = glm::smoothstep(0.25f, 0.5f, fractalNoise({p * 5.0f, 2}, 4, 142, 5));
    return glm::mix(tile * shade * glm::smoothstep(-0.02f, 0.05f, gap), colour(0x50552f) * shade,
                    0.35f * moss) *
           (1 + 0.1f * fractalNoise({p * 50.0f, 0}, 2, 143, 50));
  });
  return canvas;
}

Canvas stonePicture(int size) {
  Canvas canvas(size, size);
  canvas.fill([](const glm::vec2& p) {
    const auto stone = cellAt({p.x * 5, p.y * 7}, 151, 0);
    const float edge = stone.second - stone.nearest;
    const float grain = fractalNoise({p * 24.0f, 7 * stone.value}, 4, 152, 24);
    return glm::mix(
        colour(0x8c8473),
        gradient({colour(0x78736a), colour(0x8f887b), colour(0xa29a89)}, stone.value) * (1 + 0.18f * grain),
        glm::smoothstep(0.02f, 0.08f, edge));
  });
  return canvas;
}

Canvas woodPicture(int size) {
  Canvas canvas(size, size);
  canvas.fill([](const glm::vec2& p) {
    const float board = std::floor(p.x * 6), local = p.x * 6 - board;
    const float grain = fractalNoise({p.x * 48, p.y * 6, board}, 4, 161, 6);
    const float joint = glm::smoothstep(0.0f, 0.05f, std::min(local, 1 - local));
    return glm::vec3(0.75f) * (0.8f + 0.2f * hashUnit(int(board), 0, 0, 162)) * (1 + 0.28f * grain) *
           (0.45f + 0.55f * joint);
  });
  return canvas;
}

}  // namespace

Materials addMaterials(gallery::Model& model, float pictureScale) {
  const auto pixels = [&](int usual) { return std::max(16, int(std::lround(float(usual) * pictureScale))); };
  const auto cutOut = [&](const char* name, Picture picture) {
    Material m;
    m.name = name, m.picture = model.add(std::move(picture)), m.metres = 0, m.roughness = 0.85f;
    m.alphaCutoff = 0.5f, m.doubleSided = true;
    return model.add(m);
  };
  std::uint64_t seed = 1;
  const auto sprigs = [&](const char* name, const LeafKind& kind, int size) {
    Sprigs out(pixels(size), glm::mix(kind.dark, kind.light, 0.4f));
    const float half = 0.5f * float(out.size());
    Random random(seed++);
    for (int i = 0; i < 4; ++i)
      paintSprig(out, half * glm::vec2(float(i & 1), float(i >> 1)), half, kind, random);
    return cutOut(name, out.picture(name));
  };
  const auto needles = [&](const char* name, const LeafKind& kind, float length, float spread, int count,
                           float width) {
    Sprigs out(pixels(384), glm::mix(kind.dark, kind.light, 0.4f));
    const float half = 0.5f * float(out.size());
    Random random(seed++);
    for (int i = 0; i < 4; ++i)
      paintNeedles(out, half * glm::vec2(float(i & 1), float(i >> 1)), half, length, spread, count, width,
                   kind, random);
    return cutOut(name, out.picture(name));
  };
  const auto pictured = [&](const char* name, const Canvas& canvas, float metres,
                            const glm::vec3& tint = glm::vec3(1)) {
    Material m;
    m.name = name, m.metres = metres, m.roughness = 0.95f, m.baseColour = glm::vec4(tint, 1);
    m.picture = model.add(Picture{name, canvas.encodeJpeg(kJpegQuality), true, true});
    return model.add(m);
  };
  const auto plain = [&](const char* name, unsigned hex, float roughness = 0.8f) {
    Material m;
    m.name = name, m.baseColour = glm::vec4(colour(hex), 1), m.roughness = roughness;
    return model.add(m);
  };

  Materials out{};
  out.oak = sprigs(
      "Oak leaves",
      {0.32f, 0.3f, 13, 0.42f, 4.5f, 0.55f, colour(0x2f4f1c), colour(0x6b8f35), colour(0x9bb060)}, 320);
  out.lime =
      sprigs("Lime leaves",
             {0.27f, 0.46f, 15, 0, 0, 0.36f, colour(0x3f6a22), colour(0x8db548), colour(0xb5cc7c)}, 320);
  out.birch =
      sprigs("Birch leaves",
             {0.17f, 0.38f, 27, 0.12f, 6, 0.34f, colour(0x4d7526), colour(0xa3bd4c), colour(0xc0d080)}, 320);
  out.apple =
      sprigs("Apple leaves",
             {0.24f, 0.32f, 19, 0, 0, 0.45f, colour(0x3a5f27), colour(0x80a250), colour(0xb0c287)}, 320);
  out.hazel =
      sprigs("Hazel leaves",
             {0.28f, 0.46f, 14, 0.08f, 9, 0.5f, colour(0x355a20), colour(0x7ba03e), colour(0xa5bd6a)}, 320);
  LeafKind dark;
  dark.dark = colour(0x2b4f2e), dark.light = colour(0x6f9560);
  out.spruce = needles("Spruce twigs", dark, 0.11f, 0.85f, 120, 0.014f);
  dark.dark = colour(0x3a5c3a), dark.light = colour(0x8aa868);
  out.pine = needles("Pine twigs", dark, 0.24f, 0.75f, 130, 0.012f);
  LeafKind frond;
  frond.dark = colour(0x33591f), frond.light = colour(0x86ad45);
  Sprigs fern(pixels(256), glm::mix(frond.dark, frond.light, 0.4f));
  Random random(seed++);
  paintFrond(fern, frond, random);
  out.fern = cutOut("Fern fronds", fern.picture("Fern fronds"));

  out.grass =
      pictured("Grass blades",
               bladesPicture(pixels(192),
                             {colour(0x4d7327), colour(0x6f9537), colour(0x95a650), colour(0x5d8230)}, 0, {}),
               0);
  out.flowers =
      pictured("Flowers",
               bladesPicture(pixels(192), {colour(0x4d7327), colour(0x7a9a3c), colour(0xa8a85a)}, 0.45f,
                             {colour(0xf2efe2), colour(0xe8c23a), colour(0xc9483c), colour(0x8f6fc0)}),
               0);
  for (const int blades : {out.grass, out.flowers}) model.materials[std::size_t(blades)].doubleSided = true;
  out.bark = pictured("Bark", barkPicture(pixels(256), colour(0x372c22), colour(0x7d6a55), 4), 1);
  out.pineBark = pictured("Pine bark", barkPicture(pixels(256), colour(0x452c20), colour(0xa06a48), 7), 1);
  out.birchBark = pictured("Birch bark", birchPicture(pixels(256)), 1);
  out.ground = pictured("Ground", groundPicture(pixels(512)), 4);
  out.cobbles = pictured("Cobbles", cobblesPicture(pixels(512)), 2.2f);
  out.kerb = pictured("Kerb", kerbPicture(pixels(256)), 1.6f);
  const Canvas plaster = plasterPicture(pixels(256));
  const unsigned tints[3] = {0xf3e6c8, 0xe9d0a8, 0xe6e2d6};
  for (int i = 0; i < 3; ++i) {
    out.plasters[i] =
        i == 0 ? pictured("Plaster", plaster, 3) : model.add(model.materials[std::size_t(out.plasters[0])]);
    model.materials[std::size_t(out.plasters[i])].baseColour = glm::vec4(colour(tints[i]), 1);
  }
  const int boards = pictured("Timber", woodPicture(pixels(256)), 1.2f, colour(0x6a5040));
  out.timber = boards;
  const auto boardsOf = [&](const char* name, unsigned hex) {
    Material m = model.materials[std::size_t(boards)];
    m.name = name, m.baseColour = glm::vec4(colour(hex), 1);
    return model.add(m);
  };
  out.paint[0] = boardsOf("Green paint", 0x55785c), out.paint[1] = boardsOf("Red paint", 0x9c4a3c);
  out.paint[2] = boardsOf("Blue paint", 0x5f7f9c), out.door = boardsOf("Oak door", 0x8c6a48);
  out.frame = plain("Window frame", 0xe9e4d6, 0.6f);
  out.pane = plain("Pane", 0x2a343c, 0.15f);
  out.tiles = pictured("Roof tiles", tilesPicture(pixels(512)), 1.9f);
  out.stone = pictured("Stone", stonePicture(pixels(256)), 1.6f);
  return out;
}

}  // namespace acentric::forest
