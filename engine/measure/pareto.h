#pragma once
/// Which of many points are worth having when several things are to be small at once.

#include <cstddef>
#include <span>
#include <vector>

namespace acentric {

/// What a point costs in each respect; all points in the same ones. Less is better.
using Objectives = std::vector<double>;

/// Is `a` nowhere worse than `b` and somewhere better?
bool dominates(const Objectives& a, const Objectives& b);

/// Indices, rising, of the points that no other dominates. Equal points are all in it or all not.
std::vector<std::size_t> paretoFront(std::span<const Objectives> points);

}  // namespace acentric
