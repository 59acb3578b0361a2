#pragma once
/// A hall with two galleries, one reached by a flight of steps, the other by a ramp, as an OBJ file, Z up:
/// what stairs are tested on. Everything is striped, so that pictures show where they are wrong.

#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <string>

namespace acentric::test {

/// Metres. The hall is 14 x 8, open to the sky, its walls 5.7 high.
struct StairHall {
  static constexpr int kSteps = 15;
  static constexpr double kTread = 0.28, kRiser = 0.18;
  static constexpr double kUpper = kSteps * kRiser;  ///< the gallery over x 8..14
  static constexpr double kFlightEnd = 8, kFlightBegin = kFlightEnd - kSteps * kTread;
  static constexpr double kFlightY = 1.7;                   ///< middle of the flight, 1.4 wide
  static constexpr double kPlatform = 0.9;                  ///< over x 0..3, y 5..8
  static constexpr double kRampEnd = 3, kRampBegin = 10.2;  ///< up towards -x
  static constexpr double kRampY = 6.25;                    ///< middle of the ramp, 1.5 wide

  /// z of the nosings' line: half a tread before the first riser it is at the floor.
  static double flightGround(double x) {
    return glm::clamp((x - kFlightBegin) / kTread + 0.5, 0.0, double(kSteps)) * kRiser;
  }
  static double rampGround(double x) {
    return glm::clamp((kRampBegin - x) / (kRampBegin - kRampEnd), 0.0, 1.0) * kPlatform;
  }

  static void write(const std::filesystem::path& file) {
    std::ofstream obj(file), mtl(file.parent_path() / (file.stem().string() + ".mtl"));
    mtl << "newmtl light\nKd 0.8 0.75 0.65\nnewmtl dark\nKd 0.25 0.3 0.4\nnewmtl red\nKd 0.6 0.2 0.15\n";
    obj << "mtllib " << file.stem().string() << ".mtl\n";
    int corners = 0;
    const auto quad = [&](const char* material, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
      for (const glm::dvec3& p : {a, b, c, d}) obj << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
      obj << "usemtl " << material << "\nf";
      for (int k = 1; k <= 4; ++k) obj << ' ' << corners + k;
      obj << '\n';
      corners += 4;
    };
    const auto box = [&](const char* material, glm::dvec3 l, glm::dvec3 h) {
      quad(material, {l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
      quad(material, {l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, l.y, l.z});
      quad(material, {l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z});
      quad(material, {l.x, h.y, l.z}, {l.x, h.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z});
      quad(material, {l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z});
      quad(material, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, {h.x, l.y, h.z});
    };
    const auto striped = [](int k) { return k % 2 == 0 ? "light" : "dark"; };
    for (int k = 0; k < 14; ++k) {  // floor and the walls along it
      box(striped(k), {k, 0, -0.3}, {k + 1, 8, 0});
      box(striped(k + 1), {k, -0.1, -0.3}, {k + 1, 0, 5.7});
      box(striped(k + 1), {k, 8, -0.3}, {k + 1, 8.1, 5.7});
    }
    for (int k = 0; k < 8; ++k) {
      box(striped(k), {-0.1, k, -0.3}, {0, k + 1, 5.7});
      box(striped(k), {14, k, -0.3}, {14.1, k + 1, 5.7});
    }
    for (int k = 0; k < 6; ++k) box(striped(k), {8 + k, 0, kUpper - 0.2}, {9 + k, 8, kUpper});
    for (int k = 0; k < kSteps; ++k)
      box(k % 2 == 0 ? "red" : "light", {kFlightBegin + kTread * k, kFlightY - 0.7, 0},
          {kFlightBegin + kTread * (k + 1), kFlightY + 0.7, kRiser * (k + 1)});
    box("red", {0, 5, 0}, {3, 8, kPlatform});
    const double low = kRampY - 0.75, high = kRampY + 0.75;
    quad("light", {kRampEnd, low, kPlatform}, {kRampBegin, low, 0}, {kRampBegin, high, 0},
         {kRampEnd, high, kPlatform});
    quad("dark", {kRampEnd, low, 0}, {kRampBegin, low, 0}, {kRampBegin, low, 1e-4},
         {kRampEnd, low, kPlatform});
    quad("dark", {kRampBegin, high, 0}, {kRampEnd, high, 0}, {kRampEnd, high, kPlatform},
         {kRampBegin, high, 1e-4});
  }
};

}  // namespace acentric::test
