#include "ui/text_format.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "ui/translate.h"

namespace acentric::ui {

std::string formatCount(std::uint64_t count) {
  std::string digits = fmt::format("{}", count);
  const std::string separator = trIn("thousands separator", ",");
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, separator);
  return digits;
}

std::string formatBytes(std::uint64_t bytes) {
  constexpr std::array<const char*, 5> kUnits = {"B", "kB", "MB", "GB", "TB"};
  double value = double(bytes);
  std::size_t unit = 0;
  while (value >= 999.5 && unit + 1 < kUnits.size()) {
    value /= 1000;
    ++unit;
  }
  if (unit == 0) return fmt::format("{} B", bytes);
  return value < 9.95 ? fmt::format("{:.1f} {}", value, kUnits[unit])
                      : fmt::format("{:.0f} {}", value, kUnits[unit]);
}

std::string formatDuration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return tr("unknown");
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string formatArea(double squareMetres) {
  if (squareMetres >= 1e5) return fmt::format("{:.3g} km²", 1e-6 * squareMetres);
  if (squareMetres < 100) return fmt::format("{:.1f} m²", squareMetres);
  return formatCount(std::uint64_t(std::llround(squareMetres))) + " m²";
}

std::string formatMetres(double metres) {
  const double size = std::abs(metres);
  if (size == 0) return "0 m";
  if (size < 0.00995) return fmt::format("{:g} mm", std::round(metres * 1e5) / 100);
  if (size < 0.995) return fmt::format("{:g} cm", std::round(metres * 1e4) / 100);
  if (size < 999.5) return fmt::format("{:g} m", std::round(metres * 100) / 100);
  return fmt::format("{:g} km", std::round(metres / 10) / 100);
}

std::string formatPercent(double fraction) {
  const double percent = fraction * 100;
  if (percent == 0) return "0 %";
  return std::abs(percent) < 9.95 ? fmt::format("{:.2f} %", percent) : fmt::format("{:.0f} %", percent);
}

std::string withDigits(const std::string& format, double value) {
  constexpr int kMost = 6;
  const std::size_t at = format.find("%.");
  if (at == std::string::npos || at + 3 >= format.size() || format[at + 3] != 'f') return format;
  int decimals = format[at + 2] - '0';
  while (value != 0 && decimals < kMost && std::abs(value) * std::pow(10, decimals) < 9.5) ++decimals;
  std::string more = format;
  more[at + 2] = char('0' + decimals);
  return more;
}

std::string shortenPath(const std::string& path, std::size_t length) {
  if (path.size() <= length || length < 8) return path;
  std::size_t head = length / 4;
  std::size_t tail = path.size() - (length - head - 1);
  // Never cut inside a UTF-8 character: its continuation bytes are 10xxxxxx.
  const auto continues = [&path](std::size_t i) {
    return i < path.size() && (static_cast<unsigned char>(path[i]) & 0xc0U) == 0x80U;
  };
  while (head > 0 && continues(head)) --head;
  while (continues(tail)) ++tail;
  return path.substr(0, head) + "…" + path.substr(tail);
}

}  // namespace acentric::ui
