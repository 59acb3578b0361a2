#if defined(__x86_64__)
#include <immintrin.h>

#include "engine/view/pixel_filter.h"

namespace acentric {
namespace {

/// Eight canvas pixels: their low and high halves. Within each half the order is 0 1 4 5 2 3 6 7.
struct Eight {
  __m256i colour, place;
};

Eight load(const std::uint64_t* pixels) {
  const __m256 first = _mm256_castsi256_ps(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(pixels)));
  const __m256 second = _mm256_castsi256_ps(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(pixels + 4)));
  return {_mm256_castps_si256(_mm256_shuffle_ps(first, second, 0x88)),
          _mm256_castps_si256(_mm256_shuffle_ps(first, second, 0xdd))};
}

/// Low 16 bits of each lane of `a` below those of `b`.
__m256i lowHalves(__m256i a, __m256i b) { return _mm256_blend_epi16(a, _mm256_slli_epi32(b, 16), 0xaa); }
__m256i highHalves(__m256i a, __m256i b) { return _mm256_blend_epi16(_mm256_srli_epi32(a, 16), b, 0xaa); }

/// Sums over neighbours, two of which are taken at a time: one in the lower, one in the upper half of each
/// lane.
class Sums {
 public:
  /// (x, y): how many pixels away the neighbours are.
  void add(const Eight& a, int ax, int ay, const Eight& b, int bx, int by) {
    const __m256i redGreen = lowHalves(a.colour, b.colour), blueSlot = highHalves(a.colour, b.colour),
                  place = lowHalves(a.place, b.place), byte = _mm256_set1_epi16(0xff);
    const __m256i spread = _mm256_and_si256(_mm256_srli_epi16(place, 6), _mm256_set1_epi16(0x1c)),
                  perEighth = _mm256_sub_epi16(_mm256_set1_epi16(32), spread);
    const __m256i alongX = weight(_mm256_slli_epi16(place, 12), ax, bx, perEighth),
                  alongY = weight(_mm256_slli_epi16(place, 8), ay, by, perEighth);
    const __m256i empty = _mm256_cmpeq_epi16(_mm256_srli_epi16(blueSlot, 8), _mm256_setzero_si256());
    const __m256i w = _mm256_andnot_si256(
        empty, _mm256_mulhi_epu16(_mm256_slli_epi16(alongX, 4), _mm256_slli_epi16(alongY, 3)));
    weights_ = _mm256_add_epi16(weights_, w);
    addSquares(squares_[0], w, _mm256_and_si256(redGreen, byte));
    addSquares(squares_[1], w, _mm256_srli_epi16(redGreen, 8));
    addSquares(squares_[2], w, _mm256_and_si256(blueSlot, byte));
  }

  /// The colours, in the order of Eight; `own` where nothing has any weight.
  __m256i mean(__m256i own) const {
    const __m256i whole = _mm256_madd_epi16(weights_, _mm256_set1_epi16(1));
    const __m256 weights = _mm256_cvtepi32_ps(whole);
    const auto channel = [&](int i) {
      const __m256 root = _mm256_sqrt_ps(_mm256_div_ps(_mm256_cvtepi32_ps(squares_[i]), weights));
      return _mm256_cvttps_epi32(_mm256_add_ps(root, _mm256_set1_ps(0.5f)));
    };
    const __m256i mixed = _mm256_or_si256(
        channel(0), _mm256_or_si256(_mm256_slli_epi32(channel(1), 8), _mm256_slli_epi32(channel(2), 16)));
    const __m256i none = _mm256_cmpeq_epi32(whole, _mm256_setzero_si256());
    return _mm256_or_si256(_mm256_blendv_epi8(mixed, own, none), _mm256_set1_epi32(-0x1000000));
  }

 private:
  /// `code`: the place in the four highest bits of each 16.
  static __m256i weight(__m256i code, int a, int b, __m256i perEighth) {
    const __m256i pixels = _mm256_set1_epi32((8 * a & 0xffff) | (b * (8 << 16)));
    const __m256i away = _mm256_abs_epi16(_mm256_add_epi16(_mm256_srai_epi16(code, 12), pixels));
    return _mm256_subs_epu16(_mm256_set1_epi16(256), _mm256_mullo_epi16(away, perEighth));
  }
  static void addSquares(__m256i& sum, __m256i w, __m256i code) {
    sum = _mm256_add_epi32(sum, _mm256_madd_epi16(_mm256_mullo_epi16(w, code), code));
  }

  __m256i weights_ = _mm256_setzero_si256();
  __m256i squares_[3] = {_mm256_setzero_si256(), _mm256_setzero_si256(), _mm256_setzero_si256()};
};

}  // namespace

void filterPixelsAvx2(const std::uint64_t* left, const std::uint64_t* middle, const std::uint64_t* right,
                      int count, std::uint32_t* colour) {
  const Eight nothing{_mm256_setzero_si256(), _mm256_setzero_si256()};
  for (int i = 0; i < count; i += 8) {
    const Eight own = load(middle + i + 1);
    Sums sums;
    sums.add(load(left + i), -1, -1, load(left + i + 1), -1, 0);
    sums.add(load(left + i + 2), -1, 1, load(middle + i), 0, -1);
    sums.add(own, 0, 0, load(middle + i + 2), 0, 1);
    sums.add(load(right + i), 1, -1, load(right + i + 1), 1, 0);
    sums.add(load(right + i + 2), 1, 1, nothing, 0, 0);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(colour + i),
                        _mm256_permute4x64_epi64(sums.mean(own.colour), 0xd8));
  }
}

}  // namespace acentric
#endif
