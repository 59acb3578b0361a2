#if defined(__x86_64__)
#include "engine/view/lanes_avx2.h"
#include "engine/view/warp_kernel_body.h"

namespace acentric {
namespace {

struct WarpLanes : EightLanes {
  using EightLanes::load;
  static void load(const PackedSample* p, I& inverseAndRoles, I& rowAndSlant) {
    const __m256 first = _mm256_loadu_ps(reinterpret_cast<const float*>(p)),
                 second = _mm256_loadu_ps(reinterpret_cast<const float*>(p + 4));
    const auto inOrder = [](__m256 lanes) {
      return I{_mm256_permute4x64_epi64(_mm256_castps_si256(lanes), 0xd8)};
    };
    inverseAndRoles = inOrder(_mm256_shuffle_ps(first, second, 0x88));
    rowAndSlant = inOrder(_mm256_shuffle_ps(first, second, 0xdd));
  }
  static F tangents(const float* table, const PackedSample* rising, I rowAndSlant) {
    const I row = both(rowAndSlant, seti(0xffff));
    const int first = rising[0].row, span = rising[kWidth - 1].row - first;
    if (span >= kWidth) return gather(table, row);
    const __m256 near = _mm256_maskload_ps(table + first, firstLanes(span + 1));
    return {_mm256_permutevar8x32_ps(near, (row - seti(first)).v)};
  }
  static M needed(const std::uint8_t* roles, std::uint32_t wanted) {
    const __m128i narrow = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(roles));
    return needed(I{_mm256_cvtepu8_epi32(narrow)}, wanted);
  }
  static M needed(I roles, std::uint32_t wanted) {
    return greater(both(roles, seti(static_cast<int>(wanted))), seti(0));
  }
  static I pack(I width, I height, I placeX, I placeY) {
    const __m256i size = _mm256_or_si256(width.v, _mm256_slli_epi32(height.v, 8));
    const __m256i place = _mm256_or_si256(placeX.v, _mm256_slli_epi32(placeY.v, 8));
    return {_mm256_or_si256(size, _mm256_slli_epi32(place, 16))};
  }

  /// Writes all eight splats one after the other and steps on only past the accepted ones: no branches.
  static int append(M accepted, I x, I y, I size, std::uint32_t index, I spread, F inverseZDepth,
                    Splat* out) {
    const unsigned bits = static_cast<unsigned>(_mm256_movemask_ps(accepted.v));
    if (bits == 0) return 0;
    const __m256i xy = _mm256_blend_epi16(x.v, _mm256_slli_epi32(y.v, 16), 0xaa);
    const __m256i counted = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(index)),
                                             _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    const __m256i indices = _mm256_or_si256(counted, _mm256_slli_epi32(spread.v, 28));
    const __m256i depth = _mm256_castps_si256(inverseZDepth.v);
    const __m256i low01 = _mm256_unpacklo_epi32(xy, size.v), high01 = _mm256_unpackhi_epi32(xy, size.v);
    const __m256i low23 = _mm256_unpacklo_epi32(indices, depth),
                  high23 = _mm256_unpackhi_epi32(indices, depth);
    const __m256i lanes[4] = {_mm256_unpacklo_epi64(low01, low23), _mm256_unpackhi_epi64(low01, low23),
                              _mm256_unpacklo_epi64(high01, high23), _mm256_unpackhi_epi64(high01, high23)};
    Splat* next = out;
    for (unsigned lane = 0; lane < 4; ++lane) {
      _mm_store_si128(reinterpret_cast<__m128i*>(next), _mm256_castsi256_si128(lanes[lane]));
      next += (bits >> lane) & 1u;
    }
    for (unsigned lane = 0; lane < 4; ++lane) {
      _mm_store_si128(reinterpret_cast<__m128i*>(next), _mm256_extracti128_si256(lanes[lane], 1));
      next += (bits >> (lane + 4)) & 1u;
    }
    return static_cast<int>(next - out);
  }
};

}  // namespace

int projectSamplesAvx2(const ProjectColumn& column, const SampleColumn& samples, const SampleRun* runs,
                       int runCount, Splat* out) {
  return warp_kernel::projectColumn<WarpLanes>(column, samples, runs, runCount, out);
}

int findBlocksAvx2(const ProjectColumn& column, const BlockTest& test, const BlockColumn& blocks, int count,
                   std::uint16_t* out) {
  return warp_kernel::findBlocks<WarpLanes>(column, test, blocks, count, out);
}

}  // namespace acentric
#endif
