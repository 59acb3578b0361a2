#pragma once
/// Vectors that are read here and there while they are many megabytes: on large pages where the system has
/// them, because finding the page of each read costs as much as the read.

#include <cstddef>
#include <new>
#include <vector>

namespace acentric {

/// Asks that the memory lie on large pages; does nothing where there are none.
void adviseLargePages(void* memory, std::size_t bytes);

template <class T>
struct LargeAllocator {
  using value_type = T;
  static constexpr std::size_t kPage = std::size_t(1) << 21;  ///< of x86-64 and of most of the others

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}

  T* allocate(std::size_t count) {
    if (count > std::size_t(-1) / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = count * sizeof(T);
    void* const memory = ::operator new(bytes, alignmentOf(count));
    if (bytes >= kPage) adviseLargePages(memory, bytes);
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) { ::operator delete(memory, alignmentOf(count)); }
  template <class U>
  bool operator==(const LargeAllocator<U>&) const {
    return true;
  }

 private:
  static std::align_val_t alignmentOf(std::size_t count) {
    return std::align_val_t(count * sizeof(T) >= kPage ? kPage : alignof(std::max_align_t));
  }
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace acentric
