#include "engine/view_gl/buffer_upload.h"

#include <algorithm>

namespace acentric {

std::size_t storageLimit(std::size_t largestBuffer) {
  GLint64 driversLargest = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &driversLargest);
  const std::size_t limit = std::size_t(std::max<GLint64>(driversLargest, 0));
  return largestBuffer > 0 ? std::min(limit, largestBuffer) : limit;
}

GlBuffer BufferUpload::add(std::span<const std::byte> bytes, std::shared_ptr<const void> owned) {
  if (bytes.empty()) return {};
  GlBuffer buffer = GlBuffer::make();
  parts_.push_back({buffer.name(), bytes, std::move(owned)});
  bytes_ += bytes.size();
  return buffer;
}

std::size_t BufferUpload::send(std::size_t most) {
  std::size_t sent = 0;
  while (!done() && sent < most) {
    Part& part = parts_[next_];
    const std::size_t count = std::min(part.bytes.size() - sentOfNext_, most - sent);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, part.buffer);
    if (sentOfNext_ == 0)
      glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(part.bytes.size()), nullptr, GL_STATIC_DRAW);
    glBufferSubData(GL_SHADER_STORAGE_BUFFER, GLintptr(sentOfNext_), GLsizeiptr(count),
                    part.bytes.data() + sentOfNext_);
    sent += count, sentOfNext_ += count;
    if (sentOfNext_ < part.bytes.size()) continue;
    part.owned.reset();
    ++next_, sentOfNext_ = 0;
  }
  return sent;
}

}  // namespace acentric
