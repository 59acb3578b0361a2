// The page's module runs on one thread.
#pragma once

#include <cstddef>

namespace acentric {

class TaskRunner {
 public:
  int threads() const { return 1; }
  template <class Body>
  void parallelFor(std::size_t count, const Body& body) {
    for (std::size_t i = 0; i < count; ++i) body(i);
  }
};

}  // namespace acentric
