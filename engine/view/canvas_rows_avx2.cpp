#if defined(__x86_64__)
#include <immintrin.h>

#include "engine/view/canvas_rows.h"

namespace acentric {
namespace {

constexpr int kSide = 8;

/// The low or high halves of eight canvas pixels.
template <int kHalf>
__m256i halvesOf(const std::uint64_t* pixels) {
  const __m256 first = _mm256_castsi256_ps(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(pixels)));
  const __m256 second = _mm256_castsi256_ps(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(pixels + 4)));
  const __m256i mixed = _mm256_castps_si256(_mm256_shuffle_ps(first, second, kHalf == 0 ? 0x88 : 0xdd));
  return _mm256_permute4x64_epi64(mixed, 0xd8);
}

/// Of an 8 x 8 matrix: afterwards rows[r] holds what were lanes r.
void transpose(__m256i (&rows)[kSide]) {
  __m256i t[kSide];
  for (int i = 0; i < kSide; i += 2) {
    t[i] = _mm256_unpacklo_epi32(rows[i], rows[i + 1]);
    t[i + 1] = _mm256_unpackhi_epi32(rows[i], rows[i + 1]);
  }
  for (int i = 0; i < kSide; i += 4) {  // rows[i + j]: lanes j of each half, of four columns
    rows[i] = _mm256_unpacklo_epi64(t[i], t[i + 2]);
    rows[i + 1] = _mm256_unpackhi_epi64(t[i], t[i + 2]);
    rows[i + 2] = _mm256_unpacklo_epi64(t[i + 1], t[i + 3]);
    rows[i + 3] = _mm256_unpackhi_epi64(t[i + 1], t[i + 3]);
  }
  for (int j = 0; j < 4; ++j) {
    const __m256i left = rows[j], right = rows[4 + j];
    rows[j] = _mm256_permute2x128_si256(left, right, 0x20);
    rows[4 + j] = _mm256_permute2x128_si256(left, right, 0x31);
  }
}

/// A quarter of a block.
void writeQuarter(const CanvasBlock& block) {
  const __m256i opaque = _mm256_set1_epi32(-0x1000000);
  __m256i rows[kSide], empty[kSide];
  for (int x = 0; x < kSide; ++x) rows[x] = halvesOf<0>(block.pixels + x * block.columnPitch);
  transpose(rows);
  for (int y = 0; y < kSide; ++y) {
    const __m256i slot = _mm256_srli_epi32(rows[y], 24);
    empty[y] = _mm256_cmpeq_epi32(slot, _mm256_setzero_si256());
    const __m256i sources = _mm256_i32gather_epi32(reinterpret_cast<const int*>(block.sources), slot, 4);
    const __m256i packed =
        _mm256_permute4x64_epi64(_mm256_packus_epi32(sources, _mm256_setzero_si256()), 0x08);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(block.colour + y * block.rowPitch),
                        _mm256_or_si256(rows[y], _mm256_andnot_si256(empty[y], opaque)));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(block.source + y * block.rowPitch),
                     _mm256_castsi256_si128(packed));
  }
  for (int x = 0; x < kSide; ++x) rows[x] = halvesOf<1>(block.pixels + x * block.columnPitch);
  transpose(rows);
  for (int y = 0; y < kSide; ++y)
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(block.inverseZDepth + y * block.rowPitch),
                        _mm256_andnot_si256(empty[y], rows[y]));
}

}  // namespace

void writeRowsAvx2(const CanvasBlock& block) {
  for (int x = 0; x < kBlockSide; x += kSide)
    for (int y = 0; y < kBlockSide; y += kSide) {
      CanvasBlock quarter = block;
      const std::ptrdiff_t at = y * block.rowPitch + x;
      quarter.pixels += x * block.columnPitch + y;
      quarter.colour += at, quarter.source += at, quarter.inverseZDepth += at;
      writeQuarter(quarter);
    }
}

}  // namespace acentric
#endif
