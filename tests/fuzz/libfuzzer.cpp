/// Runs a harness with inputs that libFuzzer makes up from the seeds and from what they reach in the code.

#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  accepts(data, size);
  return 0;  // what is refused at another place is worth keeping too
}
