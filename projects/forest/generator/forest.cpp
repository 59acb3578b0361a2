#include "projects/forest/generator/forest.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "projects/forest/generator/houses.h"
#include "projects/forest/generator/materials.h"
#include "projects/forest/generator/plants.h"
#include "projects/forest/generator/tree.h"
#include "projects/gallery/generator/noise.h"

namespace acentric::forest {
namespace {

using gallery::fractalNoise;
using gallery::hashUnit;
using gallery::Shape;

constexpr float kStreetEnd = 120;                // of its middle, either way
constexpr float kStreetHalf = 3, kKerb = 0.35f;  // the kerb lies outside
constexpr float kVerge = kStreetHalf + kKerb;    // where grass begins
constexpr float kTownEnd = 86;                   // houses, either way
constexpr float kFront = 11.5f;                  // of houses, from the street's middle
constexpr float kFenceAt = 7.6f;
constexpr float kFlat = 19;         // ground is level so far from the street
constexpr float kLeastReach = 240;  // of the ground, from the street
constexpr float kSpacing = 5.2f;    // between trees of the woods

/// From the street's middle, along the whole of it.
float fromStreet(const glm::vec2& p) {
  const float beyond = std::max(0.0f, std::abs(p.y) - kStreetEnd);
  return std::hypot(p.x - streetAt(p.y), beyond);
}

/// A valley: its sides rise by some 17 %.
float groundAt(const glm::vec2& p) {
  const float beyond = std::max(0.0f, fromStreet(p) - kFlat);
  const float rise = 0.17f * beyond * beyond / (beyond + 30);
  return rise * std::exp(-beyond / 1500) +
         glm::smoothstep(0.0f, 120.0f, beyond) * 5 * fractalNoise({p / 80.0f, 0}, 3, 5);
}

struct HousePlace {
  glm::mat4 placement;
  glm::vec2 middle;
  int design = 0;
};

/// Turns what faces -y with x along the street to its side (-1 or 1) there, `away` metres from its middle.
glm::mat4 besideStreet(float y, float side, float away) {
  const float turn = glm::degrees(std::atan((streetAt(y + 1) - streetAt(y - 1)) / 2));
  return gallery::moved(streetAt(y), y, 0) * gallery::turned(-turn) *
         gallery::turned(side > 0 ? -90.0f : 90.0f) * gallery::moved(0, away, 0);
}

std::vector<HousePlace> housePlaces() {
  std::vector<HousePlace> out;
  for (const float side : {-1.0f, 1.0f})
    for (int i = 0; i < 8; ++i) {
      const float y = -kTownEnd + 22.5f * float(i) + (side > 0 ? 9.0f : 0.0f);
      const int design = (i * 2 + (side > 0 ? 1 : 0) + i / 3) % kHouseDesigns;
      const glm::mat4 placement = besideStreet(y, side, kFront + 1.5f * hashUnit(i, int(side), 0, 11));
      out.push_back({placement, glm::vec2(placement * glm::vec4(0, 0.5f * kHouseDepth, 0, 1)), design});
    }
  return out;
}

bool nearHouse(const std::vector<HousePlace>& houses, const glm::vec2& p, float room) {
  return std::ranges::any_of(houses, [&](const HousePlace& h) {
    const glm::vec2 d = glm::abs(p - h.middle);
    return d.x < 0.5f * kHouseDepth + room && d.y < 5.3f + room;
  });
}

enum class Kind {
  oak,
  oak2,
  lime,
  birch,
  birch2,
  spruce,
  spruce2,
  pine,
  apple,
  hazel,
  fern,
  grass,
  flowers,
  count
};
constexpr std::size_t kKinds = std::size_t(Kind::count);

struct Place {
  Kind kind = Kind::oak;
  glm::vec2 at{0};
  float turn = 0, scale = 1, tilt = 0;
  float order = 0;  ///< those with less come first
};

float turnOf(int i, int j, std::uint64_t seed) { return 360 * hashUnit(i, j, 21, std::uint32_t(seed)); }

/// The street's own: the same whatever the number of triangles, of light species.
std::vector<Place> streetTrees(std::uint64_t seed) {
  std::vector<Place> out;
  const auto add = [&](float y, float side, float away, Kind kind, float scale) {
    out.push_back({kind, {streetAt(y) + side * away, y}, turnOf(int(y * 8), int(side), seed), scale, 0, 0});
  };
  for (int i = -5; i <= 5; ++i) {
    const float y = 22.5f * float(i);
    // In the gaps between houses, on the verge.
    add(y + 2.4f, -1, 6.6f, i % 2 == 0 ? Kind::birch : Kind::lime, i % 2 == 0 ? 0.85f : 0.72f);
    add(y + 12.0f, 1, 6.9f, i % 2 == 0 ? Kind::birch2 : Kind::birch, 0.9f);
    add(y - 5.0f, 1, 9.6f, Kind::apple, 0.8f);
    add(y + 9.0f, -1, 9.4f, Kind::apple, 0.75f);
    add(y - 9.0f, -1, 9.0f, Kind::hazel, 0.6f);
    add(y + 4.0f, 1, 9.0f, Kind::hazel, 0.55f);
  }
  return out;
}

Kind woodKind(const glm::vec2& p, int i, int j, float away, std::uint64_t seed) {
  const auto s = std::uint32_t(seed);
  const float conifers = 0.5f + 0.9f * fractalNoise({p / 70.0f, 7}, 2, s + 31) +
                         glm::smoothstep(60.0f, 260.0f, away) * 0.2f - 0.12f;
  const float pick = hashUnit(i, j, 22, s);
  if (hashUnit(i, j, 23, s) < conifers)
    return pick < 0.42f ? Kind::spruce : pick < 0.8f ? Kind::spruce2 : Kind::pine;
  return pick < 0.3f    ? Kind::oak
         : pick < 0.52f ? Kind::oak2
         : pick < 0.7f  ? Kind::lime
         : pick < 0.88f ? Kind::birch
                        : Kind::birch2;
}

/// At most `count`, the nearest to the street, on a grid of so many metres; `keep(p, away, i, j)`: how
/// likely.
template <class Keep, class Choose>
std::vector<Place> scattered(std::size_t count, float spacing, std::uint64_t seed, int layer,
                             const Keep& keep, const Choose& choose) {
  std::vector<Place> out;
  const auto s = std::uint32_t(seed) * 16 + std::uint32_t(layer);
  // Rings around the town, until there are enough.
  const float width = std::sqrt(float(count)) * spacing;
  const float reach = 0.9f * width + 130;
  const int cells = int(reach / spacing);
  for (int j = -cells; j <= cells; ++j)
    for (int i = -cells; i <= cells; ++i) {
      const glm::vec2 p =
          spacing * (glm::vec2(float(i), float(j)) +
                     0.9f * glm::vec2(hashUnit(i, j, 1, s) - 0.5f, hashUnit(i, j, 2, s) - 0.5f));
      const float away = fromStreet(p);
      if (hashUnit(i, j, 3, s) >= keep(p, away)) continue;
      Place place{choose(p, away, i, j),
                  p,
                  360 * hashUnit(i, j, 4, s),
                  0.72f + 0.5f * hashUnit(i, j, 5, s),
                  3.5f * (hashUnit(i, j, 6, s) - 0.5f),
                  away};
      // Plants before the town's ends matter more than those far behind its middle.
      out.push_back(place);
    }
  std::ranges::stable_sort(out, {}, &Place::order);
  if (out.size() > count) out.resize(count);
  return out;
}

std::vector<Place> allPlaces(std::size_t trees, const std::vector<HousePlace>& houses, std::uint64_t seed) {
  std::vector<Place> all = streetTrees(seed);
  const std::vector<Place> street = all;
  const auto free = [&](const glm::vec2& p, float room) {
    return !nearHouse(houses, p, room) &&
           std::ranges::none_of(street, [&](const Place& t) { return glm::distance(t.at, p) < room; });
  };
  const auto add = [&](std::vector<Place> more) { all.insert(all.end(), more.begin(), more.end()); };
  add(scattered(
      trees, kSpacing, seed, 1,
      [&](const glm::vec2& p, float away) {
        const bool town = std::abs(p.y) < kTownEnd + 15;
        const float begins = town ? 22.5f : 12.5f;
        if (away < begins || !free(p, 3.5f)) return 0.0f;
        return town ? glm::mix(0.3f, 0.92f, glm::smoothstep(24.0f, 42.0f, away)) : 0.92f;
      },
      [&](const glm::vec2& p, float away, int i, int j) {
        if (away < 30 && std::abs(p.y) < kTownEnd)
          return hashUnit(i, j, 24, std::uint32_t(seed)) < 0.5f ? Kind::apple : Kind::birch2;
        return woodKind(p, i, j, away, seed);
      }));
  const auto share = [&](float of) { return std::size_t(std::max(1.0f, of * float(trees))); };
  add(scattered(
      share(0.08f), 5.2f, seed, 2,
      [&](const glm::vec2& p, float away) {
        return away > 13 && free(p, 2.0f)
                   ? 0.25f + 0.45f * std::max(0.0f, fractalNoise({p / 18.0f, 5}, 2, 41))
                   : 0.0f;
      },
      [](const glm::vec2&, float, int, int) { return Kind::hazel; }));
  add(scattered(
      share(0.45f), 1.9f, seed, 3,
      [&](const glm::vec2& p, float away) {
        return away > 20 && free(p, 0.8f)
                   ? std::clamp(0.1f + 1.3f * fractalNoise({p / 12.0f, 6}, 2, 42), 0.0f, 0.8f)
                   : 0.0f;
      },
      [](const glm::vec2&, float, int, int) { return Kind::fern; }));
  add(scattered(
      share(0.5f), 0.95f, seed, 4,
      [&](const glm::vec2& p, float away) {
        if (away < kVerge + 0.6f || !free(p, 0.4f)) return 0.0f;
        return glm::mix(0.9f, 0.25f, glm::smoothstep(8.0f, 22.0f, away));
      },
      [&](const glm::vec2& p, float, int i, int j) {
        const bool bed = fractalNoise({p / 4.0f, 8}, 2, 43) > 0.22f;
        return bed && hashUnit(i, j, 25, 3) < 0.6f ? Kind::flowers : Kind::grass;
      }));
  return all;
}

/// From -last to last, by `step(y)` from 0 on either way.
template <class Step>
std::vector<float> mirrored(float last, const Step& step) {
  std::vector<float> there, all;
  for (float y = 0; y < last; y += step(y)) there.push_back(y);
  there.push_back(last);
  for (std::size_t i = there.size(); i > 1; --i) all.push_back(-there[i - 1]);
  all.insert(all.end(), there.begin(), there.end());
  return all;
}

/// Rows along y, columns across the street, on either side of it: so far beyond it in all directions.
Shape ground(float reach) {
  Shape out;
  std::vector<float> columns{kVerge, 5, 7.5f, 11, 16, 22, 29, 38, 50, 66, 86};
  while (columns.back() < reach) columns.push_back(std::min(reach, 1.3f * columns.back()));
  const std::vector<float> ys = mirrored(kStreetEnd + reach, [](float y) {
    return y < 40 ? 8.0f : y < 200 ? 12.0f : 60.0f;
  });
  const auto put = [&](float across, float y) {
    // Beyond the street's ends both sides meet.
    const glm::vec2 p(streetAt(y) + across, y);
    constexpr float kStep = 0.5f;
    const float dx = groundAt(p + glm::vec2(kStep, 0)) - groundAt(p - glm::vec2(kStep, 0)),
                dy = groundAt(p + glm::vec2(0, kStep)) - groundAt(p - glm::vec2(0, kStep));
    return out.add({p, groundAt(p)}, glm::normalize(glm::vec3(-dx, -dy, 2 * kStep)), {p.x, -p.y});
  };
  const auto strip = [&](const std::vector<float>& across) {
    for (std::size_t r = 0; r + 1 < ys.size(); ++r)
      for (std::size_t c = 0; c + 1 < across.size(); ++c) {
        const auto a = put(across[c], ys[r]), b = put(across[c + 1], ys[r]), d = put(across[c], ys[r + 1]),
                   e = put(across[c + 1], ys[r + 1]);
        out.triangle(a, b, e);
        out.triangle(a, e, d);
      }
  };
  strip(columns);
  std::vector<float> left;
  for (std::size_t i = columns.size(); i > 0; --i) left.push_back(-columns[i - 1]);
  strip(left);
  out.paint([](const glm::vec3& p, const glm::vec3&) {
    const float away = fromStreet(glm::vec2(p));
    const glm::vec3 lawn(0.19f, 0.27f, 0.075f), litter(0.21f, 0.15f, 0.085f), moss(0.15f, 0.19f, 0.06f);
    const glm::vec3 wood = glm::mix(litter, moss, 0.5f + 0.5f * fractalNoise({p.x / 9, p.y / 9, 0}, 2, 51));
    return glm::mix(lawn, wood, glm::smoothstep(16.0f, 36.0f, away));
  });
  return out;
}

/// Between two distances from its middle.
Shape streetStrip(float from, float to, float reach) {
  Shape out;
  const std::vector<float> ys =
      mirrored(kStreetEnd + reach, [](float y) { return y < kStreetEnd + 100 ? 4.0f : 60.0f; });
  for (std::size_t row = 0; row + 1 < ys.size(); ++row) {
    const auto put = [&](float across, float at) {
      const glm::vec2 p(streetAt(at) + across, at);
      return out.add({p, groundAt(p)}, {0, 0, 1}, {across, -at});
    };
    const auto a = put(from, ys[row]), b = put(to, ys[row]), c = put(to, ys[row + 1]),
               d = put(from, ys[row + 1]);
    out.triangle(a, b, c);
    out.triangle(a, c, d);
  }
  return out;
}

glm::mat4 placed(const Place& place) {
  const glm::mat4 lean = glm::mat4(glm::mat3(gallery::turned(place.turn)));
  const float tilt = glm::radians(place.tilt);
  const glm::mat4 tilted(std::cos(tilt), 0, -std::sin(tilt), 0, 0, 1, 0, 0, std::sin(tilt), 0, std::cos(tilt),
                         0, 0, 0, 0, 1);
  return gallery::moved(place.at.x, place.at.y, groundAt(place.at)) * tilted * lean *
         glm::mat4(place.scale, 0, 0, 0, 0, place.scale, 0, 0, 0, 0, place.scale, 0, 0, 0, 0, 1);
}

std::uint64_t trianglesOf(const gallery::Thing& thing) {
  std::uint64_t count = 0;
  for (const gallery::Part& part : thing.parts) count += part.shape.indices.size() / 3;
  return count;
}

/// Of a kind with all of its detail.
std::size_t fullTriangles(Kind kind) {
  switch (kind) {
    case Kind::oak:
      return oak().triangles;
    case Kind::oak2:
      return oak().triangles * 9 / 10;
    case Kind::lime:
      return lime().triangles;
    case Kind::birch:
    case Kind::birch2:
      return birch().triangles;
    case Kind::spruce:
    case Kind::spruce2:
      return spruce().triangles;
    case Kind::pine:
      return pine().triangles;
    case Kind::apple:
      return apple().triangles;
    case Kind::hazel:
      return hazel().triangles;
    case Kind::fern:
      return kFernTriangles;
    default:
      return kGrassTriangles;
  }
}

gallery::Thing makePlant(Kind kind, std::size_t triangles, std::uint64_t seed, const Materials& m) {
  const std::uint64_t own = 100 * seed + std::uint64_t(kind);
  switch (kind) {
    case Kind::oak:
    case Kind::oak2:
      return makeTree(oak(), triangles, own, m.bark, m.oak);
    case Kind::lime:
      return makeTree(lime(), triangles, own, m.bark, m.lime);
    case Kind::birch:
    case Kind::birch2:
      return makeTree(birch(), triangles, own, m.birchBark, m.birch);
    case Kind::spruce:
    case Kind::spruce2:
      return makeTree(spruce(), triangles, own, m.bark, m.spruce);
    case Kind::pine:
      return makeTree(pine(), triangles, own, m.pineBark, m.pine);
    case Kind::apple:
      return makeTree(apple(), triangles, own, m.bark, m.apple);
    case Kind::hazel:
      return makeTree(hazel(), triangles, own, m.bark, m.hazel);
    case Kind::fern:
      return makeFern(triangles, own, m.fern);
    case Kind::flowers:
      return makeGrass("Flowers", triangles, 0.42f, own, m.flowers);
    default:
      return makeGrass("Grass", triangles, 0.28f, own, m.grass);
  }
}

}  // namespace

float streetAt(float y) {
  const float away = std::max(0.0f, std::abs(y) - 20);
  return (y > 0 ? 9.0f : -7.0f) * glm::smoothstep(0.0f, 90.0f, away) +
         (y > 0 ? -16.0f : 12.0f) * glm::smoothstep(60.0f, 220.0f, away);
}

gallery::Model makeForest(const ForestOptions& options) {
  gallery::Model model;
  const Materials materials = addMaterials(model, options.pictureScale);
  const std::vector<HousePlace> houses = housePlaces();
  // Twenty thousand trees with all of their detail are a thousand million triangles.
  const double share = std::sqrt(double(options.triangles) / 1e9);
  const std::vector<Place> places = allPlaces(std::size_t(20'000 * share), houses, options.seed);
  float reach = kLeastReach;
  for (const Place& place : places) reach = std::max(reach, fromStreet(place.at) + 30);
  model.add("Ground", materials.ground, ground(reach));
  model.add("Street", materials.cobbles, streetStrip(-kStreetHalf, kStreetHalf, reach));
  Shape kerbs = streetStrip(-kVerge, -kStreetHalf, reach);
  kerbs.append(streetStrip(kStreetHalf, kVerge, reach));
  model.add("Kerbs", materials.kerb, std::move(kerbs));

  std::vector<gallery::Thing> built;
  for (int design = 0; design < kHouseDesigns; ++design) built.push_back(makeHouse(design, materials));
  for (const HousePlace& house : houses)
    built[std::size_t(house.design)].placements.push_back(house.placement);
  gallery::Thing fences = makeFence(2.8f, materials), lamps = makeLamp(materials),
                 wells = makeWell(materials), benches = makeBench(materials);
  for (const float side : {-1.0f, 1.0f})
    for (int i = 0; i < 8; ++i) {
      const float y = -kTownEnd + 22.5f * float(i) + (side > 0 ? 9.0f : 0.0f);
      // A gate is left before the door.
      for (const float along : {-5.2f, -2.4f, 2.4f, 5.2f})
        fences.placements.push_back(besideStreet(y + along, side, kFenceAt));
      if (i % 2 == 1) lamps.placements.push_back(besideStreet(y + 10.5f, side, 4.1f));
    }
  wells.placements.push_back(besideStreet(19.5f, -1, 7.2f));
  for (const float y : {-7.6f, 30.0f, -38.0f}) benches.placements.push_back(besideStreet(y, -1, 5.2f));
  benches.placements.push_back(besideStreet(13.0f, 1, 5.0f));
  for (gallery::Thing* thing : {&fences, &lamps, &wells, &benches}) built.push_back(std::move(*thing));

  std::uint64_t still = 0;
  for (const gallery::Thing& thing : model.things) still += trianglesOf(thing);
  for (gallery::Thing& thing : built) {
    still += trianglesOf(thing) * thing.placements.size();
    model.things.push_back(std::move(thing));
  }

  std::array<std::uint64_t, kKinds> counts{};
  for (const Place& place : places) ++counts[std::size_t(place.kind)];
  double full = 0;
  for (std::size_t k = 0; k < kKinds; ++k) full += double(counts[k]) * double(fullTriangles(Kind(k)));
  const double detail = std::max(0.0, double(options.triangles) - double(still)) / full;
  for (std::size_t k = 0; k < kKinds; ++k) {
    if (counts[k] == 0) continue;
    gallery::Thing plant =
        makePlant(Kind(k), std::size_t(detail * double(fullTriangles(Kind(k)))), options.seed, materials);
    for (const Place& place : places)
      if (place.kind == Kind(k)) plant.placements.push_back(placed(place));
    model.things.push_back(std::move(plant));
  }
  gallery::Light sun;
  sun.name = "sun", sun.directional = true, sun.intensity = 3.2f, sun.colour = {1, 0.95f, 0.86f};
  sun.direction = glm::normalize(glm::vec3(0.62f, 0.38f, -0.72f));
  model.lights.push_back(sun);
  return model;
}

}  // namespace acentric::forest
