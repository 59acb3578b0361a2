/// Runs a harness: over each seed as it is, and changed in so many ways that are the same each time.
/// NAME_fuzz FOLDER CHANGES

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>

#include "tests/fuzz/fuzz.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

bool accepted(const Bytes& bytes) { return accepts(bytes.data(), bytes.size()); }

Bytes changed(Bytes bytes, std::mt19937& random) {
  const auto below = [&](std::size_t limit) {
    return std::size_t(random() % std::max<std::size_t>(limit, 1));
  };
  for (std::size_t n = 1 + below(4); n > 0 && !bytes.empty(); --n) {
    const std::size_t at =
        random() % 2 == 0 ? below(bytes.size()) : below(std::min<std::size_t>(bytes.size(), 400));
    const std::size_t length = std::min(below(40), bytes.size() - at);
    const auto begin = bytes.begin() + std::ptrdiff_t(at), end = begin + std::ptrdiff_t(length);
    switch (random() % 5) {
      case 0:
        *begin = std::uint8_t(random());
        break;
      case 1:
        *begin ^= std::uint8_t(1u << random() % 8);
        break;
      case 2:
        bytes.erase(begin, end);
        break;
      case 3: {
        const Bytes copy(begin, end);
        bytes.insert(bytes.begin() + std::ptrdiff_t(below(bytes.size())), copy.begin(), copy.end());
        break;
      }
      default:
        std::fill(begin, end, random() % 2 == 0 ? std::uint8_t(0) : std::uint8_t(255));
    }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::vector<std::filesystem::path> seeds;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) seeds.push_back(entry.path());
  std::ranges::sort(seeds);
  if (seeds.empty()) {
    std::fprintf(stderr, "%s: no seeds\n", argv[1]);
    return 1;
  }
  std::size_t runs = 0, taken = 0;
  for (const auto& seed : seeds) {
    std::ifstream file(seed, std::ios::binary);
    const Bytes bytes{std::istreambuf_iterator<char>(file), {}};
    if (!accepted(bytes)) {
      std::fprintf(stderr, "%s: refused; of an older format? Make it anew\n", seed.c_str());
      return 1;
    }
    std::mt19937 random(7);
    for (int i = std::atoi(argv[2]); i > 0; --i) taken += accepted(changed(bytes, random)) ? 1 : 0;
    runs += std::size_t(std::atoi(argv[2])) + 1;
  }
  std::printf("%zu runs of %zu seeds; %zu changes accepted\n", runs, seeds.size(), taken);
  return 0;
}
