/// What the page has of the engine, as a module of WebAssembly: it reads files (read_pack.cpp,
/// read_local.cpp) and plans frames (plan_frame.cpp). A module that traps is not used again: memory is out,
/// or what it read is refused, and then message() says why.

#include "web/runtime/module.h"

#include <cstddef>
#include <cstdlib>
#include <typeinfo>

#include "engine/export/bundle_read.h"
#include "engine/export/checked_json.h"
#include "engine/geometry/predicates/orientation.h"

namespace acentric {

std::string moduleMessage;
std::vector<std::byte> moduleBytes;
Bundle moduleBundle;

/// In place of CGAL's: differences of coordinates are exact in this format where their exponents differ by
/// less than 60, and so are the two products. Plans lie within a million metres of the origin.
int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  using Quad = long double;  // IEEE binary128 on this machine
  const Quad left = (Quad(a.x) - c.x) * (Quad(b.y) - c.y), right = (Quad(a.y) - c.y) * (Quad(b.x) - c.x);
  return left > right ? 1 : left < right ? -1 : 0;
}

}  // namespace acentric

using namespace acentric;

EXPORTED(message) const char* message() { return moduleMessage.c_str(); }
/// Room for so many.
EXPORTED(takeBytes) std::byte* takeBytes(std::size_t bytes) {
  moduleBytes.resize(bytes);
  return moduleBytes.data();
}
/// The index that was taken. 0 where it is refused.
EXPORTED(openIndex) int openIndex() {
  const std::string text(reinterpret_cast<const char*>(moduleBytes.data()), moduleBytes.size());
  moduleBytes = {};
  auto bundle = parseBundle(text, "");
  if (!bundle) {
    moduleMessage = bundle.error().message;
    return 0;
  }
  moduleBundle = std::move(*bundle);
  return 1;
}

// What is not in the module's standard library, or stays outside.

/// zstd, on the page's side; the number of bytes, or more than `room`.
__attribute__((import_module("page"), import_name("unpack"))) extern "C" std::size_t unpackZstd(
    void* into, std::size_t room, const void* from, std::size_t bytes);
extern "C" std::size_t ZSTD_decompress(void* into, std::size_t room, const void* from, std::size_t bytes) {
  return unpackZstd(into, room, from, bytes);
}
extern "C" unsigned ZSTD_isError(std::size_t result) { return result > std::size_t(1) << 31; }
extern "C" const char* ZSTD_getErrorName(std::size_t) { return "it does not unpack"; }

/// Nothing catches: what is thrown ends the module, with a message where it is of what was read.
extern "C" void* __cxa_allocate_exception(std::size_t size) { return std::malloc(size); }
extern "C" [[noreturn]] void __cxa_throw(void* thrown, std::type_info* type, void*) {
  if (*type == typeid(CheckedJson::Refused)) {
    const auto& refused = *static_cast<const CheckedJson::Refused*>(thrown);
    moduleMessage = refused.pointer + ": " + refused.reason;
  } else {
    moduleMessage = "it takes more memory than there is";
  }
  __builtin_trap();
}
extern "C" int madvise(void*, std::size_t, int) { return 0; }
