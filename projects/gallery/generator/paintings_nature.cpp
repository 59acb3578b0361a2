#include <algorithm>
#include <cmath>
#include <vector>

#include "projects/gallery/generator/noise.h"
#include "projects/gallery/generator/paintings.h"

namespace acentric::gallery {
namespace {

/// Short strokes of a field of colour: what makes it look brushed. `turnAt` is the direction in radians.
template <class ColourAt, class TurnAt>
void brush(Canvas& canvas, Random& random, int count, float length, float width, const ColourAt& colourAt,
           const TurnAt& turnAt) {
  for (int i = 0; i < count; ++i) {
    const glm::vec2 p(random.between(0, canvas.aspect()), random.unit());
    const float turn = turnAt(p) + random.between(-0.15f, 0.15f);
    const glm::vec2 half =
        0.5f * length * random.between(0.6f, 1.3f) * glm::vec2(std::cos(turn), std::sin(turn));
    const glm::vec3 tint = colourAt(p) * random.between(0.82f, 1.18f);
    canvas.stroke(p - half, p + half, width * random.between(0.7f, 1.3f), tint, 0.7f);
  }
}

}  // namespace

void varnish(Canvas& canvas, std::uint32_t seed) {
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x) {
      const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
      const float weave = 0.012f * (std::sin(fx * 1.9f) + std::sin(fy * 1.9f));
      const float grain = 0.05f * fractalNoise({fx * 0.03f, fy * 0.22f, 0}, 3, seed);
      const float rimX = std::min(fx, static_cast<float>(canvas.width() - 1) - fx);
      const float rimY = std::min(fy, static_cast<float>(canvas.height() - 1) - fy);
      const float rim = 0.75f + 0.25f * glm::smoothstep(0.0f, 22.0f, std::min(rimX, rimY));
      const glm::vec3 warm(1.02f, 1.0f, 0.95f);
      canvas.at(x, y) *= warm * (1 + weave + grain) * rim;
    }
}

Canvas paintMountains(int width, int height, std::uint32_t seed) {
  Canvas canvas(width, height);
  // Even seeds are mornings.
  const bool morning = seed % 2 == 0;
  const std::vector<glm::vec3> sky =
      morning ? std::vector{colour(0x5f8fb0), colour(0x9cc3cf), colour(0xdce8dc), colour(0xfbf0d2)}
              : std::vector{colour(0x3c4f76), colour(0x8a6f93), colour(0xe39a7b), colour(0xf7d08a)};
  const auto skyAt = [&](const glm::vec2& p) {
    const float cloud = fractalNoise({p.x * 2.2f, p.y * 9, 0.3f}, 5, seed);
    return glm::mix(gradient(sky, p.y * 1.75f), colour(0xfbe3c0),
                    0.45f * glm::smoothstep(0.05f, 0.5f, cloud));
  };
  canvas.fill(skyAt);
  Random random(seed);
  brush(canvas, random, 2600, 0.05f, 0.009f, skyAt, [](const glm::vec2&) { return 0.06f; });
  canvas.disc({canvas.aspect() * 0.68f, 0.44f}, 0.045f, colour(0xfff1c4), 0.95f);
  constexpr int kRanges = 6;
  for (int range = 0; range < kRanges; ++range) {
    const float near = static_cast<float>(range) / (kRanges - 1);
    const glm::vec3 far = colour(morning ? 0xa9c4c6 : 0xc98f83),
                    close = colour(morning ? 0x1f3f36 : 0x1d2f3c);
    const glm::vec3 haze = colour(morning ? 0xe4ecdf : 0xe6b596);
    const auto ridge = [&](float x) {
      const float rough = fractalNoise({x * (1.6f + 1.2f * near) + 17.0f * near, 4.0f * near, 0.7f}, 6,
                                       seed + 7U * static_cast<std::uint32_t>(range));
      return 0.47f + 0.47f * near * near - (0.17f - 0.05f * near) * (0.35f + rough) + 0.06f * near;
    };
    canvas.over([&](const glm::vec2& p) {
      const float below = p.y - ridge(p.x);
      const float light = 0.12f * fractalNoise({p.x * 14, p.y * 22, near}, 4, seed + 3U);
      const glm::vec3 mist = glm::mix(glm::mix(far, close, std::sqrt(near)), haze,
                                      0.5f * glm::smoothstep(0.0f, 0.22f, below) * (1 - near));
      return glm::vec4(mist * (1 + light), below * static_cast<float>(height) + 0.5f);
    });
  }
  return canvas;
}

Canvas paintSea(int width, int height, std::uint32_t seed) {
  Canvas canvas(width, height);
  const float horizon = 0.52f;
  const glm::vec2 sun(canvas.aspect() * 0.42f, 0.40f);
  // Even seeds are moonlit.
  const bool night = seed % 2 == 0;
  const std::vector<glm::vec3> sky =
      night ? std::vector{colour(0x0f1c33), colour(0x1f3a57), colour(0x4a6f86), colour(0x86a3a8)}
            : std::vector{colour(0x2f5d7c), colour(0x76a3b0), colour(0xf2c58f), colour(0xf4a261)};
  const std::vector<glm::vec3> sea = night
                                         ? std::vector{colour(0x5c7f8c), colour(0x1b3d52), colour(0x0a1a2a)}
                                         : std::vector{colour(0x9bb8ae), colour(0x2f6f7e), colour(0x123a4d)};
  const glm::vec3 gleam = colour(night ? 0xe6edda : 0xffd79a),
                  cloudTint = colour(night ? 0x7d8fa3 : 0xc9798c);
  const auto paint = [&](const glm::vec2& p) {
    if (p.y < horizon) {
      const float cloud = fractalNoise({p.x * 3, p.y * 14 - p.x, 0.1f}, 5, seed);
      const glm::vec3 base = gradient(sky, p.y / horizon);
      const float glow = std::exp(-9 * glm::length(p - sun));
      return glm::mix(glm::mix(base, cloudTint, 0.5f * glm::smoothstep(0.1f, 0.45f, cloud)), colour(0xfff0c0),
                      glow);
    }
    const float depth = (p.y - horizon) / (1 - horizon);
    const float wave =
        fractalNoise({p.x * (14 - 9 * depth), (p.y - horizon) * (90 - 62 * depth), 0.9f}, 4, seed + 5U);
    const float track =
        std::exp(-std::abs(p.x - sun.x) * (12 - 7 * depth)) * glm::smoothstep(-0.15f, 0.35f, wave);
    const glm::vec3 water = gradient(sea, depth) * (1 + 0.45f * wave);
    return glm::mix(water, gleam, std::min(1.0f, 1.1f * track));
  };
  canvas.fill(paint);
  Random random(seed);
  brush(canvas, random, 5000, 0.035f, 0.006f, paint, [](const glm::vec2&) { return 0.0f; });
  canvas.disc(sun, 0.05f, colour(0xfff3cf));
  // Two sails.
  const auto sail = [&](const glm::vec2& foot, float size) {
    const glm::vec3 hull = colour(0x2a2320), cloth = colour(0xf6ead2);
    canvas.stroke(foot + size * glm::vec2(-0.35f, 0), foot + size * glm::vec2(0.35f, 0), 0.13f * size, hull);
    canvas.mark(
        foot - size * glm::vec2(0.5f, 1.3f), foot + size * glm::vec2(0.6f, 0),
        [&](const glm::vec2& p) {
          const glm::vec2 q = (p - foot) / size;
          return size * std::max({-0.02f - q.x, q.y + 0.1f, q.x - 0.5f * (1.15f + q.y) / 1.05f});
        },
        cloth);
  };
  sail({canvas.aspect() * 0.74f, 0.60f}, 0.13f);
  sail({canvas.aspect() * 0.20f, 0.555f}, 0.06f);
  return canvas;
}

Canvas paintBirches(int width, int height, std::uint32_t seed) {
  Canvas canvas(width, height);
  const auto ground = [&](const glm::vec2& p) {
    const float leaf = fractalNoise({p.x * 5, p.y * 5, 0}, 5, seed);
    const glm::vec3 leaves = gradient(
        {colour(0x6b3d1e), colour(0xc7771f), colour(0xe9b13c), colour(0xf3d98b)}, 0.5f + 0.8f * leaf);
    return glm::mix(leaves, colour(0x3d4a2a), glm::smoothstep(0.72f, 0.95f, p.y + 0.06f * leaf));
  };
  canvas.fill(ground);
  Random random(seed);
  brush(canvas, random, 5200, 0.022f, 0.012f, ground, [&](const glm::vec2& p) {
    return 3 * noise({p * 6.0f, 0}, seed);
  });
  for (int tree = 0; tree < 13; ++tree) {
    const float near = static_cast<float>(tree) / 12;
    const float x = random.between(0.02f, canvas.aspect() - 0.02f), trunk = 0.012f + 0.03f * near;
    const float foot = 0.80f + 0.16f * near, lean = random.between(-0.05f, 0.05f);
    const auto s = seed + 31U * static_cast<std::uint32_t>(tree);
    canvas.over([&](const glm::vec2& p) {
      const float centre = x + lean * (foot - p.y) + 0.012f * noise({0, p.y * 4, 0}, s);
      const float across = (p.x - centre) / trunk;
      if (p.y > foot || std::abs(across) > 0.6f) return glm::vec4(0);
      const float bark = fractalNoise({across * 1.2f, p.y * 38, 0}, 3, s + 1U);
      const float shade = 1 - 0.55f * glm::smoothstep(-0.1f, 0.5f, across);
      const glm::vec3 white = glm::mix(colour(0xb9b3a2), colour(0xf3eee0), near);
      const glm::vec3 tint = glm::mix(white, colour(0x2b2622), glm::smoothstep(0.28f, 0.42f, bark)) * shade;
      return glm::vec4(tint, (0.5f - std::abs(across)) * trunk * static_cast<float>(height) + 0.5f);
    });
  }
  brush(
      canvas, random, 900, 0.016f, 0.013f,
      [&](const glm::vec2& p) { return p.y < 0.6f ? ground(p) * 1.25f : ground(p); },
      [&](const glm::vec2& p) {
        return 3 * noise({p * 6.0f, 1}, seed);
      });
  return canvas;
}

Canvas paintMeadow(int width, int height, std::uint32_t seed) {
  Canvas canvas(width, height);
  const float horizon = 0.36f;
  const auto paint = [&](const glm::vec2& p) {
    const float hill = horizon - 0.05f * (0.4f + fractalNoise({p.x * 2, 0, 0}, 4, seed + 1U));
    if (p.y < hill) {
      const float cloud = fractalNoise({p.x * 2.5f, p.y * 6, 0.4f}, 5, seed);
      return glm::mix(gradient({colour(0x5f95c4), colour(0xb7d3df)}, p.y / horizon), colour(0xfdf6e8),
                      glm::smoothstep(0.0f, 0.35f, cloud));
    }
    const float depth = (p.y - hill) / (1 - hill);
    const float patch = fractalNoise({p.x * 7, p.y * 16, 0}, 4, seed + 2U);
    return gradient({colour(0x6f8f6a), colour(0x9aa84f), colour(0x5d7a2c), colour(0x33511f)},
                    depth + 0.16f * patch);
  };
  canvas.fill(paint);
  Random random(seed);
  brush(canvas, random, 4200, 0.026f, 0.006f, paint, [&](const glm::vec2& p) {
    return p.y < horizon ? 0.1f : 1.4f + 0.4f * noise({p * 9.0f, 0}, seed);
  });
  // Far flowers first; nearer ones are larger.
  for (int i = 0; i < 900; ++i) {
    const float depth = static_cast<float>(i) / 900;
    const glm::vec2 p(random.between(0, canvas.aspect()),
                      horizon + 0.03f + (0.97f - horizon) * depth * depth);
    if (noise({p.x * 3.5f, p.y * 7, 0}, seed + 9U) < -0.12f) continue;
    const float size = 0.002f + 0.015f * depth * depth;
    const glm::vec3 red = glm::mix(colour(0xb3201d), colour(0xf0573a), random.unit());
    canvas.disc(p, size, red, 0.95f);
    canvas.disc(p + size * glm::vec2(0.35f, -0.3f), 0.55f * size, red * 1.35f, 0.8f);
    if (size > 0.006f) canvas.disc(p + glm::vec2(0, 0.1f * size), 0.25f * size, colour(0x241a20));
  }
  return canvas;
}

Canvas paintNightSky(int width, int height, std::uint32_t seed) {
  Canvas canvas(width, height, colour(0x14213d));
  const std::vector<glm::vec3> stars{{0.24f, 0.22f, 0.10f},
                                     {0.62f, 0.15f, 0.07f},
                                     {0.95f, 0.30f, 0.12f},
                                     {0.43f, 0.45f, 0.06f},
                                     {1.18f, 0.17f, 0.08f}};
  const auto colourAt = [&](const glm::vec2& p) {
    const float flow = fractalNoise({p * 3.0f, 0}, 4, seed);
    glm::vec3 tint = gradient({colour(0x12224a), colour(0x2c5282), colour(0x5f8fb4), colour(0xa9c5bd)},
                              0.45f + 0.75f * flow);
    for (const glm::vec3& star : stars) {
      const float d = glm::length(p - glm::vec2(star.x * canvas.aspect() / 1.25f, star.y)) / star.z;
      tint = glm::mix(tint, gradient({colour(0xfff3b8), colour(0xf2c14e), colour(0x7ea6ad)}, d * 0.8f),
                      glm::smoothstep(1.5f, 0.25f, d));
    }
    return tint;
  };
  const auto turnAt = [&](const glm::vec2& p) {
    float turn = 1.6f * noise({p * 2.0f, 0.5f}, seed + 4U);
    for (const glm::vec3& star : stars) {
      const glm::vec2 d = p - glm::vec2(star.x * canvas.aspect() / 1.25f, star.y);
      const float weight = glm::smoothstep(2.2f, 0.6f, glm::length(d) / star.z);
      turn = glm::mix(turn, std::atan2(d.y, d.x) + 1.5708f, weight);
    }
    return turn;
  };
  Random random(seed);
  brush(canvas, random, 9000, 0.05f, 0.011f, colourAt, turnAt);
  // Hills and a village below.
  canvas.over([&](const glm::vec2& p) {
    const float ridge = 0.76f - 0.10f * fractalNoise({p.x * 1.7f, 0, 0}, 4, seed + 8U);
    const float stripe = 0.25f * noise({p.x * 6 + p.y * 9, p.y * 40, 0}, seed);
    return glm::vec4(glm::mix(colour(0x1d3557), colour(0x0d1b2a), glm::smoothstep(0.0f, 0.25f, p.y - ridge)) *
                         (1 + stripe),
                     (p.y - ridge) * static_cast<float>(height));
  });
  for (int house = 0; house < 16; ++house) {
    const glm::vec2 p(random.between(0.1f, canvas.aspect() - 0.1f), random.between(0.85f, 0.95f));
    const float size = random.between(0.018f, 0.03f);
    canvas.rectangle(p - size, p + size * glm::vec2(1, 0.8f), colour(0x22304a));
    canvas.rectangle(p - 0.35f * size, p + 0.3f * size, colour(0xf4b942));
  }
  return canvas;
}

}  // namespace acentric::gallery
