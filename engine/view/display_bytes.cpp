#include "engine/view/display_bytes.h"

namespace acentric {
namespace {

template <class T, class Allocator>
std::size_t bytesOf(const std::vector<T, Allocator>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

std::size_t bytesOf(const DisplayCapture& c) {
  const DisplayBackground& b = c.background;
  return sizeof c + bytesOf(c.columnStart) + bytesOf(c.samples) + bytesOf(c.colour) +
         bytesOf(c.columnDirection) + bytesOf(c.rowTangent) + bytesOf(c.columnRange) + bytesOf(c.mirror) +
         (c.patches ? c.patches->bytes() : 0) + b.runs.bytes() + bytesOf(b.columnBorder) +
         bytesOf(b.rowBorder) + (c.reflections ? bytesOf(*c.reflections) : 0);
}

}  // namespace acentric
