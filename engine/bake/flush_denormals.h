#pragma once
/// Denormal numbers flushed to zero on this thread while in scope, as Embree asks of every thread that
/// traces. The former mode comes back afterwards, because whoever lent the thread may count on it.

#include <xmmintrin.h>

namespace acentric {

class FlushDenormals {
 public:
  FlushDenormals() : former_(_mm_getcsr()) { _mm_setcsr(former_ | kFlushToZero | kDenormalsAreZero); }
  ~FlushDenormals() { _mm_setcsr(former_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  static constexpr unsigned kFlushToZero = 0x8000;
  static constexpr unsigned kDenormalsAreZero = 0x0040;
  unsigned former_;
};

}  // namespace acentric
