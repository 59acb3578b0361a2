#pragma once
/// What the warp's kernels need of one lane beside arithmetic.

#include "engine/view/lanes_scalar.h"
#include "engine/view/warp_kernel.h"

namespace acentric {
namespace {

struct WarpLane : OneLane {
  using OneLane::load;
  static void load(const PackedSample* p, I& inverseAndRoles, I& row) {
    inverseAndRoles = static_cast<I>(p->inverseDistanceAndRoles);
    row = static_cast<I>(p->row);
  }
  static I words(const unsigned char* p, int) {
    I word = 0;
    __builtin_memcpy(&word, p, sizeof word);
    return word;
  }
  static F tangents(const float* table, const PackedSample* rising, I) { return table[rising->row]; }
  static M needed(I roles, std::uint32_t wanted) { return (static_cast<std::uint32_t>(roles) & wanted) != 0; }
  static M kept(M accepted) { return accepted; }
  static I together(M, I lane) { return lane; }
  static void storeAll(std::uint32_t* p, I a) { *p = static_cast<std::uint32_t>(a); }
};

}  // namespace
}  // namespace acentric
