#if defined(__x86_64__)
#include "engine/view/lanes_avx2.h"
#include "engine/view/warp_kernel_body.h"

namespace acentric {
namespace {

/// By mask.
struct KeptLanes {
  std::uint8_t lanes[256][8] = {};
  constexpr KeptLanes() {
    for (unsigned mask = 0; mask < 256; ++mask)
      for (unsigned lane = 0, next = 0; lane < 8; ++lane)
        if ((mask >> lane & 1u) != 0) lanes[mask][next++] = static_cast<std::uint8_t>(lane);
  }
};
constexpr KeptLanes kKeptLanes;

struct WarpLanes : EightLanes {
  using EightLanes::load;
  static void load(const PackedSample* p, I& inverseAndRoles, I& row) {
    const __m256 first = _mm256_loadu_ps(reinterpret_cast<const float*>(p)),
                 second = _mm256_loadu_ps(reinterpret_cast<const float*>(p + 4));
    const auto inOrder = [](__m256 lanes) {
      return I{_mm256_permute4x64_epi64(_mm256_castps_si256(lanes), 0xd8)};
    };
    inverseAndRoles = inOrder(_mm256_shuffle_ps(first, second, 0x88));
    row = inOrder(_mm256_shuffle_ps(first, second, 0xdd));
  }
  static I words(const unsigned char* p, int count) {
    return load(reinterpret_cast<const std::uint32_t*>(p), count);
  }
  static F tangents(const float* table, const PackedSample* rising, I row) {
    const int first = static_cast<int>(rising[0].row),
              span = static_cast<int>(rising[kWidth - 1].row) - first;
    if (span >= kWidth) return gather(table, row);
    const __m256 near = _mm256_maskload_ps(table + first, firstLanes(span + 1));
    return {_mm256_permutevar8x32_ps(near, (row - seti(first)).v)};
  }
  static M needed(I roles, std::uint32_t wanted) {
    return greater(both(roles, seti(static_cast<int>(wanted))), seti(0));
  }
  /// The kept lanes' numbers, one after the other.
  static I kept(M accepted) {
    const __m128i numbers =
        _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kKeptLanes.lanes[bits(accepted)]));
    return {_mm256_cvtepu8_epi32(numbers)};
  }
  static I together(I kept, I lanes) { return {_mm256_permutevar8x32_epi32(lanes.v, kept.v)}; }
  static void storeAll(std::uint32_t* p, I a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v); }
};

}  // namespace

int projectSamplesAvx2(const ProjectColumn& column, const SampleColumn& samples, std::uint32_t count,
                       const SplatArrays& out) {
  return warp_kernel::projectColumn<WarpLanes>(column, samples, count, out);
}

}  // namespace acentric
#endif
