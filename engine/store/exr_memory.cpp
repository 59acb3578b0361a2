#include "engine/store/exr_memory.h"

#include <cstring>
#include <stdexcept>

namespace acentric {

void ExrMemoryOutput::write(const char bytes[], int count) {
  const std::size_t size = static_cast<std::size_t>(count);
  if (bytes_.size() < position_ + size) bytes_.resize(position_ + size);
  std::memcpy(bytes_.data() + position_, bytes, size);
  position_ += size;
}

bool ExrMemoryInput::read(char out[], int count) {
  if (count < 0 || position_ > bytes_.size() || static_cast<std::size_t>(count) > bytes_.size() - position_)
    throw std::runtime_error("it ends too early");
  std::memcpy(out, bytes_.data() + position_, static_cast<std::size_t>(count));
  position_ += static_cast<std::size_t>(count);
  return position_ < bytes_.size();
}

}  // namespace acentric
