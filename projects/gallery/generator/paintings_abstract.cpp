#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "projects/gallery/generator/noise.h"
#include "projects/gallery/generator/paintings.h"

namespace acentric::gallery {
namespace {

/// Paper or primed linen: a light ground with some tooth.
void prime(Canvas& canvas, const glm::vec3& tint, std::uint32_t seed) {
  canvas.fill([&](const glm::vec2& p) {
    return tint * (1 + 0.05f * fractalNoise({p * 9.0f, 0}, 4, seed) + 0.03f * noise({p * 90.0f, 0}, seed));
  });
}

void arc(Canvas& canvas, const glm::vec2& centre, float radius, float width, float from, float to,
         const glm::vec3& tint) {
  canvas.mark(
      centre - radius - width, centre + radius + width,
      [&](const glm::vec2& p) {
        const glm::vec2 d = p - centre;
        float angle = std::atan2(-d.y, d.x);
        if (angle < from) angle += 6.2831853f;
        const float off = std::abs(glm::length(d) - radius) - 0.5f * width;
        return angle <= to ? off : 1.0f;
      },
      tint);
}

}  // namespace

Canvas paintFields(int width, int height, std::uint32_t seed) {
  Canvas canvas(width, height);
  prime(canvas, colour(0x7a2e22), seed);
  struct Field {
    float top, bottom;
    glm::vec3 tint;
  };
  const std::array<Field, 3> fields{
      {{0.06f, 0.42f, colour(0xe07a2f)}, {0.46f, 0.60f, colour(0xf2cc6b)}, {0.64f, 0.94f, colour(0x4a1420)}}};
  for (const Field& f : fields)
    canvas.over([&](const glm::vec2& p) {
      const float wobble = 0.012f * fractalNoise({p * 12.0f, f.top}, 4, seed + 1U);
      const float side = std::min(p.x, canvas.aspect() - p.x) - 0.06f;
      const float inside = std::min({side, p.y - f.top, f.bottom - p.y}) + wobble;
      const float depth = 0.85f + 0.22f * fractalNoise({p.x * 3, p.y * 7, f.top}, 5, seed + 2U);
      return glm::vec4(f.tint * depth, 0.94f * glm::smoothstep(-0.012f, 0.03f, inside));
    });
  return canvas;
}

Canvas paintRings(int width, int height, std::uint32_t seed) {
  Canvas canvas(width, height);
  const std::vector<glm::vec3> palette{colour(0x264653), colour(0x2a9d8f), colour(0xe9c46a),
                                       colour(0xf4a261), colour(0xe76f51), colour(0xf1e3c8),
                                       colour(0x7b2d43), colour(0x3a6ea5)};
  Random random(seed);
  const int rows = 3, columns = static_cast<int>(std::lround(3 * canvas.aspect()));
  const glm::vec2 cell(canvas.aspect() / static_cast<float>(columns), 1.0f / rows);
  const auto pick = [&] {
    return palette[static_cast<std::size_t>(random.below(static_cast<int>(palette.size())))];
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const glm::vec2 corner = cell * glm::vec2(column, row);
      canvas.rectangle(corner, corner + cell, pick());
      const glm::vec2 centre =
          corner + 0.5f * cell + glm::vec2(random.between(-0.01f, 0.01f), random.between(-0.01f, 0.01f));
      for (int ring = 0; ring < 5; ++ring) {
        const float radius = 0.47f * std::min(cell.x, cell.y) * (1 - 0.19f * static_cast<float>(ring)) *
                             random.between(0.94f, 1.04f);
        const glm::vec3 tint = pick();
        const auto s = seed + static_cast<std::uint32_t>(97 * (row * columns + column) + ring);
        canvas.mark(
            centre - 1.2f * radius, centre + 1.2f * radius,
            [&](const glm::vec2& p) {
              const glm::vec2 d = p - centre;
              const float angle = std::atan2(d.y, d.x);
              const float wobble = 0.06f * noise({2 * std::cos(angle), 2 * std::sin(angle), 0.5f}, s);
              return glm::length(d) - radius * (1 + wobble);
            },
            tint, 0.95f);
      }
    }
  // Water colour pools and dries unevenly.
  canvas.over([&](const glm::vec2& p) {
    const float pool = fractalNoise({p * 7.0f, 0}, 5, seed + 5U);
    return pool > 0 ? glm::vec4(colour(0xfff4e0), 0.3f * pool) : glm::vec4(colour(0x1b1720), -0.35f * pool);
  });
  return canvas;
}

Canvas paintConstruction(int width, int height, std::uint32_t seed) {
  Canvas canvas(width, height);
  prime(canvas, colour(0xece0c6), seed);
  const float w = canvas.aspect();
  const glm::vec3 ink = colour(0x22223b), red = colour(0xc8412b), ochre = colour(0xdda63a),
                  blue = colour(0x2f6690), sage = colour(0x81a88d);
  canvas.disc({0.62f * w, 0.38f}, 0.27f, red);
  canvas.mark(
      {0, 0}, {w, 1},
      [&](const glm::vec2& p) {
        return std::max(glm::length(p - glm::vec2(0.62f * w, 0.38f)) - 0.27f,
                        (p.x - 0.62f * w) + (p.y - 0.38f));
      },
      ochre);
  canvas.rectangle({0.10f * w, 0.55f}, {0.46f * w, 0.63f}, blue);
  canvas.rectangle({0.16f * w, 0.66f}, {0.38f * w, 0.70f}, ink);
  canvas.mark(
      {0, 0}, {w, 1},
      [&](const glm::vec2& p) {
        const glm::vec2 a(0.12f * w, 0.92f), b(0.5f * w, 0.92f), c(0.31f * w, 0.60f);
        const auto edge = [&](const glm::vec2& from, const glm::vec2& to) {
          const glm::vec2 d = glm::normalize(to - from);
          return d.x * (p - from).y - d.y * (p - from).x;
        };
        return std::max({edge(a, b), edge(b, c), edge(c, a)});
      },
      sage, 0.9f);
  for (int i = 0; i < 4; ++i)
    arc(canvas, {0.30f * w, 0.30f}, 0.09f + 0.045f * static_cast<float>(i), 0.014f,
        0.3f * static_cast<float>(i), 2.2f + 0.5f * static_cast<float>(i), i % 2 == 0 ? ink : blue);
  canvas.stroke({0.05f * w, 0.95f}, {0.95f * w, 0.08f}, 0.012f, ink);
  canvas.stroke({0.55f * w, 0.97f}, {0.97f * w, 0.52f}, 0.035f, ochre);
  canvas.stroke({0.60f * w, 0.98f}, {0.98f * w, 0.58f}, 0.008f, ink);
  for (int i = 0; i < 7; ++i) {
    const float y = 0.70f + 0.035f * static_cast<float>(i);
    canvas.stroke({0.62f * w, y}, {(0.70f + 0.02f * static_cast<float>(i)) * w, y}, 0.008f, ink);
  }
  canvas.disc({0.84f * w, 0.80f}, 0.075f, ink);
  canvas.disc({0.84f * w, 0.80f}, 0.045f, ochre);
  canvas.disc({0.14f * w, 0.13f}, 0.05f, blue);
  return canvas;
}

Canvas paintTown(int width, int height, std::uint32_t seed) {
  Canvas canvas(width, height);
  const std::vector<glm::vec3> warm{colour(0xd9a066), colour(0xb5523b), colour(0xe8cfa4),
                                    colour(0x8f3b2e), colour(0xc98b5e), colour(0xf1dfbd)};
  const std::vector<glm::vec3> cool{colour(0x5b7f95), colour(0x9db7b5), colour(0x3b5268), colour(0xc3cfc0)};
  canvas.fill([&](const glm::vec2& p) {
    const glm::vec2 q(p.x * 7 + 0.8f * noise({p * 3.0f, 0}, seed), p.y * 9);
    const Cell facet = cellAt(q, seed);
    const bool sky = p.y < 0.30f + 0.10f * noise({p.x * 3, 0, 0}, seed + 1U);
    const auto& palette = sky || facet.value > 0.88f ? cool : warm;
    const auto index = static_cast<std::size_t>(facet.value * 9973) % palette.size();
    const float light = 0.82f + 0.35f * facet.nearest + 0.15f * fractalNoise({p * 14.0f, 0}, 3, seed);
    return palette[index] * light * (sky ? 1.05f : 1.0f);
  });
  Random random(seed);
  for (int i = 0; i < 34; ++i) {
    const float depth = static_cast<float>(i) / 33;
    const glm::vec2 foot(random.between(0, canvas.aspect()), 0.42f + 0.55f * depth);
    const float size = 0.05f + 0.06f * depth;
    const glm::vec3 wall = glm::mix(warm[static_cast<std::size_t>(random.below(6))], colour(0xf7ead0), 0.45f);
    const glm::vec3 roof =
        random.unit() < 0.75f ? colour(0xa8432c) * random.between(0.8f, 1.25f) : colour(0x46627a);
    canvas.rectangle(foot - size * glm::vec2(0.8f, 1.3f), foot, wall);
    canvas.rectangle(foot - size * glm::vec2(0, 1.3f), foot + size * glm::vec2(0.8f, 0), wall * 0.62f);
    canvas.mark(
        foot - size * glm::vec2(1, 2.0f), foot + size * glm::vec2(1, -1.3f),
        [&](const glm::vec2& p) {
          const glm::vec2 q = (p - foot) / size + glm::vec2(0, 1.3f);
          return size * std::max(q.y, std::abs(q.x) - 1.0f - q.y / 0.7f);
        },
        roof);
    for (int window = 0; window < 2; ++window)
      canvas.rectangle(foot + size * glm::vec2(-0.6f + 0.9f * static_cast<float>(window), -0.95f),
                       foot + size * glm::vec2(-0.38f + 0.9f * static_cast<float>(window), -0.5f),
                       colour(0x2d3142));
  }
  return canvas;
}

Canvas paintStillLife(int width, int height, std::uint32_t seed) {
  Canvas canvas(width, height);
  const float w = canvas.aspect(), table = 0.66f;
  canvas.fill([&](const glm::vec2& p) {
    const float mottle = fractalNoise({p * 4.0f, 0}, 5, seed);
    const float lamp = std::exp(-2.2f * glm::length(p - glm::vec2(0.35f * w, 0.3f)));
    if (p.y < table) return colour(0x3a3326) * (0.7f + 0.5f * mottle) + colour(0x8a7448) * lamp * 0.6f;
    const float fold = noise({p.x * 9 + p.y * 5, p.y * 3, 0}, seed + 2U);
    return colour(0xcfc4ae) * (0.55f + 0.25f * fold + 0.3f * lamp);
  });
  // Turned body: half width by height; lit from the left, with a highlight.
  const auto body = [&](const glm::vec2& foot, float tall, const glm::vec3& tint, float shine,
                        auto halfWidth) {
    canvas.stroke(foot + glm::vec2(0.02f, 0), foot + glm::vec2(0.20f, 0.012f), 0.035f, colour(0x1c1713),
                  0.5f);
    canvas.over([&](const glm::vec2& p) {
      const float up = (foot.y - p.y) / tall;
      if (up < -0.05f || up > 1) return glm::vec4(0);
      const float half = halfWidth(std::max(up, 0.0f)), across = (p.x - foot.x) / std::max(half, 1e-4f);
      if (half <= 0 || std::abs(across) > 1.2f) return glm::vec4(0);
      const float bottom = up < 0 ? 1 - std::sqrt(std::max(0.0f, 1 - across * across)) : 0;
      if (up < 0 && up * tall < -0.03f * (1 - bottom)) return glm::vec4(0);
      const float light =
          0.22f + 0.9f * std::pow(std::max(0.0f, 1 - 0.5f * (across + 0.45f) * (across + 0.45f)), 3.0f);
      const float spot = shine * std::exp(-60 * (across + 0.45f) * (across + 0.45f));
      return glm::vec4(tint * light + spot,
                       (1 - std::abs(across)) * half * static_cast<float>(height) + 0.5f);
    });
  };
  body({0.30f * w, 0.74f}, 0.52f, colour(0x2f4f3e), 0.35f, [](float up) {
    return up < 0.55f ? 0.085f : glm::mix(0.085f, 0.026f, glm::smoothstep(0.55f, 0.72f, up));
  });
  body({0.62f * w, 0.78f}, 0.17f, colour(0x4d78a6), 0.25f,
       [](float up) { return 0.07f + 0.13f * std::sqrt(up); });
  const auto orange = [&](const glm::vec2& centre, float radius, const glm::vec3& tint) {
    canvas.mark(
        centre - radius, centre + radius,
        [&](const glm::vec2& p) { return glm::length(p - centre) - radius; }, tint * 0.35f);
    for (int ring = 1; ring <= 14; ++ring) {
      const float t = static_cast<float>(ring) / 14;
      canvas.disc(centre + radius * t * glm::vec2(-0.32f, -0.32f), radius * (1 - 0.92f * t),
                  tint * (0.35f + 0.95f * t), 0.55f);
    }
  };
  orange({0.56f * w, 0.585f}, 0.065f, colour(0xe8832a));
  orange({0.67f * w, 0.575f}, 0.070f, colour(0xd96f1e));
  orange({0.615f * w, 0.53f}, 0.062f, colour(0xf0a23b));
  orange({0.43f * w, 0.80f}, 0.062f, colour(0xe8832a));
  orange({0.82f * w, 0.82f}, 0.055f, colour(0xb93a32));
  return canvas;
}

}  // namespace acentric::gallery
