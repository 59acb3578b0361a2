#include "engine/base/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace acentric {

Result<std::shared_ptr<const MappedFile>> MappedFile::open(const std::filesystem::path& path) {
  const auto failed = [&](ErrorKind kind, const char* what, int code) {
    return fail(kind, fmt::format("{}: {}", what, std::strerror(code)), path.string());
  };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    return failed(errno == ENOENT ? ErrorKind::notFound : ErrorKind::unreadable,
                  "cannot be opened for reading", errno);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor);
    return fail(ErrorKind::unreadable, "is not a regular file", path.string());
  }
  const auto size = std::size_t(status.st_size);
  void* const start = size == 0 ? nullptr : ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  const int code = errno;
  ::close(descriptor);  // the mapping stays
  if (start == MAP_FAILED)
    return failed(code == ENOMEM ? ErrorKind::outOfSpace : ErrorKind::unreadable, "cannot be mapped", code);
  return std::shared_ptr<const MappedFile>(new MappedFile({static_cast<const std::byte*>(start), size}));
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace acentric
