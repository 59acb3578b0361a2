#if defined(__x86_64__)
#include <immintrin.h>

#include "engine/view/pixel_filter.h"

namespace acentric {
namespace {

/// Sixteen canvas pixels: their low and high halves. Within each half, two by two, the order is 0 4 1 5 2 6
/// 3 7.
struct Sixteen {
  __m512i colour, place;
};

Sixteen load(const std::uint64_t* pixels) {
  const __m512 first = _mm512_castsi512_ps(_mm512_loadu_si512(reinterpret_cast<const __m512i*>(pixels)));
  const __m512 second = _mm512_castsi512_ps(_mm512_loadu_si512(reinterpret_cast<const __m512i*>(pixels + 8)));
  return {_mm512_castps_si512(_mm512_shuffle_ps(first, second, 0x88)),
          _mm512_castps_si512(_mm512_shuffle_ps(first, second, 0xdd))};
}

/// Low 16 bits of each lane of `a` below those of `b`.
__m512i lowHalves(__m512i a, __m512i b) {
  return _mm512_mask_blend_epi16(0xaaaaaaaa, a, _mm512_slli_epi32(b, 16));
}
__m512i highHalves(__m512i a, __m512i b) {
  return _mm512_mask_blend_epi16(0xaaaaaaaa, _mm512_srli_epi32(a, 16), b);
}

/// Sums over neighbours, two of which are taken at a time: one in the lower, one in the upper half of each
/// lane.
class Sums {
 public:
  /// (x, y): how many pixels away the neighbours are.
  void add(const Sixteen& a, int ax, int ay, const Sixteen& b, int bx, int by) {
    const __m512i redGreen = lowHalves(a.colour, b.colour), blueSlot = highHalves(a.colour, b.colour),
                  place = lowHalves(a.place, b.place), byte = _mm512_set1_epi16(0xff);
    const __m512i spread = _mm512_and_si512(_mm512_srli_epi16(place, 6), _mm512_set1_epi16(0x1c)),
                  perSixteenh = _mm512_sub_epi16(_mm512_set1_epi16(32), spread);
    const __m512i alongX = weight(_mm512_slli_epi16(place, 12), ax, bx, perSixteenh),
                  alongY = weight(_mm512_slli_epi16(place, 8), ay, by, perSixteenh);
    const __mmask32 filled = _mm512_test_epi16_mask(blueSlot, _mm512_set1_epi16(-0x100));
    const __m512i w =
        _mm512_maskz_mulhi_epu16(filled, _mm512_slli_epi16(alongX, 4), _mm512_slli_epi16(alongY, 3));
    weights_ = _mm512_add_epi16(weights_, w);
    addSquares(squares_[0], w, _mm512_and_si512(redGreen, byte));
    addSquares(squares_[1], w, _mm512_srli_epi16(redGreen, 8));
    addSquares(squares_[2], w, _mm512_and_si512(blueSlot, byte));
  }

  /// The colours, in the order of Sixteen; `own` where nothing has any weight.
  __m512i mean(__m512i own) const {
    const __m512i whole = _mm512_madd_epi16(weights_, _mm512_set1_epi16(1));
    const __m512 weights = _mm512_cvtepi32_ps(whole);
    const auto channel = [&](int i) {
      const __m512 root = _mm512_sqrt_ps(_mm512_div_ps(_mm512_cvtepi32_ps(squares_[i]), weights));
      return _mm512_cvttps_epi32(_mm512_add_ps(root, _mm512_set1_ps(0.5f)));
    };
    const __m512i mixed = _mm512_or_si512(
        channel(0), _mm512_or_si512(_mm512_slli_epi32(channel(1), 8), _mm512_slli_epi32(channel(2), 16)));
    const __mmask16 some = _mm512_test_epi32_mask(whole, whole);
    return _mm512_or_si512(_mm512_mask_blend_epi32(some, own, mixed), _mm512_set1_epi32(-0x1000000));
  }

 private:
  /// `code`: the place in the four highest bits of each 16.
  static __m512i weight(__m512i code, int a, int b, __m512i perSixteenh) {
    const __m512i pixels = _mm512_set1_epi32((8 * a & 0xffff) | (b * (8 << 16)));
    const __m512i away = _mm512_abs_epi16(_mm512_add_epi16(_mm512_srai_epi16(code, 12), pixels));
    return _mm512_subs_epu16(_mm512_set1_epi16(256), _mm512_mullo_epi16(away, perSixteenh));
  }
  static void addSquares(__m512i& sum, __m512i w, __m512i code) {
    sum = _mm512_add_epi32(sum, _mm512_madd_epi16(_mm512_mullo_epi16(w, code), code));
  }

  __m512i weights_ = _mm512_setzero_si512();
  __m512i squares_[3] = {_mm512_setzero_si512(), _mm512_setzero_si512(), _mm512_setzero_si512()};
};

}  // namespace

void filterPixelsAvx512(const std::uint64_t* left, const std::uint64_t* middle, const std::uint64_t* right,
                        int count, std::uint32_t* colour) {
  const Sixteen nothing{_mm512_setzero_si512(), _mm512_setzero_si512()};
  for (int i = 0; i < count; i += 16) {
    const Sixteen own = load(middle + i + 1);
    Sums sums;
    sums.add(load(left + i), -1, -1, load(left + i + 1), -1, 0);
    sums.add(load(left + i + 2), -1, 1, load(middle + i), 0, -1);
    sums.add(own, 0, 0, load(middle + i + 2), 0, 1);
    sums.add(load(right + i), 1, -1, load(right + i + 1), 1, 0);
    sums.add(load(right + i + 2), 1, 1, nothing, 0, 0);
    const __m512i inOrder = _mm512_setr_epi64(0, 2, 4, 6, 1, 3, 5, 7);
    _mm512_storeu_si512(colour + i, _mm512_permutexvar_epi64(inOrder, sums.mean(own.colour)));
  }
}

}  // namespace acentric
#endif
