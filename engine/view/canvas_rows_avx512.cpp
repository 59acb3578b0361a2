#if defined(__x86_64__)
#include <immintrin.h>

#include "engine/view/canvas_rows.h"

namespace acentric {
namespace {

/// The low or high halves of sixteen canvas pixels.
template <int kHalf>
__m512i halvesOf(const std::uint64_t* pixels) {
  const __m512i every = _mm512_setr_epi32(kHalf, kHalf + 2, kHalf + 4, kHalf + 6, kHalf + 8, kHalf + 10,
                                          kHalf + 12, kHalf + 14, kHalf + 16, kHalf + 18, kHalf + 20,
                                          kHalf + 22, kHalf + 24, kHalf + 26, kHalf + 28, kHalf + 30);
  return _mm512_permutex2var_epi32(_mm512_loadu_si512(pixels), every, _mm512_loadu_si512(pixels + 8));
}

/// Of a 16 x 16 matrix: afterwards rows[r] holds what were lanes r.
void transpose(__m512i (&rows)[kBlockSide]) {
  __m512i t[kBlockSide];
  for (int i = 0; i < 16; i += 2) {
    t[i] = _mm512_unpacklo_epi32(rows[i], rows[i + 1]);
    t[i + 1] = _mm512_unpackhi_epi32(rows[i], rows[i + 1]);
  }
  for (int i = 0; i < 16; i += 4) {  // rows[i + j]: lanes j of each quarter, of four columns
    rows[i] = _mm512_unpacklo_epi64(t[i], t[i + 2]);
    rows[i + 1] = _mm512_unpackhi_epi64(t[i], t[i + 2]);
    rows[i + 2] = _mm512_unpacklo_epi64(t[i + 1], t[i + 3]);
    rows[i + 3] = _mm512_unpackhi_epi64(t[i + 1], t[i + 3]);
  }
  for (int j = 0; j < 4; ++j) {
    const __m512i even = _mm512_shuffle_i32x4(rows[j], rows[4 + j], 0x88),
                  odd = _mm512_shuffle_i32x4(rows[j], rows[4 + j], 0xdd),
                  evenRight = _mm512_shuffle_i32x4(rows[8 + j], rows[12 + j], 0x88),
                  oddRight = _mm512_shuffle_i32x4(rows[8 + j], rows[12 + j], 0xdd);
    t[j] = _mm512_shuffle_i32x4(even, evenRight, 0x88);
    t[4 + j] = _mm512_shuffle_i32x4(odd, oddRight, 0x88);
    t[8 + j] = _mm512_shuffle_i32x4(even, evenRight, 0xdd);
    t[12 + j] = _mm512_shuffle_i32x4(odd, oddRight, 0xdd);
  }
  for (int i = 0; i < 16; ++i) rows[i] = t[i];
}

}  // namespace

void writeRowsAvx512(const CanvasBlock& block) {
  const __m512i opaque = _mm512_set1_epi32(-0x1000000);
  __m512i rows[kBlockSide];
  __mmask16 filled[kBlockSide];
  for (int x = 0; x < kBlockSide; ++x) rows[x] = halvesOf<0>(block.pixels + x * block.columnPitch);
  transpose(rows);
  for (int y = 0; y < kBlockSide; ++y) {
    filled[y] = _mm512_test_epi32_mask(rows[y], opaque);
    const __m512i sources = _mm512_i32gather_epi32(_mm512_srli_epi32(rows[y], 24), block.sources, 4);
    _mm512_storeu_si512(block.colour + y * block.rowPitch,
                        _mm512_mask_or_epi32(rows[y], filled[y], rows[y], opaque));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(block.source + y * block.rowPitch),
                        _mm512_cvtepi32_epi16(sources));
  }
  for (int x = 0; x < kBlockSide; ++x) rows[x] = halvesOf<1>(block.pixels + x * block.columnPitch);
  transpose(rows);
  for (int y = 0; y < kBlockSide; ++y)
    _mm512_storeu_si512(block.inverseZDepth + y * block.rowPitch, _mm512_maskz_mov_epi32(filled[y], rows[y]));
}

}  // namespace acentric
#endif
