#pragma once
/// One measured figure, as the reports of benches have it.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace acentric::cli {

/// Puts "median", "min", "max" and "count" of repeated measurements into `figure`.
void putSpread(nlohmann::ordered_json& figure, const std::vector<double>& values);

/// Puts "beside" {name, and the spread of `other`} and "ratio": the median of the values over the other's,
/// measured by turns, turn by turn.
void putBeside(nlohmann::ordered_json& figure, const std::vector<double>& values,
               const std::string& otherName, const std::vector<double>& other);

}  // namespace acentric::cli
