#if defined(__x86_64__)
#include "engine/view/lanes_avx2.h"
#include "engine/view/warp_kernel_body.h"

namespace acentric {
namespace {

struct WarpLanes : EightLanes {
  using EightLanes::gather;
  static F gather(const float* table, const std::uint16_t* rising) {
    const __m256i index = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(rising)));
    const int first = rising[0], span = rising[kWidth - 1] - first;
    if (span >= kWidth) return {_mm256_i32gather_ps(table, index, 4)};
    const __m256i within =
        _mm256_cmpgt_epi32(_mm256_set1_epi32(span + 1), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    const __m256 near = _mm256_maskload_ps(table + first, within);
    return {_mm256_permutevar8x32_ps(near, _mm256_sub_epi32(index, _mm256_set1_epi32(first)))};
  }
  static M needed(const std::uint8_t* roles, std::uint32_t wanted) {
    const __m128i narrow = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(roles));
    const __m256i common =
        _mm256_and_si256(_mm256_cvtepu8_epi32(narrow), _mm256_set1_epi32(static_cast<int>(wanted)));
    return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(common, _mm256_setzero_si256()))};
  }
  static void slants(const Slant* p, F& across, F& down) {
    static_assert(sizeof(Slant) == 2);
    const __m256i both = _mm256_cvtepi16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
    const auto tangent = [](__m256i code) {
      const F size = toFloat({code});
      return size / (set(127) - abs(size));
    };
    across = tangent(_mm256_srai_epi32(_mm256_slli_epi32(both, 24), 24));
    down = tangent(_mm256_srai_epi32(both, 8));
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
