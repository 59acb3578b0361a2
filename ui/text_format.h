#pragma once
/// Numbers for people: units, thousands, durations. Pure.

#include <cstdint>
#include <string>

namespace acentric::ui {

std::string formatCount(std::uint64_t count);  ///< 27,126
std::string formatBytes(std::uint64_t bytes);  ///< 1.4 GB (decimal units)
std::string formatDuration(double seconds);    ///< 4 s, 3 min 20 s, 1 h 05 min
std::string formatMetres(double metres);       ///< 5 mm, 25 cm, 1.5 m, 2 km
std::string formatArea(double squareMetres);   ///< 8.6 m², 1492 m², 3.98 km²
std::string formatPercent(double fraction);    ///< 0.42 %, 12 %
/// A printf format with a fixed number of decimals ("%.2f m"), with as many more as it takes that a number
/// shows two digits; at most 6.
std::string withDigits(const std::string& format, double value);
/// Shortened in the middle to at most `length` characters: /home/…/gallery.acentric.json
std::string shortenPath(const std::string& path, std::size_t length);

}  // namespace acentric::ui
